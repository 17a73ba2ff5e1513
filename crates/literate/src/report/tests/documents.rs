//! Makes several documents of one edition, which refer to each other.

use super::*;

#[test]
fn documents_refer_to_each_other() {
    const FRONT: Document = Document {
        prose: "front",
        name: "Front",
        markdown: "README.md",
        page: "index.html",
        print: None,
        repeats: true,
        ..Document::REPORT
    };
    const MORE: Document = Document {
        prose: "more",
        name: "More",
        letter: "S",
        markdown: "more.md",
        page: "more.html",
        print: Some("more"),
        repeats: false,
    };
    let (prose, parts) = include_str!("documents.txt").split_once("\n\n").unwrap();
    let with = |from: &str, to: &str| {
        let given = given("");
        let documents = vec![FRONT, Document::REPORT, MORE];
        let edition = Edition { documents, equations: Vec::new(), ..given.edition };
        let file = |line: &'static str| {
            let (path, markdown) = line.split_once(" => ").unwrap();
            (path, unmarked(markdown).replace(from, to))
        };
        let files = prose.lines().map(file).collect();
        Given { files, edition, ..given }.made()
    };
    let error = with("", "").unwrap_err().to_string();
    assert!(error.starts_with("report/02-second.md:3:24: [@sec:b.]: nothing"), "{error}");
    let report = with("[@sec:b.]", "[@sec:b]").unwrap();
    has(&report, parts);
    let markdown = file(&report, "report.md");
    assert!(markdown.find("First") < markdown.find("Last"));
    let error = with("# More", "# More\n\n![Again.](figures/fig03.svg)").unwrap_err().to_string();
    assert!(error.contains("fig:fig03: two things"), "{error}");
}

#[test]
fn a_relation_is_shown_where_it_has_a_place() {
    let prose = "<% for c in relations %>[!claim:«c.id»] «c.statement»: «c.verdict»\n<% endfor %>\n\n[@claim:closed]\n";
    for (more, is_shown) in [(prose, true), ("", false)] {
        let given = given(&format!("{PROSE}\n\n{more}"));
        let relation = Check { kind: Kind::Relation, ..claim("closed") };
        let claims = [given.claims.clone(), vec![relation]].concat();
        let report = Given { claims, ..given }.made().unwrap();
        let markdown = file(&report, "report.md");
        assert_eq!(markdown.contains("exists: reproduced"), is_shown, "{markdown}");
        assert_eq!(file(&report, "ledger.json").contains("\"closed\""), is_shown);
    }
}

#[test]
fn a_page_names_its_address_and_its_doi_where_there_are_any() {
    let page = |address, doi| {
        let given = given(PROSE);
        let edition = Edition { address, doi, ..given.edition };
        file(&Given { edition, ..given }.made().unwrap(), "report.html")
    };
    let foot = "<a href=\"https://example.org/a&amp;b\">https://example.org/a&amp;b</a></p>";
    let full = page("https://example.org/a&b", "10.5281/zenodo.1");
    assert!(full.contains(foot), "{full}");
    assert!(full.contains("  doi    = {10.5281/zenodo.1},\n  url    = {https://"), "{full}");
    let empty = page("", "");
    assert!(!empty.contains("where to report") && !empty.contains("url    ="));
    assert!(empty.contains("},\n}</pre>"), "{empty}");
}

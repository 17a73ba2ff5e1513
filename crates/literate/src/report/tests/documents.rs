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
    let files = [
        (
            "front.md",
            "# Front\n\n![Again.](figures/fig03.svg)\n\nSee [@sec:b], [@sign:rise] and [more](more.md).",
        ),
        ("report/02-second.md", "## Last {#sec:last}\n\nWords, [@row:rise] and [@sec:b.]"),
        (
            "report/01-first.md",
            "# Report\n\n## Abstract\n\nIt *rises*.\n\n## First {#sec:first}\n\n![The rise.](figures/fig03.svg)",
        ),
        (
            "more.md",
            "# More\n\n## A {#sec:a}\n\n### B {#sec:b}\n\n«v.half_height», [@fig:fig03], [@sec:last].\n\n\
          Table: T {#tab:t}\n\n| a |\n|---|\n| [!claim:rise] |",
        ),
    ];
    let with = |from: &str, to: &str| {
        let given = given("");
        let documents = vec![FRONT, Document::REPORT, MORE];
        let edition = Edition { documents, equations: Vec::new(), ..given.edition };
        let files = files.map(|(path, markdown)| (path, markdown.replace(from, to))).to_vec();
        Given { files, edition, ..given }.made()
    };
    let error = with("", "").unwrap_err().to_string();
    assert!(error.starts_with("report/02-second.md:3:24: [@sec:b.]: nothing"), "{error}");
    let report = with("[@sec:b.]", "[@sec:b]").unwrap();
    let parts = r##"
README.md => # Front⏎⏎<a id="fig-fig03"></a>⏎![It rises \[steeply\].](figures/fig03.svg)⏎⏎**Figure 1.**
report.md => # Report⏎⏎*A. Uthor (R & D), B. Uthor, 2026-11-24*⏎⏎## Abstract⏎⏎It *rises*.⏎⏎## 
report.html => </h1>⏎<p class="byline">A. Uthor (R &amp; D), B. Uthor, 2026-11-24
report.html => <section class="abstract">⏎<h2 id="abstract"><a href="#abstract">Abstract</a></h2>⏎<p>It <em>rises</em>.</p>⏎</section>⏎<h2
report.tex => \author{A. Uthor\\{\small R \& D} \and B. Uthor}⏎\date{2026-11-24}⏎
report.tex => \maketitle⏎⏎\begin{abstract}⏎⏎It \emph{rises}.⏎\end{abstract}⏎⏎\section{First}
README.md => See [Sec.·S1.1](more.md#sec-b), [✓](more.md#claim-rise) and [more](more.md).
index.html => <a href="more.html#sec-b">Sec.·S1.1</a>
index.html => title="reproduced" data-card="claim:rise">✓</a> and <a href="more.html">more</a>.
index.html => <li><a href="index.html" aria-current="page">Front</a></li>
report.md => Words, <sup>[✓·1](more.md#claim-rise)</sup> and
report.tex => Words, \textsuperscript{\ensuremath{\checkmark}~1} and Sec.~S1.1
more.md => [Fig.·1](report.md#fig-fig03), [Sec.·2](report.md#sec-last).
more.md => **Table S1.** T
more.tex => \renewcommand{\thesection}{S\arabic{section}}"##;
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

//! A report of one document that uses everything, and everything that can be wrong with it.

mod broken;
mod damaged;
mod data;

use super::filler::Filler;
use super::*;
use crate::claims::{Check, Kind};
use crate::figures::Figure;
use crate::figures::prelude::{HPos, INK, Sheet, VPos, words};
use crate::project::Project;
use crate::prose::Templates;
use crate::source::toy;
use crate::table::{DataFile, Table, Tables};
use crate::value::Value;
use impact_numerics::estimates::with_error;
use std::sync::Arc;

const BIB: &str = "@article{rice1945, author={Rice, S. O.}, title={Noise}, journal={B}, year=1945}
    @book{timeless, author={A}, title={T}} @book{han, author={漢}, title={T}, year=1}";

const SAMPLE: &str = include_str!("sample.md");

/// Text in one line: `⏎` ends a line in it, and `·` is a blank that does not break.
fn unmarked(line: &str) -> String {
    line.replace('⏎', "\n").replace('·', "\u{a0}").replace('␇', "\u{7}")
}

/// Asserts that the files of a report have these parts, one a line, each behind its file.
fn has(report: &Files, parts: &str) {
    for line in parts.lines().skip(1) {
        let (path, part) = line.split_once(" => ").unwrap();
        let (content, part) = (file(report, path), unmarked(part));
        assert!(content.contains(&part), "{part:?} is not in\n{content}");
    }
}

/// A title is plain text where no markup is read; signs that others read are escaped.
#[test]
fn each_format_shows_what_is_meant() {
    let [svg, pdf] = [&b"<svg/>"[..], b"%PDF-1.5"];
    let picture = Figure::picture(&[svg, pdf], "The set-up", crate::describe!("Balls on [rods]."));
    let picture = Figure { id: "photo".into(), ..picture.unwrap() };
    let (claims, figures) = (vec![claim("rise"), claim("jump")], vec![figure(), picture]);
    let report = Given { claims, figures, ..given(SAMPLE) }.made().unwrap();
    has(&report, include_str!("sample.txt"));
    let [markdown, tex] = ["report.md", "report.tex"].map(|path| file(&report, path));
    assert!(!markdown.contains("\n\n\n"), "{markdown}");
    assert_eq!(tex.matches("self.b +=").count(), 1, "{tex}");
}

fn figure() -> Figure {
    let sheet = Sheet::new(400);
    let style = words(200, INK, HPos::Left, VPos::Bottom);
    sheet.area.draw_text("(a)", &style, (0, 300)).unwrap();
    let words = |row: [&str; 2]| row.map(String::from).to_vec();
    let (name, rows) = ("fig03.csv".into(), vec![words(["0.1", "2"])]);
    let data = DataFile { name, header: words(["sigma", "mean"]), rows };
    let figure = sheet.finish("The rise", crate::describe!("It rises [steeply]."));
    Figure { id: "fig03".into(), data: vec![data], ..figure }
}

fn claim(id: &'static str) -> Check {
    let result = crate::claims::text!("{}", with_error(0.11652, 0.0004));
    let check = Check::new(Kind::Statement, id, "A threshold | in [xx, {yy}^zz] @ exists", result);
    let mut judged =
        check.judged(true).with_tolerance(crate::claims::text!("{:1}", 0.005), "half a unit");
    (judged.place, judged.expected) = ("Sec. 2".into(), "σ ≈ 0.12".into());
    judged
}

struct Given {
    files: Vec<(&'static str, String)>,
    edition: Edition,
    lab: Option<&'static str>,
    figures: Vec<Figure>,
    claims: Vec<Check>,
    table: Option<Table>,
}

impl Given {
    fn made(self) -> Result<Files, Error> {
        let mut values = ValueRegistry::default();
        values.add(Value::integer("half_height", with_error(0.11652, 0.0004)))?;
        values.add(Value::real("tiny", -8.87e-4, 3))?;
        values.add(Value::real("least", 1e-9, 1))?;
        values.add(Value::integer("kept", with_error(0.945, 0.008)))?;
        values.add(Value::integer("count", 12345))?;
        let empty = Value::real("empty", 0.0, 1);
        values.add(Value { number: values::Number::None, ..empty })?;
        if let Some(table) = self.table {
            values.add_tables(&Tables::from([(table.name(), Arc::new(table))]))?;
        }
        let templates = self.files.iter().map(|(path, text)| (*path, text.as_str()));
        let templates = &Templates::from_files(templates.chain([("references.bib", BIB)]));
        assemble(
            Filler::new(templates)?,
            &Input {
                templates,
                values: &values,
                declared: &Default::default(),
                rows: &Default::default(),
                claims: &self.claims,
                figures: &self.figures,
                lab: self.lab,
                top: Some("../"),
                edition: &self.edition,
                project: &Project::new(toy()),
                experiments: &[],
                warn: &|_| (),
            },
        )
    }
}

fn given(prose: &str) -> Given {
    let (what, home) = ("the jump".into(), "toy::flight".into());
    let (number, section, digits, step_towards) = (18, 7, None, None);
    let equation = ledger::EquationEntry { number, section, digits, what, home, step_towards };
    let authors = vec![("A. Uthor", "R & D"), ("B. Uthor", "")];
    let edition = Edition::new("toy");
    Given {
        files: vec![("report.md", prose.into())],
        edition: Edition { authors, date: "2026-11-24", equations: vec![equation], ..edition },
        lab: None,
        figures: vec![figure()],
        claims: vec![claim("rise")],
        table: None,
    }
}

fn assembled(prose: &str) -> Result<Files, Error> {
    given(prose).made()
}

fn file(report: &Files, path: &str) -> String {
    String::from_utf8(report[path].clone()).unwrap()
}

const PROSE: &str = "# Title\n\nAt «v.half_height», [@rice1945]. $$x = y \\tag{18}$$\n\n[@bibliography]\n\n\
    ![The rise.](figures/fig03.svg)\n\n| Id | Check |\n|---|---|\n\
    <% for c in claims %>| [!claim:«c.id»] | «c.statement»: «c.found», «c.verdict» |\n<% endfor %>";

#[test]
fn what_readers_run_is_offered_where_it_can_be_run() {
    let prose = PROSE.replace("[@bibliography]", "Lab toy: You run *them*.\n\n[@bibliography]");
    let mut without = assembled(&prose).unwrap();
    let mut with = Given { lab: Some("end();"), ..given(&prose) }.made().unwrap();
    let parts = r##"
report.html => <figure class="lab" id="lab-toy" data-lab="toy" hidden="">
report.html => You run <em>them</em>.
lab.js => end();"##;
    has(&with, parts);
    assert!(!file(&without, "report.html").contains("You run"));
    assert!(!without.contains_key("lab.js"));
    for report in [&mut with, &mut without] {
        report.retain(|path, _| !folder::is_generated(path));
    }
    assert!(with == without, "what is committed depends on the machine");
}

#[test]
fn a_report_is_all_its_files() {
    let report = assembled(PROSE).unwrap();
    let paths = report.keys().map(String::as_str).filter(|path| !path.starts_with("fonts/"));
    let expected = "SHA256SUMS SHA256SUMS.built cards.js data/fig03.csv data/index.html figures/fig03.pdf \
        figures/fig03.svg ledger.json points.js report.css report.html report.js report.md report.tex search.js values.json";
    assert_eq!(paths.collect::<Vec<_>>().join(" "), expected);
    assert_eq!(file(&report, "SHA256SUMS").lines().count(), 6);
    let parts = r##"
report.md => 1 | A threshold \| in [xx, {yy}^zz] @ exists: 0.1165(4), reproduced |
report.md => [fig03.csv](data/fig03.csv)
report.tex => At \origin{half_height}{0.1165(4)}, 
values.json => "score.reproduced"
SHA256SUMS => 5fbfa3bf9031ae769b4cb3a5cd6b9e1c235880438f409f9ec99217b60b1ecb17  data/fig03.csv⏎
data/index.html => <a href="fig03.csv">fig03.csv</a></td><td>"##;
    has(&report, parts);
    assert_eq!(assembled(PROSE).unwrap(), report);
}

#[test]
fn numerals_that_were_typed_outside_the_prose_are_refused() {
    for (note, fault) in [
        ("so at 12 s", "src/flight.rs:12: \"so at 12 s\": hard-coded number 12;"),
        ("7 of 0.35 m", "src/flight.rs:13: \"7 of 0.35 m\": hard-coded number 0.35;"),
        ("Eq. (25) at 98.98 s of Python 3.11", "src/flight.rs:14: \"Eq. (25) at 98.98 s of"),
        ("within ten of it", "src/flight.rs:14: \"within ten of it\": hard-coded number ten;"),
        ("Eq. (25) at 12, at 120 s, of Python 3.11, 14 s, 0.35", ""),
    ] {
        let claims = vec![claim("rise").note(note).with_tolerance("", note)];
        let made = Given { claims, ..given(PROSE) }.made();
        let error = made.err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.starts_with(fault) && error.is_empty() == fault.is_empty(), "{error}");
    }
    let with_digit = || given(&PROSE.replace("x = y", "x = 2 y"));
    for (digits, fails) in [(None, false), (Some("2"), false), (Some("3"), true)] {
        let mut given = with_digit();
        given.edition.equations[0].digits = digits;
        let error = given.made().err().map(|error| error.to_string()).unwrap_or_default();
        let fault = "equation (18) has the digits 2, in the list 3";
        assert_eq!(error.contains(fault), fails, "{error}");
    }
}

#[test]
fn a_table_is_turned_and_made_small_until_it_fits_or_refused() {
    for (columns, expected) in [
        (5, "\n\n{\\footnotesize\n\\begin{longtable}{lllll}"),
        (14, "\\begin{landscape}\n{\\tiny\n\\setlength{\\tabcolsep}{3pt}\n"),
        (16, "report.md:14:1: its 16 columns do not fit on a page"),
    ] {
        let rows = ["| h ", "|--", "| elevenwords "].map(|cell| cell.repeat(columns) + "|\n");
        let report = assembled(&format!("{PROSE}\n\n{}", rows.concat()));
        let tex = report.map_or_else(|error| error.to_string(), |files| file(&files, "report.tex"));
        assert!(tex.contains(expected), "{columns}: {tex}");
    }
}

#[test]
fn a_wrong_entry_stops_only_those_who_cite_it() {
    let error = assembled(&format!("{PROSE}\n\nBy [@timeless; @han].")).unwrap_err().to_string();
    let faults = ["2:5: timeless lacks its year", "2:44: han has the character '漢', which"];
    for (line, fault) in error.split('\n').zip(faults) {
        assert!(line.starts_with(&format!("references.bib:{fault}")), "{error}");
    }
    let library = bibliography::Library::read("references.bib", BIB).unwrap();
    let warnings: Vec<String> = library.warnings().collect();
    assert!(warnings[1].starts_with("references.bib:2:5: timeless, which nobody cites, lacks"));
    assert_eq!([error.lines().count(), warnings.len()], [2; 2], "{error}");
}

#[test]
fn what_is_not_shown_is_refused() {
    for (from, to, says) in [
        ("![The rise.](figures/fig03.svg)", "", "figure fig03 is not shown"),
        ("\\tag{18}", "", "equation (18) is not shown"),
    ] {
        let error = assembled(&PROSE.replace(from, to)).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
}

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

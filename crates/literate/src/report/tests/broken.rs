//! Breaks prose: each fault is named with its place.

use super::damaged::survives;
use super::*;

#[test]
fn faults_in_prose_are_reported_with_their_places() {
    let mut wrong = Vec::new();
    let deep = [("DEEP{", r"\sqrt{"), ("DEEP}", "}"), ("HATS", r"\hat "), ("QUOTES", "> ")];
    let deep = deep.into_iter().chain([("IN1IN", "("), ("ELIFS", "<% elif false %>a")]);
    let stars = ["**a ", " a**"].map(|sign| sign.repeat(201)).join("x");
    let deep = |line: &str| {
        deep.clone().fold(line.replace("STARS", &stars), |line, (name, sign)| {
            line.replace(name, &sign.repeat(201))
        })
    };
    // Broken prose, line and column of each error, and words of their messages; or a heading.
    for line in include_str!("broken.txt").lines().map(deep) {
        let parts: Vec<String> = line.split(" => ").map(unmarked).collect();
        let [broken, places, words] = parts.as_slice() else { continue };
        let made = assembled(&format!("{PROSE}\n\n{broken}\n"));
        let error = made.map_or_else(|error| error.to_string(), |_| "no error".into());
        let (lines, places) = (error.lines(), places.split(' '));
        let is_at = |(line, place): (&str, &str)| line.starts_with(&format!("report.md:{place}"));
        let placed =
            lines.clone().count() == places.clone().count() && lines.zip(places).all(is_at);
        if !placed || !error.contains(words.as_str()) {
            wrong.push(format!("{broken}: {error}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn good_prose_passes() {
    let none = Table::builder("toy.none", &[0.5; 0], |_| 0).key("x", "1", |x| *x).done();
    let prose = format!("{PROSE}\n\n{}", include_str!("good.md"));
    let report = Given { table: Some(none), ..given(&prose) }.made().unwrap();
    let markdown = file(&report, "report.md");
    assert!(markdown.contains("nothing, 12") && markdown.contains("| – |"), "{markdown}");
    let lists = assembled(&format!("{PROSE}\n\n1. a\n\n   3. c\n\n1) b\n")).unwrap();
    assert!(file(&lists, "report.md").contains("   3. c\n\n<!-- -->\n\n1. b\n"));
    let third = "\\begin{enumerate}\n\\setcounter{\\csname @enumctr\\endcsname}{2}\n\\item c";
    assert!(file(&lists, "report.tex").contains(third));
}

#[test]
fn no_reader_panics_or_hangs() {
    let report = assembled(PROSE).unwrap();
    survives("prose", &format!("{PROSE}\n\n{}", include_str!("nested.md")), 200, assembled);
    survives("references.bib", BIB, 100, |text| {
        bibliography::Library::read("", text).map(|library| library.warnings().count())
    });
    let values = |json: &str| serde_json::from_str::<ValueRegistry>(json);
    survives("values.json", &file(&report, "values.json"), 100, values);
    let ledger = |json: &str| serde_json::from_str::<ledger::Ledger>(json);
    survives("ledger.json", &file(&report, "ledger.json"), 100, ledger);
    let sums = |text: &str| folder::read_sums(text).ok_or("");
    survives("SHA256SUMS", &file(&report, "SHA256SUMS"), 1000, sums);
}

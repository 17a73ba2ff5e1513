//! codecheck.yml: which outputs a person is to compare, in the form that CODECHECK asks for.

use super::PAPER;
use super::archive::Archive;
use impact_paper::figures::{self, Number};
use std::fmt::Write;

/// The file. Strings are quoted as in JSON, which YAML reads too.
pub fn text(archive: &Archive) -> String {
    let mut out = String::from("---\nversion: https://codecheck.org.uk/spec/config/1.0/\n");
    out += "source: \"the folder of this file; README.md says how to run it, CERTIFICATE.md what to compare\"\n";
    out += "paper:\n  title: \"Impact Dynamics of Large Dimensional Systems\"\n  authors:\n";
    out += "    - name: \"Martin Homer\"\n    - name: \"S. John Hogan\"\n";
    out += "  reference: \"International Journal of Bifurcation and Chaos 17 (2007)\"\nmanifest:\n";
    let mut entry = |file: String, comment: &str| {
        if archive.get(&file).is_some() {
            let (file, comment) = (quoted(&file), quoted(comment));
            let _ = writeln!(out, "  - file: {file}\n    comment: {comment}");
        }
    };
    for number in figures::all() {
        let (name, comment) = match number {
            Number::Paper(n) => (format!("fig{n:02}"), format!("Figure {n} of the paper")),
            Number::Own(n) => (format!("s{n:02}"), format!("Figure S{n} of this edition")),
        };
        entry(format!("{PAPER}/figures/{name}.svg"), &comment);
    }
    entry(format!("{PAPER}/report.md"), "the report, with every number");
    entry(format!("{PAPER}/report.tex"), "the report for LaTeX");
    entry(format!("{PAPER}/values.json"), "every number that the report states");
    entry(format!("{PAPER}/ledger.json"), "every claim of the paper with its verdict");
    // For a person: nothing here is known before somebody checked.
    out += "codechecker:\n  - name: \"\"\n    ORCID: \"\"\nsummary: \"\"\nrepository: \"\"\n";
    out += "check_time: \"\"\ncertificate: \"\"\nreport: \"\"\n";
    out
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

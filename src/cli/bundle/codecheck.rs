//! codecheck.yml: which outputs a person is to compare, in the form that CODECHECK asks for.

use super::PAPER;
use super::archive::Archive;
use super::told::description;
use std::fmt::Write;

/// The file. Strings are quoted as in JSON, which YAML reads too.
pub fn text(archive: &Archive) -> String {
    let mut out = String::from("---\nversion: https://codecheck.org.uk/spec/config/1.0/\n");
    out += "source: \"the folder of this file; README.md says how to run it, CERTIFICATE.md what to compare\"\n";
    out += "paper:\n  title: \"Impact Dynamics of Large Dimensional Systems\"\n  authors:\n";
    out += "    - name: \"Martin Homer\"\n    - name: \"S. John Hogan\"\n";
    out += "  reference: \"International Journal of Bifurcation and Chaos 17 (2007)\"\nmanifest:\n";
    let pictures = archive.paths().filter(|path| path.ends_with(".svg"));
    let texts = ["report.md", "report.tex", "values.json", "ledger.json"];
    let texts = texts.map(|name| format!("{PAPER}/{name}"));
    let report = pictures.filter(|path| path.starts_with(PAPER));
    for path in report.chain(texts.iter().map(String::as_str)) {
        let (file, comment) = (quoted(path), quoted(&description(path)));
        let _ = writeln!(out, "  - file: {file}\n    comment: {comment}");
    }
    // For a person: nothing here is known before somebody checked.
    out += "codechecker:\n  - name: \"\"\n    ORCID: \"\"\nsummary: \"\"\nrepository: \"\"\n";
    out += "check_time: \"\"\ncertificate: \"\"\nreport: \"\"\n";
    out
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

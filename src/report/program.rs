//! This program, as the documents speak of it.

use super::Document;
use super::recipe::recipe;
use crate::committed;
use literate::source::Program;

/// This program.
pub const PROGRAM: Program = Program {
    sources: include!(concat!(env!("OUT_DIR"), "/sources.rs")),
    crates: &[("impact_paper::", "")],
    quoted: &["impact_numerics::", "impact_chain::", "impact_circuits::"],
    recipe,
    judge: |claim| format!("claims::{}", claim.split('_').next().unwrap_or_default()),
    exists: committed::exists,
    documents: &DOCUMENTS,
    about: &ABOUT,
};

/// As in CITATION.cff.
const ABOUT: [(&str, &str); 6] = [
    ("author", "The impact-paper authors"),
    ("citation_author", "The impact-paper authors"),
    ("citation_title", "impact-paper"),
    ("citation_publication_date", "2026-11-24"),
    ("version", env!("CARGO_PKG_VERSION")),
    ("license", "MIT OR Apache-2.0"),
];

/// A reader has five minutes, half an hour, or a day.
const DOCUMENTS: [Document; 5] = [
    Document {
        prose: "front",
        name: "Overview",
        markdown: "README.md",
        page: "index.html",
        print: None,
        repeats: true,
        ..Document::REPORT
    },
    Document { prose: "edition", name: "Edition", ..Document::REPORT },
    Document {
        prose: "beyond",
        name: "Beyond the paper",
        letter: "S",
        markdown: "beyond.md",
        page: "beyond.html",
        print: Some("beyond"),
        ..Document::REPORT
    },
    Document {
        prose: "methods",
        name: "Methods",
        letter: "M",
        markdown: "methods.md",
        page: "methods.html",
        print: Some("methods"),
        ..Document::REPORT
    },
    Document {
        prose: "ledger",
        name: "Ledger",
        letter: "L",
        markdown: "ledger.md",
        page: "ledger.html",
        print: None,
        ..Document::REPORT
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use literate::source::{declared, items};

    #[test]
    fn every_item_is_whole() {
        let quoted = |module: &&str| {
            PROGRAM.quoted.iter().any(|layer| format!("{module}::").starts_with(layer))
        };
        for (module, _, text) in PROGRAM.sources.iter().filter(|(module, ..)| quoted(module)) {
            for (name, _, lines) in items(text) {
                let text = lines.join("\n");
                let count = |c| text.matches(c).count();
                assert_eq!(count('{'), count('}'), "{module}::{name}:\n{text}");
            }
        }
    }

    #[test]
    fn no_item_hides_in_the_one_before() {
        for (module, _, text) in
            PROGRAM.sources.iter().filter(|(own, ..)| !own.ends_with("::tests"))
        {
            let items = items(text);
            let lines = text.lines().take_while(|line| *line != "#[cfg(test)]");
            let outside = |line: &str| !line.starts_with(' ') && declared(line).is_some();
            for (i, line) in lines.enumerate().filter(|(_, line)| outside(line)) {
                assert!(items.iter().any(|(_, at, _)| *at == i), "{module}: {line}");
            }
        }
    }

    /// A module has the place of its file.
    #[test]
    fn items_have_a_place() {
        let jump = PROGRAM.place("impact_circuits::jump::p_jump", |_| None).unwrap();
        assert_eq!(jump.file, "crates/circuits/src/jump.rs");
        let text = std::fs::read_to_string(jump.file).unwrap();
        assert!(text.lines().nth(jump.line - 1).unwrap().contains("fn p_jump"));
        assert_eq!(PROGRAM.place("claims::sec8", |_| None).unwrap().line, 1);
    }

    #[test]
    fn a_renamed_item_is_refused() {
        let error = PROGRAM.item("impact_circuits::jump::p_yump").unwrap_err();
        assert!(error.contains("`p_yump`") && error.contains("p_jump, "), "{error}");
        assert!(
            PROGRAM.item("impact_circuits::yump::p_jump").unwrap_err().contains("there is no item")
        );
        let error = PROGRAM.item("cli::run").unwrap_err();
        assert!(
            error.contains("no such module; begin with one of impact_numerics::…, impact_chain::…"),
            "{error}"
        );
        assert!(PROGRAM.item("impact_chain::flight::Phases::kick").is_err());
    }
}

//! This program, as the documents speak of it.

use super::Document;
use super::recipe::recipe;
use crate::committed;
use crate::experiments::built::FILES;
use literate::source::{Listing, Program};

/// This program.
pub const PROGRAM: Program = Program {
    files: FILES,
    crates: &[
        ("impact_numerics", "crates/numerics/src"),
        ("impact_chain", "crates/impact-chain/src"),
        ("impact_circuits", "crates/circuits/src"),
        ("literate", "crates/literate/src"),
        ("", "src"),
    ],
    name: "impact_paper::",
    listings: &LISTINGS,
    recipe,
    judge: |claim| format!("claims::{}", claim.split('_').next().unwrap_or_default()),
    exists: committed::exists,
    documents: &DOCUMENTS,
    about: &ABOUT,
};

/// An item and its file.
macro_rules! listing {
    ($item:path, $file:literal) => {
        Listing {
            item: stringify!($item),
            file: $file,
            text: include_str!(concat!("../../", $file)),
        }
    };
}

/// What the documents quote, in the order of the paper.
const LISTINGS: [Listing; 8] = [
    listing!(impact_chain::flight::Motion::kick, "crates/impact-chain/src/flight.rs"),
    listing!(impact_chain::impact::jumps, "crates/impact-chain/src/impact.rs"),
    listing!(impact_circuits::counting::phi, "crates/circuits/src/counting.rs"),
    listing!(impact_circuits::jump::p_jump, "crates/circuits/src/jump.rs"),
    listing!(impact_circuits::jump::first_is_exceeded, "crates/circuits/src/jump.rs"),
    listing!(
        impact_circuits::impact_probability::ImpactProbability::leading,
        "crates/circuits/src/impact_probability.rs"
    ),
    listing!(impact_chain::search::stepping::stretch, "crates/impact-chain/src/search/stepping.rs"),
    listing!(
        impact_chain::search::stepping::first_root_by_steps,
        "crates/impact-chain/src/search/stepping.rs"
    ),
];

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

    #[test]
    fn each_listing_is_one_whole_item_of_its_file() {
        for Listing { item, file, text } in LISTINGS {
            assert_eq!(PROGRAM.file(item), Some(file));
            let lines = PROGRAM.listing(item).unwrap().lines();
            let name = item.rsplit("::").next().unwrap();
            assert_eq!(text.matches(&format!("// listing: {name}\n")).count(), 1, "{item}");
            assert!(lines.starts_with("///") && lines.ends_with("\n}"), "{lines}");
            assert!(lines.contains(&format!("fn {name}")), "{lines}");
        }
    }
}

//! Starts the program `impact-paper`: `paper` lists what the paper is made of, `DOCUMENTS` its
//! documents, and `cli` has the verbs that it adds to those of [`literate::cli`]. The parts are in
//! [`impact_paper`].

// Macros that print panic on a closed pipe or a full disk: `literate::cli::terminal` does not.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
#![warn(clippy::print_stderr, clippy::print_stdout)]

mod cli;

use impact_paper::{claims, contents, equations, experiments, figures, lab};
use literate::Paper;
use literate::report::{Document, Edition};
use std::process::ExitCode;

fn main() -> ExitCode {
    paper().cli_with(cli::run)
}

pub fn paper() -> Paper {
    let paper = experiments::bare();
    Paper {
        edition: Edition {
            // What owner.toml says, by way of Cargo.toml.
            authors: env!("CARGO_PKG_AUTHORS").split(':').map(|name| (name, "")).collect(),
            address: env!("CARGO_PKG_REPOSITORY"),
            doi: "",
            date: "2026-11-28",
            license: "text and figures CC BY 4.0, code MIT OR Apache-2.0",
            cover: Some("fig12"),
            links: vec![
                ("Report a problem", "../CONTRIBUTING.md"),
                ("the original", "report.html#ref-homer2007"),
                ("what journals ask", "../REPRODUCTION.md"),
                ("licence", "../LICENSE-CC-BY"),
            ],
            documents: DOCUMENTS.to_vec(),
            equations: equations::equations(),
            judged_by: |claim| format!("claims::{}", claim.split('_').next().unwrap_or_default()),
            ..paper.edition
        },
        figures: figures::ALL.to_vec(),
        rules: claims::rules(),
        values: vec![contents::values],
        rows: Some(contents::rows),
        lab: Some(lab::lab),
        ..paper
    }
}

/// A document whose files have the name of its prose.
macro_rules! document {
    ($prose:literal, $name:literal, $letter:literal) => {
        Document {
            prose: $prose,
            name: $name,
            letter: $letter,
            markdown: concat!($prose, ".md"),
            page: concat!($prose, ".html"),
            print: Some($prose),
            ..Document::REPORT
        }
    };
}

/// The documents: overview (five minutes), edition (half an hour), second paper, methods, ledger.
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
    document!("beyond", "Beyond the paper", "S"),
    document!("methods", "Methods", "M"),
    Document { print: None, ..document!("ledger", "Ledger", "L") },
];

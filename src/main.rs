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
            authors: vec![("The impact-paper authors", "")],
            date: "2026-11-27",
            license: "text and figures CC BY 4.0, code MIT OR Apache-2.0",
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

//! A literate, reproducible edition of M. Homer and S. J. Hogan (2007), *Impact Dynamics of Large
//! Dimensional Systems*: every number and figure of that paper, computed and checked.
//!
//! In the order of the paper, with links to the report that `make paper` has written:
//!
//! - [Section 1](../../../paper/report.html#sec-introduction) and
//!   [Section 2](../../../paper/report.html#sec-simulation), the chain of forced masses and its
//!   impacts: [`impact_chain`].
//! - [Section 3](../../../paper/report.html#sec-graph) to
//!   [Section 7](../../../paper/report.html#sec-jump), circuits of the impact graph, their
//!   probability, the jump: [`impact_circuits`].
//! - [Section 8](../../../paper/report.html#sec-relation), how p follows from σ:
//!   [`impact_circuits::impact_probability`].
//! - [Section 9](../../../paper/report.html#sec-higher), circuits that are not simple:
//!   [`impact_circuits::higher_order`].
//! - What is run, with which parameters: [`experiments`] and [`params`]; in the report
//!   [the method](../../../paper/methods.html#sec-method) and its
//!   [speed and accuracy](../../../paper/methods.html#sec-accuracy).
//! - What is shown: [`figures`], [`claims`], [`contents`] and the engine in the page ([`lab`]);
//!   [`paper`] puts it together. Where each equation is: [`mod@equations`].

// Macros that print panic on a closed pipe or a full disk: `literate::cli::terminal` does not.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
#![warn(clippy::print_stderr, clippy::print_stdout)]

pub mod claims;
pub mod contents;
pub mod equations;
pub mod experiments;
pub mod figures;
pub mod lab;
pub mod params;

use literate::Paper;
use literate::report::{Document, Edition};

/// Returns the paper: what it is made of, and its documents.
pub fn paper() -> Paper {
    let paper = experiments::bare();
    Paper {
        edition: Edition {
            authors: AUTHORS.to_vec(),
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

/// Names and affiliations, which `make owner` writes.
#[rustfmt::skip]
const AUTHORS: &[(&str, &str)] = &[("The impact-paper authors", "")];

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

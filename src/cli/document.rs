//! `--document`: one of the documents of a report.

use clap::builder::PossibleValuesParser;
use impact_paper::report::PROGRAM;

/// Narrows a verb to one document.
#[derive(clap::Args, Clone, Debug)]
pub struct Only {
    /// Only what this document shows; all documents without it.
    #[arg(long, value_name = "NAME", value_parser = names())]
    pub document: Option<String>,
}

fn names() -> PossibleValuesParser {
    PossibleValuesParser::new(PROGRAM.documents.iter().map(|document| document.prose))
}

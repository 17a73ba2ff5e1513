//! Typesetting: tagged for readers of screens (PDF/UA-1), so that figures and equations have alternative
//! text, headings an outline, references links. No clock, no font of the system: the same bytes each time.

use super::world::Paper;
use crate::figures::Figure;
use crate::report::Error;
use crate::report::document::Block;
use crate::report::templates::Templates;
use std::collections::BTreeMap;
use typst::diag::SourceDiagnostic;
use typst::foundations::Smart;
use typst_layout::PagedDocument;
use typst_pdf::{PdfOptions, PdfStandard, PdfStandards};

/// Typesets the report.
pub fn pdf(blocks: &[Block], figures: &[Figure], templates: &Templates) -> Result<Vec<u8>, Error> {
    let picture =
        |figure: &Figure| (format!("figures/{}.svg", figure.id), figure.svg.clone().into_bytes());
    let pictures: BTreeMap<String, Vec<u8>> = figures.iter().map(picture).collect();
    let paper = Paper::new(super::source(blocks, templates)?, pictures)
        .ok_or_else(|| Error::Typeset("no path".into()))?;
    let told = |list: &[SourceDiagnostic]| {
        let lines: Vec<String> = list.iter().take(3).map(|one| explained(&paper, one)).collect();
        Error::Typeset(lines.join("; "))
    };
    let document: PagedDocument = typst::compile(&paper).output.map_err(|errors| told(&errors))?;
    let standards = PdfStandards::new(&[PdfStandard::Ua_1])
        .map_err(|error| Error::Typeset(error.message().to_string()))?;
    let options = PdfOptions {
        ident: Smart::Custom("impact-paper".into()),
        standards,
        ..PdfOptions::default()
    };
    typst_pdf::pdf(&document, &options).map_err(|errors| told(&errors))
}

/// A message of the typesetter with the markup that it is about.
fn explained(paper: &Paper, diagnostic: &SourceDiagnostic) -> String {
    use typst::WorldExt;
    let range = paper.range(diagnostic.span);
    let near = range.and_then(|range| paper.source_text().text().get(range)).unwrap_or_default();
    let near: String = near.chars().take(80).collect();
    let hints: String = diagnostic.hints.iter().map(|hint| format!(" ({})", hint.v)).collect();
    format!("{}{hints} at `{near}`", diagnostic.message)
}

//! The tree → report.pdf, typeset inside the program (feature `pdf`).
//!
//! Tagged for readers of screens (PDF/UA-1): figures and equations have alternative text, headings
//! an outline, references links. No clock, no font of the system: the same bytes each time.

mod markup;
mod maths;
mod world;

use super::Error;
use super::document::Block;
use super::templates::Templates;
use crate::figures::Figure;
use std::collections::BTreeMap;
use typst::diag::SourceDiagnostic;
use typst::foundations::Smart;
use typst_layout::PagedDocument;
use typst_pdf::{PdfOptions, PdfStandard, PdfStandards};
use world::Paper;

/// Typesets the report.
///
/// # Errors
/// Mathematics that is not known, and whatever the typesetter or the standard refuses.
pub fn pdf(blocks: &[Block], figures: &[Figure], templates: &Templates) -> Result<Vec<u8>, Error> {
    let shell = templates.text("report.typ")?;
    let text = shell
        .replace("«title»", &markup::quoted(&markup::title(blocks)?))
        .replace("«body»", &markup::report(blocks)?);
    let picture =
        |figure: &Figure| (format!("figures/{}.svg", figure.id), figure.svg.clone().into_bytes());
    let pictures: BTreeMap<String, Vec<u8>> = figures.iter().map(picture).collect();
    let paper = Paper::new(text, pictures).ok_or_else(|| Error::Typeset("no path".into()))?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::document::Inline;

    fn report(tex: &str) -> Vec<Block> {
        vec![
            Block::Heading {
                level: 1,
                number: None,
                id: None,
                text: vec![Inline::Text("A \"title\" #[".into())],
            },
            Block::Heading {
                level: 2,
                number: Some("1".into()),
                id: Some("sec:a".into()),
                text: vec![Inline::Text("Words".into())],
            },
            Block::Paragraph(vec![
                Inline::Text("See ".into()),
                Inline::Reference { to: "eq:18".into(), shown: "Eq. (18)".into() },
                Inline::Text(" (and *this*_). ".into()),
                Inline::Display { tex: tex.into(), tag: Some("18".into()) },
            ]),
        ]
    }

    /// The same bytes twice, tagged, for the standard of accessible documents.
    #[test]
    fn a_report_is_typeset_and_is_the_same_twice() {
        let made = || pdf(&report(r"\frac{x}{2} = \sqrt{y}"), &[], &Templates::embedded()).unwrap();
        let bytes = made();
        assert!(bytes.starts_with(b"%PDF-1.7") && bytes == made());
        let holds = |what: &[u8]| bytes.windows(what.len()).any(|window| window == what);
        assert!(holds(b"/MarkInfo") && holds(b"pdfuaid:part"));
    }

    #[test]
    fn a_reference_to_nothing_is_an_error_that_says_so() {
        let mut blocks = report("x");
        blocks.truncate(2);
        let lost = Inline::Reference { to: "eq:19".into(), shown: "Eq. (19)".into() };
        blocks.push(Block::Paragraph(vec![lost]));
        let error = pdf(&blocks, &[], &Templates::embedded()).unwrap_err().to_string();
        assert!(error.contains("eq:19"), "{error}");
    }
}

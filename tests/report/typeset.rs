//! The PDF by the program itself (feature `pdf`).

use impact_paper::report::Templates;
use impact_paper::report::document::{Block, Inline};
use impact_paper::report::typeset::pdf;
use std::path::Path;

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
            Inline::Reference { to: "eq:18".into(), within: None, shown: "Eq. (18)".into() },
            Inline::Text(" (and *this*_). ".into()),
            Inline::Display { tex: tex.into(), tag: Some("18".into()) },
        ]),
    ]
}

/// The same bytes twice, tagged, for the standard of accessible documents.
#[test]
fn a_report_is_typeset_and_is_the_same_twice() {
    let made = || {
        pdf(
            &report(r"\frac{x}{2} = \sqrt{y}"),
            &[],
            &Templates::read(Path::new("templates")).unwrap(),
        )
        .unwrap()
    };
    let bytes = made();
    assert!(bytes.starts_with(b"%PDF-1.7") && bytes == made());
    let holds = |what: &[u8]| bytes.windows(what.len()).any(|window| window == what);
    assert!(holds(b"/MarkInfo") && holds(b"pdfuaid:part"));
}

#[test]
fn a_reference_to_nothing_is_an_error_that_says_so() {
    let mut blocks = report("x");
    blocks.truncate(2);
    let lost = Inline::Reference { to: "eq:19".into(), within: None, shown: "Eq. (19)".into() };
    blocks.push(Block::Paragraph(vec![lost]));
    let error = pdf(&blocks, &[], &Templates::read(Path::new("templates")).unwrap())
        .unwrap_err()
        .to_string();
    assert!(error.contains("eq:19"), "{error}");
}

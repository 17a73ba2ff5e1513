//! The documents as a host reads them: by a CommonMark parser with tables, which knows nothing of our
//! mathematics. What it makes of the text must be what the document means.

use crate::quick::QUICK;
use literate::report::{Document, Report};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

fn texts() -> impl Iterator<Item = (&'static Document, &'static str)> {
    QUICK.paper.documents.iter().map(|document| (document, QUICK.markdown(document)))
}

fn events(text: &str) -> Vec<Event<'_>> {
    Parser::new_ext(text, Options::ENABLE_TABLES).collect()
}

/// Links of a text, and places in it.
fn links(text: &str) -> (Vec<String>, Vec<String>) {
    let link = |event| match event {
        Event::Start(Tag::Link { dest_url: to, .. } | Tag::Image { dest_url: to, .. }) => {
            Some(to.to_string())
        }
        _ => None,
    };
    let places =
        text.split("<a id=\"").skip(1).map(|piece| piece.split('"').next().unwrap().into());
    (events(text).into_iter().filter_map(link).collect(), places.collect())
}

#[test]
fn every_link_lands_wherever_the_report_is_written() {
    let texts = |report: &Report| {
        let text = |of: &Document| {
            let text = std::str::from_utf8(&report.committed[of.markdown]).unwrap();
            (of.markdown.to_string(), links(text))
        };
        QUICK.paper.documents.iter().map(text).collect()
    };
    crate::quick::links_land(texts, 200, 150);
}

/// Mathematics comes through Markdown as it was written, escapes, stars and lows included: between
/// one dollar and the next the parser finds text and nothing else.
#[test]
fn mathematics_is_left_alone() {
    let formulas: usize = texts().map(|(_, text)| formulas(text)).sum();
    assert!(formulas > 400, "{formulas}");
}

fn formulas(text: &str) -> usize {
    let (mut code, mut plain) = (false, String::new());
    for event in events(text) {
        match event {
            Event::Start(Tag::CodeBlock(_)) => code = true,
            Event::End(TagEnd::CodeBlock) => code = false,
            Event::Text(piece) if !code => plain += &piece,
            Event::SoftBreak => plain.push('\n'),
            _ => plain.push('\0'),
        }
    }
    let plain = plain.replace("$$", "$");
    let pieces: Vec<&str> = plain.split('$').collect();
    assert!(pieces.len() % 2 == 1, "a formula without an end");
    let formulas = pieces.iter().skip(1).step_by(2);
    for tex in formulas.clone() {
        assert!(!tex.contains('\0') && text.contains(tex), "Markdown changed ${tex}$");
    }
    formulas.count()
}

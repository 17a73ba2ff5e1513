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
    let (mut formulas, mut open, mut code) = (0, None::<String>, false);
    for event in events(text) {
        match event {
            Event::Start(Tag::CodeBlock(_)) => code = true,
            Event::End(TagEnd::CodeBlock) => code = false,
            Event::Text(piece) if !code => {
                for (i, part) in piece.replace("$$", "$").split('$').enumerate() {
                    if i > 0 {
                        open = match open.take() {
                            None => Some(String::new()),
                            Some(tex) => {
                                formulas += 1;
                                let spelled = text.contains(tex.as_str());
                                assert!(spelled, "Markdown changed ${tex}$");
                                None
                            }
                        };
                    }
                    open.iter_mut().for_each(|tex| tex.push_str(part));
                }
            }
            Event::SoftBreak => open.iter_mut().for_each(|tex| tex.push('\n')),
            other => {
                let tex = open.as_deref();
                assert_eq!(tex, None, "Markdown finds {other:?} inside the formula");
            }
        }
    }
    assert_eq!(open, None);
    formulas
}

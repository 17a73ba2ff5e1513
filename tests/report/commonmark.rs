//! The documents as a host reads them: by a CommonMark parser with tables, which knows nothing of our
//! mathematics. What it makes of the text must be what the document means.

use crate::quick::QUICK;
use impact_paper::report::{Document, PROGRAM};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

fn texts() -> impl Iterator<Item = (&'static Document, &'static str)> {
    PROGRAM.documents.iter().map(|document| (document, QUICK.markdown(document)))
}

fn events(text: &str) -> Vec<Event<'_>> {
    Parser::new_ext(text, Options::ENABLE_TABLES).collect()
}

/// Ids that HTML in the text declares, each once.
fn anchors(text: &str) -> BTreeSet<&str> {
    let mut found = BTreeSet::new();
    for piece in text.split("<a id=\"").skip(1) {
        let id = piece.split('"').next().unwrap();
        assert!(found.insert(id), "the anchor {id} stands twice");
    }
    found
}

#[test]
fn every_link_lands_and_every_picture_is_there() {
    let anchors: BTreeMap<&str, BTreeSet<&str>> =
        texts().map(|(document, text)| (document.markdown, anchors(text))).collect();
    let (mut inside, mut across, mut pictures) = (0, 0, 0);
    for (document, text) in texts() {
        for event in events(text) {
            match event {
                Event::Start(Tag::Link { dest_url, .. }) if !dest_url.contains("://") => {
                    let (file, id) = dest_url.split_once('#').unwrap_or((&dest_url, ""));
                    let to = if file.is_empty() { document.markdown } else { file };
                    inside += usize::from(file.is_empty());
                    across += usize::from(!file.is_empty() && !id.is_empty());
                    if !id.is_empty() {
                        assert!(anchors[to].contains(id), "{}: no {dest_url}", document.markdown);
                    }
                    let source = to.strip_prefix("../").map(|path| Path::new(path).exists());
                    let made = QUICK.report.committed.contains_key(to)
                        || ["SHA256SUMS", "data"].contains(&to);
                    assert!(source.unwrap_or(made), "{}: no {dest_url}", document.markdown);
                }
                Event::Start(Tag::Image { dest_url, .. }) => {
                    pictures += usize::from(!document.repeats);
                    assert!(QUICK.report.committed.contains_key(&*dest_url), "no {dest_url}");
                }
                _ => {}
            }
        }
    }
    assert_eq!(pictures, impact_paper::figures::all().count());
    assert!(inside > 200 && across > 150, "{inside} {across}");
}

/// What the parser takes for text is what a reader sees: no markup is left over in it.
#[test]
fn no_markup_is_left_over() {
    texts().for_each(|(_, text)| whole(text));
}

fn whole(text: &str) {
    let mut code = false;
    let mut words = String::new();
    for event in events(text) {
        match event {
            Event::Start(Tag::CodeBlock(_)) => code = true,
            Event::End(TagEnd::CodeBlock) => code = false,
            Event::Text(piece) if !code => words.push_str(&piece),
            Event::SoftBreak | Event::HardBreak => words.push('\n'),
            Event::End(
                TagEnd::Paragraph | TagEnd::Item | TagEnd::TableCell | TagEnd::Heading(_),
            ) => {
                // Mathematics has its own rules.
                for (i, part) in words.split('$').enumerate() {
                    let left = ["**", "](", "```", "«", "»", "{#", "[@", "[!", "<%", "%>", "<a"];
                    let found = left.iter().find(|mark| i % 2 == 0 && part.contains(**mark));
                    assert_eq!(found, None, "{words}");
                }
                assert!(!words.contains(|c| ('\u{e000}'..='\u{f8ff}').contains(&c)), "{words}");
                words.clear();
            }
            _ => {}
        }
    }
    // An open fence would take the rest of the text.
    assert!(!code && words.is_empty());
    let fences = text.lines().filter(|line| line.trim_start().starts_with("```")).count();
    assert_eq!(fences % 2, 0);
    // HTML is ours: anchors, folds and small print.
    for event in events(text) {
        let (Event::Html(html) | Event::InlineHtml(html)) = event else { continue };
        let ours = "<a id=|</a>|<details>|</details>|<summary>|<sub>|</sub>|<sup>|</sup>";
        for line in html.lines().filter(|line| !line.trim().is_empty()) {
            assert!(ours.split('|').any(|tag| line.trim_start().starts_with(tag)), "{html}");
        }
    }
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

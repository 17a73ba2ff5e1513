//! report.md as a host reads it: by a CommonMark parser with tables, which knows nothing of our
//! mathematics. What it makes of the text must be what the report means.

use crate::quick::QUICK;
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use std::collections::BTreeSet;

fn text() -> &'static str {
    std::str::from_utf8(&QUICK.report.committed["report.md"]).unwrap()
}

fn events() -> Vec<Event<'static>> {
    Parser::new_ext(text(), Options::ENABLE_TABLES).collect()
}

/// Ids that HTML in the text declares, each once.
fn anchors() -> BTreeSet<&'static str> {
    let mut found = BTreeSet::new();
    for piece in text().split("<a id=\"").skip(1) {
        let id = piece.split('"').next().unwrap();
        assert!(found.insert(id), "the anchor {id} stands twice");
    }
    found
}

#[test]
fn every_link_lands_and_every_picture_is_there() {
    let anchors = anchors();
    let (mut inside, mut pictures) = (0, 0);
    for event in events() {
        match event {
            Event::Start(Tag::Link { dest_url, .. }) => {
                if let Some(id) = dest_url.strip_prefix('#') {
                    inside += 1;
                    assert!(anchors.contains(id), "no anchor {id}");
                } else if !dest_url.contains("://") {
                    let source = dest_url
                        .strip_prefix("../")
                        .map(|path| std::path::Path::new(path).exists());
                    let made = QUICK.report.committed.contains_key(&*dest_url)
                        || ["SHA256SUMS", "data"].contains(&&*dest_url);
                    assert!(source.unwrap_or(made), "no file {dest_url}");
                }
            }
            Event::Start(Tag::Image { dest_url, .. }) => {
                pictures += 1;
                assert!(QUICK.report.committed.contains_key(&*dest_url), "no picture {dest_url}");
            }
            _ => {}
        }
    }
    assert_eq!(pictures, impact_paper::figures::all().count());
    assert!(inside > 200, "{inside}");
}

/// What the parser takes for text is what a reader sees: no markup is left over in it.
#[test]
fn no_markup_is_left_over() {
    let mut code = false;
    let mut words = String::new();
    for event in events() {
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
    let fences = text().lines().filter(|line| line.trim_start().starts_with("```")).count();
    assert_eq!(fences % 2, 0);
    // HTML is ours: anchors, folds and small print.
    for event in events() {
        let (Event::Html(html) | Event::InlineHtml(html)) = event else { continue };
        let ours = ["<a id=", "</a>", "<details>", "</details>", "<summary>", "<sub>", "</sub>"];
        for line in html.lines().filter(|line| !line.trim().is_empty()) {
            assert!(ours.iter().any(|tag| line.trim_start().starts_with(tag)), "{html}");
        }
    }
}

/// Mathematics comes through Markdown as it was written, escapes, stars and lows included: between
/// one dollar and the next the parser finds text and nothing else.
#[test]
fn mathematics_is_left_alone() {
    let (mut formulas, mut open, mut code) = (0, None::<String>, false);
    for event in events() {
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
                                let spelled = text().contains(tex.as_str());
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
    assert!(open.is_none() && formulas > 400, "{formulas}");
}

#[test]
fn headings_step_and_tables_are_rectangles() {
    let (mut level, mut titles, mut columns, mut cells, mut tables) = (0, 0, 0, 0, 0);
    for event in events() {
        match event {
            Event::Start(Tag::Heading { level: new, .. }) => {
                let new = new as i32;
                assert!(new <= level + 1, "a heading of level {new} after one of {level}");
                titles += i32::from(new == 1);
                level = new;
            }
            Event::Start(Tag::Table(alignments)) => {
                (columns, tables) = (alignments.len(), tables + 1);
            }
            Event::Start(Tag::TableCell) => cells += 1,
            _ => {}
        }
    }
    assert_eq!(titles, 1);
    assert!(tables >= 9 && columns > 0 && cells > 500, "{tables} {cells}");
    // The parser fills and cuts rows to the head's length: lines tell how long they are.
    let bars = |line: &str| line.replace("\\|", "").matches('|').count();
    let lines: Vec<&str> = text().lines().collect();
    for pair in lines.windows(2).filter(|pair| pair.iter().all(|line| line.starts_with('|'))) {
        assert_eq!(bars(pair[0]), bars(pair[1]), "{}\n{}", pair[0], pair[1]);
    }
    let rows = lines.iter().filter(|line| line.starts_with('|')).count();
    let rules =
        lines.iter().filter(|line| line.starts_with("|--") || line.starts_with("|:-")).count();
    assert_eq!(rules, tables, "a table that is none: {rows} lines");
}

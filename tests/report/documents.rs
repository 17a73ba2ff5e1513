//! Reads the documents by a CommonMark parser, as a host does, and bounds their lengths: a reader
//! of five minutes, half an hour or a day must not find that one has grown beyond its time.

use super::*;
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

/// Words of prose: no code, no displayed formula, no table, no address of a link, no description
/// that is read instead of a picture; a formula in a line is one word.
fn words(markdown: &str) -> usize {
    let (mut left_out, mut prose) = (0, String::new());
    for event in Parser::new_ext(markdown, Options::ENABLE_TABLES | Options::ENABLE_MATH) {
        match event {
            Event::Start(Tag::Table(_) | Tag::CodeBlock(_) | Tag::Image { .. }) => left_out += 1,
            Event::End(TagEnd::Table | TagEnd::CodeBlock | TagEnd::Image) => left_out -= 1,
            // Where the files of a figure are.
            Event::InlineHtml(html) if &*html == "<sub>" => left_out += 1,
            Event::InlineHtml(html) if &*html == "</sub>" => left_out -= 1,
            Event::Text(piece) | Event::Code(piece) if left_out == 0 => prose += &piece,
            Event::InlineMath(_) if left_out == 0 => prose.push('x'),
            Event::Start(Tag::Paragraph | Tag::Item | Tag::Heading { .. })
            | Event::SoftBreak
            | Event::HardBreak => prose.push(' '),
            _ => {}
        }
    }
    prose.split_whitespace().filter(|word| word.contains(char::is_alphanumeric)).count()
}

/// The text from a heading, given by its words, on to the next heading or figure.
fn section<'a>(markdown: &'a str, heading: &str) -> &'a str {
    let rest = &markdown[markdown.find(&format!("\n## {heading}")).unwrap() + 1..];
    let end = ["\n## ", "\n!["].iter().filter_map(|end| rest.find(end)).min();
    &rest[..end.unwrap_or(rest.len())]
}

#[test]
fn no_document_outgrows_its_reader() {
    let (edition, beyond) = (QUICK.file_text("report.md"), QUICK.file_text("beyond.md"));
    let counts = [
        ("the front page", words(QUICK.file_text("README.md")), 600),
        ("the edition", words(edition), 7_000),
        ("its abstract", words(section(edition, "Abstract")), 220),
        ("the second paper", words(beyond), 4_500),
        ("its abstract", words(section(beyond, "Abstract")), 120),
        ("the methods", words(QUICK.file_text("methods.md")), 3_000),
    ];
    let too_long: Vec<_> =
        counts.iter().filter(|(_, count, budget)| *count * 10 > budget * 11).collect();
    assert!(too_long.is_empty(), "more than ten per cent too long: {too_long:?}");
}

fn events(text: &str) -> Vec<Event<'_>> {
    Parser::new_ext(text, Options::ENABLE_TABLES).collect()
}

fn links(text: &str) -> [Vec<String>; 2] {
    let link = |event| match event {
        Event::Start(Tag::Link { dest_url: to, .. } | Tag::Image { dest_url: to, .. }) => {
            Some(to.to_string())
        }
        _ => None,
    };
    let places = text.split("<a id=\"").skip(1).map(|part| part.split('"').next().unwrap().into());
    [events(text).into_iter().filter_map(link).collect(), places.collect()]
}

#[test]
fn every_link_lands_wherever_the_report_is_written() {
    let names = QUICK.paper.edition.documents.iter().map(|document| document.markdown);
    super::links_land(names.collect(), links, 200, 150);
}

/// Between one dollar and the next the parser finds text and nothing else.
#[test]
fn mathematics_is_left_alone() {
    let documents = QUICK.paper.edition.documents.iter();
    let formulas: usize =
        documents.map(|document| formulas(QUICK.file_text(document.markdown))).sum();
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

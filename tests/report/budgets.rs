//! Documents are bounded: a reader of five minutes, half an hour or a day must not find that one
//! has grown beyond its time. Bytes and elements of the pages are bounded by the browser test, pages by `.ci/latex`.

use crate::quick::QUICK;
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

/// Words of prose: no code, no displayed formula, no table, no address of a link, no description that is read
/// instead of a picture; a formula in a line is one word.
fn words(markdown: &str) -> usize {
    let (mut left_out, mut text) = (0, String::new());
    for event in Parser::new_ext(markdown, Options::ENABLE_TABLES | Options::ENABLE_MATH) {
        match event {
            Event::Start(Tag::Table(_) | Tag::CodeBlock(_) | Tag::Image { .. }) => left_out += 1,
            Event::End(TagEnd::Table | TagEnd::CodeBlock | TagEnd::Image) => left_out -= 1,
            // Where the files of a figure are.
            Event::InlineHtml(html) if &*html == "<sub>" => left_out += 1,
            Event::InlineHtml(html) if &*html == "</sub>" => left_out -= 1,
            Event::Text(piece) | Event::Code(piece) if left_out == 0 => text += &piece,
            Event::InlineMath(_) if left_out == 0 => text.push('x'),
            Event::Start(Tag::Paragraph | Tag::Item | Tag::Heading { .. })
            | Event::SoftBreak
            | Event::HardBreak => text.push(' '),
            _ => {}
        }
    }
    text.split_whitespace().filter(|word| word.contains(char::is_alphanumeric)).count()
}

/// The text from one heading on to the next, by the words of the heading.
fn section<'a>(markdown: &'a str, heading: &str) -> &'a str {
    let from = markdown.find(&format!("\n## {heading}")).unwrap_or_else(|| panic!("no {heading}"));
    let rest = &markdown[from + 1..];
    rest.find("\n## ").map_or(rest, |end| &rest[..end])
}

#[test]
fn words_are_counted_as_a_reader_does() {
    let text = "## One *two*\n\nThree [four](five/six.md) $a + b$ <a id=\"x\"></a>(five) – six.\n\n| no | no |\n|---|---|\n\n```rust\nno\n```\n\n$$\nno\n$$\n\n$$no$$\n";
    assert_eq!(words(text), 7);
}

#[test]
fn no_document_outgrows_its_reader() {
    let text = |name: &str| {
        std::str::from_utf8(&QUICK.report.committed[&format!("{name}.md")]).unwrap().to_owned()
    };
    let (edition, beyond) = (text("report"), text("beyond"));
    let counts = [
        ("the front page", words(&text("README")), 600),
        ("the edition", words(&edition), 7_000),
        ("its abstract", words(section(&edition, "Abstract")), 220),
        ("the second paper", words(&beyond), 4_500),
        ("the methods", words(&text("methods")), 3_000),
    ];
    let passed: Vec<_> =
        counts.iter().filter(|(_, count, budget)| *count * 10 > budget * 11).collect();
    assert!(passed.is_empty(), "more than ten per cent too long: {passed:?}");
}

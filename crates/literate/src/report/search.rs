//! Makes the index of the search: the words of a document, each with its place.

use super::document::{Block, Inline, Table, heading_place, place_on_page, to_spelt_text};
use super::tex;

/// Returns each piece of a document that has text: the id of its place, the name of its section,
/// and the text.
pub fn passages(blocks: &[Block], document: &str) -> Vec<[String; 3]> {
    let (mut section, mut name, mut passages) = ("text".into(), document.into(), Vec::new());
    for block in blocks {
        if let Block::Heading { level: 2.., number, id, text } = block {
            section = heading_place(id.as_deref(), number.as_deref(), text);
            name = heading(number.as_deref(), text);
        }
        for (place, text) in texts(block) {
            let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
            if !words.is_empty() {
                passages.push([place.unwrap_or_else(|| section.clone()), name.clone(), words]);
            }
        }
    }
    passages
}

fn heading(number: Option<&str>, text: &[Inline]) -> String {
    format!("{} {}", number.unwrap_or_default(), to_spelt_text(text)).trim().into()
}

/// Returns the texts of a block, each with the id of its place, or `None` for that of its section.
fn texts(block: &Block) -> Vec<(Option<String>, String)> {
    match block {
        // The title is the name of the document, and a page hides what cannot run on it.
        Block::Heading { level: 1, .. } | Block::Lab { .. } => Vec::new(),
        Block::Heading { number, text, .. } => vec![(None, heading(number.as_deref(), text))],
        Block::Paragraph(text) => {
            let equation = |inline: &Inline| match inline {
                Inline::Display { formula, number, id: Some(id) } => {
                    let words = format!("Equation ({number}): {}", tex::spell(&formula.to_tex()));
                    Some((Some(place_on_page(id)), words))
                }
                _ => None,
            };
            let words = (None, to_spelt_text(text));
            [words].into_iter().chain(text.iter().filter_map(equation)).collect()
        }
        Block::Figure { id, number, caption, .. } => {
            let words = format!("Figure {number}. {}", to_spelt_text(caption));
            vec![(Some(place_on_page(id)), words)]
        }
        Block::Table(Table { number, caption, head, rows, .. }) => {
            let caption = number.as_ref().map(|n| format!("Table {n}. {}", to_spelt_text(caption)));
            let row = |cells: &Vec<Vec<Inline>>| {
                let words =
                    cells.iter().map(|cell| to_spelt_text(cell)).collect::<Vec<_>>().join(" ");
                match cells.first().map(Vec::as_slice) {
                    Some([Inline::Anchor { id, .. }]) => {
                        (Some(place_on_page(id)), format!("Statement {words}"))
                    }
                    _ => (None, words),
                }
            };
            let rows = [head].into_iter().chain(rows).map(row);
            caption.map(|words| (None, words)).into_iter().chain(rows).collect()
        }
        Block::List { items, .. } => items.iter().flatten().flat_map(texts).collect(),
        Block::Quote(blocks) => blocks.iter().flat_map(texts).collect(),
        Block::Code { code, .. } => vec![(None, code.clone())],
        Block::Listing { number, caption, code, .. } => {
            let caption = format!("Listing {number}. {}", to_spelt_text(caption));
            vec![(None, caption), (None, code.clone())]
        }
        Block::Bibliography(entries) => {
            entries.iter().map(|entry| (None, to_spelt_text(&entry.to_inlines()))).collect()
        }
    }
}

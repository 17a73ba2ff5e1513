//! Makes the index of the search: the words of a document, each with its place.

use super::document::{Block, Inline, Table, heading_place, place_on_page, to_spelt_text};
use super::tex;

/// What the search can find: the id of its place, the name of its section, and its text.
type Passage = [String; 3];

/// Returns a passage for each piece of a document that has text.
pub fn passages(blocks: &[Block], document: &str) -> Vec<Passage> {
    let mut index = Index { section: ["text".into(), document.into()], passages: Vec::new() };
    index.blocks(blocks);
    index.passages
}

struct Index {
    section: [String; 2],
    passages: Vec<Passage>,
}

impl Index {
    fn add(&mut self, text: &str) {
        self.add_at(&self.section[0].clone(), text);
    }

    fn add_at(&mut self, place: &str, words: &str) {
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        if !words.is_empty() {
            self.passages.push([place.into(), self.section[1].clone(), words]);
        }
    }

    fn blocks(&mut self, blocks: &[Block]) {
        for block in blocks {
            match block {
                // The title is the name of the document, and a page hides what cannot run on it.
                Block::Heading { level: 1, .. } | Block::Lab { .. } => (),
                Block::Heading { number, id, text, .. } => {
                    let words = format!(
                        "{} {}",
                        number.as_deref().unwrap_or_default(),
                        to_spelt_text(text)
                    );
                    let place = heading_place(id.as_deref(), number.as_deref(), text);
                    self.section = [place, words.trim().into()];
                    self.add(&words);
                }
                Block::Paragraph(text) => self.paragraph(text),
                Block::Figure { id, number, caption, .. } => {
                    let words = format!("Figure {number}. {}", to_spelt_text(caption));
                    self.add_at(&place_on_page(id), &words);
                }
                Block::Table(table) => self.table(table),
                Block::List { items, .. } => items.iter().for_each(|item| self.blocks(item)),
                Block::Quote(blocks) => self.blocks(blocks),
                Block::Code { code, .. } => self.add(code),
                Block::Listing { number, caption, code, .. } => {
                    self.add(&format!("Listing {number}. {}", to_spelt_text(caption)));
                    self.add(code);
                }
                Block::Bibliography(entries) => {
                    entries.iter().for_each(|entry| self.add(&to_spelt_text(&entry.to_inlines())));
                }
            }
        }
    }

    fn paragraph(&mut self, text: &[Inline]) {
        self.add(&to_spelt_text(text));
        for inline in text {
            if let Inline::Display { formula, number, id: Some(id) } = inline {
                let words = format!("Equation ({number}): {}", tex::spell(&formula.to_tex()));
                self.add_at(&place_on_page(id), &words);
            }
        }
    }

    fn table(&mut self, Table { number, caption, head, rows, .. }: &Table) {
        if let Some(number) = number {
            self.add(&format!("Table {number}. {}", to_spelt_text(caption)));
        }
        for cells in [head].into_iter().chain(rows) {
            let words = cells.iter().map(|cell| to_spelt_text(cell)).collect::<Vec<_>>().join(" ");
            match cells.first().map(Vec::as_slice) {
                Some([Inline::Anchor { id, .. }]) => {
                    self.add_at(&place_on_page(id), &format!("Statement {words}"));
                }
                _ => self.add(&words),
            }
        }
    }
}

//! Makes the index of the search: the words of a document, each with its section, statement or
//! equation.

use super::document::{Block, Inline, heading_place, place_on_page, spelt};
use super::tex;

/// What the search can find: the id of its place, the name of its section, and its text.
type Passage = [String; 3];

/// Returns a passage for each heading, paragraph, equation with a number, caption, item of a list,
/// row of a table and reference of a document.
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

    /// Adds text with the id of its place on the page.
    fn add_at(&mut self, id: &str, text: &str) {
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        if !text.is_empty() {
            self.passages.push([id.into(), self.section[1].clone(), text]);
        }
    }

    fn blocks(&mut self, blocks: &[Block]) {
        for block in blocks {
            self.block(block);
        }
    }

    fn block(&mut self, block: &Block) {
        match block {
            // The title is the name of the document.
            Block::Heading { level: 1, .. } => (),
            Block::Heading { number, id, text, .. } => {
                let words = format!("{} {}", number.as_deref().unwrap_or_default(), spelt(text));
                let place = heading_place(id.as_deref(), number.as_deref(), text);
                self.section = [place, words.trim().into()];
                self.add(&words);
            }
            Block::Paragraph(text) => {
                self.add(&spelt(text));
                for inline in text {
                    if let Inline::Display { formula, number, id: Some(id) } = inline {
                        let words =
                            format!("Equation ({number}): {}", tex::spell(&formula.digits()));
                        self.add_at(&place_on_page(Some(id), &[]), &words);
                    }
                }
            }
            Block::Figure { number, caption, .. } => {
                self.add(&format!("Figure {number}. {}", spelt(caption)));
            }
            Block::Table { number, caption, head, rows, .. } => {
                if let Some(number) = number {
                    self.add(&format!("Table {number}. {}", spelt(caption)));
                }
                self.row(head);
                for row in rows {
                    self.row(row);
                }
            }
            Block::List { items, .. } => {
                for item in items {
                    self.blocks(item);
                }
            }
            Block::Quote(blocks) => self.blocks(blocks),
            Block::Code { text, .. } => self.add(text),
            Block::Listing { number, caption, text, .. } => {
                self.add(&format!("Listing {number}. {}", spelt(caption)));
                self.add(text);
            }
            // A page hides what cannot run on it.
            Block::Lab { .. } => (),
            Block::Bibliography(entries) => {
                for entry in entries {
                    self.add(&spelt(&entry.text()));
                }
            }
        }
    }

    fn row(&mut self, cells: &[Vec<Inline>]) {
        let cells_spelt: Vec<String> = cells.iter().map(|cell| spelt(cell)).collect();
        let words = cells_spelt.join(" ");
        match cells.first().map(Vec::as_slice) {
            Some([Inline::Anchor { id, .. }]) => {
                self.add_at(&place_on_page(Some(id), &[]), &format!("Statement {words}"));
            }
            _ => self.add(&words),
        }
    }
}

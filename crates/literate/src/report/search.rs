//! Makes the index of the search: the words of a document, with the section in which each stands.

use super::document::{Block, Inline, heading_place, spelt};

/// A place that the search can find: id and name of its section, and its text.
type Passage = [String; 3];

/// Returns a passage for each heading, paragraph, caption, item of a list, row of a table and
/// reference of a document.
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
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        if !text.is_empty() {
            let [id, name] = self.section.clone();
            self.passages.push([id, name, text]);
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
            Block::Paragraph(text) => self.add(&spelt(text)),
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
                    self.add(&spelt(&entry.text));
                }
            }
        }
    }

    fn row(&mut self, cells: &[Vec<Inline>]) {
        let cells: Vec<String> = cells.iter().map(|cell| spelt(cell)).collect();
        self.add(&cells.join(" "));
    }
}

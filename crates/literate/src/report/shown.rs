//! What each document shows: its files, and the ids of its values and statements.

use super::document::{Block, Inline, visit};
use super::documents::Document;
use super::valued::{Piece, pieces};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// What a document shows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Shown {
    /// Paths of its files, with those of its figures.
    pub files: BTreeSet<String>,
    /// Ids of the statements that it refers to.
    pub claims: BTreeSet<String>,
    /// Ids of the values that it names.
    pub values: BTreeSet<String>,
}

impl Shown {
    /// Of a whole document.
    pub fn of(document: Document, blocks: &[Block]) -> Self {
        let mut shown = Shown::in_blocks(blocks);
        shown.files.extend(document.paths());
        for block in blocks {
            if let Block::Figure { path, data, .. } = block {
                shown.files.extend(data.iter().cloned());
                shown.files.extend([path.clone(), path.replace(".svg", ".pdf")]);
            }
        }
        shown
    }

    /// What some blocks name.
    pub fn in_blocks(blocks: &[Block]) -> Self {
        let mut shown = Shown::default();
        visit(blocks, &mut |inline| match inline {
            Inline::Reference { to, .. } => {
                shown.claims.extend(to.strip_prefix("claim:").map(String::from));
            }
            Inline::Value { id, .. } => {
                shown.values.insert(id.clone());
            }
            Inline::Maths(tex) | Inline::Display { tex, .. } => {
                shown.values.extend(pieces(tex).into_iter().filter_map(|piece| match piece {
                    Piece::Value { id, .. } => Some(id.to_string()),
                    Piece::Tex(_) => None,
                }));
            }
            _ => {}
        });
        shown
    }
}

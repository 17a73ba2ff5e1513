//! The card of a figure.

use super::{Card, Cards, links};
use crate::report::captions::number_of_figure;
use crate::report::document::Inline;

/// `fig03` → `fig:3`, `s01` → `fig:s1`.
pub fn id(figure: &str) -> String {
    format!("fig:{}", number_of_figure(figure).to_lowercase())
}

impl Cards<'_> {
    pub(super) fn figure(&self, asked: &str) -> Option<Card> {
        let figure = self.ledger.figures.iter().find(|figure| id(&figure.id) == asked)?;
        let title = vec![Inline::Text(figure.title.clone())];
        let mut card = Card { id: id(&figure.id), title, lead: String::new(), rows: Vec::new() };
        card.words("shows", figure.description.clone());
        card.row("picture", links([&figure.picture]));
        card.row("data", links(&figure.data));
        card.item("drawn by", &figure.source, self.program);
        for name in &figure.experiments {
            card.experiment(name, self);
        }
        Some(card)
    }
}

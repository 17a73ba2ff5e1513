//! The card of a judged statement.

use super::{Card, Cards, words_and_maths};

impl Cards<'_> {
    pub(super) fn claim(&self, id: &str) -> Option<Card> {
        let claim = self.ledger.claims.iter().find(|claim| claim.id == id)?;
        let title = words_and_maths(&claim.statement);
        let mut card =
            Card { id: format!("claim:{id}"), title, lead: String::new(), rows: Vec::new() };
        card.words("stands in", claim.place.clone());
        card.words("printed", claim.printed.clone());
        card.words("found", claim.ours.clone());
        card.words("tolerance", claim.tolerance.clone());
        card.words("because", claim.reason.clone());
        card.words("verdict", claim.verdict.clone());
        card.words("note", claim.note.clone());
        card.words("values", claim.values.join(", "));
        card.item("judged by", &(self.program.judge)(&claim.id), self.program);
        Some(card)
    }
}

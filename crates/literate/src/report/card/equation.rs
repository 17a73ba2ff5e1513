//! The card of a numbered equation.

use super::{Card, Cards, words_and_maths};

impl Cards<'_> {
    pub(super) fn equation(&self, number: u32) -> Option<Card> {
        let equation = self.ledger.equations.iter().find(|equation| equation.number == number)?;
        let title = words_and_maths(&equation.what);
        let mut card =
            Card { id: format!("eq:{number}"), title, lead: String::new(), rows: Vec::new() };
        card.words("stands in", format!("Sec. {}", equation.section));
        card.item("home", &equation.home, self.program);
        if let Some(towards) = &equation.step_towards {
            card.words("is", format!("a step towards {towards}"));
        }
        let values = self.values.iter().filter(|value| value.source == equation.home);
        let values: Vec<&str> = values.map(|value| value.id.as_str()).collect();
        card.words("values", values.join(", "));
        Some(card)
    }
}

//! Numbers that open a card. Cards are data: as elements they were two fifths of a page.

use super::{Page, escape};
use crate::report::Error;
use crate::report::card::Cards;
use crate::report::document::Inline;
use std::collections::BTreeMap;

impl Page<'_> {
    /// The button that shows a value; the script opens its card.
    pub(super) fn button(&self, id: &str, shown: &str) -> String {
        self.named.borrow_mut().insert(id.to_string());
        let id = escape::text(id);
        format!("<button type=\"button\" class=\"value\" data-card=\"{id}\">{shown}</button>")
    }

    /// The cards of all values that were shown, as data for the script. A row that several cards have stands once.
    pub(super) fn cards(&self, cards: Cards<'_>) -> Result<String, Error> {
        let named = self.named.borrow().clone();
        let mut rows = Vec::new();
        let mut places = BTreeMap::new();
        let mut all = BTreeMap::new();
        for id in named {
            let unknown = || Error::Template(format!("there is no value {id}"));
            let card = cards.get(&id).ok_or_else(unknown)?;
            let own = card.rows.iter().map(|row| {
                let text: Vec<Inline> = row.text.iter().map(|inline| self.placed(inline)).collect();
                let row = format!("<dt>{}</dt><dd>{}</dd>", row.name, self.inlines(&text)?);
                Ok(*places.entry(row.clone()).or_insert_with(|| {
                    rows.push(row);
                    rows.len() - 1
                }))
            });
            let own: Vec<usize> = own.collect::<Result<_, Error>>()?;
            all.insert(id, (self.inlines(&card.title)?, escape::text(&card.lead), own));
        }
        Ok(escape::data(&(rows, all)))
    }

    /// A reference of a card with the document that has its place.
    fn placed(&self, inline: &Inline) -> Inline {
        match inline {
            Inline::Reference { to, shown, .. } => {
                let within = self.site.labels.beside(to, self.site.here);
                Inline::Reference { to: to.clone(), within, shown: shown.clone() }
            }
            other => other.clone(),
        }
    }
}

//! Numbers that open a card, without a script: `popover` and `popovertarget`.

use super::{Page, escape};
use crate::report::Error;
use crate::report::card::{Card, Cards};
use std::fmt::Write as _;

impl Page<'_> {
    /// The button that shows a value; its card is written at the end of the page.
    pub(super) fn button(&self, id: &str, shown: &str) -> String {
        self.named.borrow_mut().insert(id.to_string());
        format!(
            "<button type=\"button\" class=\"value\" popovertarget=\"{}\">{shown}</button>",
            target(id)
        )
    }

    /// The cards of all values that were shown, each once.
    pub(super) fn cards(&self, cards: Cards<'_>) -> Result<String, Error> {
        let named = self.named.borrow().clone();
        let mut out = String::new();
        for id in named {
            let unknown = || Error::Template(format!("there is no value {id}"));
            out.push_str(&self.card(&cards.get(&id).ok_or_else(unknown)?)?);
        }
        Ok(out)
    }

    fn card(&self, card: &Card) -> Result<String, Error> {
        let id = target(&card.id);
        let mut out = format!(
            "<div popover=\"auto\" id=\"{id}\" class=\"card\" role=\"dialog\" \
             aria-labelledby=\"{id}-title\"><header><span id=\"{id}-title\">{}</span><button \
             popovertarget=\"{id}\" popovertargetaction=\"hide\" aria-label=\"Close\">×</button></header>",
            self.inlines(&card.title)?
        );
        if !card.lead.is_empty() {
            let _ = write!(out, "<p>{}</p>", escape::text(&card.lead));
        }
        out.push_str("<dl>");
        for row in &card.rows {
            let _ = write!(out, "<dt>{}</dt><dd>{}</dd>", row.name, self.inlines(&row.text)?);
        }
        let _ = writeln!(out, "</dl></div>");
        Ok(out)
    }
}

fn target(id: &str) -> String {
    escape::id(&format!("card:{id}"))
}

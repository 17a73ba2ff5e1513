//! The card of a value.

use super::{Card, Cards, link, words_and_maths};
use crate::report::document::Inline;
use crate::report::print::{Asked, Style, print};
use crate::report::values::{Digits, Kind, Number, Value};

impl Cards<'_> {
    pub(super) fn value(&self, id: &str) -> Option<Card> {
        let value = self.values.get(id)?;
        let mut title = words_and_maths(&print(&value.number, Style::default()).markdown());
        if !value.unit.is_empty() {
            title.push(Inline::Text("\u{a0}".into()));
            title.extend(words_and_maths(&value.unit));
        }
        let mut card = Card { id: value.id.clone(), title, rows: Vec::new() };
        card.row("id", vec![Inline::Code(value.id.clone())]);
        if !matches!(value.number, Number::Text(_) | Number::Integer(_)) {
            let full = Style { digits: Some(Asked::Full), ..Style::default() };
            card.words("in full", print(&value.number, full).plain());
        }
        card.words("kind", kind(value));
        if let Kind::Ensemble { realisations, standard_error } = &value.kind {
            card.words("standard error", format!("{standard_error}"));
            card.words("n", format!("{realisations}"));
        }
        if let Kind::Printed { place } = &value.kind {
            card.words("place", place.clone());
        }
        if !value.source.is_empty() {
            card.item("computed by", &value.source);
        }
        let home = self.ledger.equations.iter().find(|equation| equation.home == value.source);
        if let Some(number) = home.map(|equation| equation.number) {
            let shown = format!("Eq.\u{a0}({number})");
            card.row("equation", vec![Inline::Reference { to: format!("eq:{number}"), shown }]);
        }
        card.experiment(&value.experiment, self.profile());
        card.row("note", words_and_maths(&value.note));
        let mut data = vec![link("values.json", Inline::Text("values.json".into()))];
        let shows = |names: &[String]| names.contains(&value.experiment);
        let figures = self.ledger.figures.iter().filter(|figure| shows(&figure.experiments));
        let csv: Vec<&String> = figures.flat_map(|figure| &figure.data).collect();
        if value.experiment != "theory" && !csv.is_empty() {
            data.push(Inline::Text("; of the same experiment: ".into()));
            data.extend(super::links(csv));
        }
        card.row("data", data);
        let claims = self.ledger.claims.iter().filter(|claim| claim.values.contains(&value.id));
        let mut used = Vec::new();
        for claim in claims {
            if !used.is_empty() {
                used.push(Inline::Text("; ".into()));
            }
            let shown = claim.id.clone();
            used.push(Inline::Reference { to: format!("claim:{}", claim.id), shown });
            used.push(Inline::Text(format!(" ({}): {}", claim.place, claim.verdict)));
        }
        card.row("claims", used);
        Some(card)
    }
}

fn kind(value: &Value) -> &'static str {
    match (&value.kind, &value.number) {
        (Kind::Exact, Number::Text(_)) => "words",
        (Kind::Exact, _) => "exact",
        (Kind::Deterministic, Number::Interval { .. }) => "an interval",
        (Kind::Deterministic, Number::Real { digits: Digits::Significant(_), .. }) => {
            "computed without chance, rounded"
        }
        (Kind::Deterministic, _) => "computed without chance",
        (Kind::Ensemble { .. }, _) => "an average over realisations",
        (Kind::Printed { .. }, _) => "printed in the paper",
        (Kind::Measured, _) => "measured once, and an input since",
    }
}

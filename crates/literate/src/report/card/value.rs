//! The card of a value.

use super::{Card, Cards, link, words_and_maths};
use crate::figures::DataFile;
use crate::report::document::Inline;
use crate::report::print::{Asked, Style, print};
use crate::report::values::{Digits, Kind, Number, Value};
use crate::table::table_of;

impl Cards<'_> {
    pub(super) fn value(&self, id: &str) -> Option<Card> {
        let value = self.values.get(id)?;
        let mut title = words_and_maths(&print(&value.number, Style::default()).markdown());
        if !value.unit.is_empty() {
            title.push(Inline::Text("\u{a0}".into()));
            title.extend(words_and_maths(&value.unit));
        }
        let mut card = Card { id: value.id.clone(), title, lead: lead(value), rows: Vec::new() };
        if !matches!(value.number, Number::Text(_) | Number::Integer(_)) {
            let full = Style { digits: Some(Asked::Full), ..Style::default() };
            card.words("in full", print(&value.number, full).plain());
        }
        if let Kind::Ensemble { realisations, standard_error } = &value.kind {
            card.words("standard error", format!("{standard_error}"));
            card.words("n", format!("{realisations}"));
        }
        if let Kind::Printed { place } = &value.kind {
            card.words("place", place.clone());
        }
        if !value.source.is_empty() {
            card.item("computed by", &value.source, self.program);
        }
        let home = self.ledger.equations.iter().find(|equation| equation.home == value.source);
        if let Some(number) = home.map(|equation| equation.number) {
            let shown = format!("Eq.\u{a0}({number})");
            card.row(
                "equation",
                vec![Inline::Reference { to: format!("eq:{number}"), within: None, shown }],
            );
        }
        card.experiment(&value.experiment, self);
        card.row("note", words_and_maths(&value.note));
        let mut data = vec![link("values.json", Inline::Text("values.json".into()))];
        let shows = |names: &[String]| names.contains(&value.experiment);
        let figures = self.ledger.figures.iter().filter(|figure| shows(&figure.experiments));
        let csv: Vec<&String> = figures.flat_map(|figure| &figure.data).collect();
        // A cell has the file of its table; what has no table has those of its experiment.
        let own = table_of(&value.id).map(|table| format!("data/{}", DataFile::name_of(table)));
        if let Some(own) = &own {
            data.push(Inline::Text(", ".into()));
            data.extend(super::links([own]));
        } else if value.experiment != "theory" && !csv.is_empty() {
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
            let to = format!("claim:{}", claim.id);
            used.push(Inline::Reference { to, within: None, shown });
            used.push(Inline::Text(format!(" ({}): {}", claim.place, claim.verdict)));
        }
        card.row("claims", used);
        card.row("id", vec![Inline::Code(value.id.clone())]);
        Some(card)
    }
}

/// What kind of number it is, and where it comes from.
fn lead(value: &Value) -> String {
    let what = match (&value.kind, &value.number) {
        (Kind::Exact, Number::Text(_)) => "Words that were computed".into(),
        (Kind::Exact, _) => "An exact number".into(),
        (Kind::Deterministic, Number::Interval { .. }) => "An interval".into(),
        (Kind::Deterministic, Number::Real { digits: Digits::Significant(_), .. }) => {
            "A number computed without chance and rounded".into()
        }
        (Kind::Deterministic, _) => "A number computed without chance".into(),
        (Kind::Ensemble { realisations, .. }, _) => {
            format!("Found from {realisations} realisations, with its standard error in brackets")
        }
        (Kind::Printed { .. }, _) => return "A number that the paper prints.".into(),
        (Kind::Measured, _) => "A number measured once, and an input since".into(),
    };
    match value.experiment.as_str() {
        "" => format!("{what}."),
        "theory" => format!("{what}, from the theory."),
        name => format!("{what}, from the experiment “{}”.", name.replace('_', " ")),
    }
}

//! What a reader is told about one number: the card that opens in HTML and in the terminal.

use super::Error;
use super::document::Inline;
use super::equations::{EQUATIONS, homes};
use super::print::{Asked, Style, print};
use super::values::{Digits, Kind, Number, Value};

/// A card: a name and rows, in any format.
#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// Id of what it is about, as `half_height`.
    pub id: String,
    /// What it is about, as the report shows it.
    pub title: Vec<Inline>,
    /// What is known of it.
    pub rows: Vec<Row>,
}

/// One thing that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its name, as "standard error".
    pub name: &'static str,
    /// The thing.
    pub text: Vec<Inline>,
}

fn words(text: impl Into<String>) -> Vec<Inline> {
    vec![Inline::Text(text.into())]
}

/// Markdown of printed values, "3 $\times$ 4", as words and mathematics.
pub fn words_and_maths(text: &str) -> Vec<Inline> {
    let piece = |(i, piece): (usize, &str)| match i % 2 {
        0 => Inline::Text(piece.to_string()),
        _ => Inline::Maths(piece.to_string()),
    };
    text.split('$').enumerate().filter(|(_, piece)| !piece.is_empty()).map(piece).collect()
}

/// The card of a value.
///
/// # Errors
/// None yet.
pub fn of_value(value: &Value) -> Result<Card, Error> {
    let shown = |style: Style| words_and_maths(&print(&value.number, style).markdown());
    let mut title = shown(Style::default());
    if !value.unit.is_empty() {
        title.push(Inline::Text("\u{a0}".into()));
        title.extend(words_and_maths(&value.unit));
    }
    let mut rows = vec![Row { name: "id", text: vec![Inline::Code(value.id.clone())] }];
    let mut row = |name, text| rows.push(Row { name, text });
    if !matches!(value.number, Number::Text(_) | Number::Integer(_)) {
        let full = Style { digits: Some(Asked::Full), ..Style::default() };
        row("in full", words(print(&value.number, full).plain()));
    }
    row("kind", words(kind(value)));
    if let Kind::Ensemble { realisations, standard_error } = &value.kind {
        row("standard error", words(format!("{standard_error}")));
        row("n", words(format!("{realisations}")));
    }
    if let Kind::Printed { place } = &value.kind {
        row("place", words(place.clone()));
    }
    if !value.source.is_empty() {
        row("computed by", vec![Inline::Code(value.source.clone())]);
    }
    let of = |n: u32| homes(n).any(|home| home.item == value.source);
    if let Some(equation) = EQUATIONS.iter().find(|equation| of(equation.number)) {
        let number = equation.number;
        let reference =
            Inline::Reference { to: format!("eq:{number}"), shown: format!("Eq.\u{a0}({number})") };
        row("equation", vec![reference]);
    }
    if !value.experiment.is_empty() {
        row("experiment", words(value.experiment.replace('_', " ")));
    }
    if !value.note.is_empty() {
        row("note", words_and_maths(&value.note));
    }
    let data = Inline::Link { to: "values.json".into(), shown: words("values.json") };
    row("data", vec![data]);
    Ok(Card { id: value.id.clone(), title, rows })
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

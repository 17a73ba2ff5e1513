//! What a reader is told about one thing: the card that opens in HTML and in the terminal.
//!
//! Cards are made of values.json and ledger.json alone, with the parameters of the profile, so that
//! no run is needed.

mod claim;
mod equation;
mod figure;
mod value;

use super::document::Inline;
use super::ledger::Ledger;
use super::values::{Number, Registry};
use crate::source::{Program, Recipe};

/// A card: a title and rows, for any format.
#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// Id of what it is about: `half_height`, `fig:3`, `eq:18`, `claim:sec7_jump`.
    pub id: String,
    /// What it is about, as the report shows it.
    pub title: Vec<Inline>,
    /// What it is in one plain sentence; may be empty.
    pub lead: String,
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
    /// Path of the item of the source that it names, if it does.
    pub item: Option<String>,
}

impl Card {
    fn row(&mut self, name: &'static str, text: Vec<Inline>) {
        if !text.is_empty() {
            self.rows.push(Row { name, text, item: None });
        }
    }

    fn words(&mut self, name: &'static str, text: impl Into<String>) {
        let text = text.into();
        if !text.is_empty() {
            self.row(name, vec![Inline::Text(text)]);
        }
    }

    /// A row with an item of the source, which links to its file.
    fn item(&mut self, name: &'static str, item: &str, program: Program) {
        if item.is_empty() {
            return;
        }
        let code = Inline::Code(item.to_string());
        let text = match program.file(item) {
            Some(file) => vec![link(&format!("../{file}"), code)],
            None => vec![code],
        };
        self.rows.push(Row { name, text, item: Some(item.to_string()) });
    }

    /// Rows for an experiment: where it is, and its parameters.
    fn experiment(&mut self, name: &str, cards: &Cards<'_>) {
        let recipe = (cards.program.recipe)(name, cards.profile());
        let Some(Recipe { item, parameters, data, .. }) = recipe else { return };
        self.item("experiment", &item, cards.program);
        let pairs: Vec<String> =
            parameters.iter().map(|(name, setting)| format!("{name}: {setting}")).collect();
        self.words("its parameters", pairs.join("; "));
        if let Some(path) = data {
            let name = path.rsplit('/').next().unwrap_or(path);
            self.row("its data", vec![link(&format!("../{path}"), Inline::Text(name.into()))]);
        }
    }
}

/// Everything that has a card.
#[derive(Clone, Copy, Debug)]
pub struct Cards<'a> {
    /// The values.
    pub values: &'a Registry,
    /// Claims, figures, equations.
    pub ledger: &'a Ledger,
    /// The program that they lead to.
    pub program: Program,
}

impl Cards<'_> {
    /// The profile with which the values were made.
    pub(super) fn profile(&self) -> &str {
        match self.values.get("profile").map(|value| &value.number) {
            Some(Number::Text(text)) => text,
            _ => "",
        }
    }

    /// The card of an id; a claim is found without its `claim:` too, a figure as `fig:s1`, `Fig:3`.
    pub fn get(&self, id: &str) -> Option<Card> {
        let id = id.trim();
        let lower = id.to_lowercase();
        match lower.split_once(':') {
            Some(("fig", _)) => self.figure(&lower),
            Some(("eq", number)) => self.equation(number.parse().ok()?),
            Some(("claim", name)) => self.claim(name),
            Some(_) => None,
            None => self.value(id.strip_prefix("v.").unwrap_or(id)).or_else(|| self.claim(id)),
        }
    }

    /// All ids, in the order values, figures, equations, claims.
    pub fn ids(&self) -> Vec<String> {
        let values = self.values.iter().map(|value| value.id.clone());
        let figures = self.ledger.figures.iter().map(|figure| figure::id(&figure.id));
        let equations = self.ledger.equations.iter().map(|e| format!("eq:{}", e.number));
        let claims = self.ledger.claims.iter().map(|claim| format!("claim:{}", claim.id));
        values.chain(figures).chain(equations).chain(claims).collect()
    }
}

/// Markdown of printed values, "3 $\times$ 4", as words and mathematics.
pub fn words_and_maths(text: &str) -> Vec<Inline> {
    let piece = |(i, piece): (usize, &str)| match i % 2 {
        0 => Inline::Text(piece.to_string()),
        _ => Inline::Maths(piece.to_string()),
    };
    text.split('$').enumerate().filter(|(_, piece)| !piece.is_empty()).map(piece).collect()
}

fn link(to: &str, shown: Inline) -> Inline {
    Inline::Link { to: to.into(), shown: vec![shown] }
}

/// A list of links with commas.
fn links<'a>(paths: impl IntoIterator<Item = &'a String>) -> Vec<Inline> {
    let mut out = Vec::new();
    for path in paths {
        if !out.is_empty() {
            out.push(Inline::Text(", ".into()));
        }
        let name = path.rsplit('/').next().unwrap_or(path);
        out.push(link(path, Inline::Text(name.into())));
    }
    out
}

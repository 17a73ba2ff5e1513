//! Makes the card of a value, figure, equation or statement: all that is known of it.

use super::claims::with_formulas;
use super::document::{Inline, to_inlines, words_and_maths};
use super::edition::Edition;
use super::ledger::Ledger;
use super::values::{Digits, Number, Provenance, Value, ValueRegistry};
use crate::experiments::{AnyExperiment, Profile};
use crate::print::{Style, print};
use crate::project::Project;
use crate::table::{DataFile, table_name};
use serde_json::Value as Json;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// Id of what it is about: `sweep.rise.half_height`, `fig:3`, `eq:18`, `claim:sec7_jump`.
    pub id: String,
    pub title: Vec<Inline>,
    /// What it is in one plain sentence; may be empty.
    pub lead: String,
    /// Names, as "standard error", and texts; an empty name continues the row before.
    pub rows: Vec<Row>,
}

type Row = (&'static str, Vec<Inline>);

impl Card {
    fn new(id: String, title: Vec<Inline>) -> Self {
        Card { id, title, lead: String::new(), rows: Vec::new() }
    }

    fn add_row(&mut self, name: &'static str, text: Vec<Inline>) {
        if !text.is_empty() {
            self.rows.push((name, text));
        }
    }

    fn add_words(&mut self, name: &'static str, text: &str) {
        self.add_row(name, words_and_maths(text));
    }

    fn add_item(&mut self, name: &'static str, item: &str, cards: &Cards<'_>) {
        if !item.is_empty() {
            let link = || vec![(name, vec![link_to_line(item, cards.project)])];
            self.rows.extend(cards.cached(name, item, link));
        }
    }

    /// Ends a card with the command of the program that makes what it shows again.
    fn add_command(&mut self, command: &str, project: &Project) {
        let line = format!("{} {command}", project.sources.name);
        self.add_row("repeat it", vec![Inline::Code(line)]);
    }

    fn add_experiment(&mut self, name: &str, cards: &Cards<'_>) {
        let mut experiments = cards.experiments.iter();
        let Some(experiment) = experiments.find(|one| one.name() == name) else { return };
        self.add_item("experiment", &experiment.item(), cards);
        let profile = cards.values.profile().unwrap_or(Profile::Full);
        let parameters = || {
            let settings = settings(&experiment.parameters(profile).unwrap_or_default());
            let names = std::iter::once("its parameters").chain(std::iter::repeat(""));
            names.zip(settings.iter().map(|setting| words_and_maths(setting))).collect()
        };
        self.rows.extend(cards.cached("its parameters", name, parameters));
    }
}

pub struct Cards<'a> {
    pub values: &'a ValueRegistry,
    pub ledger: &'a Ledger,
    pub edition: &'a Edition,
    pub project: &'a Project,
    /// Experiments, for the parameters that cards of their results show.
    pub experiments: &'a [&'static dyn AnyExperiment],
    /// Rows that many cards have, by their name and what they are about.
    pub shared: Mutex<BTreeMap<(&'static str, String), Vec<Row>>>,
}

impl Cards<'_> {
    /// Returns rows that many cards have, and makes them for the first of these.
    fn cached(&self, name: &'static str, of: &str, make: impl FnOnce() -> Vec<Row>) -> Vec<Row> {
        let mut shared = self.shared.lock().unwrap_or_else(PoisonError::into_inner);
        shared.entry((name, of.into())).or_insert_with(make).clone()
    }

    /// Makes the card of an id: `fig:spread` or `Fig:3`; `claim:` may be left out.
    pub fn get(&self, id: &str) -> Option<Card> {
        let id = id.trim();
        let lower = id.to_lowercase();
        match lower.split_once(':') {
            Some(("fig", _)) => self.figure(&lower),
            Some(("eq", number)) => self.equation(number.parse().ok()?),
            Some(("claim", name)) => self.claim(name),
            _ => self.value(id.strip_prefix("v.").unwrap_or(id)).or_else(|| self.claim(id)),
        }
    }

    /// Returns all ids, in the order values, figures, equations, statements.
    pub fn ids(&self) -> Vec<String> {
        let values = self.values.iter().map(|value| value.id.clone());
        let figures = self.ledger.figures.iter().map(|figure| figure.label.clone());
        let equations = self.ledger.equations.iter().map(|e| format!("eq:{}", e.number));
        let claims = self.ledger.claims.iter().map(|claim| format!("claim:{}", claim.id));
        values.chain(figures).chain(equations).chain(claims).collect()
    }

    /// Returns the ids for what a person typed: "Fig. 3", a part of an id, or digits of a value.
    pub fn find(&self, asked: &str) -> Vec<String> {
        // Templates have quotation marks in names of rows; people write brackets and blanks.
        let asked = asked.trim().replace('"', "");
        let lower = asked.to_lowercase().replace(['(', ')', ' '], "");
        let id = lower.replacen("fig.", "fig:", 1).replacen("eq.", "eq:", 1);
        for id in [&asked, &id] {
            if let Some(card) = self.get(id) {
                return vec![card.id];
            }
        }
        if lower.is_empty() {
            return Vec::new();
        }
        // Reports have a minus that no keyboard has.
        let digits = asked.replace('−', "-");
        let begins = |value: &Value| value.to_plain_text().starts_with(&digits);
        let mut ids = self.ids();
        ids.retain(|id| {
            id.to_lowercase().contains(&lower) || self.values.get(id).is_some_and(begins)
        });
        ids
    }

    fn value(&self, id: &str) -> Option<Card> {
        let value = self.values.get(id)?;
        let mut title = to_inlines(&print(&value.number, Style::default()));
        if !value.unit.is_empty() {
            title.push(Inline::Text("\u{a0}".into()));
            title.extend(words_and_maths(&value.unit));
        }
        let mut card = Card { lead: first_sentence(value), ..Card::new(value.id.clone(), title) };
        if matches!(value.number, Number::Real { .. }) {
            let full = Style { digits: Some(Digits::Full), ..Style::default() };
            card.add_words("in full", &print(&value.number, full).to_plain_text());
        }
        if let Provenance::Ensemble { realisations, standard_error, .. } = &value.kind {
            card.add_words("standard error", &standard_error.to_string());
            if *realisations > 0 {
                card.add_words("realisations", &realisations.to_string());
            }
        }
        // Before its parameters, which may be many.
        match (&value.kind, &*value.experiment) {
            (Provenance::Printed { place }, _) => card.add_words("place", place),
            (_, "") => card.add_command("paper", self.project),
            (_, name) => card.add_command(&format!("paper --rerun {name}"), self.project),
        }
        card.add_item("computed by", &value.source, self);
        // Two paths of one item: the home was written by `stringify!`, the source by `type_name`.
        let home = self.ledger.equations.iter().find(|equation| equation.home == value.source);
        if let Some(number) = home.map(|equation| equation.number) {
            let (to, label) = (format!("eq:{number}"), format!("Eq.\u{a0}({number})"));
            card.add_row("equation", vec![Inline::Reference { to, within: None, label }]);
        }
        let mut data = vec!["values.json".to_string()];
        data.extend(table_name(&value.id).map(|t| format!("data/{}", DataFile::file_name(t))));
        card.add_row("data", links(&data));
        card.add_row("id", vec![Inline::Code(value.id.clone())]);
        card.add_experiment(&value.experiment, self);
        Some(card)
    }

    fn figure(&self, asked: &str) -> Option<Card> {
        let is_asked = |label: &str| label.to_lowercase() == asked;
        let mut figures = self.ledger.figures.iter();
        let figure =
            figures.find(|f| is_asked(&f.label) || is_asked(&format!("fig:{}", f.number)))?;
        let title = vec![Inline::Text(figure.title.clone())];
        let mut card = Card::new(figure.label.clone(), title);
        card.add_words("shows", &figure.description);
        card.add_row("picture", links([&figure.picture]));
        card.add_row("data", links(&figure.data));
        card.add_item("drawn by", &figure.source, self);
        for name in &figure.experiments {
            card.add_experiment(name, self);
        }
        card.add_command(&format!("paper --figure {}", figure.number), self.project);
        Some(card)
    }

    fn equation(&self, number: u32) -> Option<Card> {
        let equation = self.ledger.equations.iter().find(|equation| equation.number == number)?;
        let title = words_and_maths(&equation.what);
        let mut card = Card::new(format!("eq:{number}"), title);
        card.lead = format!("Equation ({number}).");
        card.add_words("stands in", &format!("Sec. {}", equation.section));
        card.add_item("home", &equation.home, self);
        if let Some(towards) = &equation.step_towards {
            card.add_words("is", &format!("a step towards {towards}"));
        }
        let values = self.values.iter().filter(|value| value.source == equation.home);
        let values: Vec<&str> = values.map(|value| value.id.as_str()).collect();
        card.add_words("values", &values.join(", "));
        Some(card)
    }

    fn claim(&self, id: &str) -> Option<Card> {
        let claim = self.ledger.claims.iter().find(|claim| claim.id == id)?;
        let title = words_and_maths(&with_formulas(&claim.statement));
        let mut card = Card::new(format!("claim:{id}"), title);
        let words = claim.verdict.words();
        let [first, rest] = [words.get(..1), words.get(1..)].map(Option::unwrap_or_default);
        let why = claim.difference().map_or_else(String::new, |why| format!(" ({why})"));
        card.lead = format!("{}{rest}{why}.", first.to_uppercase());
        card.add_words("paper", &with_formulas(&claim.expected));
        card.add_words("here", &with_formulas(&claim.found.to_string()));
        card.add_words("tolerance", &with_formulas(&claim.tolerance.to_string()));
        card.add_words("because", &with_formulas(&claim.reason));
        card.add_words("note", &with_formulas(&claim.note.to_string()));
        card.add_words("stands in", &claim.place);
        card.add_item("judged by", &(self.edition.judged_by)(&claim.id), self);
        let (to, label) = (card.id.clone(), "the row of this statement".into());
        card.add_row("ledger", vec![Inline::Reference { to, within: None, label }]);
        card.add_command(&format!("check {}", claim.id), self.project);
        Some(card)
    }
}

fn link(to: &str, words: Inline) -> Inline {
    Inline::Link { to: to.into(), words: vec![words] }
}

pub(super) fn links<'a>(paths: impl IntoIterator<Item = &'a String>) -> Vec<Inline> {
    let mut links = Vec::new();
    for path in paths {
        if !links.is_empty() {
            links.push(Inline::Text(", ".into()));
        }
        let name = path.rsplit('/').next().unwrap_or(path);
        links.push(link(path, Inline::Text(name.into())));
    }
    links
}

/// Makes a link to the line of an item of the source; only its path if there is no such file.
pub(super) fn link_to_line(item: &str, project: &Project) -> Inline {
    let code = Inline::Code(item.into());
    match project.sources.place(item) {
        Some((file, Some(line))) => {
            let words = vec![code, Inline::Text(format!(", line {line}"))];
            Inline::Link { to: format!("../{file}#L{line}"), words }
        }
        Some((file, None)) => link(&format!("../{file}"), code),
        None => code,
    }
}

/// Says what the number means, then what kind of number it is and where it comes from.
fn first_sentence(value: &Value) -> String {
    let Some(first) = value.note.chars().next() else { return kind_in_words(value) };
    // A name as σ begins no sentence.
    let meaning = match value.note.split_at(first.len_utf8()) {
        (first, rest) if rest.starts_with(char::is_alphabetic) => first.to_uppercase() + rest,
        _ => format!("The {}", value.note),
    };
    format!("{}. {}", meaning.trim_end_matches('.'), kind_in_words(value))
}

fn kind_in_words(value: &Value) -> String {
    let computed = match &value.kind {
        Provenance::Exact => "Computed exactly".into(),
        Provenance::Deterministic => "Computed without chance".into(),
        Provenance::Ensemble { realisations: 0, .. } => {
            "An estimate from several samples, with its standard error in brackets".into()
        }
        Provenance::Ensemble { realisations, .. } => {
            format!("Found from {realisations} realisations, with its standard error in brackets")
        }
        Provenance::Printed { .. } => "A number that the paper prints".into(),
        Provenance::Measured => {
            "Measured, or a ratio of what was measured, and an input since".into()
        }
    };
    match value.experiment.as_str() {
        "" => format!("{computed}."),
        name => format!("{computed}, from the experiment “{}”.", name.replace('_', " ")),
    }
}

/// Writes each parameter, the seed among them: `runs: 3`, `seed: 7`. A nested field has both names;
/// one with several values lists them, or the first and the last of more than eight.
fn settings(parameters: &Json) -> Vec<String> {
    let mut settings: Vec<(String, Vec<String>)> = Vec::new();
    for (name, value) in leaves("", parameters) {
        match settings.iter_mut().find(|(known, _)| *known == name) {
            Some((_, values)) if values.contains(&value) => (),
            Some((_, values)) => values.push(value),
            None => settings.push((name, vec![value])),
        }
    }
    let listed = |(name, values): (String, Vec<String>)| match values.as_slice() {
        [first, .., last] if values.len() > 8 => {
            format!("{name}: {} from {first} to {last}", values.len())
        }
        few => format!("{name}: {}", few.join(", ")),
    };
    settings.into_iter().map(listed).collect()
}

/// Returns the numbers and words in JSON, each with the names of its fields.
fn leaves(name: &str, value: &Json) -> Vec<(String, String)> {
    let of_field = |(field, value): (&String, &Json)| {
        leaves(format!("{name} {}", field.replace('_', " ")).trim_start(), value)
    };
    match value {
        Json::Null => Vec::new(),
        Json::Array(list) => list.iter().flat_map(|one| leaves(name, one)).collect(),
        Json::Object(fields) => fields.iter().flat_map(of_field).collect(),
        Json::String(text) => vec![(name.into(), text.clone())],
        Json::Number(number) if number.is_f64() => {
            vec![(name.into(), number.as_f64().unwrap_or(f64::NAN).to_string())]
        }
        other => vec![(name.into(), other.to_string())],
    }
}

//! Makes the card of a value, figure, equation or statement: all that is known of it.

use super::claims::with_formulas;
use super::document::{Inline, to_inlines, words_and_maths};
use super::edition::Edition;
use super::ledger::Ledger;
use super::values::{Digits, Number, Provenance, Registry, Value};
use crate::experiments::{AnyExperiment, Profile};
use crate::print::{Style, print};
use crate::project::Project;
use crate::table::{DataFile, table_name};
use serde_json::Value as Json;

#[derive(Clone, Debug, PartialEq)]
pub struct Card {
    /// Id of what it is about: `sweep.rise.half_height`, `fig:3`, `eq:18`, `claim:sec7_jump`.
    pub id: String,
    pub title: Vec<Inline>,
    /// What it is in one plain sentence; may be empty.
    pub lead: String,
    /// Names, as "standard error", and texts; an empty name continues the row before.
    pub rows: Vec<(&'static str, Vec<Inline>)>,
}

impl Card {
    fn new(id: String, title: Vec<Inline>) -> Self {
        Card { id, title, lead: String::new(), rows: Vec::new() }
    }

    fn row(&mut self, name: &'static str, text: Vec<Inline>) {
        if !text.is_empty() {
            self.rows.push((name, text));
        }
    }

    fn words(&mut self, name: &'static str, text: &str) {
        self.row(name, words_and_maths(text));
    }

    fn item(&mut self, name: &'static str, item: &str, project: &Project) {
        if !item.is_empty() {
            self.row(name, vec![link_to_line(item, project)]);
        }
    }

    /// Ends a card with the command of the program that makes what it shows again.
    fn repeat(&mut self, command: &str, project: &Project) {
        let line = format!("{} {command}", project.sources.name);
        self.row("repeat it", vec![Inline::Code(line)]);
    }

    fn experiment(&mut self, name: &str, cards: &Cards<'_>) {
        let mut experiments = cards.experiments.iter();
        let Some(experiment) = experiments.find(|one| one.name() == name) else { return };
        self.item("experiment", &experiment.item(), cards.project);
        let profile = cards.values.profile().unwrap_or(Profile::Full);
        let parameters = experiment.parameters(profile).unwrap_or_default();
        for (number, setting) in settings(&parameters).iter().enumerate() {
            self.words(if number == 0 { "its parameters" } else { "" }, setting);
        }
    }
}

pub struct Cards<'a> {
    pub values: &'a Registry,
    pub ledger: &'a Ledger,
    pub edition: &'a Edition,
    pub project: &'a Project,
    /// Experiments, for the parameters that cards of their results show.
    pub experiments: &'a [&'static dyn AnyExperiment],
}

impl Cards<'_> {
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
        let mut ids = self.ids();
        ids.retain(|id| id.to_lowercase().contains(&lower));
        if ids.is_empty() {
            let digits =
                self.values.iter().filter(|value| value.to_plain_text().starts_with(&asked));
            ids.extend(digits.map(|value| value.id.clone()));
        }
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
            card.words("in full", &print(&value.number, full).to_plain_text());
        }
        if let Provenance::Ensemble { realisations, standard_error, .. } = &value.kind {
            card.words("standard error", &standard_error.to_string());
            if *realisations > 0 {
                card.words("realisations", &realisations.to_string());
            }
        }
        if let Provenance::Printed { place } = &value.kind {
            card.words("place", place);
        }
        card.item("computed by", &value.source, self.project);
        let home = self.ledger.equations.iter().find(|equation| equation.home == value.source);
        if let Some(number) = home.map(|equation| equation.number) {
            let (to, label) = (format!("eq:{number}"), format!("Eq.\u{a0}({number})"));
            card.row("equation", vec![Inline::Reference { to, within: None, label }]);
        }
        let mut data = vec!["values.json".to_string()];
        data.extend(table_name(&value.id).map(|t| format!("data/{}", DataFile::file_name(t))));
        card.row("data", links(&data));
        card.row("id", vec![Inline::Code(value.id.clone())]);
        card.experiment(&value.experiment, self);
        if !value.experiment.is_empty() {
            card.repeat(&format!("paper --rerun {}", value.experiment), self.project);
        }
        Some(card)
    }

    fn figure(&self, asked: &str) -> Option<Card> {
        let is_asked = |label: &str| label.to_lowercase() == asked;
        let mut figures = self.ledger.figures.iter();
        let figure =
            figures.find(|f| is_asked(&f.label) || is_asked(&format!("fig:{}", f.number)))?;
        let title = vec![Inline::Text(figure.title.clone())];
        let mut card = Card::new(figure.label.clone(), title);
        card.words("shows", &figure.description);
        card.row("picture", links([&figure.picture]));
        card.row("data", links(&figure.data));
        card.item("drawn by", &figure.source, self.project);
        for name in &figure.experiments {
            card.experiment(name, self);
        }
        card.repeat(&format!("paper --figure {}", figure.number), self.project);
        Some(card)
    }

    fn equation(&self, number: u32) -> Option<Card> {
        let equation = self.ledger.equations.iter().find(|equation| equation.number == number)?;
        let title = words_and_maths(&equation.what);
        let mut card = Card::new(format!("eq:{number}"), title);
        card.lead = format!("Equation ({number}).");
        card.words("stands in", &format!("Sec. {}", equation.section));
        card.item("home", &equation.home, self.project);
        if let Some(towards) = &equation.step_towards {
            card.words("is", &format!("a step towards {towards}"));
        }
        let values = self.values.iter().filter(|value| value.source == equation.home);
        let values: Vec<&str> = values.map(|value| value.id.as_str()).collect();
        card.words("values", &values.join(", "));
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
        card.words("paper", &with_formulas(&claim.expected));
        card.words("here", &with_formulas(&claim.found.to_string()));
        card.words("tolerance", &with_formulas(&claim.tolerance.to_string()));
        card.words("because", &with_formulas(&claim.reason));
        card.words("note", &with_formulas(&claim.note.to_string()));
        card.words("stands in", &claim.place);
        card.item("judged by", &(self.edition.judged_by)(&claim.id), self.project);
        let (to, label) = (card.id.clone(), "the row of this statement".into());
        card.row("ledger", vec![Inline::Reference { to, within: None, label }]);
        card.repeat(&format!("check {}", claim.id), self.project);
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
    let Some(first) = value.note.chars().next() else { return kind(value) };
    // A name as σ begins no sentence.
    let meaning = match value.note.split_at(first.len_utf8()) {
        (first, rest) if rest.starts_with(char::is_alphabetic) => first.to_uppercase() + rest,
        _ => format!("The {}", value.note),
    };
    format!("{}. {}", meaning.trim_end_matches('.'), kind(value))
}

fn kind(value: &Value) -> String {
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
        Provenance::Measured => "A number measured once, and an input since".into(),
    };
    match value.experiment.as_str() {
        "" => format!("{computed}."),
        name => format!("{computed}, from the experiment “{}”.", name.replace('_', " ")),
    }
}

/// Writes each parameter, the seed among them: `runs: 3`, `seed: 7`. A nested field has both names;
/// one with several values lists them, or the first and the last of more than eight.
fn settings(parameters: &Json) -> Vec<String> {
    let mut settings = Vec::new();
    collect("", parameters, &mut settings);
    let listed = |(name, values): (String, Vec<String>)| match values.as_slice() {
        [first, .., last] if values.len() > 8 => {
            format!("{name}: {} from {first} to {last}", values.len())
        }
        few => format!("{name}: {}", few.join(", ")),
    };
    settings.into_iter().map(listed).collect()
}

fn collect(name: &str, value: &Json, settings: &mut Vec<(String, Vec<String>)>) {
    let written = match value {
        Json::Null => return,
        Json::Array(list) => return list.iter().for_each(|one| collect(name, one, settings)),
        Json::Object(fields) => {
            for (field, value) in fields {
                let whole = format!("{name} {}", field.replace('_', " "));
                collect(whole.trim_start(), value, settings);
            }
            return;
        }
        Json::String(text) => text.clone(),
        Json::Number(number) if number.is_f64() => number.as_f64().unwrap_or(f64::NAN).to_string(),
        other => other.to_string(),
    };
    match settings.iter_mut().find(|(known, _)| known == name) {
        Some((_, values)) if values.contains(&written) => (),
        Some((_, values)) => values.push(written),
        None => settings.push((name.into(), vec![written])),
    }
}

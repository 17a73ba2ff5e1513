//! Reads what the paper printed from `published.toml`.

use super::check::Kind;
use crate::input::{one_line, toml_fault};
use serde::Deserialize;
use std::collections::BTreeSet;

/// Everything that the paper printed and this edition judges or uses.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Published {
    /// Numbers that the paper chose.
    #[serde(rename = "parameter")]
    pub parameters: Vec<Parameter>,
    #[serde(rename = "statement")]
    pub statements: Vec<Statement>,
    #[serde(skip)]
    text: String,
}

/// A number that the paper chose.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table [[parameter]]")]
pub struct Parameter {
    /// Its id, `«paper.id»` in the prose.
    pub id: String,
    /// Where it stands in the paper.
    pub place: String,
    pub value: f64,
}

/// A quantitative statement of the paper.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table [[statement]]")]
pub struct Statement {
    /// Its id: the rule with this id judges it.
    pub id: String,
    /// `definition` for a definition of words or symbols: no score counts it.
    #[serde(default)]
    pub kind: Kind,
    /// A word for the difference, if it differs: `misprint` or another; scores count each word.
    #[serde(default)]
    pub why: String,
    /// Where it stands in the paper.
    pub place: String,
    /// What it states, in our words.
    pub statement: String,
    /// What can be read there, in its shortest form.
    pub printed: String,
    /// The number in it, if there is one; that of `printed`, where this is a number alone.
    pub value: Option<f64>,
    /// Decimals that were printed; an integer has none.
    #[serde(default)]
    pub decimals: u8,
}

/// What is wrong with a file of published statements.
#[derive(Debug, thiserror::Error)]
pub enum PublishedError {
    #[error("published.toml:{0}")]
    Line(String),
    #[error("published.toml: no {what} {id:?}; add it, or remove the check that asks for it")]
    Missing { what: &'static str, id: String },
}

impl Published {
    /// Reads the file.
    ///
    /// # Errors
    /// If it has another form, or an id stands twice, with the line.
    pub fn parse(text: &str) -> Result<Published, PublishedError> {
        let mut published: Published =
            toml::from_str(text).map_err(|error| PublishedError::Line(toml_fault(text, &error)))?;
        published.text = text.into();
        for at in 0..published.statements.len() {
            let statement = &mut published.statements[at];
            let Ok(number) = statement.printed.parse::<f64>() else { continue };
            let decimals = statement.printed.split_once('.').map_or(0, |(_, after)| after.len());
            let decimals = decimals as u8;
            if statement.value.is_none() && number.is_finite() {
                (statement.value, statement.decimals) = (Some(number), decimals);
            } else if statement.value != Some(number) || statement.decimals != decimals {
                let what = "printed and value are not one number; leave value out";
                let id = statement.id.clone();
                return Err(published.fault(&id, what));
            }
        }
        let mut seen = BTreeSet::new();
        let parameters = published.parameters.iter().map(|parameter| &parameter.id);
        for id in parameters.chain(published.statements.iter().map(|statement| &statement.id)) {
            if !seen.insert(id) {
                return Err(published.fault(id, "it stands twice; give each entry its own"));
            }
        }
        Ok(published)
    }

    /// Makes an error of the entry with this id, with its line.
    fn fault(&self, id: &str, what: &str) -> PublishedError {
        let line = self.line(id);
        PublishedError::Line(format!("{line}: the id {:?}: {what}", one_line(id, 80)))
    }

    /// Makes the error of a statement with other printed words than those that its rule judges.
    pub fn unread(&self, id: &str, words: &str) -> PublishedError {
        let what = format!(
            "its check judges {words:?}, and not its printed; restore the one that is wrong"
        );
        self.fault(id, &what)
    }

    /// Returns the statement with this id.
    pub fn statement(&self, id: &str) -> Result<&Statement, PublishedError> {
        let found = self.statements.iter().find(|statement| statement.id == id);
        found.ok_or_else(|| PublishedError::Missing { what: "statement", id: id.into() })
    }

    /// Finds the last line of the file, from 1, that gives an entry this id; 1 if there is none.
    pub fn line(&self, id: &str) -> usize {
        let ways = ['"', '\''].map(|quote| format!("id={quote}{id}{quote}"));
        let mut found = 1;
        for (number, line) in (1..).zip(self.text.lines()) {
            if ways.contains(&line.split_whitespace().collect()) {
                found = number;
            }
        }
        found
    }

    /// Returns the number that the paper chose under this id.
    pub fn parameter(&self, id: &str) -> Result<f64, PublishedError> {
        let found = self.parameters.iter().find(|parameter| parameter.id == id);
        let missing = || PublishedError::Missing { what: "parameter", id: id.into() };
        found.map(|parameter| parameter.value).ok_or_else(missing)
    }
}

impl Statement {
    /// Makes a statement without a place, as of a relation between numbers.
    pub(super) fn new(kind: Kind, id: &str, statement: &str) -> Statement {
        let (id, statement) = (id.into(), statement.into());
        Statement { kind, id, statement, ..Statement::default() }
    }

    /// Returns the printed number.
    pub fn number(&self) -> Result<f64, PublishedError> {
        self.value.ok_or_else(|| PublishedError::Missing { what: "value of", id: self.id.clone() })
    }

    /// Returns half a unit of the last printed digit.
    pub fn half_unit(&self) -> f64 {
        (0..self.decimals).fold(1.0, |unit, _| unit / 10.0) / 2.0
    }

    /// Returns the ends of the numbers that round to the printed one: half a unit of its last digit
    /// to both sides.
    pub fn interval(&self) -> Result<[f64; 2], PublishedError> {
        let value = self.number()?;
        Ok([value - self.half_unit(), value + self.half_unit()])
    }
}

//! What the paper printed: `templates/published.toml`.

use super::Kind;
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
    /// Statements that it makes.
    #[serde(rename = "statement")]
    pub statements: Vec<Statement>,
    #[serde(skip)]
    text: String,
}

/// A number that the paper chose.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table [[parameter]]")]
pub struct Parameter {
    /// Its id, `«paper.id»` in the templates.
    pub id: String,
    /// Where it stands.
    pub place: String,
    /// The number.
    pub value: f64,
}

/// A quantitative statement of the paper.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table [[statement]]")]
pub struct Statement {
    /// Its id: the check with this id judges it.
    pub id: String,
    /// `definition` for a definition of words or symbols: no score counts it.
    #[serde(default)]
    pub kind: Kind,
    /// A word for the difference, if it differs: `misprint` or another; scores count each word.
    #[serde(default)]
    pub why: String,
    /// Where it stands.
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
    /// What is no such file, and an id that stands twice, with the line.
    pub fn parse(text: &str) -> Result<Published, PublishedError> {
        let mut published: Published =
            toml::from_str(text).map_err(|error| PublishedError::Line(toml_fault(text, &error)))?;
        published.text = text.into();
        for at in 0..published.statements.len() {
            let own = &mut published.statements[at];
            let Ok(number) = own.printed.parse::<f64>() else { continue };
            let digits = own.printed.split_once('.').map_or(0, |(_, digits)| digits.len() as u8);
            if own.value.is_none() && number.is_finite() {
                (own.value, own.decimals) = (Some(number), digits);
            } else if own.value != Some(number) || own.decimals != digits {
                let (id, what) =
                    (own.id.clone(), "printed and value are not one number; leave value out");
                return Err(published.fault(&id, what));
            }
        }
        let ids = published.parameters.iter().map(|own| &own.id);
        let mut seen = BTreeSet::new();
        let twice =
            ids.chain(published.statements.iter().map(|own| &own.id)).find(|id| !seen.insert(*id));
        if let Some(id) = twice {
            return Err(published.fault(id, "it stands twice; give each entry its own"));
        }
        Ok(published)
    }

    /// What is wrong with the entry of this id, with its line.
    fn fault(&self, id: &str, what: &str) -> PublishedError {
        let line = self.line(id);
        PublishedError::Line(format!("{line}: the id {:?}: {what}", one_line(id, 80)))
    }

    /// A statement of which other words are printed than those that its check judges.
    pub fn unread(&self, id: &str, reads: &str) -> PublishedError {
        let what = format!(
            "its check judges {reads:?}, and not its printed; restore the one that is wrong"
        );
        self.fault(id, &what)
    }

    /// The statement with this id.
    pub fn statement(&self, id: &str) -> Result<&Statement, PublishedError> {
        let found = self.statements.iter().find(|own| own.id == id);
        found.ok_or_else(|| PublishedError::Missing { what: "statement", id: id.into() })
    }

    /// The last line of the file, from 1, where an entry gives itself this id.
    pub fn line(&self, id: &str) -> usize {
        let own = ['"', '\''].map(|quote| format!("id={quote}{id}{quote}"));
        let named = |line: &str| own.contains(&line.split_whitespace().collect());
        self.text.lines().zip(1..).filter(|(line, _)| named(line)).last().map_or(1, |(_, at)| at)
    }

    /// The number that the paper chose under this id.
    pub fn parameter(&self, id: &str) -> Result<f64, PublishedError> {
        let found = self.parameters.iter().find(|own| own.id == id).map(|own| own.value);
        found.ok_or_else(|| PublishedError::Missing { what: "parameter", id: id.into() })
    }
}

impl Statement {
    /// The printed number.
    pub fn number(&self) -> Result<f64, PublishedError> {
        self.value.ok_or_else(|| PublishedError::Missing { what: "value of", id: self.id.clone() })
    }

    /// Half a unit of the last printed digit.
    pub fn half_unit(&self) -> f64 {
        (0..self.decimals).fold(1.0, |unit, _| unit / 10.0) / 2.0
    }

    /// The numbers that round to the printed one: half a unit of its last digit to both sides.
    pub fn interval(&self) -> Result<[f64; 2], PublishedError> {
        let value = self.number()?;
        Ok([value - self.half_unit(), value + self.half_unit()])
    }
}

//! What the paper printed: `templates/published.toml`.

use crate::digest::sha256;
use crate::input::{one_line, toml_fault};
use serde::Deserialize;
use std::collections::BTreeSet;

/// Everything that the paper printed and this edition judges or uses.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Published {
    /// Numbers that the paper chose.
    #[serde(rename = "parameter")]
    pub parameters: Vec<Parameter>,
    /// Statements that it makes.
    #[serde(rename = "statement")]
    pub statements: Vec<Statement>,
    /// SHA-256 of the file, in hexadecimal: a printed digit or a value that is edited shows.
    #[serde(skip)]
    pub digest: String,
}

/// A number that the paper chose.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// Its id, `«paper.id»` in the templates.
    pub id: String,
    /// Where it stands.
    pub place: String,
    /// Its letter.
    pub symbol: String,
    /// The number.
    pub value: f64,
}

/// A quantitative statement of the paper.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Statement {
    /// Its id: the claim with this id judges it.
    pub id: String,
    /// Where it stands.
    pub place: String,
    /// What it says, in our words.
    pub statement: String,
    /// What can be read there, in its shortest form.
    pub printed: String,
    /// The number in it, if there is one.
    pub value: Option<f64>,
    /// Decimals that were printed; an integer has none.
    #[serde(default)]
    pub decimals: u8,
}

/// What is wrong with a file of published statements.
#[derive(Debug, thiserror::Error)]
pub enum PublishedError {
    /// It cannot be read.
    #[error("published.toml: {0}")]
    Unread(std::io::Error),
    /// It is not the TOML that is expected: line and fault.
    #[error("published.toml:{0}")]
    Syntax(String),
    /// An id stands twice.
    #[error("published.toml: the id {0:?} stands twice; give each statement its own")]
    Twice(String),
    /// TOML has NaN and infinity; no paper prints them.
    #[error("published.toml: the value of {0:?} is not finite; give a number")]
    NotFinite(String),
    /// A claim asks for a statement or a number that is not there.
    #[error("published.toml: no {what} {id:?}; add it, or remove the claim that asks for it")]
    Missing {
        /// Statement, value or parameter.
        what: &'static str,
        /// Its id.
        id: String,
    },
    /// A statement that no claim judges.
    #[error("published.toml: no claim judges {0:?}; write one, or remove it")]
    Unjudged(String),
}

impl Published {
    /// Reads the file.
    ///
    /// # Errors
    /// [`PublishedError`] for a syntax error, an id that stands twice, a value that is not finite.
    pub fn parse(text: &str) -> Result<Published, PublishedError> {
        let mut published: Published = toml::from_str(text)
            .map_err(|error| PublishedError::Syntax(toml_fault(text, &error)))?;
        published.digest = sha256(text);
        let parameters = published.parameters.iter().map(|p| &p.id);
        let statements = published.statements.iter().map(|s| &s.id);
        let mut seen = BTreeSet::new();
        for id in parameters.chain(statements) {
            if !seen.insert(id) {
                return Err(PublishedError::Twice(one_line(id, 80)));
            }
        }
        let chosen = published.parameters.iter().map(|p| (&p.id, Some(p.value)));
        let stated = published.statements.iter().map(|s| (&s.id, s.value));
        match chosen.chain(stated).find(|(_, value)| value.is_some_and(|x| !x.is_finite())) {
            Some((id, _)) => Err(PublishedError::NotFinite(one_line(id, 80))),
            None => Ok(published),
        }
    }

    /// The statement with this id.
    ///
    /// # Errors
    /// [`PublishedError::Missing`] if there is none.
    pub fn statement(&self, id: &str) -> Result<&Statement, PublishedError> {
        self.statements
            .iter()
            .find(|s| s.id == id)
            .ok_or_else(|| PublishedError::Missing { what: "statement", id: id.into() })
    }

    /// The line of the file, from 1, where the entry with this id names itself.
    pub fn line(&self, text: &str, id: &str) -> usize {
        let own = format!("id = \"{id}\"");
        text.lines().position(|line| line.trim() == own).map_or(1, |index| index + 1)
    }

    /// The number that the paper chose under this id.
    ///
    /// # Errors
    /// [`PublishedError::Missing`] if there is none.
    pub fn parameter(&self, id: &str) -> Result<f64, PublishedError> {
        self.parameters
            .iter()
            .find(|p| p.id == id)
            .map(|p| p.value)
            .ok_or_else(|| PublishedError::Missing { what: "parameter", id: id.into() })
    }
}

impl Statement {
    /// The printed number.
    ///
    /// # Errors
    /// [`PublishedError::Missing`] if the statement has none.
    pub fn number(&self) -> Result<f64, PublishedError> {
        self.value.ok_or_else(|| PublishedError::Missing { what: "value of", id: self.id.clone() })
    }

    /// The numbers that round to the printed one: half a unit of its last digit to both sides.
    ///
    /// # Errors
    /// [`PublishedError::Missing`] if the statement has none.
    pub fn rounding(&self) -> Result<[f64; 2], PublishedError> {
        let unit = (0..self.decimals).fold(1.0, |unit, _| unit / 10.0);
        let value = self.number()?;
        Ok([value - unit / 2.0, value + unit / 2.0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_wrong_says_what() {
        let row = "[[parameter]]\nid='a'\nplace='x'\nsymbol='a'\nvalue=1\n";
        let twice = format!("{row}{row}statement=[]");
        // `statement` after a table belongs to that table: the key is unknown there.
        assert!(matches!(Published::parse(&twice), Err(PublishedError::Syntax(_))));
        let twice = format!("statement=[]\n{row}{row}");
        assert!(matches!(Published::parse(&twice), Err(PublishedError::Twice(id)) if id == "a"));
        let once = Published::parse(&format!("statement=[]\n{row}")).unwrap();
        assert!(matches!(once.parameter("b"), Err(PublishedError::Missing { .. })));
        assert!(matches!(once.statement("b"), Err(PublishedError::Missing { .. })));
    }
}

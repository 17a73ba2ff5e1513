//! What the paper printed: `templates/published.toml`.

use crate::digest::sha256;
use crate::input::{is_no_text, is_obeyed, one_line, toml_fault};
use serde::Deserialize;
use std::collections::BTreeMap;

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
    /// The file.
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
    /// Its letter.
    pub symbol: String,
    /// The number.
    pub value: f64,
}

/// A quantitative statement of the paper.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table [[statement]]")]
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
#[expect(missing_docs, reason = "the messages tell")]
pub enum PublishedError {
    #[error("published.toml: {0}")]
    Unread(std::io::Error),
    #[error("published.toml:{0}")]
    Line(String),
    #[error("published.toml: no {what} {id:?}; add it, or remove the claim that asks for it")]
    Missing { what: &'static str, id: String },
}

impl Published {
    /// Reads the file.
    pub fn parse(text: &str) -> Result<Published, PublishedError> {
        let mut published: Published =
            toml::from_str(text).map_err(|error| PublishedError::Line(toml_fault(text, &error)))?;
        (published.digest, published.text) = (sha256(text), text.into());
        let chosen = published.parameters.iter();
        let chosen = chosen
            .map(|p| (&p.id, Some(p.value), vec![("place", &p.place), ("symbol", &p.symbol)]));
        let stated = published.statements.iter().map(|s| {
            let words =
                vec![("place", &s.place), ("statement", &s.statement), ("printed", &s.printed)];
            (&s.id, s.value, words)
        });
        let mut seen = BTreeMap::<&str, usize>::new();
        for (id, value, words) in chosen.chain(stated) {
            let before = seen.entry(id).or_default();
            *before += 1;
            let fault = |what: String| Err(published.fault(id, *before, &what));
            if *before > 1 {
                return fault("it stands twice; give each entry its own".into());
            }
            if value.is_some_and(|x| !x.is_finite()) {
                return fault("its value is not finite; give a number".into());
            }
            for (name, words) in words {
                if words.trim().is_empty() {
                    return fault(format!("its {name} has no words; write them"));
                }
                let odd = |c: &char| is_no_text(*c) || is_obeyed(*c) || ['«', '»'].contains(c);
                if let Some(c) = words.chars().find(odd) {
                    let number = u32::from(c);
                    return fault(format!(
                        "its {name} has the character U+{number:04X}, which no row of a table can have; remove it"
                    ));
                }
                if words.matches('$').count() % 2 == 1 {
                    return fault(format!(
                        "its {name} has a formula without its end; write the other $"
                    ));
                }
            }
        }
        Ok(published)
    }

    /// What is wrong with the entry of this id, the first or a later one, with its line.
    fn fault(&self, id: &str, which: usize, what: &str) -> PublishedError {
        let line = self.lines(id).nth(which - 1).unwrap_or(1);
        PublishedError::Line(format!("{line}: the id {:?}: {what}", one_line(id, 80)))
    }

    /// A statement that no claim judges.
    pub fn unjudged(&self, id: &str) -> PublishedError {
        self.fault(id, 1, "no claim judges it; write one, or remove it")
    }

    /// A statement of which other words are printed than those that its claim judges.
    pub fn unread(&self, id: &str, reads: &str) -> PublishedError {
        let made = |own: &&Statement| {
            let digits = |value| format!("{value:.*}", usize::from(own.decimals));
            own.value.is_some_and(|value| reads.contains(&digits(value)))
        };
        let own = self.statement(id).ok().filter(made);
        let what = match own {
            Some(own) => format!(
                "its value and decimals read {reads:?}, and its printed is {:?}; restore the one that is wrong",
                one_line(&own.printed, 80)
            ),
            None => format!(
                "its claim judges {reads:?}, and not its printed; restore it, or write a claim"
            ),
        };
        self.fault(id, 1, &what)
    }

    /// The lines of the file, from 1, where an entry gives itself this id.
    fn lines(&self, id: &str) -> impl Iterator<Item = usize> {
        let own = ['"', '\''].map(|quote| format!("id={quote}{id}{quote}"));
        let lines = self.text.lines().zip(1..);
        lines.filter_map(move |(line, number)| {
            let line: String = line.split_whitespace().collect();
            own.iter().any(|own| line.starts_with(own)).then_some(number)
        })
    }

    /// The statement with this id.
    pub fn statement(&self, id: &str) -> Result<&Statement, PublishedError> {
        self.statements
            .iter()
            .find(|s| s.id == id)
            .ok_or_else(|| PublishedError::Missing { what: "statement", id: id.into() })
    }

    /// The line of the file, from 1, where the entry with this id names itself.
    pub fn line(&self, id: &str) -> usize {
        self.lines(id).next().unwrap_or(1)
    }

    /// The number that the paper chose under this id.
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
    pub fn number(&self) -> Result<f64, PublishedError> {
        self.value.ok_or_else(|| PublishedError::Missing { what: "value of", id: self.id.clone() })
    }

    /// The numbers that round to the printed one: half a unit of its last digit to both sides.
    pub fn rounding(&self) -> Result<[f64; 2], PublishedError> {
        let unit = (0..self.decimals).fold(1.0, |unit, _| unit / 10.0);
        let value = self.number()?;
        Ok([value - unit / 2.0, value + unit / 2.0])
    }
}

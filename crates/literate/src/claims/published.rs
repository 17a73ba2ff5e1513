//! Reads what the paper printed from `published.toml`.

use super::check::{Check, Kind};
use super::numeral::{MAX_PLACES, number_alone, with_other_digit, written};
use super::texts::{Text, Words};
use crate::input::{one_line, toml_fault};
use serde::Deserialize;
use std::collections::BTreeSet;

/// All that was printed: the entries of `published.toml`.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Published {
    /// The entries `[[parameter]]`.
    #[serde(rename = "parameter")]
    pub parameters: Vec<Parameter>,
    #[serde(rename = "statement")]
    pub(crate) statements: Vec<Statement>,
    /// The texts of the checks, which stand in other files.
    #[serde(skip)]
    pub(crate) words: Words,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table [[parameter]]")]
pub struct Parameter {
    /// Its id, `«paper.id»` in the prose.
    pub id: String,
    pub(crate) place: String,
    pub(crate) value: f64,
}

/// An entry `[[statement]]`: something that was printed.
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
    pub(crate) why: String,
    pub(crate) place: String,
    /// The id of the sentence of which it is one reading of several; empty if it is the only one.
    #[serde(default)]
    pub(crate) sentence: String,
    pub(crate) statement: String,
    /// What can be read there, in its shortest form.
    pub printed: String,
    /// The number in it, if there is one; that of `printed`, where this is a number alone.
    pub value: Option<f64>,
    /// The place of its last printed digit: its decimals, and −3 if it was printed in thousands.
    #[serde(default)]
    pub(crate) decimals: Option<i32>,
    #[serde(skip)]
    pub(crate) line: usize,
}

/// What is wrong with a file of published statements or of texts, after its path.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct PublishedError(pub(super) String);

impl PublishedError {
    fn in_entry(line: usize, id: &str, problem: &str) -> PublishedError {
        PublishedError(format!("published.toml:{line}: the id {:?}: {problem}", one_line(id, 80)))
    }

    fn missing(kind: &str, id: &str) -> PublishedError {
        let remedy = "add it, or remove the check that asks for it";
        PublishedError(format!("published.toml: no {kind} {id:?}; {remedy}"))
    }
}

impl Published {
    /// Reads the file; an error has the line of what is wrong.
    pub fn parse(toml: &str) -> Result<Published, PublishedError> {
        let fault = |error| PublishedError(format!("published.toml:{}", toml_fault(toml, &error)));
        let mut published: Published = toml::from_str(toml).map_err(fault)?;
        let ids: Vec<(&str, usize)> = toml.lines().zip(1..).filter_map(id_of).collect();
        let line = |entry: Option<&(&str, usize)>| entry.map_or(1, |(_, line)| *line);
        let last_line = |id: &str| line(ids.iter().rfind(|(known, _)| *known == id));
        for statement in &mut published.statements {
            statement.line = last_line(&statement.id);
            statement.read_number().map_err(|problem| statement.fault(problem))?;
        }
        for Parameter { id, value, .. } in &published.parameters {
            if !value.is_finite() {
                let problem = "value is not a finite number";
                return Err(PublishedError::in_entry(last_line(id), id, problem));
            }
        }
        let mut seen = BTreeSet::new();
        let parameters = published.parameters.iter().map(|parameter| &parameter.id);
        for id in parameters.chain(published.statements.iter().map(|statement| &statement.id)) {
            if !seen.insert(id) {
                let first = line(ids.iter().find(|(known, _)| known == id));
                let problem = format!("it is also on line {first}; give each entry its own");
                return Err(PublishedError::in_entry(last_line(id), id, &problem));
            }
        }
        Ok(published)
    }

    /// Returns the statement with this id; it is an error if there is none.
    pub fn statement(&self, id: &str) -> Result<&Statement, PublishedError> {
        let statement = self.statements.iter().find(|statement| statement.id == id);
        statement.ok_or_else(|| PublishedError::missing("statement", id))
    }

    /// Returns the number of the parameter with this id; it is an error if there is none.
    pub fn parameter(&self, id: &str) -> Result<f64, PublishedError> {
        let parameter = self.parameters.iter().find(|parameter| parameter.id == id);
        parameter.map(|one| one.value).ok_or_else(|| PublishedError::missing("parameter", id))
    }

    /// Refuses a parameter with another number than the one that a check uses.
    pub(super) fn compare(&self, id: &str, number: f64) -> Result<(), PublishedError> {
        let value = self.parameter(id)?;
        if value == number {
            return Ok(());
        }
        let problem = format!("the parameter {id:?} is {value}, and its check uses {number}");
        let remedy = "restore the one that is wrong";
        Err(PublishedError(format!("published.toml: {problem}; {remedy}")))
    }
}

/// Returns the id that a line gives to an entry, with the number of the line.
fn id_of((line, number): (&str, usize)) -> Option<(&str, usize)> {
    let id = line.trim_start().strip_prefix("id")?.trim_start().strip_prefix('=')?;
    Some((id.trim().trim_matches(['"', '\'']), number))
}

fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::INFINITY)
}

impl Statement {
    pub(super) fn fault(&self, problem: &str) -> PublishedError {
        PublishedError::in_entry(self.line, &self.id, problem)
    }

    /// Reads the number from `printed` if this is one, and checks a number that is given besides.
    fn read_number(&mut self) -> Result<(), &'static str> {
        if let Some((value, decimals)) = number_alone(&self.printed) {
            let agrees = self.value.is_none_or(|given| given == value)
                && self.decimals.is_none_or(|given| given == decimals);
            (self.value, self.decimals) = (Some(value), Some(decimals));
            let problem = "printed and value are not one number; leave value out";
            return if agrees { Ok(()) } else { Err(problem) };
        }
        let Some(value) = self.value else { return Ok(()) };
        let decimals = self.decimals.or((value.fract() == 0.0).then_some(0));
        let decimals = decimals.ok_or("value needs `decimals`: write as many as were printed")?;
        let is_rounded = match decimals {
            ..0 => value % power_of_ten(-decimals) == 0.0,
            _ => written(value, decimals).parse() == Ok(value),
        };
        if !value.is_finite() || decimals.abs() > MAX_PLACES || !is_rounded {
            return Err("value is not a number with so many `decimals`");
        }
        // As a number, per cent or per mille.
        let as_printed = |shift| written(value * power_of_ten(shift), (decimals - shift).max(0));
        if value.fract() != 0.0
            && ![0, 2, 3].map(as_printed).iter().any(|form| self.printed.contains(form))
        {
            return Err("value does not stand in printed; write both as they were printed");
        }
        self.decimals = Some(decimals);
        Ok(())
    }

    /// Returns a misprinted copy of the statement, with another first digit in its number and in
    /// what was printed, or `None` if the statement has no number.
    pub(super) fn misprint(&self) -> Option<Statement> {
        let digits = self.printed_digits()?;
        let value = with_other_digit(&digits).parse().ok();
        let printed = match number_alone(&self.printed) {
            Some(_) => with_other_digit(&self.printed),
            None => self.printed.replacen(&digits, &with_other_digit(&digits), 1),
        };
        Some(Statement { value, printed, ..self.clone() })
    }

    pub(super) fn printed_digits(&self) -> Option<String> {
        Some(written(self.value?, self.decimals?))
    }

    /// Starts the check of the statement, which is open so far.
    pub(super) fn open(&self, found: impl Into<Text>) -> Check {
        Check {
            why: self.why.clone(),
            sentence: self.sentence.clone(),
            place: self.place.clone(),
            expected: self.printed.clone(),
            ..Check::new(self.kind, &self.id, &self.statement, found)
        }
    }

    /// Returns the printed number; it is an error if there is none.
    pub fn number(&self) -> Result<f64, PublishedError> {
        self.value.ok_or_else(|| {
            let remedy = "write it as `value`, with `decimals`, as many as were printed";
            let printed = &self.printed;
            self.fault(&format!("its check needs the number in printed = {printed:?}; {remedy}"))
        })
    }

    /// Returns half a unit of the last printed digit.
    pub fn half_unit(&self) -> f64 {
        0.5 * power_of_ten(-self.decimals.unwrap_or(0))
    }

    /// Returns the ends of the numbers that round to the printed one.
    pub fn interval(&self) -> Result<[f64; 2], PublishedError> {
        let value = self.number()?;
        Ok([value - self.half_unit(), value + self.half_unit()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(fields: &str) -> String {
        format!("[[statement]]\nid = \"a\"\nplace = \"b\"\nstatement = \"c\"\n{fields}\n")
    }

    fn parse(fields: &str) -> Result<Statement, String> {
        let published = Published::parse(&entry(fields)).map_err(|error| error.to_string())?;
        Ok(published.statements[0].clone())
    }

    #[test]
    fn the_tolerance_is_half_a_unit_of_the_last_digit_of_the_mantissa() {
        for (printed, value, half_unit, misprint) in [
            ("0.12", 0.12, 5e-3, "0.22"),
            ("1e-3", 1e-3, 5e-4, "2e-3"),
            ("1.2e5", 1.2e5, 5e3, "2.2e5"),
            ("3·10⁻⁴", 3e-4, 5e-5, "4·10⁻⁴"),
            ("−9.50 × 10¹²", -9.5e12, 5e9, "-8.50 × 10¹²"),
            ("10⁻⁹", 1e-9, 5e-10, "20⁻⁹"),
            ("12 %", 0.12, 5e-3, "22 %"),
            ("0.5 ‰", 5e-4, 5e-5, "0.6 ‰"),
            ("0", 0.0, 0.5, "1"),
        ] {
            let read = parse(&format!("printed = \"{printed}\"")).unwrap();
            assert_eq!((read.value, read.half_unit()), (Some(value), half_unit), "{printed}");
            assert_eq!(read.misprint().unwrap().printed.replace('−', "-"), misprint);
        }
        let read = parse("printed = \"σ ≈ 0.12\"\nvalue = 0.12\ndecimals = 2").unwrap();
        assert_eq!(read.half_unit(), 5e-3);
        let read = read.misprint().unwrap();
        assert_eq!((read.value, read.printed.as_str()), (Some(0.22), "σ ≈ 0.22"));
        for words in ["about 2.094", "1 2", "e5", "·10⁻⁴", "3 10⁻⁴", "inf", "1e999", "1e-99999999"]
        {
            assert_eq!(number_alone(words), None, "{words}");
        }
    }

    #[test]
    fn a_number_that_is_not_what_was_printed_is_refused_with_its_line() {
        for (fields, problem) in [
            ("printed = \"x\"\nvalue = 0.12", "value needs `decimals`"),
            ("printed = \"x\"\nvalue = 0.125\ndecimals = 2", "with so many `decimals`"),
            ("printed = \"x\"\nvalue = 1\ndecimals = 99999", "with so many `decimals`"),
            ("printed = \"x\"\nvalue = inf\ndecimals = 0", "with so many `decimals`"),
            ("printed = \"x\"\nvalue = 0.6\ndecimals = -3", "with so many `decimals`"),
            ("printed = \"x\"\nvalue = 1500\ndecimals = -3", "with so many `decimals`"),
            ("printed = \"about 2.094\"\nvalue = 2.5\ndecimals = 1", "does not stand in printed"),
            ("printed = \"12 %\"\nvalue = 12", "printed and value are not one number"),
            ("printed = \"1e-3\"\nvalue = 1e-3\ndecimals = 0", "printed and value are not"),
        ] {
            let error = parse(fields).unwrap_err();
            assert!(error.starts_with("published.toml:2: the id \"a\": "), "{error}");
            assert!(error.contains(problem), "{error}");
        }
        let twice = entry("printed = \"x\"") + &entry("printed = \"y\"");
        let error = Published::parse(&twice).unwrap_err().to_string();
        assert!(error.contains("toml:7: the id \"a\": it is also on line 2"), "{error}");
        let error = parse("printed = \"about 2.094\"").unwrap().number().unwrap_err().to_string();
        assert!(error.contains("\"about 2.094\"; write it as `value`, with `decimals`"), "{error}");
    }
}

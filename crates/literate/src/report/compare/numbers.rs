//! Which values changed between two files values.json.

use super::super::Error;
use super::super::print::{Asked, Style, print};
use super::super::values::{Digits, Kind, Number, Registry, Value};
use crate::report::spell;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// One difference between two sets of values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// Id of the value.
    pub id: String,
    /// How it was printed; None for a new value.
    pub before: Option<String>,
    /// How it is printed now; None for a value that is gone.
    pub after: Option<String>,
    /// After minus before, where both are numbers.
    pub difference: Option<f64>,
    /// The difference over the combined standard error, where there is one. Runs with the same seed
    /// share their chance, and then it overrates the error.
    pub sigmas: Option<f64>,
    /// Kind and unit before and after, where they differ.
    pub kind: Option<[String; 2]>,
}

impl std::fmt::Display for Change {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (&self.before, &self.after) {
            (Some(before), Some(after)) => write!(f, "{}: {before} -> {after}", self.id)?,
            (None, Some(after)) => write!(f, "{}: new, {after}", self.id)?,
            (Some(before), None) => write!(f, "{}: gone, was {before}", self.id)?,
            (None, None) => write!(f, "{}", self.id)?,
        }
        match &self.kind {
            Some([before, after]) => write!(f, " ({before} -> {after})"),
            None => Ok(()),
        }
    }
}

/// Significant digits of a double at most; more are those of its binary fraction.
const SIGNIFICANT: usize = 17;

/// Decimals of the least double with all its digits.
const DECIMALS: usize = 323 + SIGNIFICANT;

/// Reads a values.json.
///
/// # Errors
/// What is none, and the name of a value whose digits are none.
pub fn read(text: &str) -> Result<Registry, Error> {
    let fault = |what: String| Error::Template(format!("values.json: {what}"));
    let values: BTreeMap<String, Value> =
        serde_json::from_str(text).map_err(|e| fault(e.to_string()))?;
    let mut registry = Registry::new();
    for (id, value) in values {
        if value.id != id {
            return Err(fault(format!("{id:?} has the id {:?}; give it its own", value.id)));
        }
        registry.add(value).map_err(|e| fault(e.to_string()))?;
    }
    let odd = registry.iter().find_map(|value| Some((&value.id, oddity(&value.number)?)));
    odd.map_or(Ok(()), |(id, what)| Err(fault(format!("{id}: {what}"))))?;
    Ok(registry)
}

/// What is wrong with the digits of a number that nobody would print so.
fn oddity(number: &Number) -> Option<String> {
    let Number::Real { digits, .. } = number else { return None };
    match *digits {
        Digits::Error(error) if error < 0.0 => Some(format!("its error is {error:?}")),
        Digits::Significant(digits) if !(1..=SIGNIFICANT).contains(&digits) => {
            Some(format!("{digits} significant digits"))
        }
        Digits::Decimals(decimals) if decimals > DECIMALS => Some(format!("{decimals} decimals")),
        _ => None,
    }
}

/// All changes of numbers, units and kinds, sorted by id; other fields (notes, sources) do not
/// count.
pub fn changes(before: &Registry, after: &Registry) -> Vec<Change> {
    let ids: BTreeSet<&str> = before.iter().chain(after.iter()).map(|v| v.id.as_str()).collect();
    let change = |id: &str| {
        let (old, new) = (before.get(id), after.get(id));
        let meant = |value: Option<&Value>| value.map(|v| (v.number.clone(), kind(v)));
        (meant(old) != meant(new)).then(|| Change {
            id: id.to_string(),
            before: old.map(|value| spell::text(&full_if_same(value, old, new))),
            after: new.map(|value| spell::text(&full_if_same(value, old, new))),
            difference: difference(old, new),
            sigmas: sigmas(old, new),
            kind: old.zip(new).map(|(old, new)| [kind(old), kind(new)]).filter(|[a, b]| a != b),
        })
    };
    ids.into_iter().filter_map(change).collect()
}

/// The value in its own digits, or in full where those do not show the difference.
fn full_if_same(value: &Value, before: Option<&Value>, after: Option<&Value>) -> String {
    let number = |value: Option<&Value>| value.map(|value| value.number.clone());
    if before.map(Value::plain) == after.map(Value::plain) && number(before) != number(after) {
        let style = Style { digits: Some(Asked::Full), ..Style::default() };
        return print(&value.number, style).plain();
    }
    value.plain()
}

/// Kind and unit in words.
fn kind(value: &Value) -> String {
    let kind = match &value.kind {
        Kind::Exact => "exact".into(),
        Kind::Deterministic => "deterministic".into(),
        Kind::Ensemble { realisations, .. } => format!("ensemble of {realisations}"),
        Kind::Printed { place } => format!("printed at {place}"),
        Kind::Measured => "measured".into(),
    };
    if value.unit.is_empty() { kind } else { format!("{kind}, in {}", spell::text(&value.unit)) }
}

fn difference(before: Option<&Value>, after: Option<&Value>) -> Option<f64> {
    let real = |value: &Value| match value.number {
        Number::Integer(n) => Some(n as f64),
        Number::Real { value, .. } => Some(value),
        _ => None,
    };
    Some(real(after?)? - real(before?)?).filter(|difference| difference.is_finite())
}

/// None without an error on either side.
fn sigmas(before: Option<&Value>, after: Option<&Value>) -> Option<f64> {
    let error = |value: &Value| match value.kind {
        Kind::Ensemble { standard_error, .. } => standard_error,
        _ => 0.0,
    };
    let (a, b) = (error(before?), error(after?));
    let sigmas = difference(before, after)? / (a * a + b * b).sqrt();
    sigmas.is_finite().then_some(sigmas)
}

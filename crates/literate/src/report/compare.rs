//! What changed between two reports: numbers, verdicts and files; as text and JSON.

use super::folder::SUMS;
use super::ledger::{self, Ledger};
use super::print::{Asked, Style, print};
use super::values::{Registry, Value};
use super::{Error, Files, tex};
use crate::claims::{Check, Text, significant};
use crate::input::is_obeyed;
use crate::table::number;
use impact_numerics::text::count;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// A report, with the parts that are compared as what they mean.
#[derive(Debug)]
pub struct Parts {
    files: Files,
    values: Registry,
    ledger: Ledger,
}

/// A number or a check of which something differs.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Change {
    /// Its id.
    pub id: String,
    /// The number as it was printed, or the verdict; None for what is new.
    pub before: Option<String>,
    /// The same now; None for what is gone.
    pub after: Option<String>,
    /// After minus before, where both are numbers.
    pub difference: Option<f64>,
    /// The difference over the combined standard error, where there is one. Runs with the same seed
    /// share their chance, and then it overrates the error.
    pub sigmas: Option<f64>,
    /// What else differs, by its name, before and after.
    pub also: BTreeMap<&'static str, [String; 2]>,
}

/// What differs, part by part; all empty for the same bytes.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Diff {
    /// Checks with another verdict or another measure, gained and lost.
    pub verdicts: Vec<Change>,
    /// Values with another number or unit, gained and lost, the largest change first.
    pub numbers: Vec<Change>,
    /// Files that only the later report has.
    pub gained: Vec<String>,
    /// Files that only the earlier report has.
    pub lost: Vec<String>,
    /// Files with other bytes.
    pub differing: Vec<String>,
}

/// Reads a values.json. A number of a form that only another version of the program knows is left out.
///
/// # Errors
/// What is none.
pub fn read(text: &str) -> Result<Registry, Error> {
    let fault = |what: String| Error::Template(format!("values.json: {what}"));
    let values: BTreeMap<String, serde_json::Value> =
        serde_json::from_str(text).map_err(|e| fault(e.to_string()))?;
    let known = values.into_values().filter_map(|value| serde_json::from_value(value).ok());
    let mut registry = Registry::new();
    registry.extend(known).map_err(|e| fault(e.to_string()))?;
    Ok(registry)
}

impl Parts {
    /// Reads values and checks of a report, which errors call `name`.
    ///
    /// # Errors
    /// What is missing or cannot be read.
    pub fn of(name: &str, files: Files) -> Result<Self, String> {
        let text = |path: &str| {
            let bytes = files.get(path).ok_or_else(|| format!("{name}: {path} is missing"))?;
            std::str::from_utf8(bytes).map_err(|error| format!("{name}: {path}: {error}"))
        };
        let fault = |error: Error| format!("{name}: {error}");
        let values = read(text("values.json")?).map_err(fault)?;
        let ledger = ledger::read(text("ledger.json")?).map_err(fault)?;
        Ok(Parts { files, values, ledger })
    }
}

/// What differs.
pub fn diff(before: &Parts, after: &Parts) -> Diff {
    let known = |files: &'_ Files| -> BTreeSet<String> {
        files.keys().filter(|path| *path != SUMS).cloned().collect()
    };
    let (old, new) = (known(&before.files), known(&after.files));
    let differing = |path: &&String| before.files[*path] != after.files[*path];
    let by_id = |ledger: &'_ Ledger| -> BTreeMap<String, Check> {
        ledger.claims.iter().map(|check| (check.id.clone(), check.clone())).collect()
    };
    let (checks, were) = (by_id(&after.ledger), by_id(&before.ledger));
    let ids: BTreeSet<&String> = were.keys().chain(checks.keys()).collect();
    let verdicts = ids.into_iter().filter_map(|id| verdict(id, were.get(id), checks.get(id)));
    Diff {
        verdicts: verdicts.collect(),
        numbers: numbers(&before.values, &after.values),
        gained: new.difference(&old).cloned().collect(),
        lost: old.difference(&new).cloned().collect(),
        differing: old.intersection(&new).filter(differing).cloned().collect(),
    }
}

/// How a check changed: its verdict, and what it is held against.
fn verdict(id: &str, before: Option<&Check>, after: Option<&Check>) -> Option<Change> {
    let words = |check: &Check| check.words().to_string();
    let measure = |check: &Check| [check.expected.clone(), check.tolerance.to_string()];
    let moved = before.map(words) != after.map(words);
    if !moved && before.map(measure) == after.map(measure) {
        return None;
    }
    let fields = |check: &Check| {
        let found = if moved { check.found.to_string() } else { String::new() };
        let [expected, tolerance] = measure(check);
        [("found", found), ("expected", expected), ("tolerance", tolerance)]
    };
    let pairs = before.map(fields).zip(after.map(fields));
    let also = pairs.into_iter().flat_map(|(old, new)| old.into_iter().zip(new));
    let also = also.map(|((name, old), (_, new))| (name, [old, new]));
    Some(Change {
        id: id.into(),
        before: before.map(words),
        after: after.map(words),
        also: also.filter(|(_, [old, new])| old != new).collect(),
        ..Change::default()
    })
}

/// All changes of numbers and units; other fields (notes, sources) do not count. What is a number no more
/// comes first, then the largest differences in standard errors, and last what only one report has.
fn numbers(before: &Registry, after: &Registry) -> Vec<Change> {
    let ids: BTreeSet<&str> = before.iter().chain(after.iter()).map(|v| v.id.as_str()).collect();
    let change = |id: &str| {
        let (old, new) = (before.get(id), after.get(id));
        let meant = |value: Option<&Value>| value.map(|v| (v.number.clone(), v.unit.clone()));
        if meant(old) == meant(new) {
            return None;
        }
        // In full where their digits do not show the difference.
        let exact = |value: &Value| value.number.clone();
        let hidden =
            old.map(Value::plain) == new.map(Value::plain) && old.map(exact) != new.map(exact);
        let style = Style { digits: hidden.then_some(Asked::Full), ..Style::default() };
        let shown = |value: &Value| tex::spelt(&print(&value.number, style).plain());
        let both = old.zip(new);
        let difference = both.and_then(|(old, new)| Some(number(new)? - number(old)?));
        let difference = difference.filter(|difference| difference.is_finite());
        let error = both.map(|(old, new)| {
            let [old, new] = [old, new].map(Value::standard_error);
            (old * old + new * new).sqrt()
        });
        let sigmas = difference.zip(error).map(|(difference, error)| difference / error);
        Some(Change {
            id: id.to_string(),
            before: old.map(shown),
            after: new.map(shown),
            difference,
            sigmas: sigmas.filter(|sigmas| sigmas.is_finite()),
            ..Change::default()
        })
    };
    let mut changes: Vec<Change> = ids.into_iter().filter_map(change).collect();
    let weight = |change: &Change| match (change.sigmas, change.difference) {
        _ if change.before.is_none() || change.after.is_none() => -1.0,
        (Some(sigmas), _) => sigmas.abs(),
        (None, Some(_)) => 0.0,
        _ => f64::INFINITY,
    };
    changes.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    changes
}

/// A difference with its sign and three digits.
fn signed(value: f64) -> String {
    let sign = if value > 0.0 { "+" } else { "" };
    format!("{sign}{}", Text::from(significant(value, 3)))
}

impl Change {
    /// `x: reproduced -> differs`, `x: new, reproduced`, `x: gone, was reproduced`, and what else is known.
    fn line(&self) -> String {
        let fate = match (&self.before, &self.after) {
            (Some(before), Some(after)) if before == after => before.clone(),
            (Some(before), Some(after)) => format!("{before} -> {after}"),
            (None, after) => format!("new, {}", after.as_deref().unwrap_or_default()),
            (Some(before), None) => format!("gone, was {before}"),
        };
        let difference = self.difference.map(|own| format!("; Δ {}", signed(own)));
        let sigmas = self.sigmas.map(|own| format!(", {} σ", signed(own)));
        let also = self.also.iter().map(|(name, [old, new])| format!("; {name}: {old} -> {new}"));
        let more = difference.unwrap_or_default() + &sigmas.unwrap_or_default();
        format!("  {}: {fate}{more}{}", self.id, also.collect::<String>())
    }
}

impl Diff {
    /// Whether nothing differs.
    pub fn is_empty(&self) -> bool {
        *self == Diff::default()
    }

    /// How many verdicts and numbers changed.
    fn counts(&self) -> String {
        let verdicts = count(self.verdicts.len(), "check");
        format!("{verdicts} and {} changed", count(self.numbers.len(), "number"))
    }

    fn files(&self) -> [(&'static str, &[String]); 3] {
        [("new", &self.gained), ("gone", &self.lost), ("differs", &self.differing)]
    }

    /// For people: all of it.
    pub fn text(&self, old: &str, new: &str) -> String {
        if self.is_empty() {
            return format!("{old} and {new}: nothing differs\n");
        }
        let changes = self.verdicts.iter().chain(&self.numbers).map(Change::line);
        let files = self
            .files()
            .into_iter()
            .flat_map(|(what, paths)| paths.iter().map(move |path| format!("  {what:8} {path}")));
        // A report, and the name of a file, may hold what a terminal obeys.
        let lines = changes.chain(files).map(|line| line.replace(is_obeyed, " ") + "\n");
        lines.fold(self.counts() + "\n", |text, line| text + &line)
    }
}

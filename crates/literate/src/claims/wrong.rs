//! Judges by wrong evidence: a verdict that no wrong result moves says nothing.

use super::check::{Kind, Verdict};
use super::evidence::Error;
use super::numeral::with_other_digit;
use super::published::Statement;
use super::rule::{Judge, Rule};
use crate::experiments::Results;
use serde_json::Value;
use std::cell::Cell;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Makes a wrong number, or no number, of a number and its standard error.
type Change = fn(f64, f64) -> Option<f64>;

/// The changes, small ones first: first digit, ten standard errors, sign, size, no number.
const CHANGES: [Change; 7] = [
    |value, _| with_other_digit(&value.to_string()).parse().ok(),
    |value, error| Some(value + 10.0 * error),
    |value, error| Some(value - 10.0 * error),
    |value, _| Some(-value),
    |value, _| Some(1e6 * (value + 1.0)),
    |value, _| Some(1e-6 * value),
    |_, _| None,
];

/// How many of them are small.
const SMALL: usize = 3;

/// The path to numbers in a result: names of fields, and `None` for all elements of a list.
type Way = Vec<Option<String>>;

/// A rule whose verdict no wrong result has moved so far, and what it reads.
struct Unmoved<'a> {
    rule: &'a Rule,
    statement: Statement,
    verdict: Verdict,
    read: BTreeSet<String>,
}

thread_local! {
    /// Whether a rule is being tried on this thread: a panic of it is no fault of the program.
    static TRYING: Cell<bool> = const { Cell::new(false) };
}

pub(crate) fn is_trying() -> bool {
    TRYING.get()
}

impl Judge<'_> {
    /// Changes the numbers that each rule reads, a column of a table or a field of a result at a
    /// time, and judges again. Returns the ids of statements that are reproduced whatever changes,
    /// and of those that are explained whatever changes a little: their verdicts cannot fail. With
    /// `open` also those that no change decides, which takes longer. Definitions are left out.
    pub fn ids_never_moved(&self, open: bool) -> Result<Vec<&'static str>, Error> {
        let results = self.results;
        let mut unmoved = Vec::new();
        for rule in self.rules {
            let (statement, copy) = (rule.statement(self.published)?, results.copy());
            let verdict = Judge { results: &copy, ..*self }.check(rule, &statement)?.verdict;
            if statement.kind != Kind::Definition && (open || verdict != Verdict::CannotBeJudged) {
                unmoved.push(Unmoved { rule, statement, verdict, read: copy.read() });
            }
        }
        let names: BTreeSet<String> = unmoved.iter().flat_map(|rule| rule.read.clone()).collect();
        TRYING.set(true);
        for name in &names {
            let mut try_all = |wrong: &dyn Fn(Change) -> Option<Results>| {
                for (number, change) in CHANGES.into_iter().enumerate() {
                    if !unmoved.iter().any(|rule| rule.read.contains(name)) {
                        return;
                    }
                    let Some(wrong) = &wrong(change) else { continue };
                    let judge = Judge { results: wrong, ..*self };
                    let moves = |rule: &Unmoved<'_>| {
                        rule.read.contains(name) && rule.is_moved(judge, number < SMALL)
                    };
                    unmoved.retain(|rule| !moves(rule));
                }
            };
            if let Ok(table) = results.table(name) {
                for column in 0..table.names().count() {
                    let changed = |change| table.with_column_changed(column, change);
                    try_all(&|change| Some(results.with_table(changed(change)?)));
                }
            } else if let Some(result) = results.json(name) {
                let mut paths = BTreeSet::new();
                find_numbers(&result, &mut Vec::new(), &mut paths);
                for path in paths {
                    try_all(&|change| {
                        let mut wrong = result.clone();
                        change_numbers(&mut wrong, &path, 0.0, change);
                        results.with_json(name, wrong)
                    });
                }
            }
        }
        TRYING.set(false);
        Ok(unmoved.iter().map(|unmoved| unmoved.rule.id).collect())
    }
}

impl Unmoved<'_> {
    /// Returns whether wrong evidence leads to a verdict that excludes the right one. A rule that
    /// fails or panics gives no verdict. An explanation has to be broken by a small change.
    fn is_moved(&self, judge: Judge<'_>, is_small: bool) -> bool {
        let check = AssertUnwindSafe(|| judge.check(self.rule, &self.statement));
        let Ok(Ok(check)) = catch_unwind(check) else { return false };
        match self.verdict {
            Verdict::Reproduced => {
                [Verdict::Differs, Verdict::DiffersAndExplained].contains(&check.verdict)
            }
            Verdict::DiffersAndExplained => is_small && check.verdict == Verdict::Differs,
            before => check.verdict != before,
        }
    }
}

fn find_numbers(value: &Value, path: &mut Way, paths: &mut BTreeSet<Way>) {
    let mut below = |step, value: &Value| {
        path.push(step);
        find_numbers(value, path, paths);
        path.pop();
    };
    match value {
        Value::Array(values) => values.iter().for_each(|value| below(None, value)),
        Value::Object(fields) => {
            fields.iter().for_each(|(name, value)| below(Some(name.clone()), value));
        }
        Value::Number(_) if !paths.contains(path) => drop(paths.insert(path.clone())),
        _ => (),
    }
}

/// Changes all numbers on a path; the field `error` beside a number is its standard error.
fn change_numbers(value: &mut Value, path: &[Option<String>], error: f64, change: Change) {
    match (value, path) {
        (Value::Array(values), [None, path @ ..]) => {
            values.iter_mut().for_each(|value| change_numbers(value, path, error, change));
        }
        (Value::Object(fields), [Some(name), path @ ..]) => {
            let error = fields.get("error").and_then(Value::as_f64).unwrap_or(0.0);
            if let Some(value) = fields.get_mut(name) {
                change_numbers(value, path, error, change);
            }
        }
        (value @ Value::Number(_), []) => {
            let changed = change(value.as_f64().unwrap_or(f64::NAN), error);
            *value = match changed {
                // A whole number stays one.
                Some(changed) if !value.is_f64() => (changed as i64).into(),
                changed => changed.into(),
            };
        }
        _ => (),
    }
}

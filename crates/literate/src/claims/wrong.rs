//! Judges by wrong evidence: a verdict that no wrong result moves says nothing.

use super::check::{Kind, Verdict};
use super::evidence::{Error, Evidence};
use super::numeral::with_other_digit;
use super::published::{Published, Statement};
use super::rule::{Rule, level_of};
use crate::experiments::Results;
use serde_json::Value;
use std::cell::Cell;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A wrong number in the place of a number, made of it and its standard error.
type Change = fn(f64, f64) -> Option<f64>;

/// Small changes first: another first digit, ten standard errors, another sign, another size, none.
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

/// The way to numbers of a result: names of fields, and none for all elements of a list.
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

/// Changes the numbers that each rule reads, a column of a table or a field of a result at a time,
/// and judges again. Returns the ids of statements that are reproduced whatever changes, and of
/// those that are explained whatever changes a little: their verdicts cannot fail. With `open` also
/// those that no change decides, which takes longer. Definitions are left out.
pub fn never_moved(
    published: &Published,
    rules: &[Rule],
    results: &Results,
    open: bool,
) -> Result<Vec<&'static str>, Error> {
    let (level, mut left) = (Some(level_of(rules)), Vec::new());
    for rule in rules {
        let (statement, copy) = (rule.statement(published)?, results.copy());
        let evidence =
            Evidence { statement: &statement, results: &copy, published, level, is_strict: false };
        let verdict = rule.check(evidence)?.verdict;
        if statement.kind != Kind::Definition && (open || verdict != Verdict::CannotBeJudged) {
            left.push(Unmoved { rule, statement, verdict, read: copy.read() });
        }
    }
    let names: BTreeSet<String> = left.iter().flat_map(|unmoved| unmoved.read.clone()).collect();
    TRYING.set(true);
    for name in &names {
        let mut try_all = |wrong: &dyn Fn(Change) -> Option<Results>| {
            for (number, change) in CHANGES.into_iter().enumerate() {
                if !left.iter().any(|one| one.read.contains(name)) {
                    return;
                }
                let Some(wrong) = &wrong(change) else { continue };
                let moves = |one: &Unmoved<'_>| {
                    let evidence = Evidence {
                        statement: &one.statement,
                        results: wrong,
                        published,
                        level,
                        is_strict: false,
                    };
                    one.read.contains(name) && one.is_moved(evidence, number < SMALL)
                };
                left.retain(|one| !moves(one));
            }
        };
        if let Ok(table) = results.table(name) {
            for column in 0..table.width() {
                let changed = |change| table.changed(column, change);
                try_all(&|change| Some(results.with_table(changed(change)?)));
            }
        } else if let Some(result) = results.json(name) {
            let mut ways = BTreeSet::new();
            find_numbers(&result, &mut Vec::new(), &mut ways);
            for way in ways {
                try_all(&|change| {
                    let mut wrong = result.clone();
                    change_numbers(&mut wrong, &way, 0.0, change);
                    results.with_json(name, wrong)
                });
            }
        }
    }
    TRYING.set(false);
    Ok(left.iter().map(|unmoved| unmoved.rule.id).collect())
}

impl Unmoved<'_> {
    /// Returns whether the verdict by wrong evidence is one that the right one excludes. A rule
    /// that fails or panics has none. A small change has to break an explanation.
    fn is_moved(&self, evidence: Evidence<'_>, is_small: bool) -> bool {
        let judge = AssertUnwindSafe(|| self.rule.check(evidence));
        let Ok(Ok(check)) = catch_unwind(judge) else { return false };
        match self.verdict {
            Verdict::Reproduced => {
                [Verdict::Differs, Verdict::DiffersAndExplained].contains(&check.verdict)
            }
            Verdict::DiffersAndExplained => is_small && check.verdict == Verdict::Differs,
            before => check.verdict != before,
        }
    }
}

fn find_numbers(value: &Value, way: &mut Way, found: &mut BTreeSet<Way>) {
    let mut below = |step, value: &Value| {
        way.push(step);
        find_numbers(value, way, found);
        way.pop();
    };
    match value {
        Value::Array(values) => values.iter().for_each(|value| below(None, value)),
        Value::Object(fields) => {
            fields.iter().for_each(|(name, value)| below(Some(name.clone()), value));
        }
        Value::Number(_) if !found.contains(way) => drop(found.insert(way.clone())),
        _ => (),
    }
}

/// Changes all numbers on a way; the field `error` beside a number is its standard error.
fn change_numbers(value: &mut Value, way: &[Option<String>], error: f64, change: Change) {
    match (value, way) {
        (Value::Array(values), [None, way @ ..]) => {
            values.iter_mut().for_each(|value| change_numbers(value, way, error, change));
        }
        (Value::Object(fields), [Some(name), way @ ..]) => {
            let error = fields.get("error").and_then(Value::as_f64).unwrap_or(0.0);
            if let Some(value) = fields.get_mut(name) {
                change_numbers(value, way, error, change);
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

//! The results in parts, each of which can be read and written as JSON.

use impact_paper::experiments::{Looked, Results, laws};
use rayon::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value as Json;
use std::sync::OnceLock;

/// One part: the result of one experiment.
pub struct Part {
    /// The experiment, as values name it; theory and identities are one to them.
    pub experiment: &'static str,
    /// Members, at any depth, that are its raw record: lists of events, none of which is a number of
    /// the report.
    record: &'static [&'static str],
    read: fn(&Results) -> Option<Json>,
    write: fn(&mut Results, &Json) -> serde_json::Result<()>,
    /// From results that have it to others.
    restore: fn(&mut Results, &Results),
}

fn json<T: Serialize>(result: &T) -> Option<Json> {
    serde_json::to_value(result).ok()
}

fn typed<T: DeserializeOwned>(json: &Json) -> serde_json::Result<T> {
    T::deserialize(json)
}

macro_rules! ran {
    ($name:literal, $field:ident) => {
        ran!($name, $field, &[])
    };
    ($name:literal, $field:ident, $record:expr) => {
        Part {
            experiment: $name,
            record: $record,
            read: |results| results.$field.as_ref().and_then(json),
            write: |results, json| {
                results.$field = Some(typed(json)?);
                Ok(())
            },
            restore: |results, from| results.$field = from.$field.clone(),
        }
    };
}

macro_rules! looked_at {
    ($field:ident) => {
        Part {
            experiment: "theory",
            record: &[],
            read: |results| json(&*results.$field),
            write: |results, json| {
                *results.$field = typed(json)?;
                Ok(())
            },
            restore: |results, from| {
                let known = from.$field.clone();
                results.$field = Looked::new(Box::new(move || known));
            },
        }
    };
}

/// All parts. What is computed from the main sweep in memory stands before it.
const PARTS: [Part; 29] = [
    looked_at!(theory),
    looked_at!(identities),
    ran!("laws", laws),
    Part {
        experiment: "sweep",
        record: &[],
        read: |results| results.sweep.as_ref().and_then(json),
        write: |results, json| {
            results.sweep = Some(typed(json)?);
            // The laws follow from the rows.
            results.laws = results.sweep.as_ref().map(|sweep| laws::run(&sweep.rows));
            Ok(())
        },
        restore: |results, from| {
            results.sweep = from.sweep.clone();
            results.laws = from.laws.clone();
        },
    },
    ran!("second_seed", second_seed),
    ran!("protocol", protocol),
    ran!("protocols", protocols),
    ran!("starts", starts),
    ran!("horizon", horizon),
    ran!("two_masses", two_masses),
    ran!("segments", segments),
    ran!("space-time", spacetime, &["times", "gaps", "scene"]),
    ran!("race", race),
    ran!("bias", biases),
    ran!("trials", trials),
    ran!("scale", scale),
    ran!("analytic", analytic),
    ran!("measured", measured),
    ran!("heat", heat, &["rows"]),
    ran!("nucleation", nucleation),
    ran!("history", history),
    ran!("seeds", seeds, &["seen", "waits", "closing"]),
    ran!("independence", independence, &["hits", "histogram"]),
    ran!("orbits", orbits, &["found", "ends", "singles", "each", "example"]),
    ran!("restitution", restitution, &["rows"]),
    ran!("chains", chains, &["runs"]),
    ran!("long_protocol", long_protocol),
    ran!("sizes", sizes, &["runs"]),
    Part {
        experiment: "audits",
        record: &[],
        read: |results| json(&results.audits),
        write: |results, json| {
            results.audits = typed(json)?;
            Ok(())
        },
        restore: |results, from| results.audits.clone_from(&from.audits),
    },
];

/// The parts of some results as JSON; an index is that of [`experiments`].
#[derive(Clone)]
pub struct Whole(Vec<Json>);

/// Names of the parts' experiments, in order.
pub fn experiments() -> impl Iterator<Item = &'static str> {
    PARTS.iter().map(|part| part.experiment)
}

impl Whole {
    /// Of complete results.
    pub fn of(results: &Results) -> Self {
        Whole(PARTS.par_iter().map(|part| (part.read)(results).unwrap_or_default()).collect())
    }

    /// One part.
    pub fn part(&self, index: usize) -> &Json {
        &self.0[index]
    }

    /// Adds to the number at a path of a part.
    pub fn add(&mut self, index: usize, path: &str, by: f64) {
        add(&mut self.0[index], path, by);
    }

    /// Takes what stands at a path of a part from others.
    pub fn restore(&mut self, index: usize, path: &str, from: &Whole) {
        if let (Some(own), Some(was)) =
            (self.0[index].pointer_mut(path), from.part(index).pointer(path))
        {
            own.clone_from(was);
        }
    }

    /// Paths in a part of all numbers that are this one.
    pub fn leaves(&self, index: usize, number: f64) -> Vec<String> {
        paths(self.part(index), PARTS[index].record, number)
    }
}

/// Puts a part into results.
///
/// # Errors
/// When it is not of the part's shape: a negative count.
pub fn put(results: &mut Results, index: usize, part: &Json) -> serde_json::Result<()> {
    if tabled(results, index) {
        results.tables = OnceLock::new();
    }
    (PARTS[index].write)(results, part)
}

/// Whether tables are made of a part.
fn tabled(results: &Results, index: usize) -> bool {
    let of = |name: &str| name.split('.').next() == Some(PARTS[index].experiment);
    results.tables().keys().any(|name| of(name))
}

/// Gives results a part of others.
pub fn restore(results: &mut Results, index: usize, from: &Results) {
    (PARTS[index].restore)(results, from);
    results.tables = from.tables.clone();
}

/// Whether a part can be missing: theory is computed when it is first looked at.
pub fn can_be_missing(index: usize) -> bool {
    PARTS[index].experiment != "theory"
}

/// Results with all parts of others.
pub fn copy(from: &Results) -> Results {
    let mut results = Results::empty(from.profile);
    (0..PARTS.len()).for_each(|index| restore(&mut results, index, from));
    results
}

/// Paths of all numbers in JSON that are this one, as JSON pointers; members of objects first, for a
/// long list of counts has every small integer many times.
fn paths(json: &Json, record: &[&str], number: f64) -> Vec<String> {
    let mut walk = Walk { record, number, way: vec![], members: vec![], listed: vec![] };
    walk.down(json);
    [walk.members, walk.listed].concat()
}

/// The way to a number: a member of an object, or a place in a list.
#[derive(Clone, Copy)]
enum Step<'a> {
    Member(&'a str),
    Place(usize),
}

struct Walk<'a> {
    record: &'a [&'a str],
    number: f64,
    /// Where it is. Few numbers are the wanted one, so only their ways are written out.
    way: Vec<Step<'a>>,
    members: Vec<String>,
    listed: Vec<String>,
}

impl<'a> Walk<'a> {
    fn down(&mut self, json: &'a Json) {
        match json {
            Json::Number(found) if found.as_f64() == Some(self.number) => {
                let listed = matches!(self.way.last(), Some(Step::Place(_)));
                let list = if listed { &mut self.listed } else { &mut self.members };
                list.push(pointer(&self.way));
            }
            Json::Array(items) => {
                items.iter().enumerate().for_each(|(i, item)| self.step(Step::Place(i), item));
            }
            Json::Object(members) => {
                let record = self.record;
                let read = members.iter().filter(|(name, _)| !record.contains(&name.as_str()));
                read.for_each(|(name, item)| self.step(Step::Member(name), item));
            }
            _ => {}
        }
    }

    fn step(&mut self, step: Step<'a>, json: &'a Json) {
        self.way.push(step);
        self.down(json);
        self.way.pop();
    }
}

/// A JSON pointer.
fn pointer(way: &[Step<'_>]) -> String {
    let written = |step: &Step<'_>| match step {
        Step::Member(name) => format!("/{name}"),
        Step::Place(place) => format!("/{place}"),
    };
    way.iter().map(written).collect()
}

/// Adds to the number at a path. An integer stays one if it can.
fn add(json: &mut Json, path: &str, by: f64) {
    let Some(found) = json.pointer_mut(path) else { return };
    let whole = found.as_i64().filter(|_| by.fract() == 0.0);
    *found = match whole {
        Some(n) => (n + by as i64).into(),
        None => (found.as_f64().unwrap_or_default() + by).into(),
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn leaves_are_found_and_moved() {
        let mut tree = json!({"a": [3, {"b": 3.0, "raw": [3]}], "c": 4, "e": 3, "raw": 3});
        assert_eq!(paths(&tree, &["raw"], 3.0), ["/a/1/b", "/e", "/a/0"]);
        add(&mut tree, "/a/0", 0.5);
        add(&mut tree, "/a/1/b", 0.5);
        add(&mut tree, "/e", -1.0);
        assert_eq!(tree, json!({"a": [3.5, {"b": 3.5, "raw": [3]}], "c": 4, "e": 2, "raw": 3}));
    }
}

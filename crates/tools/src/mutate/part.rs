//! The results in parts, each of which can be read and written as JSON.

use impact_paper::experiments::ALL;
use impact_paper::experiments::{Need, Results};
use rayon::prelude::*;
use serde_json::Value as Json;

/// One part: the theory, its identities, the audits, or the result of one experiment.
#[derive(Clone, Copy)]
enum Part {
    Theory,
    Identities,
    Audits,
    Of(Need),
}

/// Members, at any depth, that are the raw record of an experiment: lists of events, none of which is a
/// number of the report.
const RECORDS: [(&str, &[&str]); 8] = [
    ("spacetime", &["times", "gaps", "scene"]),
    ("heat", &["rows"]),
    ("seeds", &["seen", "waits", "closing"]),
    ("independence", &["hits", "histogram"]),
    ("orbits", &["found", "ends", "singles", "each", "example"]),
    ("restitution", &["rows"]),
    ("chains", &["runs"]),
    ("sizes", &["runs"]),
];

impl Part {
    /// The experiment, as values name it; theory and identities are one to them.
    fn experiment(self) -> &'static str {
        match self {
            Part::Theory | Part::Identities => "theory",
            Part::Audits => "audits",
            Part::Of(experiment) => experiment.name(),
        }
    }

    fn read(self, results: &Results) -> Option<Json> {
        match self {
            Part::Theory => serde_json::to_value(&*results.theory).ok(),
            Part::Identities => serde_json::to_value(&*results.identities).ok(),
            Part::Audits => serde_json::to_value(&results.audits).ok(),
            Part::Of(experiment) => experiment.json(results.found(experiment.name())?),
        }
    }
}

/// All parts.
fn parts() -> impl Iterator<Item = Part> {
    [Part::Theory, Part::Identities].into_iter().chain(ALL.map(Part::Of)).chain([Part::Audits])
}

fn part(index: usize) -> Part {
    parts().nth(index).unwrap_or(Part::Theory)
}

/// The parts of some results as JSON; an index is that of [`experiments`].
#[derive(Clone)]
pub struct Whole(Vec<Json>);

/// Names of the parts' experiments, in order.
pub fn experiments() -> impl Iterator<Item = &'static str> {
    parts().map(Part::experiment)
}

impl Whole {
    /// Of complete results.
    pub fn of(results: &Results) -> Self {
        let parts: Vec<Part> = parts().collect();
        Whole(parts.par_iter().map(|part| part.read(results).unwrap_or_default()).collect())
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
        let experiment = part(index).experiment();
        let record = RECORDS.iter().find(|(name, _)| *name == experiment);
        paths(self.part(index), record.map_or(&[], |(_, own)| own), number)
    }
}

/// Puts a part into results.
///
/// # Errors
/// When it is not of the part's shape: a negative count.
pub fn put(results: &mut Results, index: usize, json: &Json) -> serde_json::Result<()> {
    match part(index) {
        Part::Theory => *results.theory_mut().0 = serde::Deserialize::deserialize(json)?,
        Part::Identities => *results.theory_mut().1 = serde::Deserialize::deserialize(json)?,
        Part::Audits => results.audits = serde::Deserialize::deserialize(json)?,
        Part::Of(experiment) => results.put(experiment.name(), experiment.typed(json)?),
    }
    Ok(())
}

/// Gives results a part of others.
pub fn restore(results: &mut Results, index: usize, from: &Results) {
    match part(index) {
        Part::Theory => results.theory_mut().0.clone_from(&from.theory),
        Part::Identities => results.theory_mut().1.clone_from(&from.identities),
        Part::Audits => results.audits.clone_from(&from.audits),
        Part::Of(experiment) => results.restore(experiment.name(), from),
    }
}

/// Whether a part can be missing: theory is computed when it is first looked at.
pub fn can_be_missing(index: usize) -> bool {
    part(index).experiment() != "theory"
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

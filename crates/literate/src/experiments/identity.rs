//! What a saved result was made of, and why one is not used.

use super::Profile;
use super::cutting::Unit;
use crate::input::one_line;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::io;

/// The form of saved files; a change of it makes all of them unknown.
const SCHEMA: u32 = 2;

/// What a program was built of, and where it finds what is committed.
pub struct Built {
    /// Hash of Cargo.lock.
    pub lock: &'static str,
    /// Path and hash of every file that the code in a file depends on, itself among them.
    pub files: fn(&str) -> Vec<(String, String)>,
    /// The text of a committed file, by its path from the top of the project.
    pub committed: fn(&str) -> io::Result<Cow<'static, str>>,
}

/// The code of an experiment.
#[derive(Clone, Copy)]
pub struct Code {
    /// The program that it belongs to.
    pub built: &'static Built,
    /// Its file, from the top of the project.
    pub file: &'static str,
}

/// The code of experiments in tests.
#[cfg(test)]
pub(crate) const TOY: Code = Code {
    built: &Built {
        lock: "lock",
        files: |file| vec![(file.into(), "hash".into())],
        committed: |_| Err(io::ErrorKind::NotFound.into()),
    },
    file: "toy.rs",
};

/// Everything that a result depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    /// Name of the experiment.
    pub experiment: String,
    /// The form of the saved file.
    schema: u32,
    /// The parameters, seed included.
    pub parameters: serde_json::Value,
    /// The unit of work, if it is only a part of the result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit: Option<UnitOf>,
    /// Hash of Cargo.lock.
    lock: String,
    /// Hashes of the files that the experiment depends on.
    code: BTreeMap<String, String>,
}

/// A unit of an experiment that is cut.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct UnitOf {
    /// Its place among all units, from 0.
    number: usize,
    /// Its realisations of the row that it covers.
    realisations: std::ops::Range<usize>,
    /// What its row is about.
    covers: String,
}

impl Identity {
    /// Of an experiment with these parameters and this code.
    pub fn new(experiment: &str, code: Code, parameters: &impl Serialize) -> Self {
        Identity {
            experiment: experiment.into(),
            schema: SCHEMA,
            parameters: serde_json::to_value(parameters).unwrap_or_default(),
            unit: None,
            lock: code.built.lock.into(),
            code: (code.built.files)(code.file).into_iter().collect(),
        }
    }

    /// Of one unit of the experiment, at its place among all.
    pub fn of_unit(&self, number: usize, unit: &Unit) -> Self {
        let (realisations, covers) = (unit.realisations.clone(), unit.covers.clone());
        Identity { unit: Some(UnitOf { number, realisations, covers }), ..self.clone() }
    }

    /// Name of its file in a profile, without the ending.
    pub fn file_stem(&self, profile: Profile) -> String {
        let (experiment, profile) = (&self.experiment, profile.name());
        match &self.unit {
            Some(unit) => format!("{experiment}-{profile}-{:04}", unit.number),
            None => format!("{experiment}-{profile}"),
        }
    }

    /// Files of the source that the experiment depends on.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        self.code.keys().map(String::as_str)
    }

    /// Why a result that was made of `saved` is not the one that would be made of this.
    pub(super) fn reasons(&self, saved: &Identity) -> Vec<Reason> {
        let mut reasons = Vec::new();
        if saved.schema != self.schema || saved.experiment != self.experiment {
            return vec![Reason::Schema];
        }
        if saved.parameters != self.parameters {
            reasons.push(Reason::Parameters);
        }
        if saved.unit != self.unit {
            reasons.push(Reason::Unit);
        }
        let paths: BTreeSet<&String> = self.code.keys().chain(saved.code.keys()).collect();
        let changed =
            paths.into_iter().filter(|path| self.code.get(*path) != saved.code.get(*path));
        let changed: Vec<String> = changed.cloned().collect();
        if !changed.is_empty() {
            reasons.push(Reason::Code(changed));
        }
        if saved.lock != self.lock {
            reasons.push(Reason::Dependency);
        }
        reasons
    }
}

/// Why a saved result is not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// There is none.
    Missing,
    /// It has other parameters.
    Parameters,
    /// It is another unit of work.
    Unit,
    /// These files of the source are others now.
    Code(Vec<String>),
    /// Other versions of crates (Cargo.lock).
    Dependency,
    /// It was saved in another form.
    Schema,
    /// It cannot be trusted, and why.
    Damaged(String),
}

impl std::fmt::Display for Reason {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Reason::Missing => f.write_str("no saved result"),
            Reason::Parameters => f.write_str("other parameters"),
            Reason::Unit => f.write_str("another unit of work"),
            Reason::Code(files) => match files.as_slice() {
                [one] => write!(f, "{one} changed"),
                [one, others @ ..] => write!(f, "{one} and {} more changed", others.len()),
                [] => f.write_str("the code changed"),
            },
            Reason::Dependency => f.write_str("Cargo.lock changed"),
            Reason::Schema => f.write_str("saved in another form"),
            Reason::Damaged(what) => f.write_str(what),
        }
    }
}

/// Reasons in one line.
pub fn told(reasons: &[Reason]) -> String {
    // A file that was saved elsewhere names its own sources.
    one_line(&reasons.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "), 1000)
}

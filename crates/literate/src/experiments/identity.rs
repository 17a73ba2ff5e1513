//! What a saved result was made of, and why one is not used.

use super::Profile;
use super::cutting::Unit;
use crate::input::one_line;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// The form of saved files; a change of it makes all of them unknown.
const SCHEMA: u32 = 3;

/// The code of an experiment.
#[derive(Clone, Copy)]
pub struct Code {
    /// Its own files and folders, from the top of the project, that of its main item first.
    pub own: &'static [&'static str],
    /// Path and hash of every file that the code in these depends on, themselves among them.
    pub files: fn(&[&str]) -> BTreeMap<String, String>,
}

/// The code of experiments in tests.
#[cfg(test)]
pub(crate) const TOY: Code = Code {
    own: &["toy.rs"],
    files: |own| own.iter().map(|file| (file.to_string(), "hash".into())).collect(),
};

/// Everything that a result depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    /// Name of the experiment.
    pub experiment: String,
    /// Its sample sizes by name.
    profile: Profile,
    /// The form of the saved file.
    schema: u32,
    /// The parameters, seed included.
    pub parameters: serde_json::Value,
    /// The unit of work, if it is only a part of the result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit: Option<Unit>,
    /// Hashes of the files that the experiment depends on.
    code: BTreeMap<String, String>,
}

impl Identity {
    /// Of an experiment with these parameters and this code.
    pub fn new(
        experiment: &str,
        profile: Profile,
        code: Code,
        parameters: &impl Serialize,
    ) -> Self {
        Identity {
            experiment: experiment.into(),
            profile,
            schema: SCHEMA,
            parameters: serde_json::to_value(parameters).unwrap_or_default(),
            unit: None,
            code: (code.files)(code.own),
        }
    }

    /// Of one unit of the experiment.
    pub fn of_unit(&self, unit: &Unit) -> Self {
        Identity { unit: Some(unit.clone()), ..self.clone() }
    }

    /// Whether it is of a whole result, and not of a unit.
    pub fn is_whole(&self) -> bool {
        self.unit.is_none()
    }

    /// Name of its file, without the ending: `sweep-full`, of a unit `sweep-full-0012`.
    pub fn file_stem(&self) -> String {
        let (experiment, profile) = (&self.experiment, self.profile.name());
        match &self.unit {
            Some(unit) => format!("{experiment}-{profile}-{:04}", unit.number),
            None => format!("{experiment}-{profile}"),
        }
    }

    /// Why a result that was made of `saved` is not the one that would be made of this.
    pub(super) fn reasons(&self, saved: &Identity) -> Vec<Reason> {
        let mut reasons = Vec::new();
        if saved.schema != self.schema || saved.experiment != self.experiment {
            return vec![Reason::Schema];
        }
        if saved.parameters != self.parameters || saved.profile != self.profile {
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
            Reason::Schema => f.write_str("saved in another form"),
            Reason::Damaged(what) => f.write_str(what),
        }
    }
}

/// What is done for these reasons, in one line: `run again, Cargo.lock changed`; `run` where nothing was saved.
pub fn told(reasons: &[Reason]) -> String {
    if reasons == [Reason::Missing] {
        return "run".into();
    }
    // A file that was saved elsewhere names its own sources.
    let all = reasons.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    one_line(&format!("run again, {all}"), 1000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_file_is_named_and_another_changes_nothing() {
        let of = |hash: &'static str| {
            let code = BTreeMap::from([("Cargo.lock", "0"), ("sweep/mod.rs", hash)]);
            let code = code.into_iter().map(|(path, hash)| (path.into(), hash.into())).collect();
            Identity { code, ..Identity::new("sweep", Profile::Quick, TOY, &1) }
        };
        assert_eq!(of("a").reasons(&of("a")), []);
        assert_eq!(told(&of("a").reasons(&of("b"))), "run again, sweep/mod.rs changed");
    }
}

//! What a saved result was made of.

use super::Profile;
use super::cutting::Unit;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// The form of saved files; a change of it makes all of them unknown.
const SCHEMA: u32 = 3;

/// What is said of a file of another form.
pub(super) const FORM: &str = "saved in another form";

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
        code: BTreeMap<String, String>,
        parameters: &impl Serialize,
    ) -> Self {
        Identity {
            experiment: experiment.into(),
            profile,
            schema: SCHEMA,
            parameters: serde_json::to_value(parameters).unwrap_or_default(),
            unit: None,
            code,
        }
    }

    /// Of one unit of the experiment.
    pub fn of_unit(&self, unit: &Unit) -> Self {
        Identity { unit: Some(unit.clone()), ..self.clone() }
    }

    /// Name of its file, without the ending: `sweep-full`, of a unit `sweep-full-0012`.
    pub fn file_stem(&self) -> String {
        let (experiment, profile) = (&self.experiment, self.profile.name());
        match &self.unit {
            Some(unit) => format!("{experiment}-{profile}-{:04}", unit.number),
            None => format!("{experiment}-{profile}"),
        }
    }

    /// In which respects a result that was made of `saved` is not the one that would be made of this, in one line; empty
    /// if it is.
    pub(super) fn differences(&self, saved: &Identity) -> String {
        if saved.schema != self.schema || saved.experiment != self.experiment {
            return FORM.into();
        }
        let mut differences = Vec::new();
        if saved.parameters != self.parameters || saved.profile != self.profile {
            differences.push("other parameters".to_string());
        }
        if saved.unit != self.unit {
            differences.push("another unit of work".into());
        }
        let paths: BTreeSet<&String> = self.code.keys().chain(saved.code.keys()).collect();
        let changed = |path: &&&String| self.code.get(**path) != saved.code.get(**path);
        let changed: Vec<_> = paths.iter().filter(changed).collect();
        match changed.as_slice() {
            [] => (),
            [one] => differences.push(format!("{one} changed")),
            [one, more @ ..] => differences.push(format!("{one} and {} more changed", more.len())),
        }
        differences.join(", ")
    }
}

//! Saves results of long runs, and reads those that are fresh.
//!
//! A result is a file that is named by experiment and profile, and a unit of work by its number
//! too, until all units are joined. The file has three lines: a checksum of the other two, what the
//! result was made of, and the result. It is used again if a run would be made of the same now; if
//! not, or if the file is damaged, the experiment is run again, and the reason is printed.

use super::cutting::Unit;
use super::{Error, Fault};
use crate::input::{WRITING, is_absent, one_line, read_text, sha256};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The sizes of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    /// Small samples, to try things out
    Quick,
    /// The committed report
    Full,
}

impl Profile {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Profile::Quick => "quick",
            Profile::Full => "full",
        }
    }
}

pub trait Json: Serialize + DeserializeOwned + PartialEq + Send + Sync + 'static {}

impl<T: Serialize + DeserializeOwned + PartialEq + Send + Sync + 'static> Json for T {}

const SCHEMA: u32 = 3;

const OLDER_FORMAT: &str = "saved in an older format";

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identity {
    pub experiment: String,
    profile: Profile,
    schema: u32,
    pub parameters: serde_json::Value,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit: Option<Unit>,
    code: BTreeMap<String, String>,
}

impl Identity {
    pub fn new(
        experiment: &str,
        profile: Profile,
        code: BTreeMap<String, String>,
        parameters: serde_json::Value,
    ) -> Self {
        let (experiment, unit) = (experiment.into(), None);
        Identity { experiment, profile, schema: SCHEMA, parameters, unit, code }
    }

    pub fn for_unit(&self, unit: &Unit) -> Self {
        Identity { unit: Some(unit.clone()), ..self.clone() }
    }

    /// Returns the name of its file without the ending: `sweep-full`, of a unit `sweep-full-0012`.
    pub fn file_stem(&self) -> String {
        let (experiment, profile) = (&self.experiment, self.profile.name());
        match &self.unit {
            Some(unit) => format!("{experiment}-{profile}-{:04}", unit.number),
            None => format!("{experiment}-{profile}"),
        }
    }

    /// Says in one line what differs from what a saved result was made of; empty if nothing does.
    pub(super) fn differences(&self, saved: &Identity) -> String {
        if saved.schema != self.schema || saved.experiment != self.experiment {
            return OLDER_FORMAT.into();
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
        let mut changed: Vec<_> = paths.iter().filter(changed).collect();
        changed.sort_by_key(|path| path.starts_with(".."));
        match changed.as_slice() {
            [] => (),
            [one] => differences.push(format!("{one} changed")),
            [one, more @ ..] => differences.push(format!("{one} and {} more changed", more.len())),
        }
        differences.join(", ")
    }
}

/// The folder of saved results.
#[derive(Clone, Debug)]
pub struct Store {
    folder: Option<PathBuf>,
}

impl Store {
    /// Opens a store in a folder, which is made when a result has to be saved.
    pub fn open(folder: &Path) -> Self {
        Store { folder: Some(folder.into()) }
    }

    /// Makes a store that saves and finds nothing.
    pub fn nowhere() -> Self {
        Store { folder: None }
    }

    fn path(&self, identity: &Identity) -> Option<PathBuf> {
        let name = format!("{}.json", identity.file_stem());
        self.folder.as_ref().map(|folder| folder.join(name))
    }

    /// Returns the saved result, or why it must be run, as [`Store::fresh`] does.
    pub(crate) fn load<T: DeserializeOwned>(&self, identity: &Identity) -> Result<T, String> {
        serde_json::from_str(&self.fresh(identity)?).map_err(|_| run_again(OLDER_FORMAT))
    }

    /// Returns the result that was saved last, whatever it was made of.
    pub(super) fn load_last<T: DeserializeOwned>(&self, name: &str, profile: Profile) -> Option<T> {
        let identity = Identity::new(name, profile, BTreeMap::new(), ().into());
        let saved = read_text(&self.path(&identity)?).ok()?;
        serde_json::from_str(parse(&saved).ok()?.1).ok()
    }

    /// Returns the JSON of a result that is saved whole and was made of the same, or why it must be
    /// run, in one line: `run`, `run again, Cargo.lock changed`.
    pub(crate) fn fresh(&self, identity: &Identity) -> Result<String, String> {
        let saved = match self.path(identity).map(|path| read_text(&path)) {
            Some(Ok(saved)) => saved,
            Some(Err(error)) if !is_absent(&error) => {
                return Err(run_again(&format!("the saved result cannot be read: {error}")));
            }
            _ => return Err("run".into()),
        };
        let (made_of, body) = parse(&saved).map_err(run_again)?;
        let differences = identity.differences(&made_of);
        if differences.is_empty() { Ok(body.into()) } else { Err(run_again(&differences)) }
    }

    /// Makes the folder, so that one which cannot be made is known before a run.
    pub(crate) fn prepare(&self) -> Result<(), Error> {
        let Some(folder) = &self.folder else { return Ok(()) };
        let failed = |source| Error(Fault::Store { path: folder.clone(), source });
        std::fs::create_dir_all(folder).map_err(failed)
    }

    pub(crate) fn save<T: Json>(&self, identity: &Identity, result: &T) -> Result<(), Error> {
        let Some(path) = self.path(identity) else { return Ok(()) };
        let [made_of, body] = [to_json(identity, identity)?, to_json(identity, result)?];
        let lines = format!("{made_of}\n{body}\n");
        write_whole(&path, &format!("{}\n{lines}", sha256(&lines)))
            .map_err(|source| Error(Fault::Store { path, source }))
    }

    /// Removes the units of a result, and the result too if it is to be run again.
    pub(crate) fn remove(&self, identity: &Identity, is_to_run: bool) -> Result<(), Error> {
        let stem = format!("{}-", identity.file_stem());
        let is_unit = |path: &PathBuf| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let number = name.strip_prefix(&stem).and_then(|rest| rest.strip_suffix(".json"));
            number.is_some_and(|number| number.bytes().all(|digit| digit.is_ascii_digit()))
        };
        let files = self.folder.iter().filter_map(|folder| folder.read_dir().ok()).flatten();
        let units = files.flatten().map(|entry| entry.path()).filter(is_unit);
        for path in units.chain(self.path(identity).filter(|_| is_to_run)) {
            if let Err(source) = std::fs::remove_file(&path)
                && !is_absent(&source)
            {
                return Err(Error(Fault::Store { path, source }));
            }
        }
        Ok(())
    }
}

fn run_again(reason: &str) -> String {
    format!("run again, {}", one_line(reason, 1000))
}

/// Returns what a saved result was made of, and its JSON.
fn parse(saved: &str) -> Result<(Identity, &str), &'static str> {
    let (checksum, lines) = saved.split_once('\n').unwrap_or_default();
    let [identity, body, ""] = lines.split('\n').collect::<Vec<_>>()[..] else {
        return Err("the saved result is cut short or has extra lines");
    };
    if checksum != sha256(lines) {
        return Err("the saved result was damaged or edited: its checksum is wrong");
    }
    serde_json::from_str(identity).map(|identity| (identity, body)).map_err(|_| OLDER_FORMAT)
}

/// Writes a result as text that reads back to the same bits. JSON has neither NaN nor infinity, and
/// serde_json writes null instead: reading back finds all such losses, and those of fields.
fn to_json<T: Json>(identity: &Identity, result: &T) -> Result<String, Error> {
    let json = serde_json::to_string(result).ok();
    let is_same = |json: &String| serde_json::from_str(json).is_ok_and(|read: T| read == *result);
    json.filter(is_same).ok_or_else(|| Error(Fault::Lost(identity.experiment.clone())))
}

/// Writes a temporary file and renames it, so that no file ever has half a result.
fn write_whole(path: &Path, content: &str) -> std::io::Result<()> {
    std::fs::create_dir_all(path.parent().unwrap_or(path))?;
    let _moment = WRITING.read();
    let temporary = path.with_extension(format!("json.{}", std::process::id()));
    let written = std::fs::write(&temporary, content);
    let saved = written.and_then(|()| std::fs::rename(&temporary, path));
    saved.inspect_err(|_| drop(std::fs::remove_file(&temporary)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::random::{NormalPairs, Seed};

    #[test]
    fn results_come_back_to_the_bit_and_what_is_not_finite_is_not_saved() {
        let folder = tempfile::tempdir().unwrap();
        let mut normals = NormalPairs::new("test-store", Seed(1), 0);
        let mut result: Vec<_> = (0..500).flat_map(|_| normals.pair()).map(Some).collect();
        result.extend([None, Some(-0.0), Some(f64::MIN_POSITIVE / 4.0), Some(f64::MAX)]);
        let store = Store::open(folder.path());
        let identity = Identity::new("test", Profile::Quick, Default::default(), 1.5.into());
        store.save(&identity, &result).unwrap();
        let again: Vec<Option<f64>> = store.load(&identity).unwrap();
        assert_eq!(format!("{again:?}"), format!("{result:?}"));
        for bad in [f64::NAN, f64::INFINITY] {
            let bad = store.save(&identity, &vec![None, Some(bad)]);
            assert!(matches!(bad, Err(Error(Fault::Lost(_)))));
        }
        #[derive(PartialEq, Serialize, Deserialize)]
        struct Partly(Option<f64>, #[serde(skip)] u32);
        assert!(matches!(store.save(&identity, &Partly(None, 1)), Err(Error(Fault::Lost(_)))));
        let keys = BTreeMap::from([((1, 2), 3)]);
        assert!(matches!(to_json(&identity, &keys), Err(Error(Fault::Lost(_)))));
    }

    #[test]
    fn an_experiment_removes_its_own_results_only() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path());
        let of = |name| Identity::new(name, Profile::Full, Default::default(), 1.into());
        let ([a, long], unit) = ([of("a"), of("a-full")], Unit::whole(1));
        let identities = [a.for_unit(&unit), a.clone(), long.for_unit(&unit), long];
        identities.iter().for_each(|one| store.save(one, &7).unwrap());
        store.remove(&a, true).unwrap();
        assert_eq!(identities.map(|one| store.fresh(&one).is_ok()), [false, false, true, true]);
    }
}

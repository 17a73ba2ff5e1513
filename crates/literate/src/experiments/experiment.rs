//! An experiment: a name, parameters, a way to run it, and the tables that follow.

use super::cutting::{Cutting, Unit};
use super::deep::Audit;
use super::identity::{Identity, Reason, told};
use super::store::{Store, written};
use super::{Code, Error, Profile, Progress};
use crate::table::Table;
use rayon::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::any::Any;
use std::sync::Arc;

/// An experiment with parameters P and result T; U is what a unit of one that is cut gives.
pub struct Experiment<P: 'static, T: 'static, U: 'static = ()> {
    /// Its name, as values and saved files carry it.
    pub name: &'static str,
    /// Its code.
    pub code: Code,
    /// Its parameters in a profile.
    pub parameters: fn(Profile) -> P,
    /// How it is run.
    pub how: How<P, T, U>,
    /// What follows from its result.
    pub tables: fn(&T) -> Vec<Table>,
}

/// How an experiment is run.
pub enum How<P, T, U> {
    /// Read from a file that is committed, and never saved.
    Read(fn(Given<'_>) -> Result<T, Error>),
    /// As one unit of work.
    Whole {
        /// Runs it.
        run: fn(&P, &Progress) -> Result<T, Error>,
        /// Work in impacts, roughly.
        weight: fn(&P) -> u64,
    },
    /// Cut into units; the name is for people who wait.
    Cut(&'static str, Cutting<P, U, T>),
}

/// Gives the text of a file of the templates, or says why there is none.
pub type Given<'a> = &'a dyn Fn(&str) -> Result<String, String>;

/// What is saved as JSON.
pub trait Json: Serialize + DeserializeOwned + PartialEq + Send + Sync + 'static {}

impl<T: Serialize + DeserializeOwned + PartialEq + Send + Sync + 'static> Json for T {}

/// A result of any experiment.
pub type Found = Arc<dyn Any + Send + Sync>;

impl<P: Serialize + Sync, T: Json, U: Json> Experiment<P, T, U> {
    /// The result: the saved one if it is fresh, else that of a run.
    ///
    /// # Errors
    /// As [`Store::get`].
    pub fn get(&self, profile: Profile, store: &Store, progress: &Progress) -> Result<T, Error> {
        let parameters = (self.parameters)(profile);
        let identity = self.made_of(&parameters);
        store.get(&identity, profile, progress, || self.run(&parameters, progress))
    }

    fn made_of(&self, parameters: &P) -> Identity {
        Identity::new(self.name, self.code, parameters)
    }

    fn run(&self, parameters: &P, progress: &Progress) -> Result<T, Error> {
        match &self.how {
            How::Read(_) => Err(Error::NotRun(self.name)),
            How::Whole { run, .. } => run(parameters, progress),
            How::Cut(name, cutting) => cutting.run(parameters, name, progress),
        }
    }
}

/// What is known of every experiment, whatever its parameters and result are.
pub trait Entry: Saved {
    /// Path of the item that is its code.
    fn item(&self) -> String;

    /// Whether its result is saved; else it is read from a committed file.
    fn is_saved(&self) -> bool {
        true
    }

    /// What it runs, in words with a reference, if it takes so long that its result is committed.
    fn carried(&self) -> Option<&'static str> {
        None
    }

    /// Its result, with the audit of one that is carried over.
    ///
    /// # Errors
    /// As [`Experiment::get`].
    fn found(
        &self,
        profile: Profile,
        given: Given<'_>,
        store: &Store,
        progress: &Progress,
    ) -> Result<(Found, Option<Audit>), Error>;

    /// The tables of a result.
    fn tables(&self, found: &Found) -> Vec<Table>;
}

/// An experiment whose result has a type that is known.
pub trait Typed: Entry {
    /// The type.
    type Result: Json;
}

/// The path of the item that a file is: `src/experiments/heat/mod.rs` is `experiments::heat`.
pub(super) fn item(module: &str) -> String {
    let path = module.trim_start_matches("src/").trim_end_matches(".rs").trim_end_matches("/mod");
    path.replace('/', "::")
}

/// A result of a type that is known, if it is one.
pub(super) fn typed<T: Json>(found: &Found) -> Option<&T> {
    found.downcast_ref()
}

impl<P: Serialize + Sync, T: Json, U: Json> Entry for Experiment<P, T, U> {
    fn item(&self) -> String {
        item(self.code.file)
    }

    fn is_saved(&self) -> bool {
        !matches!(self.how, How::Read(_))
    }

    fn found(
        &self,
        profile: Profile,
        given: Given<'_>,
        store: &Store,
        progress: &Progress,
    ) -> Result<(Found, Option<Audit>), Error> {
        let found = match &self.how {
            How::Read(read) => read(given)?,
            _ => self.get(profile, store, progress)?,
        };
        Ok((Arc::new(found), None))
    }

    fn tables(&self, found: &Found) -> Vec<Table> {
        typed(found).map_or_else(Vec::new, self.tables)
    }
}

impl<P: Serialize + Sync, T: Json, U: Json> Typed for Experiment<P, T, U> {
    type Result = T;
}

/// What can be asked of every experiment that is saved.
pub trait Saved: Sync {
    /// Its name, as values and saved files carry it.
    fn name(&self) -> &'static str;

    /// What its saved result depends on.
    fn identity(&self, profile: Profile) -> Identity;

    /// With which parameters it was run, in this profile or for it.
    fn parameters(&self, profile: Profile) -> serde_json::Value {
        self.identity(profile).parameters
    }

    /// Why its saved result is not to be used; nothing if it is fresh.
    fn stale(&self, profile: Profile, store: &Store) -> Vec<Reason>;

    /// Runs it again and compares with the fresh saved result, byte by byte.
    ///
    /// # Errors
    /// As [`Experiment::get`]; [`Error::Stale`] if there is none that is fresh.
    fn audit(&self, profile: Profile, store: &Store, progress: &Progress) -> Result<bool, Error>;

    /// Its units of work: one if it is not cut.
    fn units(&self, profile: Profile) -> Vec<Unit>;

    /// Runs some of its units and saves what each gives as soon as it is there.
    ///
    /// # Errors
    /// What a unit returns; what [`Store::put`] does.
    fn run_units(
        &self,
        profile: Profile,
        units: &[(&Unit, Identity)],
        store: &Store,
        progress: &Progress,
    ) -> Result<(), Error>;

    /// Whether a text can be what a unit gave.
    fn understands(&self, profile: Profile, unit: &Unit, text: &str) -> bool;

    /// Joins what all units gave, as texts in their order, and saves the result.
    ///
    /// # Errors
    /// [`Error::Interrupted`]; what [`Store::put`] returns; [`Error::NotUnderstood`] for texts that
    /// it does not understand.
    fn merge(
        &self,
        profile: Profile,
        texts: &[String],
        store: &Store,
        progress: &Progress,
    ) -> Result<(), Error>;
}

impl<P: Serialize + Sync, T: Json, U: Json> Saved for Experiment<P, T, U> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn identity(&self, profile: Profile) -> Identity {
        self.made_of(&(self.parameters)(profile))
    }

    fn stale(&self, profile: Profile, store: &Store) -> Vec<Reason> {
        match store.look(&Saved::identity(self, profile), profile) {
            Ok(text) if serde_json::from_str::<T>(&text).is_ok() => Vec::new(),
            Ok(_) => vec![Reason::Schema],
            Err(reasons) => reasons,
        }
    }

    fn audit(&self, profile: Profile, store: &Store, progress: &Progress) -> Result<bool, Error> {
        let name = self.name;
        let saved = store.look(&Saved::identity(self, profile), profile);
        let saved = saved.map_err(|reasons| Error::Stale { name, why: told(&reasons) })?;
        let again = self.run(&(self.parameters)(profile), progress)?;
        Ok(written(name, &again)? == saved)
    }

    fn units(&self, profile: Profile) -> Vec<Unit> {
        let parameters = (self.parameters)(profile);
        match &self.how {
            How::Read(_) => Vec::new(),
            How::Whole { weight, .. } => vec![Unit {
                row: 0,
                realisations: 0..0,
                covers: "all of it".into(),
                weight: weight(&parameters),
            }],
            How::Cut(_, cutting) => cutting.units(&parameters),
        }
    }

    fn run_units(
        &self,
        profile: Profile,
        units: &[(&Unit, Identity)],
        store: &Store,
        progress: &Progress,
    ) -> Result<(), Error> {
        let parameters = (self.parameters)(profile);
        match &self.how {
            How::Read(_) => Ok(()),
            How::Whole { run, .. } => units.iter().try_for_each(|(_, identity)| {
                store.put(identity, profile, &run(&parameters, progress)?)
            }),
            How::Cut(name, cutting) => {
                let stage = progress.stage(name, units.iter().map(|(unit, _)| unit.weight).sum());
                units.par_iter().with_max_len(1).try_for_each(|(unit, identity)| {
                    let part = (cutting.part)(&parameters, unit, &stage, progress)?;
                    store.put(identity, profile, &part)
                })
            }
        }
    }

    fn understands(&self, profile: Profile, unit: &Unit, text: &str) -> bool {
        match &self.how {
            How::Read(_) | How::Whole { .. } => serde_json::from_str::<T>(text).is_ok(),
            How::Cut(_, cutting) => serde_json::from_str::<U>(text)
                .is_ok_and(|part| (cutting.fits)(&(self.parameters)(profile), unit, &part)),
        }
    }

    fn merge(
        &self,
        profile: Profile,
        texts: &[String],
        store: &Store,
        progress: &Progress,
    ) -> Result<(), Error> {
        let unread = |_| Error::NotUnderstood { name: self.name };
        let result = match &self.how {
            How::Read(_) | How::Whole { .. } => {
                serde_json::from_str(&texts.concat()).map_err(unread)?
            }
            How::Cut(_, cutting) => {
                let given = texts.iter().map(|text| serde_json::from_str(text));
                let given: Vec<U> = given.collect::<Result<_, _>>().map_err(unread)?;
                cutting.joined(&(self.parameters)(profile), given, progress)?
            }
        };
        store.put(&Saved::identity(self, profile), profile, &result)
    }
}

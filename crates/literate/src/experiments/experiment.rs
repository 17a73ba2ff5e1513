//! An experiment: a name, parameters, a way to run it, and the tables that follow.

use super::cutting::{Cutting, Unit};
use super::identity::Identity;
use super::store::Store;
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

/// What an experiment is told, and known by.
pub trait Params: Serialize + Send + Sync {}

impl<P: Serialize + Send + Sync> Params for P {}

/// A result of any experiment.
pub type Found = Arc<dyn Any + Send + Sync>;

impl<P: Params, T: Json, U: Json> Experiment<P, T, U> {
    /// The result: the saved one if it is fresh, else that of a run.
    pub fn get(&self, profile: Profile, store: &Store, progress: &Progress) -> Result<T, Error> {
        self.run_of(profile).get(store, progress)
    }

    pub(super) fn run_of(&self, profile: Profile) -> Run<P, T, U> {
        let parameters = (self.parameters)(profile);
        let identity = Identity::new(self.name, self.code, &parameters);
        let how = match self.how {
            How::Read(read) => How::Read(read),
            How::Whole { run, weight } => How::Whole { run, weight },
            How::Cut(words, Cutting { rows, part, fits, join }) => {
                How::Cut(words, Cutting { rows, part, fits, join })
            }
        };
        Run { name: self.name, profile, identity, parameters, how }
    }
}

/// What is known of every experiment, whatever its parameters and result are.
pub trait Entry: Sync {
    /// Its name, as values and saved files carry it.
    fn name(&self) -> &'static str;

    /// Its code.
    fn code(&self) -> Code;

    /// What it saves in a profile.
    fn at(&self, profile: Profile) -> Arc<dyn Saved + '_>;

    /// With which parameters it was run, in this profile or for it.
    fn parameters(&self, profile: Profile) -> serde_json::Value {
        self.at(profile).identity().parameters.clone()
    }

    /// Path of the item that is its code: `src/experiments/sweep/mod.rs` is `experiments::sweep`.
    fn item(&self) -> String {
        let path = self.code().file.trim_start_matches("src/").trim_end_matches(".rs");
        path.trim_end_matches("/mod").replace('/', "::")
    }

    /// Whether its result is saved; else it is read from a committed file.
    fn is_saved(&self) -> bool {
        true
    }

    /// Its result.
    fn found(
        &self,
        profile: Profile,
        given: Given<'_>,
        store: &Store,
        progress: &Progress,
    ) -> Result<Found, Error>;

    /// The tables of a result.
    fn tables(&self, found: &Found) -> Vec<Table>;
}

/// An experiment whose result has a type that is known.
pub trait Typed: Entry {
    /// The type.
    type Result: Json;
}

impl<P: Params, T: Json, U: Json> Entry for Experiment<P, T, U> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn code(&self) -> Code {
        self.code
    }

    fn at(&self, profile: Profile) -> Arc<dyn Saved + '_> {
        Arc::new(self.run_of(profile))
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
    ) -> Result<Found, Error> {
        Ok(Arc::new(match &self.how {
            How::Read(read) => read(given)?,
            _ => self.get(profile, store, progress)?,
        }))
    }

    fn tables(&self, found: &Found) -> Vec<Table> {
        found.downcast_ref().map_or_else(Vec::new, self.tables)
    }
}

impl<P: Params, T: Json, U: Json> Typed for Experiment<P, T, U> {
    type Result = T;
}

/// What an experiment saves in a profile.
pub trait Saved: Send + Sync {
    /// The name of the experiment.
    fn name(&self) -> &'static str;

    /// What the result depends on.
    fn identity(&self) -> &Identity;

    /// Its units of work: one if it is not cut.
    fn units(&self) -> Vec<Unit>;

    /// Runs some of its units and saves what each gives as soon as it is there.
    fn run_units(
        &self,
        units: &[(&Unit, &Identity)],
        store: &Store,
        progress: &Progress,
    ) -> Result<(), Error>;

    /// Whether a text can be what a unit gave.
    fn understands(&self, unit: &Unit, text: &str) -> bool;

    /// Joins what all units gave, as texts in their order, and saves the result.
    fn merge(&self, texts: &[String], store: &Store, progress: &Progress) -> Result<(), Error>;
}

/// What is run in a profile, with its parameters.
pub(super) struct Run<P, T, U> {
    pub name: &'static str,
    pub profile: Profile,
    pub identity: Identity,
    pub parameters: P,
    pub how: How<P, T, U>,
}

impl<P: Send + Sync, T: Json, U: Json> Run<P, T, U> {
    /// The result: the saved one if it is fresh, else that of a run.
    pub fn get(&self, store: &Store, progress: &Progress) -> Result<T, Error> {
        store.get(&self.identity, self.profile, progress, || self.run(progress))
    }

    fn run(&self, progress: &Progress) -> Result<T, Error> {
        match &self.how {
            How::Read(_) => Err(Error::NotRun(self.name)),
            How::Whole { run, .. } => run(&self.parameters, progress),
            How::Cut(name, cutting) => cutting.run(&self.parameters, name, progress),
        }
    }
}

impl<P: Send + Sync, T: Json, U: Json> Saved for Run<P, T, U> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn units(&self) -> Vec<Unit> {
        match &self.how {
            How::Read(_) => Vec::new(),
            How::Whole { weight, .. } => vec![Unit {
                row: 0,
                realisations: 0..0,
                covers: "all of it".into(),
                weight: weight(&self.parameters),
            }],
            How::Cut(_, cutting) => cutting.units(&self.parameters),
        }
    }

    fn run_units(
        &self,
        units: &[(&Unit, &Identity)],
        store: &Store,
        progress: &Progress,
    ) -> Result<(), Error> {
        match &self.how {
            How::Read(_) | How::Whole { .. } => units.iter().try_for_each(|(_, identity)| {
                store.put(identity, self.profile, &self.run(progress)?)
            }),
            How::Cut(name, cutting) => {
                let stage = progress.stage(name, units.iter().map(|(unit, _)| unit.weight).sum());
                units.par_iter().with_max_len(1).try_for_each(|(unit, identity)| {
                    let part = (cutting.part)(&self.parameters, unit, &stage, progress)?;
                    store.put(identity, self.profile, &part)
                })
            }
        }
    }

    fn understands(&self, unit: &Unit, text: &str) -> bool {
        match &self.how {
            How::Read(_) | How::Whole { .. } => serde_json::from_str::<T>(text).is_ok(),
            How::Cut(_, cutting) => serde_json::from_str(text)
                .is_ok_and(|part| (cutting.fits)(&self.parameters, unit, &part)),
        }
    }

    fn merge(&self, texts: &[String], store: &Store, progress: &Progress) -> Result<(), Error> {
        let unread = |_| Error::NotUnderstood { name: self.name };
        let result = match &self.how {
            How::Read(_) | How::Whole { .. } => {
                serde_json::from_str(&texts.concat()).map_err(unread)?
            }
            How::Cut(_, cutting) => {
                let given = texts.iter().map(|text| serde_json::from_str(text));
                let given: Vec<U> = given.collect::<Result<_, _>>().map_err(unread)?;
                cutting.joined(&self.parameters, given, progress)?
            }
        };
        store.put(&self.identity, self.profile, &result)
    }
}

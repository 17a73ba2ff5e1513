//! An experiment whose result is saved, whole or cut into units of work.

use super::cutting::{Cutting, Unit};
use super::identity::{Identity, Reason, told};
use super::store::{Store, written};
use super::{Error, Need, Progress};
use crate::params::Profile;
use rayon::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// An experiment with parameters P and result T; U is what a unit of one that is cut gives.
pub struct Experiment<P: 'static, T: 'static, U: 'static = ()> {
    /// What it is needed for; its name is that of the experiment.
    pub need: Need,
    /// The file of its code.
    pub(super) module: &'static str,
    /// Its parameters in a profile.
    pub(super) parameters: fn(Profile) -> P,
    pub(super) how: How<P, T, U>,
}

/// How an experiment is run.
pub(super) enum How<P, T, U> {
    /// As one unit of work.
    Whole {
        run: fn(&P, &Progress) -> Result<T, Error>,
        /// Work in impacts, roughly.
        weight: fn(&P) -> u64,
    },
    /// Cut into units; the name is for people who wait.
    Cut(&'static str, Cutting<P, U, T>),
}

/// What is saved as JSON.
pub trait Json: Serialize + DeserializeOwned + PartialEq + Send {}

impl<T: Serialize + DeserializeOwned + PartialEq + Send> Json for T {}

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
        Identity::new(self.need.name(), self.module, parameters)
    }

    fn run(&self, parameters: &P, progress: &Progress) -> Result<T, Error> {
        match &self.how {
            How::Whole { run, .. } => run(parameters, progress),
            How::Cut(name, cutting) => cutting.run(parameters, name, progress),
        }
    }
}

/// What can be asked of every experiment, whatever its parameters and result are.
pub trait Saved: Sync {
    /// What it is needed for.
    fn need(&self) -> Need;

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
    fn need(&self) -> Need {
        self.need
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
        let name = self.need.name();
        let saved = store.look(&Saved::identity(self, profile), profile);
        let saved = saved.map_err(|reasons| Error::Stale { name, why: told(&reasons) })?;
        let again = self.run(&(self.parameters)(profile), progress)?;
        Ok(written(name, &again)? == saved)
    }

    fn units(&self, profile: Profile) -> Vec<Unit> {
        let parameters = (self.parameters)(profile);
        match &self.how {
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
            How::Whole { .. } => serde_json::from_str::<T>(text).is_ok(),
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
        let unread = |_| Error::NotUnderstood { name: self.need.name() };
        let result = match &self.how {
            How::Whole { .. } => serde_json::from_str(&texts.concat()).map_err(unread)?,
            How::Cut(_, cutting) => {
                let given = texts.iter().map(|text| serde_json::from_str(text));
                let given: Vec<U> = given.collect::<Result<_, _>>().map_err(unread)?;
                cutting.joined(&(self.parameters)(profile), given, progress)?
            }
        };
        store.put(&Saved::identity(self, profile), profile, &result)
    }
}

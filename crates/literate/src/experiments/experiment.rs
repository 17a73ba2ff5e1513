//! An experiment: a name, parameters, a way to run it, and the tables that follow.

use super::cutting::{Cutting, Unit};
use super::store::{Identity, Json};
use super::{Error, Profile, Progress, Session};
use crate::input::count;
use crate::project::Project;
use crate::table::Table;
use rayon::prelude::*;
use serde::Serialize;
use std::any::Any;
use std::collections::BTreeMap;
use std::sync::Arc;

/// An experiment with parameters P and result T; U is what a unit of one that is cut gives.
pub struct Experiment<P: 'static, T: 'static, U: 'static = ()> {
    /// Its name, as values and saved files carry it.
    pub name: &'static str,
    /// The files and folders of its source, from the top of the project, the main one first: a
    /// saved result is fresh as long as they, and what all experiments share, are the same. None:
    /// as long as the whole source is.
    pub code: &'static [&'static str],
    pub parameters: fn(Profile) -> P,
    pub how: How<P, T, U>,
    /// What follows from its result.
    pub tables: fn(&T) -> Vec<Table>,
}

/// Estimates the work of a run with some parameters, so that people know how long they will wait: a
/// core does [`SECOND`](super::cutting::SECOND) in about a second. No result depends on it.
pub type Work<P> = fn(&P) -> u64;

pub enum How<P, T, U> {
    /// Read from a file that is committed, or known without a run; never saved.
    Read(fn(&Session<'_>) -> Result<T, Error>),
    /// As one unit of work.
    Whole(fn(&P, &Progress) -> Result<T, Error>, Work<P>),
    /// Cut into units; the name is for people who wait.
    Cut(&'static str, Cutting<P, U, T>),
}

impl<P, T> Experiment<P, T> {
    /// An experiment that is run as a whole, and again whenever the source of the paper changes.
    pub const fn new(
        name: &'static str,
        parameters: fn(Profile) -> P,
        run: fn(&P, &Progress) -> Result<T, Error>,
        tables: fn(&T) -> Vec<Table>,
    ) -> Self {
        Experiment { name, code: &[], parameters, how: How::Whole(run, |_| 0), tables }
    }
}

pub type Found = Arc<dyn Any + Send + Sync>;

impl<P: Serialize + Sync, T: Json, U: Json> Experiment<P, T, U> {
    /// The result: the saved one if it is fresh, else that of a run, which is then saved. Units
    /// that are in the store are not run again; each of the others is saved as soon as it is there.
    pub fn get(&self, session: &Session<'_>) -> Result<T, Error> {
        if let How::Read(read) = &self.how {
            return read(session);
        }
        let (parameters, identity) = self.known_by(session);
        session.saved(&identity, || match &self.how {
            How::Read(read) => read(session),
            How::Whole(run, _) => run(&parameters, &session.progress),
            How::Cut(_, cutting) => {
                let units = self.units(session.profile);
                let (parts, _) = self.parts(&units, &parameters, &identity, session)?;
                cutting.joined(&parameters, &units, parts, &session.progress)
            }
        })
    }

    /// Its parameters in a profile, and what its result depends on.
    fn known_by(&self, session: &Session<'_>) -> (P, Identity) {
        let parameters = (self.parameters)(session.profile);
        let code = AnyExperiment::code(self, session.project);
        let identity = Identity::new(self.name, session.profile, code, &parameters);
        (parameters, identity)
    }

    /// What some units of one that is cut give, in their order, and how many of them were not in
    /// the store and had to be run.
    fn parts(
        &self,
        units: &[Unit],
        parameters: &P,
        identity: &Identity,
        session: &Session<'_>,
    ) -> Result<(Vec<U>, usize), Error> {
        let How::Cut(words, cutting) = &self.how else { return Ok((Vec::new(), 0)) };
        let (store, progress, name) = (&session.store, &session.progress, self.name);
        let look = |unit: &Unit| store.look::<U>(&identity.of_unit(unit));
        let saved: Vec<_> = units.par_iter().map(look).collect();
        let mut lost: BTreeMap<String, usize> = BTreeMap::new();
        for why in saved.iter().filter_map(|found| found.as_ref().err()) {
            *lost.entry(why.clone()).or_default() += 1;
        }
        let run: usize = lost.values().sum();
        if run < units.len() {
            let all = count(units.len(), "unit");
            progress.say(&format!("{name}: {} of {all} there", units.len() - run));
        }
        for (why, number) in lost.iter().filter(|(why, _)| *why != "run") {
            progress.say(&format!("{name}: {} {why}", count(*number, "unit")));
        }
        let open = units.iter().zip(&saved).filter(|(_, found)| found.is_err());
        let stage = progress.stage(words, open.map(|(unit, _)| unit.weight).sum());
        let part = |(unit, found): (&Unit, Result<U, _>)| {
            found.or_else(|_| {
                let part = (cutting.part)(parameters, unit, &stage, progress)?;
                store.put(&identity.of_unit(unit), &part)?;
                Ok(part)
            })
        };
        // Units share the cores with the realisations inside them.
        let parts = units.par_iter().zip(saved).with_max_len(1).map(part);
        Ok((parts.collect::<Result<_, Error>>()?, run))
    }
}

/// What is known of every experiment, whatever its parameters and result are.
pub trait AnyExperiment: Sync {
    /// Its name, as values and saved files carry it.
    fn name(&self) -> &'static str;

    /// Path and hash of every file on which its result depends.
    fn code(&self, project: &Project) -> BTreeMap<String, String>;

    /// With which parameters it is run in a profile.
    fn parameters(&self, profile: Profile) -> serde_json::Value;

    /// Path of the item that is its code: `src/experiments/sweep` is `experiments::sweep`.
    fn item(&self) -> String;

    /// Whether its result is saved; else it is read from a committed file.
    fn is_saved(&self) -> bool {
        true
    }

    /// Its units of work: one if it is not cut.
    fn units(&self, _: Profile) -> Vec<Unit> {
        vec![Unit::whole(0)]
    }

    /// Runs those of some of its units that are not in the store, and saves what each gives as soon
    /// as it is there; none if the result is fresh. Returns how many were run.
    fn run_units(&self, _: &[Unit], session: &Session<'_>) -> Result<usize, Error> {
        let stale = self.stale(session).is_some();
        self.found(session).map(|_| usize::from(stale))
    }

    /// What would be run, and why; none if the saved result is fresh.
    fn stale(&self, session: &Session<'_>) -> Option<String>;

    fn found(&self, session: &Session<'_>) -> Result<Found, Error>;

    fn tables(&self, found: &Found) -> Vec<Table>;
}

impl std::fmt::Debug for dyn AnyExperiment {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl<P: Serialize + Sync, T: Json, U: Json> AnyExperiment for Experiment<P, T, U> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn code(&self, project: &Project) -> BTreeMap<String, String> {
        project.code(self.code)
    }

    fn parameters(&self, profile: Profile) -> serde_json::Value {
        serde_json::to_value((self.parameters)(profile)).unwrap_or_default()
    }

    fn item(&self) -> String {
        let path = self.code.first().copied().unwrap_or_default();
        path.trim_start_matches("src/").trim_end_matches(".rs").replace('/', "::")
    }

    fn is_saved(&self) -> bool {
        !matches!(self.how, How::Read(_))
    }

    fn units(&self, profile: Profile) -> Vec<Unit> {
        match &self.how {
            How::Read(_) => Vec::new(),
            How::Whole(_, work) => vec![Unit::whole(work(&(self.parameters)(profile)))],
            How::Cut(_, cutting) => cutting.units(&(self.parameters)(profile)),
        }
    }

    fn run_units(&self, units: &[Unit], session: &Session<'_>) -> Result<usize, Error> {
        let (parameters, identity) = self.known_by(session);
        if session.store.look::<T>(&identity).is_ok() {
            return Ok(0);
        }
        let How::Cut(..) = self.how else { return self.get(session).map(|_| units.len()) };
        session.store.prepare()?;
        Ok(self.parts(units, &parameters, &identity, session)?.1)
    }

    fn stale(&self, session: &Session<'_>) -> Option<String> {
        let store = &session.store;
        let (parameters, identity) = self.known_by(session);
        let why = store.look::<T>(&identity).err().filter(|_| self.is_saved())?;
        let why = format!("{}: {why}", self.name);
        let How::Cut(_, cutting) = &self.how else { return Some(why) };
        let units = cutting.units(&parameters);
        let there = |unit: &&Unit| store.look::<U>(&identity.of_unit(unit)).is_ok();
        let there = units.iter().filter(there).count();
        Some(format!("{why}; {there} of {} there", count(units.len(), "unit")))
    }

    fn found(&self, session: &Session<'_>) -> Result<Found, Error> {
        Ok(Arc::new(self.get(session)?))
    }

    fn tables(&self, found: &Found) -> Vec<Table> {
        found.downcast_ref().map_or_else(Vec::new, self.tables)
    }
}

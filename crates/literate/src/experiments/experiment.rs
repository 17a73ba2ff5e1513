//! Defines an experiment: its name, its parameters, how it is run, and the tables of its result.

use super::cutting::{Cutting, Unit};
use super::store::{Identity, Json, Store};
use super::{Error, Profile, Progress, Session};
use crate::input::count;
use crate::project::Project;
use crate::table::Table;
use rayon::prelude::*;
use std::any::Any;
use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;

/// An experiment with parameters P and result T; U is what a unit of one that is cut gives.
pub struct Experiment<P: 'static, T: 'static, U: 'static = ()> {
    /// Its name, with which the names of its tables begin.
    pub name: &'static str,
    /// Files and folders of code that only this experiment needs, from the top of the project, the
    /// main one first: a change of them makes no other result stale. All other code counts for all.
    pub own: &'static [&'static str],
    /// Files and folders that it reads when it runs, from the top of the project.
    pub reads: &'static [&'static str],
    /// Its parameters in a profile.
    pub parameters: fn(Profile) -> P,
    /// How its result is found.
    pub how: How<P, T, U>,
    /// Makes the tables of a result.
    pub tables: fn(&T) -> Vec<Table>,
}

/// How the result of an experiment is found.
pub enum How<P, T, U> {
    /// Read from a file that is committed, or known without a run; never saved.
    Read(fn(&Session<'_>) -> Result<T, Error>),
    /// Run as a whole, and saved; the second function estimates its work, of which a core does
    /// [`super::cutting::WORK_PER_SECOND`] in about a second, and no result depends on it.
    Whole(fn(&P, &Progress) -> Result<T, Error>, fn(&P) -> u64),
    /// Cut into units; progress is shown under the name.
    Cut(&'static str, Cutting<P, U, T>),
}

impl<P, T> Experiment<P, T> {
    /// Makes an experiment that is run as a whole, and again whenever the source changes.
    pub const fn new(
        name: &'static str,
        parameters: fn(Profile) -> P,
        run: fn(&P, &Progress) -> Result<T, Error>,
        tables: fn(&T) -> Vec<Table>,
    ) -> Self {
        Experiment { name, own: &[], reads: &[], parameters, how: How::Whole(run, |_| 0), tables }
    }
}

/// The result of any experiment, whose type only that experiment knows.
pub type AnyResult = Arc<dyn Any + Send + Sync>;

impl<P: Json, T: Json, U: Json> Experiment<P, T, U> {
    /// Returns the results of some units, in their order, and how many of them had to be run.
    fn parts(
        &self,
        (words, cutting): (&str, &Cutting<P, U, T>),
        units: &[Unit],
        identity: &Identity,
        session: &Session<'_>,
    ) -> Result<(Vec<U>, usize), Error> {
        let parameters = (self.parameters)(session.profile);
        let (store, progress, name) = (&session.store, &session.progress, self.name);
        let saved: Vec<Result<U, String>> =
            units.par_iter().map(|unit| store.load(&identity.for_unit(unit))).collect();
        let (mut reasons, mut work) = (BTreeMap::new(), 0);
        for (unit, saved_part) in units.iter().zip(&saved) {
            if let Err(reason) = saved_part {
                *reasons.entry(reason.clone()).or_insert(0) += 1;
                work += unit.work;
            }
        }
        let units_to_run: usize = reasons.values().sum();
        if units_to_run < units.len() {
            let (saved, total) = (units.len() - units_to_run, count(units.len(), "unit"));
            progress.say(&format!("{name}: {saved} of {total} there"));
        }
        for (reason, number) in reasons.iter().filter(|(reason, _)| *reason != "run") {
            progress.say(&format!("{name}: {} {reason}", count(*number, "unit")));
        }
        let stage = progress.stage(words, work);
        let part = |(unit, saved_part): (&Unit, Result<U, String>)| {
            if let Ok(part) = saved_part {
                return Ok(part);
            }
            let part = (cutting.run_unit)(&parameters, unit, &stage, progress)?;
            store.save(&identity.for_unit(unit), &part)?;
            Ok(part)
        };
        // Units share the cores with the realisations inside them.
        let parts = units.par_iter().zip(saved).with_max_len(1).map(part);
        Ok((parts.collect::<Result<_, Error>>()?, units_to_run))
    }
}

/// What is known of every experiment, whatever its parameters and result are.
pub trait AnyExperiment: Sync {
    /// Returns its name.
    fn name(&self) -> &'static str;

    /// Returns the code that only this experiment needs.
    fn own(&self) -> &'static [&'static str] {
        &[]
    }

    /// Checks that the files that it lists are there.
    fn check_files(&self, project: &Project) -> Result<(), Error>;

    /// Returns what the result is made of besides the parameters: a hash by the name of each thing.
    fn made_of(&self, session: &Session<'_>) -> Result<BTreeMap<String, String>, Error>;

    /// Returns its parameters as JSON; it is an error if JSON loses some of them.
    fn parameters(&self, profile: Profile) -> Result<serde_json::Value, Error>;

    /// Returns the path of its module: `experiments::sweep` for `src/experiments/sweep.rs`.
    fn item(&self) -> String;

    /// Returns whether its result is saved; if not, it is read or computed each time.
    fn is_saved(&self) -> bool {
        true
    }

    /// Returns all by which its saved result is known: name, profile, parameters and code.
    fn identity(&self, session: &Session<'_>) -> Result<Identity, Error> {
        let made_of = self.made_of(session)?;
        Ok(Identity::new(self.name(), session.profile, made_of, self.parameters(session.profile)?))
    }

    /// Returns its units of work: one if it is not cut.
    fn units(&self, _: Profile) -> Vec<Unit> {
        vec![Unit::whole(0)]
    }

    /// Returns those of the units that must be run: none if the saved result is fresh.
    fn units_to_run(&self, mut units: Vec<Unit>, identity: &Identity, store: &Store) -> Vec<Unit> {
        if !self.is_saved() || store.fresh(identity).is_ok() {
            return Vec::new();
        }
        units.retain(|unit| store.fresh(&identity.for_unit(unit)).is_err());
        units
    }

    /// Runs and saves those of the units that are not in the store; returns how many were run.
    fn run_units(
        &self,
        units: &[Unit],
        identity: &Identity,
        session: &Session<'_>,
    ) -> Result<usize, Error> {
        self.read_or_run(identity, session).map(|_| units.len())
    }

    /// Returns why and how much of it must be run, or `None` if its saved result is fresh.
    fn why_stale(&self, session: &Session<'_>) -> Result<Option<String>, Error> {
        let identity = self.identity(session)?;
        let Some(reason) = session.store.fresh(&identity).err().filter(|_| self.is_saved()) else {
            return Ok(None);
        };
        let reason = format!("{}: {reason}", self.name());
        let units = self.units(session.profile);
        if let [_] = units[..] {
            return Ok(Some(reason));
        }
        let units_in_words = count(units.len(), "unit");
        let saved = units.len() - self.units_to_run(units, &identity, &session.store).len();
        Ok(Some(format!("{reason}; {saved} of {units_in_words} there")))
    }

    /// Returns the result that is saved or known without a run, or why it must be run.
    fn load_saved(&self, identity: &Identity, session: &Session<'_>) -> Result<AnyResult, String>;

    /// Reads or runs the experiment, and saves the result of a run.
    fn read_or_run(&self, identity: &Identity, session: &Session<'_>) -> Result<AnyResult, Error>;

    /// Returns the tables of its result.
    fn tables(&self, result: &AnyResult) -> Vec<Table>;

    /// Returns its result as JSON, or `None` if it is a command.
    fn to_json(&self, _: &AnyResult) -> Option<serde_json::Value> {
        None
    }

    /// Makes a result of JSON, or returns `None` if it can have no such result.
    fn read_json(&self, _: serde_json::Value) -> Option<AnyResult> {
        None
    }
}

impl<P: Json, T: Json, U: Json> AnyExperiment for Experiment<P, T, U> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn own(&self) -> &'static [&'static str] {
        self.own
    }

    fn check_files(&self, project: &Project) -> Result<(), Error> {
        // Without a checkout there is no code to look for.
        let own = if project.top().is_some() { self.own } else { &[] };
        let fault = |(problem, remedy)| Error::input(self.name, problem, remedy);
        project.check_listed(&[own, self.reads].concat()).map_err(fault)
    }

    fn made_of(&self, session: &Session<'_>) -> Result<BTreeMap<String, String>, Error> {
        let mut made_of = session.code.counted(session.project, self.own);
        let unread = |error: io::Error| Error::input(self.name, error.to_string(), "restore it");
        made_of.extend(session.project.hashes(self.reads).map_err(unread)?);
        Ok(made_of)
    }

    fn parameters(&self, profile: Profile) -> Result<serde_json::Value, Error> {
        let parameters = (self.parameters)(profile);
        let json = serde_json::to_value(&parameters).map_err(|error| {
            let problem = format!("JSON cannot hold its parameters: {error}");
            Error::input(self.name, problem, "use texts as keys, and numbers of 64 bits")
        })?;
        // JSON has null for a number that is not finite.
        if P::deserialize(&json).is_ok_and(|read| read == parameters) {
            return Ok(json);
        }
        let problem = "a parameter is NaN or infinite, or is not saved";
        let remedy = "give it a number or `None`, without `#[serde(skip)]`";
        Err(Error::input(self.name, problem, remedy))
    }

    fn item(&self) -> String {
        let path = self.own.first().copied().unwrap_or_default();
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

    fn run_units(
        &self,
        units: &[Unit],
        identity: &Identity,
        session: &Session<'_>,
    ) -> Result<usize, Error> {
        let How::Cut(words, cutting) = &self.how else {
            return self.read_or_run(identity, session).map(|_| units.len());
        };
        Ok(self.parts((words, cutting), units, identity, session)?.1)
    }

    fn load_saved(&self, identity: &Identity, session: &Session<'_>) -> Result<AnyResult, String> {
        if let How::Read(_) = self.how {
            return self.read_or_run(identity, session).map_err(|error| error.to_string());
        }
        Ok(Arc::new(session.store.load::<T>(identity)?))
    }

    fn read_or_run(&self, identity: &Identity, session: &Session<'_>) -> Result<AnyResult, Error> {
        let parameters = (self.parameters)(session.profile);
        let result = match &self.how {
            How::Read(read) => return Ok(Arc::new(read(session)?)),
            How::Whole(run, _) => run(&parameters, &session.progress)?,
            How::Cut(words, cutting) => {
                let units = cutting.units(&parameters);
                let (parts, _) = self.parts((words, cutting), &units, identity, session)?;
                cutting.join_parts(&parameters, &units, parts, &session.progress)?
            }
        };
        if self.identity(session)? != *identity {
            let problem = "a file that it reads changed since this run began";
            return Err(Error::input(self.name, problem, "run it again"));
        }
        session.store.save(identity, &result)?;
        // Units that stay do no harm: the joined result is looked for first.
        let _ = session.store.remove(identity, false);
        Ok(Arc::new(result))
    }

    fn tables(&self, result: &AnyResult) -> Vec<Table> {
        result.downcast_ref().map_or_else(Vec::new, self.tables)
    }

    fn to_json(&self, result: &AnyResult) -> Option<serde_json::Value> {
        serde_json::to_value(result.downcast_ref::<T>()?).ok()
    }

    fn read_json(&self, result: serde_json::Value) -> Option<AnyResult> {
        Some(Arc::new(serde_json::from_value::<T>(result).ok()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::{Deserialize, Serialize};

    #[test]
    fn a_parameter_that_json_loses_is_refused() {
        #[derive(Clone, PartialEq, Serialize, Deserialize)]
        struct Skips {
            #[serde(skip)]
            seed: u64,
        }
        fn problem<P: Json>(parameters: fn(Profile) -> P) -> Option<String> {
            let toy = Experiment::new("toy", parameters, |_, _| Ok(()), |()| Vec::new());
            toy.parameters(Profile::Quick).err().map(|error| error.to_string())
        }
        let lost = "toy: a parameter is NaN or infinite, or is not saved; ";
        assert!(problem(|_| (vec![1.0, f64::NAN], Some(1))).unwrap().starts_with(lost));
        assert!(problem(|_| Skips { seed: 1 }).unwrap().starts_with(lost));
        let keys = problem(|_| BTreeMap::from([((1, 2), 3)])).unwrap();
        assert!(keys.starts_with("toy: JSON cannot hold its parameters: "), "{keys}");
        assert!(problem(|_| u128::MAX).is_some());
        assert_eq!(problem(|_| (vec![1.0], Some(1), -0.0)), None);
    }
}

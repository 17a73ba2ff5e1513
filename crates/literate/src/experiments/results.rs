//! Runs experiments, and holds their results and the tables that follow from them.

use super::progress::say;
use super::store::Json;
use super::{AnyExperiment, Command, Error, Experiment, Found, Profile, Session};
use crate::input::count;
use crate::table::{Table, Tables, number_at, table};
use rayon::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Arc, OnceLock};

/// Makes tables of the results and tables of several experiments; none if one of these was not run.
pub type DerivedTables = fn(&Results, &[Table]) -> Option<Vec<Table>>;

pub struct Results {
    pub profile: Profile,
    found: Vec<(&'static dyn AnyExperiment, Found)>,
    /// The tables that need several of them.
    derived: Vec<DerivedTables>,
    /// Or why they are refused.
    tables: OnceLock<Result<Tables, String>>,
}

impl Results {
    pub fn of<P, T: Json, U>(&self, experiment: &Experiment<P, T, U>) -> Result<&T, Error> {
        self.found(experiment.name)?.downcast_ref().ok_or(Error::NotRun(experiment.name))
    }

    fn found(&self, name: &'static str) -> Result<&Found, Error> {
        let found = self.found.iter().find(|(experiment, _)| experiment.name() == name);
        found.map(|(_, found)| found).ok_or(Error::NotRun(name))
    }

    /// Returns the result of an experiment for a test to change; tables are made anew.
    pub fn of_mut<P, T: Json, U>(&mut self, experiment: &Experiment<P, T, U>) -> Option<&mut T> {
        self.tables = OnceLock::new();
        let (_, found) = self.found.iter_mut().find(|(one, _)| one.name() == experiment.name)?;
        Arc::get_mut(found)?.downcast_mut()
    }

    /// Returns the tables of all results, by name. Fails if two have one name or one has a fault.
    pub fn tables(&self) -> Result<&Tables, Error> {
        // Made before the lock is taken: a thread that waits in it may begin what looks here.
        let tables = match self.tables.get() {
            Some(tables) => tables,
            None => {
                let made = self.made();
                self.tables.get_or_init(|| made)
            }
        };
        tables.as_ref().map_err(|fault| Error::Table(fault.clone()))
    }

    #[cfg(test)]
    pub(crate) fn made_up(tables: Vec<Table>) -> Self {
        let tables: Tables =
            tables.into_iter().map(|table| (table.name(), Arc::new(table))).collect();
        let (found, derived) = Default::default();
        Results { profile: Profile::Full, found, derived, tables: OnceLock::from(Ok(tables)) }
    }

    fn made(&self) -> Result<Tables, String> {
        let found = self.found.par_iter().with_max_len(1);
        let tables =
            found.map(|(experiment, found)| naming(experiment.name(), || experiment.tables(found)));
        let mut all = tables.collect::<Vec<_>>().concat();
        for tables in &self.derived {
            all.extend(tables(self, &all).into_iter().flatten());
        }
        let mut tables = Tables::new();
        for table in all {
            if let Some(fault) = table.fault() {
                return Err(fault.into());
            }
            let place = table.place();
            if let Some(before) = tables.insert(table.name(), Arc::new(table)) {
                let (name, before) = (before.name(), before.place());
                return Err(format!("{place}: the table {name} was made at {before}; rename one"));
            }
        }
        Ok(tables)
    }

    #[track_caller]
    pub fn table(&self, name: &str) -> Result<&Table, Error> {
        Ok(table(self.tables()?, name)?)
    }

    pub fn file(&self, command: &Command, path: &str) -> Result<Vec<u8>, Error> {
        let found = self.found(command.name)?;
        let problem = format!("{} wrote no such file", command.name);
        let missing = Error::input(path, problem, "add it to its `writes`");
        command.file(found, path).ok_or(missing)
    }

    /// Returns the number with this address: `theory.jump.p_jump`.
    #[track_caller]
    pub fn number(&self, address: &str) -> Result<f64, Error> {
        Ok(number_at(self.tables()?, address)?)
    }

    /// Returns results of experiments in this order: saved ones where they are fresh, else of runs.
    pub fn run(
        experiments: &[&'static dyn AnyExperiment],
        derived: &[DerivedTables],
        session: &Session<'_>,
    ) -> Result<Self, Error> {
        let (mut stale, mut missing) = (0, Vec::new());
        for experiment in experiments {
            let units = experiment.missing(experiment.units(session.profile), session);
            stale += usize::from(!units.is_empty());
            missing.extend(units);
        }
        session.announce(&count(stale, "experiment"), &missing)?;
        let mut found = Vec::new();
        for experiment in experiments {
            found.push((*experiment, naming(experiment.name(), || experiment.found(session))?));
        }
        session.progress.check()?;
        let (profile, derived) = (session.profile, derived.to_vec());
        Ok(Results { profile, found, derived, tables: OnceLock::new() })
    }
}

/// Does a part of the work of an experiment; if it panics, says which experiment it was.
fn naming<T>(experiment: &str, work: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        let words = format!("the internal error was in the experiment {experiment}");
        say(&words);
        resume_unwind(Box::new(words))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::{Progress, Store};

    #[test]
    fn a_panic_names_its_experiment() {
        const PANICS: Experiment<(), ()> =
            Experiment::new("orbit", |_| (), |(), _| panic!("no orbit"), |()| Vec::new());
        let session = Session::toy(Store::nowhere(), Progress::silent());
        let run = || Results::run(&[&PANICS], &[], &session).map(|_| ());
        let panic = catch_unwind(AssertUnwindSafe(run)).unwrap_err();
        let words = panic.downcast_ref::<String>().unwrap();
        assert_eq!(words, "the internal error was in the experiment orbit");
    }
}

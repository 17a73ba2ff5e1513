//! Runs experiments, and holds their results and the tables that follow from them.

use super::progress::say;
use super::store::{Identity, Json};
use super::{AnyExperiment, Command, Error, Experiment, Found, Profile, Session};
use crate::input::count;
use crate::names::{self, Names};
use crate::table::{Table, Tables, cell, number_at, table, table_of};
use crate::value::Value;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Makes tables of the results and tables of several experiments; none if one of these was not run.
pub type DerivedTables = fn(&Results, &[Table]) -> Option<Vec<Table>>;

pub struct Results {
    pub profile: Profile,
    found: Vec<(&'static dyn AnyExperiment, Found)>,
    /// The tables that need several of them.
    derived: Vec<DerivedTables>,
    /// Or why they are refused.
    tables: OnceLock<Result<Tables, String>>,
    /// The names of the tables, and of the experiments, that were asked for.
    read: Mutex<BTreeSet<String>>,
}

impl Results {
    pub fn of<P, T: Json, U>(&self, experiment: &Experiment<P, T, U>) -> Result<&T, Error> {
        self.note(experiment.name);
        self.found(experiment.name)?.downcast_ref().ok_or(Error::NotRun(experiment.name))
    }

    fn note(&self, name: &str) {
        self.read.lock().unwrap_or_else(PoisonError::into_inner).insert(name.into());
    }

    /// Returns the names of all tables and experiments that were read.
    pub(crate) fn read(&self) -> BTreeSet<String> {
        self.read.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Returns the same results, of which nothing was read.
    pub(crate) fn copy(&self) -> Results {
        let Results { profile, found, derived, tables, .. } = self;
        let (found, derived, tables) = (found.clone(), derived.clone(), tables.clone());
        Results { profile: *profile, found, derived, tables, read: Mutex::default() }
    }

    /// Returns these results with another table in the place of the one with its name.
    pub(crate) fn with_table(&self, table: Table) -> Results {
        let mut copy = self.copy();
        if let Some(Ok(tables)) = copy.tables.get_mut() {
            tables.insert(table.name(), Arc::new(table));
        }
        copy
    }

    /// Returns the result of an experiment as JSON; none if it was not run.
    pub(crate) fn json(&self, name: &str) -> Option<serde_json::Value> {
        let (experiment, found) = self.found.iter().find(|(one, _)| one.name() == name)?;
        experiment.json(found)
    }

    /// Returns these results and their tables, but with another result of an experiment; none if
    /// the experiment cannot have this one.
    pub(crate) fn with_json(&self, name: &str, result: serde_json::Value) -> Option<Results> {
        let mut copy = self.copy();
        let (experiment, found) = copy.found.iter_mut().find(|(one, _)| one.name() == name)?;
        *found = experiment.of_json(result)?;
        Some(copy)
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
        let again = || {
            let found = self.found.iter();
            self.joined(found.flat_map(|(experiment, found)| tables(*experiment, found)).collect())
        };
        self.tables.get_or_init(again).as_ref().map_err(|fault| Error::Table(fault.clone()))
    }

    #[cfg(test)]
    pub(crate) fn made_up(tables: Vec<Table>) -> Self {
        let tables: Tables =
            tables.into_iter().map(|table| (table.name(), Arc::new(table))).collect();
        let (found, derived) = Default::default();
        let (tables, read) = (OnceLock::from(Ok(tables)), Mutex::default());
        Results { profile: Profile::Full, found, derived, tables, read }
    }

    /// Returns these tables and those that need several experiments, by name.
    fn joined(&self, mut all: Vec<Table>) -> Result<Tables, String> {
        let experiments: Vec<&str> = self.found.iter().map(|(one, _)| one.name()).collect();
        for tables in &self.derived {
            let made = tables(self, &all).into_iter().flatten();
            all.extend(made.map(|table| table.made_by(&experiments)).collect::<Vec<_>>());
        }
        let (mut tables, mut names) = (Tables::new(), Names::default());
        for table in all {
            if let Some(fault) = table.fault() {
                return Err(fault.into());
            }
            let (name, place) = (table.name(), table.place());
            let columns = table.names().find_map(names::fault);
            if let Some(fault) = names::fault(name).or(columns) {
                return Err(format!("{place}: the table {name}: {fault}"));
            }
            names.add(name, &place).map_err(|what| format!("tables: {what}"))?;
            tables.insert(name, Arc::new(table));
        }
        Ok(tables)
    }

    #[track_caller]
    pub fn table(&self, name: &str) -> Result<&Table, Error> {
        self.note(name);
        Ok(table(self.tables()?, name)?)
    }

    pub fn file(&self, command: &Command, path: &str) -> Result<Vec<u8>, Error> {
        let found = self.found(command.name)?;
        let problem = format!("{} wrote no such file", command.name);
        let missing = Error::input(path, problem, "add it to its `writes`");
        command.file(found, path).ok_or(missing)
    }

    /// Returns the cell with this address: `theory.jump.p_jump`.
    #[track_caller]
    pub fn cell(&self, address: &str) -> Result<&Value, Error> {
        self.note(table_of(address).unwrap_or(address));
        Ok(cell(self.tables()?, address)?)
    }

    /// Returns the number with this address.
    #[track_caller]
    pub fn number(&self, address: &str) -> Result<f64, Error> {
        self.note(table_of(address).unwrap_or(address));
        Ok(number_at(self.tables()?, address)?)
    }

    /// Returns results of experiments in this order: saved ones where they are fresh, else of runs.
    pub fn run(
        experiments: &[&'static dyn AnyExperiment],
        derived: &[DerivedTables],
        session: &Session<'_>,
    ) -> Result<Self, Error> {
        let identities = experiments.par_iter().with_max_len(1).map(|one| one.identity(session));
        let identities: Vec<Identity> = identities.collect::<Result<_, Error>>()?;
        let pairs = experiments.par_iter().zip(&identities).with_max_len(1);
        let saved = pairs.map(|(one, identity)| {
            let read = || one.found(identity, session).map_err(|error| error.to_string());
            let saved = || one.saved(identity, &session.store);
            made(*one, || if one.is_saved() { saved() } else { read() })
        });
        let saved: Vec<_> = saved.collect();
        let (mut stale, mut missing) = (0, Vec::new());
        for ((experiment, identity), _) in
            experiments.iter().zip(&identities).zip(&saved).filter(|(_, saved)| saved.is_err())
        {
            let units = experiment.units(session.profile);
            let units = experiment.missing(units, identity, &session.store);
            stale += usize::from(!units.is_empty());
            missing.extend(units);
        }
        session.announce(&count(stale, "experiment"), &missing)?;
        let (mut found, mut all) = (Vec::new(), Vec::new());
        for ((experiment, identity), saved) in experiments.iter().zip(&identities).zip(saved) {
            if experiment.is_saved() {
                let why = saved.as_ref().err().map_or("fresh", String::as_str);
                session.progress.say(&format!("{}: {why}", experiment.name()));
            }
            let run = |_| made(*experiment, || experiment.found(identity, session));
            let (result, tables) = saved.or_else(run)?;
            found.push((*experiment, result));
            all.extend(tables);
        }
        session.progress.check()?;
        let (profile, derived) = (session.profile, derived.to_vec());
        let (tables, read) = (OnceLock::new(), Mutex::default());
        let results = Results { profile, found, derived, tables, read };
        let tables = OnceLock::from(results.joined(all));
        Ok(Results { tables, ..results })
    }
}

fn tables(one: &dyn AnyExperiment, found: &Found) -> Vec<Table> {
    one.tables(found).into_iter().map(|table| table.made_by(&[one.name()])).collect()
}

/// Gets the result of an experiment, and makes its tables; a panic says which experiment it was.
fn made<E>(
    experiment: &'static dyn AnyExperiment,
    get: impl FnOnce() -> Result<Found, E>,
) -> Result<(Found, Vec<Table>), E> {
    let work = || get().map(|found| (found.clone(), tables(experiment, &found)));
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        let words = format!("the internal error was in the experiment {}", experiment.name());
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

//! Runs experiments, and holds their results and the tables that follow from them.

use super::progress::say;
use super::store::{Identity, Json};
use super::{AnyExperiment, AnyResult, Command, Error, Experiment, Fault, Profile, Session};
use crate::input::count;
use crate::names::{self, Names};
use crate::table::{Missing, NO_NUMBER, Table, Tables, no_such, table_name};
use crate::value::Value;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Makes tables of several experiments, or returns `None` if one of these was not run.
pub type DerivedTables = fn(&Results, &[Table]) -> Option<Vec<Table>>;

/// The results of experiments, and the tables that are made of them.
pub struct Results {
    pub(crate) profile: Profile,
    results: Vec<(&'static dyn AnyExperiment, AnyResult)>,
    /// The tables that need several of them.
    derived: Vec<DerivedTables>,
    /// Or why they are refused.
    tables: OnceLock<Result<Tables, String>>,
    /// The names of the tables, and of the experiments, that were asked for.
    read: Mutex<BTreeSet<String>>,
}

impl Results {
    /// Returns the result of an experiment; it is an error if that was not run.
    pub fn of<P, T: Json, U>(&self, experiment: &Experiment<P, T, U>) -> Result<&T, Error> {
        self.note(experiment.name);
        self.result(experiment.name)?.downcast_ref().ok_or(Error(Fault::NotRun(experiment.name)))
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
        let Results { profile, results, derived, tables, .. } = self;
        let (results, derived, tables) = (results.clone(), derived.clone(), tables.clone());
        Results { profile: *profile, results, derived, tables, read: Mutex::default() }
    }

    pub(crate) fn with_table(&self, table: Table) -> Results {
        let mut copy = self.copy();
        if let Some(Ok(tables)) = copy.tables.get_mut() {
            tables.insert(table.name(), Arc::new(table));
        }
        copy
    }

    /// Returns the result of an experiment as JSON, or `None` if it was not run.
    pub(crate) fn json(&self, name: &str) -> Option<serde_json::Value> {
        let (experiment, result) = self.results.iter().find(|(one, _)| one.name() == name)?;
        experiment.to_json(result)
    }

    /// Returns the results with another one of an experiment, or `None` if it cannot be one.
    pub(crate) fn with_json(&self, name: &str, result: serde_json::Value) -> Option<Results> {
        let mut copy = self.copy();
        let (experiment, replaced) = copy.results.iter_mut().find(|(one, _)| one.name() == name)?;
        *replaced = experiment.read_json(result)?;
        Some(copy)
    }

    fn result(&self, name: &'static str) -> Result<&AnyResult, Error> {
        let mut results = self.results.iter();
        let pair = results.find(|(experiment, _)| experiment.name() == name);
        pair.map(|(_, result)| result).ok_or(Error(Fault::NotRun(name)))
    }

    /// Returns the result of an experiment for a test to change; tables are made anew.
    pub fn get_mut<P, T: Json, U>(&mut self, experiment: &Experiment<P, T, U>) -> Option<&mut T> {
        self.tables = OnceLock::new();
        let (_, result) = self.results.iter_mut().find(|(one, _)| one.name() == experiment.name)?;
        Arc::get_mut(result)?.downcast_mut()
    }

    /// Returns the tables of all results, by name. Fails if two have one name or one has a fault.
    pub(crate) fn tables(&self) -> Result<&Tables, Error> {
        let again = || {
            let results = self.results.iter();
            self.joined(results.flat_map(|(one, result)| tables(*one, result)).collect())
        };
        self.tables.get_or_init(again).as_ref().map_err(|fault| Error(Fault::Table(fault.clone())))
    }

    #[cfg(test)]
    pub(crate) fn made_up(tables: Vec<Table>) -> Self {
        let tables = tables.into_iter().map(|table| (table.name(), Arc::new(table))).collect();
        let (results, derived) = Default::default();
        let (tables, read) = (OnceLock::from(Ok(tables)), Mutex::default());
        Results { profile: Profile::Full, results, derived, tables, read }
    }

    /// Returns these tables and those that need several experiments, by name.
    fn joined(&self, mut made: Vec<Table>) -> Result<Tables, String> {
        let experiments: Vec<&str> = self.results.iter().map(|(one, _)| one.name()).collect();
        for tables in &self.derived {
            let derived = tables(self, &made).into_iter().flatten();
            made.extend(derived.map(|table| table.made_by(&experiments)).collect::<Vec<_>>());
        }
        let (mut tables, mut names) = (Tables::new(), Names::default());
        for table in made {
            if let Some(fault) = &table.fault {
                return Err(fault.into());
            }
            let (name, place) = (table.name(), table.place());
            let columns = table.names().find_map(names::fault);
            if let Some(fault) = names::fault(name).or(columns) {
                return Err(format!("{place}: the table {name}: {fault}"));
            }
            names.add(name, &place).map_err(|problem| format!("tables: {problem}"))?;
            tables.insert(name, Arc::new(table));
        }
        Ok(tables)
    }

    /// Returns a table by its name, `experiment.table`; it is an error if there is none.
    #[track_caller]
    pub fn table(&self, name: &str) -> Result<&Table, Error> {
        self.note(name);
        let tables = self.tables()?;
        let Some(table) = tables.get(name) else {
            let mut missing = Missing::new(name, no_such("table", name, tables.keys().copied()));
            missing.remedy = "add its experiment to `needs`";
            return Err(missing.into());
        };
        Ok(table)
    }

    /// Returns the bytes of a file in the `writes` of a command; it is an error if there is none.
    pub fn file(&self, command: &Command, path: &str) -> Result<Vec<u8>, Error> {
        let output = self.result(command.name)?;
        let problem = format!("{} wrote no such file", command.name);
        let missing = Error::input(path, problem, "add it to its `writes`");
        command.file(output, path).ok_or(missing)
    }

    #[track_caller]
    pub(crate) fn cell(&self, address: &str) -> Result<&Value, Error> {
        let table = self.table(table_name(address).unwrap_or(address))?;
        match table.cell(address) {
            Some(cell) => Ok(cell),
            None => Err(Missing::new(address, table.describe_missing(address)).into()),
        }
    }

    /// Returns the number with this address.
    #[track_caller]
    pub fn number(&self, address: &str) -> Result<f64, Error> {
        match self.cell(address)?.as_f64() {
            Some(number) => Ok(number),
            None => Err(Missing::new(address, NO_NUMBER).into()),
        }
    }

    /// Returns the results of experiments in this order, saved ones where they are fresh.
    pub(crate) fn run(
        experiments: &[&'static dyn AnyExperiment],
        derived: &[DerivedTables],
        session: &Session<'_>,
    ) -> Result<Self, Error> {
        let identities = experiments.par_iter().with_max_len(1).map(|one| one.identity(session));
        let identities: Vec<Identity> = identities.collect::<Result<_, Error>>()?;
        let identified = experiments.par_iter().zip(&identities).with_max_len(1);
        let saved = identified.map(|(experiment, identity)| {
            made(*experiment, || experiment.load_saved(identity, session))
        });
        let saved: Vec<_> = saved.collect();
        let (mut stale, mut units_to_run) = (0, Vec::new());
        for ((experiment, identity), _) in
            experiments.iter().zip(&identities).zip(&saved).filter(|(_, saved)| saved.is_err())
        {
            let units = experiment.units(session.profile);
            let units = experiment.units_to_run(units, identity, &session.store);
            stale += usize::from(!units.is_empty());
            units_to_run.extend(units);
        }
        session.announce(&count(stale, "experiment"), &units_to_run)?;
        let (mut finished, mut tables_made) = (Vec::new(), Vec::new());
        for ((experiment, identity), saved) in experiments.iter().zip(&identities).zip(saved) {
            if experiment.is_saved() {
                let state = saved.as_ref().err().map_or("fresh", String::as_str);
                session.progress.say(&format!("{}: {state}", experiment.name()));
            }
            let run = |_| made(*experiment, || experiment.read_or_run(identity, session));
            let (result, tables) = saved.or_else(run)?;
            finished.push((*experiment, result));
            tables_made.extend(tables);
        }
        session.progress.check()?;
        let (profile, derived) = (session.profile, derived.to_vec());
        let (tables, read) = (OnceLock::new(), Mutex::default());
        let results = Results { profile, results: finished, derived, tables, read };
        let tables = OnceLock::from(results.joined(tables_made));
        Ok(Results { tables, ..results })
    }
}

fn tables(experiment: &dyn AnyExperiment, result: &AnyResult) -> Vec<Table> {
    let tables = experiment.tables(result).into_iter();
    tables.map(|table| table.made_by(&[experiment.name()])).collect()
}

/// Gets the result of an experiment, and makes its tables; a panic says which experiment it was.
fn made<E>(
    experiment: &'static dyn AnyExperiment,
    get: impl FnOnce() -> Result<AnyResult, E>,
) -> Result<(AnyResult, Vec<Table>), E> {
    let work = || get().map(|result| (result.clone(), tables(experiment, &result)));
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
    fn an_address_without_a_cell_is_an_error_with_the_nearest_names() {
        let rise = Table::builder("test.rise", &[0.1], |_| 1).key("sigma", "1", |row| *row);
        let results = Results::made_up(vec![rise.count("mean", "", |_| 2).done()]);
        let message = |address| results.cell(address).unwrap_err().to_string();
        let column = message("test.rise[sigma=0.1].meen");
        assert!(column.contains("no column meen; nearest: mean"), "{column}");
        let table = message("test.ris.mean");
        assert!(table.contains("nearest: test.rise; add its experiment"), "{table}");
        assert!(table.contains("src/experiments/results.rs:"), "{table}");
    }

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

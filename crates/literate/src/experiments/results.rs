//! All results together.

use super::experiment::Json;
use super::{Error, Experiment, Found, Need, Profile, Session};
use crate::table::{Table, Tables, number_at};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

/// Makes tables of the results and tables of several experiments; none if one of these was not run.
pub type Together = fn(&Results, &[Table]) -> Option<Vec<Table>>;

/// The results of the experiments that were asked for.
#[derive(Debug)]
pub struct Results {
    /// The sample sizes.
    pub profile: Profile,
    /// The experiments, and the tables that need several of them.
    made_by: (Vec<Need>, Vec<Together>),
    /// Of each experiment that was run, by its name.
    found: BTreeMap<&'static str, Found>,
    tables: OnceLock<Tables>,
}

impl Results {
    /// The result of an experiment.
    pub fn of<P, T: Json, U>(&self, experiment: &Experiment<P, T, U>) -> Result<&T, Error> {
        let found = self.found.get(experiment.name).and_then(|found| found.downcast_ref());
        found.ok_or(Error::NotRun(experiment.name))
    }

    /// The result of an experiment, to be changed where nobody else holds it; its tables are made anew.
    pub fn of_mut<P, T: Json, U>(&mut self, experiment: &Experiment<P, T, U>) -> Option<&mut T> {
        self.tables = OnceLock::new();
        Arc::get_mut(self.found.get_mut(experiment.name)?)?.downcast_mut()
    }

    /// The tables of the theory and of all results that there are, by name.
    pub fn tables(&self) -> &Tables {
        // Made before the lock is taken: a thread that waits in it for others may begin something else that looks here.
        match self.tables.get() {
            Some(tables) => tables,
            None => {
                let made = self.made();
                self.tables.get_or_init(|| made)
            }
        }
    }

    #[cfg(test)]
    pub(crate) fn made_up(tables: Vec<Table>) -> Self {
        let tables: Tables =
            tables.into_iter().map(|table| (table.name(), Arc::new(table))).collect();
        let (made_by, found) = (Default::default(), BTreeMap::new());
        Results { profile: Profile::Full, made_by, found, tables: OnceLock::from(tables) }
    }

    fn made(&self) -> Tables {
        let (experiments, together) = &self.made_by;
        let of = |experiment: &Need| {
            self.found
                .get(experiment.name())
                .map_or_else(Vec::new, |found| experiment.tables(found))
        };
        let mut all = experiments.par_iter().with_max_len(1).map(of).collect::<Vec<_>>().concat();
        for tables in together {
            all.extend(tables(self, &all).into_iter().flatten());
        }
        all.into_iter().map(|table| (table.name(), Arc::new(table))).collect()
    }

    /// One of the tables.
    pub fn table(&self, name: &'static str) -> Result<&Table, Error> {
        let experiment = name.split('.').next().unwrap_or(name);
        self.tables().get(name).map(Arc::as_ref).ok_or(Error::NotRun(experiment))
    }

    /// The number with this address: `theory.jump.p_jump`.
    #[track_caller]
    pub fn number(&self, address: &str) -> Result<f64, Error> {
        Ok(number_at(self.tables(), address)?)
    }

    /// The results of the experiments that are needed, in the order of the paper: saved ones where they are fresh, else those
    /// of runs.
    ///
    /// # Errors
    /// Of the first run that fails or is interrupted.
    pub fn run(needs: &[Need], session: &Session<'_>) -> Result<Self, Error> {
        let (experiments, together) = (&session.paper.experiments, &session.paper.together);
        let needed = |one: &&Need| needs.iter().any(|need| need.name() == one.name());
        let mut found = BTreeMap::new();
        for experiment in experiments.iter().filter(needed) {
            found.insert(experiment.name(), experiment.found(session)?);
        }
        session.progress.check()?;
        let made_by = (experiments.clone(), together.clone());
        Ok(Results { profile: session.profile, made_by, found, tables: OnceLock::new() })
    }
}

//! All results together.

use super::{ALL, Error, Need, Progress, Store, TOGETHER, identities, theory};
use crate::params::Profile;
use literate::experiments::experiment::Given;
use literate::experiments::{Found, Typed};
use literate::table::{Table, Tables, number_at};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

/// The results of the experiments that were asked for.
#[derive(Debug)]
pub struct Results {
    /// The sample sizes.
    pub profile: Profile,
    /// Of each experiment that was run, by its name.
    found: BTreeMap<&'static str, Found>,
    /// Tables of the results, made when first looked at.
    tables: OnceLock<Tables>,
}

impl Results {
    /// The result of an experiment.
    pub fn of<E: Typed>(&self, experiment: &E) -> Result<&E::Result, Error> {
        let found = self.found.get(experiment.name()).and_then(|found| found.downcast_ref());
        found.ok_or(Error::NotRun(experiment.name()))
    }

    /// A result by the name of its experiment.
    pub fn found(&self, name: &str) -> Option<&Found> {
        self.found.get(name)
    }

    /// Puts the result of an experiment in place.
    pub fn put(&mut self, name: &'static str, found: Found) {
        self.tables = OnceLock::new();
        self.found.insert(name, found);
    }

    /// The result of an experiment, to be changed where nobody else holds it; its tables are made anew.
    pub fn of_mut<E: Typed>(&mut self, experiment: &E) -> Option<&mut E::Result> {
        self.tables = OnceLock::new();
        Arc::get_mut(self.found.get_mut(experiment.name())?)?.downcast_mut()
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

    fn made(&self) -> Tables {
        let of = |experiment: &Need| {
            self.found(experiment.name()).map_or_else(Vec::new, |own| experiment.tables(own))
        };
        let runs = || ALL.par_iter().with_max_len(1).map(of).collect::<Vec<_>>().concat();
        let exact = || rayon::join(theory::tables, identities::tables);
        let (mut all, (theory, identities)) = rayon::join(runs, exact);
        all.extend(theory.into_iter().chain(identities));
        for tables in TOGETHER {
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

    /// Results of which nothing was run yet.
    pub fn empty(profile: Profile) -> Self {
        Results { profile, found: BTreeMap::new(), tables: OnceLock::new() }
    }
}

/// Runs the experiments that are needed with the sample sizes of a profile. `given` gives the text of a
/// file of the templates; it is asked only by experiments that read one.
pub fn run(
    needs: &[Need],
    profile: Profile,
    given: Given<'_>,
    store: &Store,
    progress: &Progress,
) -> Result<Results, Error> {
    let mut results = Results::empty(profile);
    let needed = |one: &&Need| needs.iter().any(|need| need.name() == one.name());
    for experiment in ALL.iter().filter(needed) {
        results.put(experiment.name(), experiment.found(profile, given, store, progress)?);
    }
    progress.check()?;
    Ok(results)
}

#[cfg(test)]
mod tests {
    use super::super::SWEEP;
    use super::*;

    #[test]
    fn what_was_not_run_is_an_error() {
        let results = Results::empty(Profile::Quick);
        assert!(matches!(results.of(&SWEEP), Err(Error::NotRun("sweep"))));
        assert!(matches!(results.table("sweep.rows"), Err(Error::NotRun("sweep"))));
        let missing = results.number("theory.jump.no").unwrap_err().to_string();
        assert!(missing.contains("theory.jump.no") && missing.contains("results.rs"), "{missing}");
        assert!(results.number("sweep.rise.half_height").is_err());
    }
}

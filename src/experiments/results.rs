//! All results together.

use super::{ALL, Error, Need, TOGETHER, identities, theory};
use crate::params::{Profile, VERTICES};
use literate::experiments::{Found, Typed};
use literate::table::Table;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock, OnceLock};

/// What is computed when it is first looked at.
pub type Looked<T> = LazyLock<T, Box<dyn FnOnce() -> T + Send>>;

/// The results of the experiments that were asked for.
#[derive(Debug)]
pub struct Results {
    /// The sample sizes.
    pub profile: Profile,
    /// Secs. 3 to 9, computed when first looked at: `&results.theory.curve` is all it takes.
    pub theory: Looked<theory::Theory>,
    /// Exact statements of Secs. 3 to 9 against a second route, computed when first looked at.
    pub identities: Looked<identities::Identities>,
    /// Of each experiment that was run, by its name.
    found: BTreeMap<&'static str, Found>,
    /// Tables of the results, made when first looked at.
    tables: OnceLock<BTreeMap<&'static str, Arc<Table>>>,
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

    /// Computes what is otherwise computed when first looked at. Who works on several threads looks
    /// first.
    pub fn look(&self) {
        rayon::join(|| LazyLock::force(&self.theory), || LazyLock::force(&self.identities));
        // After them: some tables look at both.
        self.tables();
    }

    /// The tables of all results that there are, by name.
    pub fn tables(&self) -> &BTreeMap<&'static str, Arc<Table>> {
        // Made before the lock is taken: a thread that waits in it for others may begin something else that looks here.
        match self.tables.get() {
            Some(tables) => tables,
            None => {
                let made = self.made();
                self.tables.get_or_init(|| made)
            }
        }
    }

    fn made(&self) -> BTreeMap<&'static str, Arc<Table>> {
        let of = |experiment: &Need| {
            self.found(experiment.name()).map_or_else(Vec::new, |own| experiment.tables(own))
        };
        let own: Vec<Vec<Table>> = ALL.par_iter().with_max_len(1).map(of).collect();
        let mut all: Vec<Table> = own.into_iter().flatten().collect();
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

    /// Results of which nothing was run yet.
    pub fn empty(profile: Profile) -> Self {
        Results {
            profile,
            theory: LazyLock::new(Box::new(|| {
                theory::run(VERTICES).expect("the theory exists for the paper's N")
            })),
            identities: LazyLock::new(Box::new(|| {
                identities::run(VERTICES).expect("the theory exists for the paper's N")
            })),
            found: BTreeMap::new(),
            tables: OnceLock::new(),
        }
    }
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
    }
}

//! Experiments: parameters, units of work, runs, tables; results that save and reload exactly, and are used again
//! as long as what they are made of is the same.

mod announce;
mod command;
pub mod cutting;
pub mod experiment;
pub mod progress;
mod results;
mod store;

pub use command::Command;
pub use experiment::{AnyExperiment, Experiment, Found};
pub use progress::{Progress, alive, be_quiet, say};
pub use results::{DerivedTables, Results};
pub use store::Store;

use crate::input::remedy;
use crate::project::Project;
use crate::prose::Templates;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// How much is sampled: small to try out, large for the committed report.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, clap::ValueEnum,
)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    /// To try out: small samples.
    Quick,
    /// The committed report.
    Full,
}

impl Profile {
    /// Its name on the command line, in reports and in names of files.
    pub fn name(self) -> &'static str {
        match self {
            Profile::Quick => "quick",
            Profile::Full => "full",
        }
    }
}

impl std::str::FromStr for Profile {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let mut all = [Profile::Quick, Profile::Full].into_iter();
        all.find(|profile| profile.name() == name)
            .ok_or_else(|| format!("no profile {name:?}; give quick or full"))
    }
}

/// An error of an experiment.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("interrupted; nothing was left half-written")]
    Interrupted,
    #[error("{field}: {problem}; {remedy}")]
    Input { field: String, problem: String, remedy: String },
    #[error(transparent)]
    Missing(#[from] crate::table::Missing),
    #[error("{experiment}: {source}")]
    Failed { experiment: &'static str, source: Box<dyn std::error::Error + Send + Sync> },
    #[error("the results of {0} were not run; declare them among what is needed")]
    NotRun(&'static str),
    #[error(
        "{experiment}: a result is not finite, so it was not saved; this is a fault of the program"
    )]
    NotFinite { experiment: String },
    #[error("--results: {path}: {source}; {}", remedy(source, "choose another folder"))]
    Store { path: PathBuf, source: std::io::Error },
}

impl Error {
    /// An [`Error::Failed`] of an experiment.
    pub fn failed(
        experiment: &'static str,
        source: impl std::error::Error + Send + Sync + 'static,
    ) -> Self {
        Error::Failed { experiment, source: Box::new(source) }
    }

    /// An [`Error::Input`] from its three parts.
    pub fn input(
        field: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Error::Input { field: field.into(), problem: problem.into(), remedy: remedy.into() }
    }
}

/// A run: of which project, with which samples and prose, and where results are kept.
#[derive(Debug)]
pub struct Session<'a> {
    pub project: &'a Project,
    pub templates: Templates,
    pub profile: Profile,
    pub store: Store,
    pub progress: Progress,
}

impl Session<'_> {
    /// The saved result if it is fresh, else that of a run, which is then saved.
    fn saved<T: experiment::Json>(
        &self,
        identity: &store::Identity,
        run: impl FnOnce() -> Result<T, Error>,
    ) -> Result<T, Error> {
        let say = |why| self.progress.say(&format!("{}: {why}", identity.experiment));
        let why = match self.store.look(identity) {
            Ok(found) => {
                say("fresh");
                return Ok(found);
            }
            Err(why) => why,
        };
        self.store.prepare()?;
        say(&why);
        let result = run()?;
        self.store.put(identity, &result)?;
        self.store.remove_units(identity);
        Ok(result)
    }
}

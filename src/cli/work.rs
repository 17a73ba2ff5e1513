//! What the verbs that take time have in common: experiments by name, threads, Ctrl-C, and errors as exit codes.

use super::Failure;
use impact_paper::experiments::shards::Plan;
use impact_paper::experiments::{Error, Progress, catalogue, deep};
use impact_paper::params::Profile;
use impact_paper::report::{self, contents};
use impact_paper::{claims, figures};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Sample sizes, as named on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum ProfileName {
    /// To try out: seconds.
    Quick,
    /// For pull requests: half a minute.
    Ci,
    /// The committed report: minutes.
    Full,
}

/// Sample sizes, and what takes longer than any report may.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum AnyProfile {
    /// To try out: seconds.
    Quick,
    /// For pull requests: half a minute.
    Ci,
    /// The committed report: minutes.
    Full,
    /// What is run now and then, committed, and carried over: half an hour.
    Deep,
}

/// Which experiments of a profile are meant.
#[derive(clap::Args)]
pub struct Only {
    /// Only these experiments, by the names that `status` shows, with commas between them. Shards are those of
    /// the units of these: `plan`, `run` and `merge` must name the same.
    #[arg(long = "experiment", value_name = "NAME", value_delimiter = ',')]
    names: Vec<String>,
}

impl Only {
    /// The units of work of these experiments, or of all if none is named.
    pub fn plan(&self, profile: Profile) -> Result<Plan, Failure> {
        let known: Vec<&str> = catalogue::of(profile).iter().map(|one| one.need().name()).collect();
        if let Some(name) = self.names.iter().find(|name| !known.contains(&name.as_str())) {
            let (profile, known) = (profile.name(), known.join(", "));
            return Err(Failure::input(format!(
                "--experiment: profile {profile} has no experiment \"{name}\"; give some of {known}"
            )));
        }
        let plan = Plan::new(profile);
        Ok(if self.names.is_empty() { plan } else { plan.only(&self.names) })
    }
}

/// Where results of a profile are kept unless a folder is given: beside the source what is committed,
/// under target what is not.
pub fn results(given: Option<PathBuf>, profile: Profile) -> PathBuf {
    given.unwrap_or_else(|| match profile {
        Profile::Deep => "benches/deep".into(),
        _ => "target/results".into(),
    })
}

/// How stale results of a profile are made fresh.
pub fn remedy(profile: Profile) -> String {
    match profile {
        Profile::Deep => deep::REMEDY.into(),
        _ => format!("`impact-paper paper --profile {}` runs them", profile.name()),
    }
}

impl From<AnyProfile> for Profile {
    fn from(name: AnyProfile) -> Self {
        match name {
            AnyProfile::Quick => Profile::Quick,
            AnyProfile::Ci => Profile::Ci,
            AnyProfile::Full => Profile::Full,
            AnyProfile::Deep => Profile::Deep,
        }
    }
}

impl From<ProfileName> for Profile {
    fn from(name: ProfileName) -> Self {
        match name {
            ProfileName::Quick => Profile::Quick,
            ProfileName::Ci => Profile::Ci,
            ProfileName::Full => Profile::Full,
        }
    }
}

/// What a shell calls a program that Ctrl-C ended: 128 + SIGINT.
const INTERRUPTED: u8 = 130;

/// Progress on stderr. Ctrl-C (or SIGTERM) raises a flag that all work looks at, so that it ends
/// within a moment at a place where nothing is half-written.
pub fn progress() -> Progress {
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    // A handler can only be refused if there is one already; then Ctrl-C just ends the program.
    let _ = ctrlc::set_handler(move || raised.store(true, Ordering::Relaxed));
    Progress::on_stderr(stop)
}

/// Runs `work` on that many threads; none means all cores.
pub fn on_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    if threads == Some(0) {
        return Err(Failure::input("--threads: 0 threads do no work; give 1 or more"));
    }
    let builder = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0));
    let pool = builder.build().map_err(|error| {
        Failure::input(format!("--threads: {error}; give a smaller number of threads"))
    })?;
    pool.install(work)
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = match &error {
            Error::Interrupted => INTERRUPTED,
            Error::Store { source, .. } => Failure::io(source, "").code,
            Error::Input { .. } | Error::Scenario { .. } | Error::Measured(_) => 2,
            Error::Dynamics { source: impact_paper::dynamics::Error::Input { .. }, .. } => 2,
            Error::Stale { .. } | Error::Units { .. } | Error::NotUnderstood { .. } => 3,
            _ => 4,
        };
        Failure { code, message: error.to_string() }
    }
}

impl From<claims::Error> for Failure {
    fn from(error: claims::Error) -> Self {
        match error {
            claims::Error::Published(error) => Failure::input(error.to_string()),
            claims::Error::Experiment(error) => error.into(),
        }
    }
}

impl From<contents::Error> for Failure {
    fn from(error: contents::Error) -> Self {
        match error {
            contents::Error::Claims(error) => error.into(),
            contents::Error::Experiment(error) => error.into(),
            contents::Error::Report(error) => error.into(),
            contents::Error::Rows(_) | contents::Error::Missing(_) => {
                Failure::run(error.to_string())
            }
        }
    }
}

impl From<figures::Error> for Failure {
    fn from(error: figures::Error) -> Self {
        match error {
            figures::Error::Experiment(error) => error.into(),
            other => Failure::run(other.to_string()),
        }
    }
}

impl From<report::Error> for Failure {
    fn from(error: report::Error) -> Self {
        use report::Error::{Lint, NotShown, Unused};
        match error {
            // What can be read, and breaks a rule of the prose.
            Lint(_) | NotShown(_) | Unused(_) => Failure::check(error.to_string()),
            _ => Failure::input(error.to_string()),
        }
    }
}

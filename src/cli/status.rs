//! `impact-paper status`.

use super::{Failure, stdout, work};
use impact_paper::experiments::Store;
use impact_paper::experiments::{self, Entry};
use impact_paper::params::Profile;
use literate::experiments::identity::{Reason, told};
use std::path::PathBuf;

/// Says which saved results are fresh, and which would be run again and why.
///
/// Runs nothing. A result is fresh if it was saved whole, with the same parameters, by the same code, and with the
/// same versions of all crates. Ends with exit code 3 if any is not.
///
/// What the deep profile gave is committed, and carried over changes of code and crates: the full profile
/// runs a sample of it again (smaller ones that of the longest transients alone), and only if that fails
/// is it stale.
#[derive(clap::Args)]
pub struct Args {
    /// Sample sizes.
    #[arg(long, default_value = "full", value_parser = work::of_all())]
    profile: Profile,
    /// Folder in which results of long runs are kept; without it target/results, and benches/deep for
    /// the deep profile.
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
    /// As JSON: one boolean for each reason, and the files that changed.
    #[arg(long)]
    json: bool,
}

pub fn run(args: Args) -> Result<(), Failure> {
    let profile = args.profile;
    let store = Store::open(&work::results(args.results.clone(), profile))?;
    let found: Vec<Found> =
        experiments::of(profile).iter().map(|one| Found::look(*one, profile, &store)).collect();
    let stale = found.iter().filter(|one| one.is_stale()).count();
    let text = if args.json {
        let lines: Vec<_> = found.iter().map(Found::json).collect();
        let json = serde_json::json!({
            "profile": profile.name(), "fresh": stale == 0, "experiments": lines,
        });
        format!("{json:#}\n")
    } else {
        let line = |one: &Found| format!("{:13} {}\n", one.experiment.name(), one.told());
        found.iter().map(line).collect()
    };
    stdout::print(&text)?;
    if stale == 0 {
        return Ok(());
    }
    let remedy = work::remedy(profile, args.results.as_deref());
    let are = if stale == 1 { "is" } else { "are" };
    Err(Failure::stale(format!("{stale} of {} results {are} stale; {remedy}", found.len())))
}

/// What was found of one experiment.
struct Found {
    experiment: &'static dyn Entry,
    /// Why its result is not what this program would save.
    reasons: Vec<Reason>,
    /// Whether it is used all the same.
    carried: bool,
}

impl Found {
    fn look(experiment: &'static dyn Entry, profile: Profile, store: &Store) -> Found {
        let reasons = experiment.at(profile).stale(store);
        let carried = profile == Profile::Deep
            && !reasons.is_empty()
            && reasons.iter().all(Reason::is_of_source);
        Found { experiment, reasons, carried }
    }

    fn is_stale(&self) -> bool {
        !self.reasons.is_empty() && !self.carried
    }

    /// One truth for each reason.
    fn json(&self) -> serde_json::Value {
        let has = |test: fn(&Reason) -> bool| self.reasons.iter().any(test);
        let changed = |reason: &Reason| match reason {
            Reason::Code(files) => files.clone(),
            _ => Vec::new(),
        };
        serde_json::json!({
            "experiment": self.experiment.name(),
            "fresh": self.reasons.is_empty(),
            "carried": self.carried,
            "failed": has(|reason| *reason == Reason::Failed),
            "missing": has(|reason| *reason == Reason::Missing),
            "parameters": has(|reason| matches!(reason, Reason::Parameters | Reason::Unit)),
            "code": has(|reason| matches!(reason, Reason::Code(_))),
            "dependency": has(|reason| *reason == Reason::Dependency),
            "schema": has(|reason| *reason == Reason::Schema),
            "damaged": has(|reason| matches!(reason, Reason::Damaged(_))),
            "changed": self.reasons.iter().flat_map(changed).collect::<Vec<String>>(),
        })
    }

    fn told(&self) -> String {
        match self.reasons.as_slice() {
            [] => "fresh".into(),
            reasons if self.carried => {
                format!("carried over ({}); other profiles audit it", told(reasons))
            }
            reasons => told(reasons),
        }
    }
}

//! `impact-paper status`.

use super::{Failure, stdout, work};
use impact_paper::experiments::Store;
use impact_paper::experiments::catalogue::{ALL, Saved};
use impact_paper::experiments::store::{Reason, told};
use impact_paper::params::Profile;
use serde::Serialize;
use std::path::PathBuf;

/// Says which saved results are fresh, and which `paper` would run again and why. Runs nothing.
///
/// A result is fresh if it was saved whole, with the same parameters, by the same code, and with the
/// same versions of all crates. Ends with exit code 3 if any is not.
#[derive(clap::Args)]
pub struct Args {
    /// Sample sizes.
    #[arg(long, default_value = "full")]
    profile: work::ProfileName,
    /// Folder in which results of long runs are kept.
    #[arg(long, value_name = "DIR", default_value = "target/results")]
    results: PathBuf,
    /// As JSON: one boolean for each reason, and the files that changed.
    #[arg(long)]
    json: bool,
}

/// What is said of one result.
#[derive(Serialize)]
struct Line {
    experiment: &'static str,
    fresh: bool,
    missing: bool,
    parameters: bool,
    code: bool,
    dependency: bool,
    schema: bool,
    damaged: bool,
    /// Files of the source that are others than when it was saved.
    changed: Vec<String>,
}

impl Line {
    fn of(experiment: &dyn Saved, reasons: &[Reason]) -> Line {
        let has = |test: fn(&Reason) -> bool| reasons.iter().any(test);
        let changed = |reason: &Reason| match reason {
            Reason::Code(files) => files.clone(),
            _ => Vec::new(),
        };
        Line {
            experiment: experiment.need().name(),
            fresh: reasons.is_empty(),
            missing: has(|reason| *reason == Reason::Missing),
            parameters: has(|reason| matches!(reason, Reason::Parameters | Reason::Unit)),
            code: has(|reason| matches!(reason, Reason::Code(_))),
            dependency: has(|reason| *reason == Reason::Dependency),
            schema: has(|reason| *reason == Reason::Schema),
            damaged: has(|reason| matches!(reason, Reason::Damaged(_))),
            changed: reasons.iter().flat_map(changed).collect(),
        }
    }
}

/// Runs the verb.
pub fn run(args: Args) -> Result<(), Failure> {
    let profile = Profile::from(args.profile);
    let store = Store::open(&args.results)?;
    let found: Vec<(&dyn Saved, Vec<Reason>)> =
        ALL.iter().map(|experiment| (*experiment, experiment.stale(profile, &store))).collect();
    let text = if args.json {
        let lines: Vec<Line> =
            found.iter().map(|(experiment, reasons)| Line::of(*experiment, reasons)).collect();
        let all = lines.iter().all(|line| line.fresh);
        let json = serde_json::json!({
            "profile": profile.name(), "fresh": all, "experiments": lines,
        });
        format!("{json:#}\n")
    } else {
        let line = |(experiment, reasons): &(&dyn Saved, Vec<Reason>)| {
            let state = if reasons.is_empty() { "fresh".into() } else { told(reasons) };
            format!("{:12} {state}\n", experiment.need().name())
        };
        found.iter().map(line).collect()
    };
    stdout::print(&text)?;
    let stale = found.iter().filter(|(_, reasons)| !reasons.is_empty()).count();
    if stale == 0 {
        return Ok(());
    }
    let (name, all) = (profile.name(), found.len());
    Err(Failure::stale(format!(
        "{stale} of {all} results are stale; `impact-paper paper --profile {name}` runs them"
    )))
}

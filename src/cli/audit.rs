//! `impact-paper audit`.

use super::{Failure, number, signals, stdout, threads, work};
use impact_numerics::random::generator;
use impact_paper::experiments::{self, Error, Store};
use impact_paper::params::Profile;
use rand::seq::SliceRandom;
use std::path::PathBuf;

/// Runs a sample of the saved results again, and compares them byte by byte.
///
/// Nothing is saved. Ends with exit code 1 if a result differs, and with 3 if there is nothing fresh
/// to compare with.
#[derive(clap::Args)]
pub struct Args {
    /// Sample sizes.
    #[arg(long, default_value = "full", value_parser = work::of_all())]
    profile: Profile,
    /// Share of the experiments to run again; at least one is.
    #[arg(long, value_name = "SHARE", default_value = "10%", value_parser = share, allow_hyphen_values = true)]
    sample: Share,
    /// Seed of the choice.
    #[arg(long, value_name = "K", default_value_t = 0, allow_hyphen_values = true)]
    seed: u64,
    /// Folder in which results of long runs are kept; without it target/results, and benches/deep for
    /// the deep profile.
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
    /// Number of threads; all cores without it. It changes no bit of the result.
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = threads::read)]
    threads: Option<usize>,
}

/// A share of all, above 0 and at most 1.
#[derive(Clone, Copy)]
struct Share(f64);

/// "10%" or "0.1".
fn share(text: &str) -> Result<Share, String> {
    let (number, unit) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 100.0),
        None => (text, 1.0),
    };
    match number::parse(number) {
        Ok(number) if number > 0.0 && number <= unit => Ok(Share(number / unit)),
        _ => Err("a share is a number above 0 and at most 1, or a percentage like 10%".into()),
    }
}

pub fn run(args: Args) -> Result<(), Failure> {
    let profile = args.profile;
    let store = Store::open(&work::results(args.results.clone(), profile))?;
    let mut chosen = experiments::of(profile);
    chosen.shuffle(&mut generator("audit", args.seed, 0));
    chosen.truncate((args.sample.0 * chosen.len() as f64).ceil() as usize);
    let progress = signals::progress();
    let differ = threads::run(args.threads, || {
        let mut differ = Vec::new();
        for experiment in chosen {
            let name = experiment.name();
            let same =
                experiment.at(profile).audit(&store, &progress).map_err(|error| match error {
                    Error::Stale { .. } => Failure::stale(format!(
                        "{error}; {}",
                        work::remedy(profile, args.results.as_deref())
                    )),
                    other => other.into(),
                })?;
            stdout::print(&format!("{name}: {}\n", if same { "identical" } else { "differs" }))?;
            if !same {
                differ.push(name);
            }
        }
        Ok(differ)
    })?;
    if differ.is_empty() {
        return Ok(());
    }
    let remedy = "delete them from the results folder, and find out what changed them";
    let message =
        format!("saved results that a run does not give: {}; {remedy}", differ.join(", "));
    Err(Failure::check(message))
}

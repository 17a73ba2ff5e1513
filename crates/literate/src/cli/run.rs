//! Runs the verb `run`: the experiments, or this machine's share of their units of work.

use super::common::RunOptions;
use super::terminal::{display_path, print};
use crate::experiments::{AnyExperiment, Error, Session};
use crate::failure::Failure;
use crate::input::count;
use crate::paper::Paper;

/// Run all experiments, or one shard of their units of work, and save what they give
///
/// Examples:
///   run --shard 1/3 --results DIR     on the first of three machines, 2/3 and 3/3 on the others,
///   paper --results DIR               then on one, which joins the units and runs what is missing
///
/// Start it again after Ctrl-C, a crash or a lost machine: each unit is saved as soon as it is
/// done, whole or not at all, and none is run twice. Shards may save in one folder, or in several
/// that are copied together.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// Run this share of the work, like 2/3: the second of three.
    #[arg(long, value_name = "i/N", value_parser = share, allow_hyphen_values = true)]
    shard: Option<(usize, usize)>,
    #[command(flatten)]
    options: RunOptions,
}

fn share(shard: &str) -> Result<(usize, usize), String> {
    let read = |number: &str| number.parse().ok().filter(|number| (1..=MOST).contains(number));
    match shard.split_once('/').map(|(i, n)| (read(i), read(n))) {
        Some((Some(i), Some(n))) if i <= n => Ok((i, n)),
        _ => Err(format!("a shard is i/N with 1 <= i <= N <= {MOST}, like 2/3")),
    }
}

pub(super) fn run(paper: &Paper, args: Args) -> Result<(), Failure> {
    let Args { shard, options } = args;
    let session = options.open(paper, None)?.session;
    let saved: Vec<&'static dyn AnyExperiment> =
        paper.experiments.iter().copied().filter(|one| one.is_saved()).collect();
    let outcome = options.threads.run(|| match shard {
        Some((i, of)) => {
            let [run, saved] = run_shard(&saved, (i, of), &session)?;
            Ok(format!("shard {i}/{of}: {} run, {saved} already saved", count(run, "unit")))
        }
        None => {
            paper.results(&saved, &session)?;
            Ok(format!("results of {}", count(saved.len(), "experiment")))
        }
    })?;
    print(&format!("{}: {outcome}\n", display_path(&options.results(paper))))
}

/// How many shards there can be at most; more would have nothing to do.
const MOST: usize = 100_000;

/// Runs each N-th unit that is not in the store. Returns the numbers of those run and those there.
fn run_shard(
    experiments: &[&'static dyn AnyExperiment],
    (shard, shards): (usize, usize),
    session: &Session<'_>,
) -> Result<[usize; 2], Error> {
    let mut turns = (1..=shards).cycle();
    let (mut shares, mut open) = (Vec::new(), Vec::new());
    for experiment in experiments {
        let mut units = experiment.units(session.profile);
        units.retain(|_| turns.next() == Some(shard));
        let identity = experiment.identity(session)?;
        open.extend(experiment.units_to_run(units.clone(), &identity, &session.store));
        shares.push((experiment, units, identity));
    }
    session.announce(&format!("shard {shard}/{shards}: {}", count(open.len(), "unit")), &open)?;
    let [mut run, mut total] = [0, 0];
    for (experiment, units, identity) in shares.iter().filter(|(_, units, _)| !units.is_empty()) {
        session.progress.check()?;
        total += units.len();
        if session.store.fresh(identity).is_err() {
            run += experiment.run_units(units, identity, session)?;
        }
    }
    Ok([run, total - run])
}

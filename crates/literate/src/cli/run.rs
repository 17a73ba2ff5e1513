//! The verb `run`.

use super::make::Sources;
use super::terminal::{print, shown};
use crate::experiments::shards::{self, MOST};
use crate::experiments::{Need, Results};
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
/// there, whole or not at all, and none is run twice. Shards may save in one folder, or in several
/// that are copied together.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// Run this share of the work, like 2/3: the second of three.
    #[arg(long, value_name = "i/N", value_parser = share, allow_hyphen_values = true)]
    shard: Option<(usize, usize)>,
    #[command(flatten)]
    sources: Sources,
}

/// "2/3".
fn share(text: &str) -> Result<(usize, usize), String> {
    let read = |text: &str| text.parse::<usize>().ok().filter(|number| (1..=MOST).contains(number));
    match text.split_once('/').map(|(i, n)| (read(i), read(n))) {
        Some((Some(i), Some(n))) if i <= n => Ok((i, n)),
        _ => Err(format!("a shard is i/N with 1 <= i <= N <= {MOST}, like 2/3")),
    }
}

pub(super) fn run(paper: &Paper, args: Args) -> Result<(), Failure> {
    let Args { shard, sources } = args;
    let session = sources.session(paper)?;
    let saved: Vec<Need> = paper.experiments.iter().copied().filter(|one| one.is_saved()).collect();
    let done = sources.threads.run(|| match shard {
        Some(shard) => {
            let [run, there] = shards::run(&saved, shard, &session)?;
            let (i, of) = shard;
            Ok(format!("shard {i}/{of}: {} run, {there} there before", count(run, "unit")))
        }
        None => {
            Results::run(&saved, &session)?;
            Ok(format!("results of {}", count(saved.len(), "experiment")))
        }
    })?;
    print(&format!("{}: {done}\n", shown(&sources.results)))
}

//! `impact-paper run`.

use super::{Failure, shown, signals, stdout, threads, work};
use impact_numerics::text::count;
use impact_paper::experiments::{self, Store};
use impact_paper::params::Profile;
use literate::experiments::shards::{self, MOST};
use std::path::PathBuf;

/// Runs all experiments, or one shard of their units of work, and saves what they give.
///
/// An ensemble is cut into units of about half a second, other experiments are one unit each. Each
/// unit is saved as soon as it is there, whole or not at all, and none is run twice: after Ctrl-C
/// (exit code 130), a crash or a lost machine the same command goes on where it was. Shards may save
/// in one folder, or in several that are copied together; `paper` joins the units that it finds
/// there, and runs what is missing.
///
/// On three machines:  impact-paper run --shard 1/3 --results DIR   (and 2/3, 3/3),
/// then on one:        impact-paper paper --results DIR
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub struct Args {
    /// Which share of how many, like 2/3: the second of three.
    #[arg(long, value_name = "i/N", value_parser = share, allow_hyphen_values = true)]
    shard: Option<(usize, usize)>,
    /// Sample sizes.
    #[arg(long, default_value = "full", value_parser = work::profiles())]
    profile: Profile,
    /// Folder in which results are kept; it is made when missing.
    #[arg(long, value_name = "DIR", default_value = "target/results")]
    results: PathBuf,
    /// Number of threads; all cores without it. It changes no bit of the result.
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = threads::read)]
    threads: Option<usize>,
}

/// "2/3".
fn share(text: &str) -> Result<(usize, usize), String> {
    let read = |text: &str| text.parse::<usize>().ok().filter(|number| (1..=MOST).contains(number));
    match text.split_once('/').map(|(i, n)| (read(i), read(n))) {
        Some((Some(i), Some(n))) if i <= n => Ok((i, n)),
        _ => Err(format!("a shard is i/N with 1 <= i <= N <= {MOST}, like 2/3")),
    }
}

pub fn run(args: Args) -> Result<(), Failure> {
    let Args { shard, profile, results, threads } = args;
    let store = Store::open(&results)?;
    let progress = signals::progress();
    let saved = experiments::saved();
    let told = threads::run(threads, || match shard {
        Some(shard) => {
            let [run, there] = shards::run(&saved, profile, shard, &store, &progress)?;
            let (i, of) = shard;
            Ok(format!("shard {i}/{of}: {} run, {there} there before", count(run, "unit")))
        }
        None => {
            let none = |file: &str| Err(format!("{file} is not read"));
            experiments::run(&saved, profile, &none, &store, &progress)?;
            Ok(format!("results of {}", count(saved.len(), "experiment")))
        }
    })?;
    stdout::print(&format!("{}: {told}\n", shown(&results)))
}

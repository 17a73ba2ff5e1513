//! `impact-paper merge`.

use super::folder::resolved;
use super::places::refuse_report;
use super::{Failure, shard, shown, signals, stdout, threads, work};
use impact_numerics::text::count;
use impact_paper::experiments::{Store, alive};
use impact_paper::params::Profile;
use std::path::PathBuf;

/// Joins the folders of all shards to saved results, byte for byte those of one machine.
///
/// `paper`, `check` and `status` find them there, fresh, and run nothing again. Nothing is saved unless every
/// unit of work is there. Files that are no JSON, such as logs, are passed over. Refused are units that two folders have with different bytes and files that are no unit of
/// the profile (exit code 2), and units that are missing, damaged, or made by other code or parameters (exit code 3).
#[derive(clap::Args)]
pub struct Args {
    /// Folders that `run` wrote, of all shards.
    #[arg(value_name = "DIR", required = true)]
    folders: Vec<PathBuf>,
    /// Sample sizes.
    #[arg(long, default_value = "full", value_parser = work::profiles())]
    profile: Profile,
    #[command(flatten)]
    only: work::Only,
    /// Folder in which results of long runs are kept.
    #[arg(long, value_name = "DIR", default_value = "target/results", value_parser = work::folder())]
    results: PathBuf,
    /// Number of threads; all cores without it. It changes no bit of the result.
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = threads::read)]
    threads: Option<usize>,
}

pub fn run(args: Args) -> Result<(), Failure> {
    let profile = args.profile;
    let plan = args.only.plan(profile)?;
    let folder = args.results;
    let there = resolved(&folder);
    if args.folders.iter().any(|own| resolved(own) == there) {
        let message = format!(
            "--results: {} is given as a folder of a shard too; give another for one of the two",
            folder.display()
        );
        return Err(Failure::input(message));
    }
    refuse_report("--results", &folder, None)?;
    let results = Store::open(&folder)?;
    let _made = signals::made(&folder);
    args.folders.iter().try_for_each(|folder| shard::refuse_above(folder))?;
    if args.folders.iter().all(|folder| folder.is_dir() && !shard::holds_units(folder)) {
        let first = args.folders.first().map(|folder| shown(folder)).unwrap_or_default();
        let remedy = "give folders that `impact-paper run` wrote";
        return Err(Failure::input(format!("{first}: it has no unit of work; {remedy}")));
    }
    let progress = signals::progress();
    let _alive = alive(|| Some("merge: at work".into()));
    threads::run(args.threads, || Ok(plan.merge(&args.folders, &results, &progress)?))?;
    let (units, out) = (count(plan.tasks.len(), "unit"), shown(&folder));
    stdout::print(&format!("{out}: results of {units} of work\n"))
}

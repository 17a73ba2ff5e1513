//! `impact-paper run`.

use super::places::refuse_report;
use super::{Failure, shown, signals, stdout, threads, work};
use impact_numerics::text::count;
use impact_paper::experiments::{Error, Store};
use impact_paper::params::Profile;
use literate::experiments::shards::MOST;
use std::fs::DirEntry;
use std::path::{Path, PathBuf};

/// Runs one shard of a profile: its share of the units of work that `plan` lists.
///
/// Each unit is saved as soon as it is there, whole or not at all. After Ctrl-C (exit code 130), a crash or a lost
/// machine the same command goes on where it was. `merge` joins the folders of all shards.
#[derive(clap::Args)]
pub struct Args {
    /// Which share of how many, like 2/3: the second of three.
    #[arg(long, value_name = "i/N", value_parser = share, allow_hyphen_values = true)]
    shard: (usize, usize),
    /// Sample sizes.
    #[arg(long, default_value = "full", value_parser = work::profiles())]
    profile: Profile,
    #[command(flatten)]
    only: work::Only,
    /// Folder for what the units give, one file each; it is made when missing. Shards may share it.
    #[arg(long, value_name = "DIR", value_parser = work::folder())]
    out: PathBuf,
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

/// Refuses numbers of shards that make no sense.
pub fn number(option: &str, of: usize) -> Result<(), Failure> {
    if (1..=MOST).contains(&of) {
        return Ok(());
    }
    Err(Failure::input(format!("{option}: {of} is not allowed; give 1 to {MOST}")))
}

/// A folder of units that cannot be used is told by the option that gave it.
pub fn given_by(option: &str) -> impl Fn(Error) -> Failure + Copy {
    move |error| match error {
        Error::Store { path, source } => {
            let what = format!("{option}: {}", path.display());
            Failure::io(&source, what, "give a folder that can be written")
        }
        other => other.into(),
    }
}

/// May there be units in the folder?
pub fn holds_units(folder: &Path) -> bool {
    let unit = |entry: DirEntry| {
        entry.path().extension().is_some_and(|end| end == "json")
            && entry.metadata().is_ok_and(|found| found.is_file())
    };
    std::fs::read_dir(folder).into_iter().flatten().flatten().any(unit)
}

/// Refuses a folder that has folders of shards in it in place of units.
pub fn refuse_above(folder: &Path) -> Result<(), Failure> {
    let below = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let below = below.map(|entry| entry.path()).filter(|path| holds_units(path));
    let Some(first) = below.min().filter(|_| !holds_units(folder)) else { return Ok(()) };
    let (folder, first) = (shown(folder), shown(&first));
    let what = format!("{folder}: units of work are in {first} and not in it");
    Err(Failure::input(format!("{what}; give folders that `impact-paper run` wrote")))
}

pub fn run(args: Args) -> Result<(), Failure> {
    let profile = args.profile;
    let unwritable = given_by("--out");
    let plan = args.only.plan(profile)?;
    refuse_report("--out", &args.out, None)?;
    let store = Store::open(&args.out).map_err(unwritable)?;
    let _made = signals::made(&args.out);
    let progress = signals::progress();
    let ran =
        threads::run(args.threads, || plan.run(args.shard, &store, &progress).map_err(unwritable))?;
    let ((i, n), out) = (args.shard, shown(&args.out));
    let run = count(ran.run, "unit");
    stdout::print(&format!("{out}: shard {i}/{n}: {run} run, {} fresh\n", ran.fresh))
}

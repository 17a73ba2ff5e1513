//! `impact-paper-tools bundle`.

mod archive;
mod metadata;
mod told;
mod tree;
mod vendored;

use archive::Archive;
use clap::ValueEnum;
use impact_paper::experiments::{self, Progress, Store};
use impact_paper::params::Profile;
use impact_paper::program::listed::{listed, own_profile};
use impact_paper::program::output::{self, Force};
use impact_paper::program::sources::Sources;
use impact_paper::program::{Failure, about, folder, make, signals, stdout};
use impact_paper::report::{Files, sums};
use std::path::{Path, PathBuf};
use tree::Tree;

/// Packs all that is needed to make the report again in ten years into one ZIP file.
///
/// In it: the committed source, the source of every crate with the settings that let cargo build
/// without a network, the toolchain file, saved results, paper/ with what is built beside it from
/// these results, SHA256SUMS of everything, RO-Crate 1.2 metadata and CITATION.cff. The same revision and
/// results give the same bytes. Run it in a clone without uncommitted changes.
#[derive(clap::Args)]
pub struct Args {
    /// The archive.
    #[arg(value_name = "OUT.zip")]
    out: PathBuf,
    /// Folder of the saved results; they must be fresh.
    #[arg(long, value_name = "DIR", default_value = "target/results")]
    results: PathBuf,
    #[command(flatten)]
    force: Force,
    /// Leave something out; may be repeated.
    #[arg(long, value_name = "WHAT")]
    without: Vec<Part>,
}

/// What can be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Part {
    /// The source of all crates: building then needs a registry.
    Crates,
    /// Saved results and what is built beside the report: making it then takes minutes.
    Results,
}

/// The committed report, in a clone.
const PAPER: &str = "paper";

/// Runs the verb.
pub fn run(args: Args) -> Result<(), Failure> {
    output::free("bundle", &args.out, args.force)?;
    let progress = signals::progress();
    let tree = Tree::here()?;
    let report = Path::new(PAPER);
    let listed = listed(report, None, &progress)?;
    if let Some(first) = listed.faults.first() {
        let what = format!("bundle: paper/ is not what its {} lists ({first})", sums::NAME);
        return Err(Failure::check(format!("{what}; make it anew with `make paper`")));
    }
    let top = format!("impact-paper-{}", about::VERSION);
    let mut archive = Archive::at(&args.out, &top)?;
    let released = metadata::released(Path::new("."))?;

    for (path, is_program) in &tree.files {
        progress.check()?;
        archive.add(path, &read(Path::new("."), path)?, *is_program)?;
    }
    if !args.without.contains(&Part::Results) {
        let profile = own_profile(report)?;
        for name in fresh(&args.results, profile)? {
            archive.add(&format!("results/{name}"), &read(&args.results, &name)?, false)?;
        }
        for (path, bytes) in beside(&args, profile, &progress)? {
            archive.add(&format!("{PAPER}/{path}"), &bytes, false)?;
        }
    }
    if !args.without.contains(&Part::Crates) {
        vendored::add(&mut archive, &progress)?;
    }
    let metadata = metadata::text(&archive, &tree.revision, &released);
    archive.add(metadata::NAME, metadata.as_bytes(), false)?;
    progress.check()?;
    let over = args.out.symlink_metadata().is_ok();
    let (files, size) = archive.finish(args.force.force)?;
    if over {
        progress.say(&format!("impact-paper: --force: wrote over {}", args.out.display()));
    }
    let size = size as f64 / 1e6;
    stdout::print(&format!("{}: {files} files, {size:.1} MB\n", args.out.display()))
}

/// What is built beside the committed report, made of the saved results: whatever stands there may be
/// older.
///
/// # Errors
/// Exit code 1 if the results give another report than the committed one.
fn beside(args: &Args, profile: Profile, progress: &Progress) -> Result<Files, Failure> {
    let sources = Sources::of(None, None, args.results.clone());
    let (made, _) = make::whole(&sources, profile, progress)?;
    for (path, bytes) in &made.committed {
        if folder::read(Path::new(PAPER), path).ok().as_ref() != Some(bytes) {
            let what = format!("bundle: the results do not give paper/{path} as it is committed");
            return Err(Failure::check(format!(
                "{what}; make it anew with `make paper` and commit it"
            )));
        }
    }
    let list = sums::write(&made.beside).into_bytes();
    Ok(made.beside.into_iter().chain([(sums::LOCAL.to_string(), list)]).collect())
}

fn read(root: &Path, path: &str) -> Result<Vec<u8>, Failure> {
    folder::read(root, path).map_err(|error| {
        let path = root.join(path);
        Failure::input(format!("{}: {error}; make it a file that can be read", path.display()))
    })
}

/// Names of the saved results of a profile.
///
/// # Errors
/// Exit code 3 if one of them is not what this program would run to.
fn fresh(results: &Path, profile: Profile) -> Result<Vec<String>, Failure> {
    let store = Store::open(results)?;
    let stale = |experiment: &&experiments::Need| !experiment.at(profile).stale(&store).is_empty();
    let stale: Vec<&str> =
        experiments::of(profile).iter().filter(stale).map(|experiment| experiment.name()).collect();
    if stale.is_empty() {
        let name = |experiment: &experiments::Need| {
            format!("{}.json", experiment.at(profile).identity().file_stem(profile))
        };
        return Ok(experiments::of(profile).iter().map(name).collect());
    }
    Err(Failure::stale(format!(
        "--results: {} in {} not fresh; `impact-paper paper --profile {}` makes them, `--without results` packs none",
        stale.join(", "),
        results.display(),
        profile.name()
    )))
}

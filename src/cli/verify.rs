//! `impact-paper verify`.

use impact_numerics::text::count;
use impact_paper::experiments::Store;
use impact_paper::params::Profile;
use impact_paper::program::sources::Sources;
use impact_paper::program::{Failure, make, shown, signals, stdout, threads, work};
use impact_paper::report::folder;
use std::path::PathBuf;

/// Says whether a report is what its SHA256SUMS lists; with --rerun, what is made here.
///
/// Ends with exit code 1 if a file differs, is missing, or stands there without being listed. Pages and figures for LaTeX
/// are built beside and not listed; --rerun, which makes the report again and compares byte by byte, compares them too.
/// Writes nothing. What a release on GitHub holds is attested besides: `gh attestation verify FILE --repo OWNER/REPO` says
/// whether that repository built the file, and from which commit.
#[derive(clap::Args)]
pub struct Args {
    /// Folder of the report.
    #[arg(value_name = "DIR", default_value = "paper")]
    folder: PathBuf,
    /// Make the report again, with the profile that it has and without saved results, and compare byte by byte.
    #[arg(long)]
    rerun: bool,
    /// Take results of long runs from this folder, where they are fresh, and keep them there.
    #[arg(long, value_name = "DIR", requires = "rerun")]
    results: Option<PathBuf>,
    /// Folder of the prose [default: templates of the checkout, or the copy inside the program].
    #[arg(long, value_name = "DIR", requires = "rerun")]
    templates: Option<PathBuf>,
    /// Number of threads; all cores without it. It changes no bit of the result.
    #[arg(long, value_name = "K", allow_hyphen_values = true, requires = "rerun", value_parser = threads::read)]
    threads: Option<usize>,
}

pub fn run(args: Args) -> Result<(), Failure> {
    let place = shown(&args.folder);
    let (files, mut faults) = folder::verify(&args.folder)?;
    if faults.is_empty() {
        let sums = folder::SUMS;
        stdout::print(&format!("{place}: {files} files, all as {sums} lists them\n"))?;
    }
    if args.rerun {
        let profile = profile(&args)?;
        let store = args.results.as_deref().map_or(Ok(Store::nowhere()), Store::open)?;
        let Args { threads, templates, folder, .. } = args;
        let sources = Sources { threads, templates, results: PathBuf::new() };
        let progress = signals::progress();
        let made =
            threads::run(threads, || make::whole(&sources, profile, &folder, &store, &progress))?.0;
        let (files, again) = made.compare(&folder)?;
        if again.is_empty() {
            let name = profile.name();
            let fine = format!("made again with the {name} profile, the same bytes");
            stdout::print(&format!("{place}: {files} files {fine}\n"))?;
        }
        faults.extend(again.into_iter().map(|fault| format!("rerun: {fault}")));
    }
    if faults.is_empty() {
        return Ok(());
    }
    stdout::print(&(faults.join("\n") + "\n"))?;
    Err(Failure::check(format!(
        "{place}: not as it should be: {}; `impact-paper paper --out {place} --force` writes the report anew, what is not \
         listed is yours to move",
        count(faults.len(), "file")
    )))
}

/// The profile of the report, by its values.
fn profile(args: &Args) -> Result<Profile, Failure> {
    let name = super::profile_in(&args.folder);
    let unknown =
        || Failure::input(format!("{}: values.json names no profile", shown(&args.folder)));
    name.and_then(|name| work::profile(&name)).ok_or_else(unknown)
}

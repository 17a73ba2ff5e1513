//! Runs the verb `verify`: compares a report with its list, or with what the source makes.

use super::common::{Run, profile_in};
use super::terminal::{Threads, display_path, print};
use crate::build::make_report;
use crate::experiments::{Progress, Store};
use crate::failure::Failure;
use crate::input::count;
use crate::paper::Paper;
use crate::report::folder;
use std::path::PathBuf;

/// Check a report against its SHA256SUMS, and with --rerun against what this program makes
///
/// Examples:
///   verify                                      paper/ and its list
///   verify --rerun                              every number from scratch, every byte compared
///   verify --rerun --results target/results     the same with saved results
///
/// Nothing is written. Exit code 1 says that a file differs, is missing, or is there without being
/// listed, or that prose and saved results would make it otherwise. Pages and figures for LaTeX are
/// listed in SHA256SUMS.built, and may be missing.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// Folder of the report [default: paper in the project].
    #[arg(value_name = "DIR")]
    folder: Option<PathBuf>,
    /// Make the report again, with the profile that it has and without saved results, and compare
    /// byte by byte.
    #[arg(long)]
    rerun: bool,
    /// Take results of long runs from this folder, where they are fresh; with --rerun keep them
    /// there [default: target/results in the project, with --rerun none].
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
    /// Read the prose from this folder [default: that of the project, or the copy inside the
    /// program].
    #[arg(long, value_name = "DIR")]
    templates: Option<PathBuf>,
    #[command(flatten)]
    threads: Threads,
}

pub(super) fn run(paper: &Paper, args: Args) -> Result<(), Failure> {
    let Args { folder, rerun, results, templates, threads } = args;
    let out = folder.unwrap_or_else(|| paper.project.place("paper"));
    let place = display_path(&out);
    let open = |profile, store| -> Result<Run<'_>, Failure> {
        let session = paper.session(templates.as_deref(), profile, store, Progress::on_stderr())?;
        Ok(Run { paper, session, out: out.clone() })
    };
    let (files, mut faults) = folder::verify(&out)?;
    if faults.is_empty() {
        print(&format!("{place}: {files} files, all as {} lists them\n", folder::SUMS))?;
    }
    let profile = profile_in(&out);
    if rerun {
        let no_profile = || Failure::input(format!("{place}: values.json names no profile"));
        let profile = profile.ok_or_else(no_profile)?;
        let store = results.as_deref().map_or(Store::nowhere(), Store::open);
        let run = open(profile, store)?;
        let report = threads.run(|| make_report(paper, &run.session, &out))?.0;
        let (files, differences) = folder::compare(&out, &report)?;
        if differences.is_empty() {
            let name = profile.name();
            let outcome = format!("made again with the {name} profile, the same bytes");
            print(&format!("{place}: {files} files {outcome}\n"))?;
        }
        faults.extend(differences.into_iter().map(|fault| format!("rerun: {fault}")));
    }
    if !faults.is_empty() {
        print(&(faults.join("\n") + "\n"))?;
        let number = count(faults.len(), "file");
        return Err(Failure::check(format!(
            "{place}: faults in {number}; with the same options `paper --force` writes it again, and \
             `paper --force --rerun all` without saved results; move unlisted files yourself"
        )));
    }
    // Without a run the report is compared with what prose and saved results make.
    let Some(profile) = profile.filter(|_| !rerun) else { return Ok(()) };
    let results = results.unwrap_or_else(|| paper.project.place("target/results"));
    if open(profile, Store::open(&results))?.refuse_outdated()? {
        return Ok(());
    }
    if results.is_dir() {
        let problem = "saved results are stale or missing, so prose was not compared";
        return Err(Failure::check(format!("{place}: {problem}; `paper` runs them")));
    }
    let problem = "not compared with the prose, since there are no saved results";
    print(&format!("{place}: {problem}; --rerun runs them\n"))
}

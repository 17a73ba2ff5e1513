//! `impact-paper paper`.

use super::sources::Sources;
use super::{Failure, judged, make, shown, signals, stdout, threads, work};
use impact_numerics::text::count;
use impact_paper::experiments::{ALL, Need, Progress, Store, say};
use impact_paper::figures::{self, Listed};
use impact_paper::params::Profile;
use impact_paper::report::{self, Files, PROGRAM, Report, folder};
use literate::input::listed;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Runs every experiment, draws all figures and writes the report.
///
/// Results of long runs are saved and used again as long as parameters and simulating code are the
/// same. Files are moved into place at the very end: Ctrl-C (exit code 130) leaves the report as it was. Only files
/// that an earlier run wrote, and nobody edited since, are replaced; pages, and what they load, are made anew each time. Ends with exit code 1 if a claim,
/// a target of accuracy or counted work, or a check fails; the report is written all the same.
#[derive(clap::Args)]
pub struct Args {
    /// Sample sizes.
    #[arg(long, default_value = "full", value_parser = work::profiles())]
    profile: Profile,
    /// Draw this figure only (1 to 15, s1 to s9; may be repeated): its SVG and its CSV are written.
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    figure: Vec<String>,
    /// Folder to write into [default: paper for the full profile, else target/paper-PROFILE].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Say which experiments would be run, and why (exit code 1 if any), and run nothing.
    #[arg(long)]
    dry_run: bool,
    /// Write over files that this program did not make, or that were edited since; says which.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    sources: Sources,
}

pub fn run(args: Args) -> Result<(), Failure> {
    let began = Instant::now();
    let Args { profile, sources, force, .. } = args;
    let out = args.out.unwrap_or_else(|| default_folder(profile));
    let find = |text: &String| {
        figures::find(text).map_err(|error| Failure::input(format!("--figure: {error}")))
    };
    let chosen = args.figure.iter().map(find).collect::<Result<Vec<&Listed>, Failure>>()?;
    if args.dry_run {
        return dry_run(&sources, profile, &needs(&chosen));
    }
    let whole = chosen.is_empty();
    refuse_over_other(profile, &out, whole)?;
    let option = |error: folder::Error| Failure::from(error).of("--out");
    folder::refuse(&out, &Files::new(), whole, force).map_err(option)?;
    let progress = signals::progress();
    let store = Store::open(&sources.results)?;
    let made = threads::run(sources.threads, || match whole {
        true => make::whole(&sources, profile, &out, &store, &progress),
        false => {
            let committed = some(&sources, &chosen, profile, &progress)?;
            Ok((Report { committed, beside: Files::new() }, Vec::new()))
        }
    });
    let (report, checks) = made?;
    let told = if whole { judged::scores(&checks) } else { Vec::new() };
    let told: String = told.into_iter().map(|line| line + "\n").collect();
    let written = report.write(&out, force).map_err(option)?;
    for (what, files) in [("removed", written.removed), ("--force: wrote over", written.over)] {
        if !files.is_empty() {
            say(&format!("impact-paper: {what} {}", listed(&files)));
        }
    }
    let time = duration(began.elapsed());
    let pages: Vec<&str> = PROGRAM.documents.iter().map(|document| document.page).collect();
    let documents = if whole { format!(": {}", pages.join(", ")) } else { String::new() };
    let number = count(report.committed.len() + report.beside.len(), "file");
    // It is told also where a check fails.
    let printed = stdout::print(&format!("{}: {number} in {time}{documents}\n{told}", shown(&out)));
    let more = |failure: Failure| failure.and("`impact-paper check` of the same says more");
    judged::verdict(&checks).map_err(more).and(printed)
}

/// Where a profile writes unless told otherwise.
fn default_folder(profile: Profile) -> PathBuf {
    match profile {
        Profile::Full => "paper".into(),
        Profile::Quick => "target/paper-quick".into(),
    }
}

/// Lesser samples must not take the place of the committed report, and single figures not stand among those
/// of other samples.
fn refuse_over_other(profile: Profile, out: &Path, whole: bool) -> Result<(), Failure> {
    match super::profile_in(out) {
        Some(name) if name != profile.name() && (!whole || name == Profile::Full.name()) => {
            Err(Failure::input(format!(
                "--out: {} holds a report of the {name} profile; give another folder",
                out.display()
            )))
        }
        _ => Ok(()),
    }
}

/// The experiments of figures, or all if none is named.
fn needs(listed: &[&Listed]) -> Vec<Need> {
    match listed.is_empty() {
        true => ALL.to_vec(),
        false => listed.iter().flat_map(|figure| figure.needs).copied().collect(),
    }
}

/// One line for each experiment that would be run.
fn dry_run(sources: &Sources, profile: Profile, needs: &[Need]) -> Result<(), Failure> {
    let store = Store::open(&sources.results)?;
    let stale: Vec<String> =
        needs.iter().filter_map(|need| Some(need.stale(profile, &store)? + "\n")).collect();
    stdout::print(&stale.concat())?;
    match stale.len() {
        0 => Ok(()),
        stale => Err(Failure::check(format!("{} to be run", count(stale, "experiment")))),
    }
}

/// The figures that were asked for, and nothing else.
fn some(
    sources: &Sources,
    listed: &[&Listed],
    profile: Profile,
    progress: &Progress,
) -> Result<Files, Failure> {
    let results = sources.run(&needs(listed), profile, &sources.templates()?, progress)?;
    let mut files = Files::new();
    for figure in listed {
        progress.check()?;
        files.extend(report::files_of(&make::figure(figure, &results)?));
    }
    Ok(files)
}

/// `3 min 20 s` or `4.2 s`.
fn duration(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    if seconds < 0.1 {
        return "less than 0.1 s".into();
    }
    if seconds < 60.0 {
        return format!("{seconds:.1} s");
    }
    format!("{} min {} s", time.as_secs() / 60, time.as_secs() % 60)
}

//! `impact-paper paper`.

use super::output::{Staging, remove_stale};
use super::sources::Sources;
use super::{Failure, make, work};
use impact_paper::experiments::Progress;
use impact_paper::figures;
use impact_paper::input;
use impact_paper::params::Profile;
use impact_paper::report::values::Number;
use impact_paper::report::{self, Files, Registry, compare, sums};
use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Runs every experiment, draws all figures and writes the report.
///
/// Results of long runs are saved and used again as long as parameters and simulating code are the
/// same. Files are moved into place at the very end: Ctrl-C (exit code 130) changes nothing.
#[derive(clap::Args)]
pub struct Args {
    /// Sample sizes.
    #[arg(long, default_value = "full")]
    profile: work::ProfileName,
    /// Draw this figure only (1 to 15, s1 to s8; may be repeated): its SVG and its CSV are written.
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    figure: Vec<String>,
    /// Folder to write into [default: paper for the full profile, else target/paper-PROFILE].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write report.pdf too (needs a binary with the feature pdf: make pdf).
    #[arg(long)]
    pdf: bool,
    #[command(flatten)]
    sources: Sources,
}

/// The file in which a report keeps its values.
const VALUES: &str = "values.json";

/// Runs the verb.
pub fn run(args: Args) -> Result<(), Failure> {
    let began = Instant::now();
    let profile = Profile::from(args.profile);
    let out = args.out.clone().unwrap_or_else(|| default_folder(profile));
    let read = |text: &String| text.parse().map_err(|e| Failure::input(format!("--figure: {e}")));
    let numbers =
        args.figure.iter().map(read).collect::<Result<BTreeSet<figures::Number>, Failure>>()?;
    refuse_over_full(profile, &out)?;
    let progress = work::progress();
    let staging = Staging::below(&out, "--out")?;
    let files = work::on_threads(args.sources.threads, || {
        if args.figure.is_empty() {
            let report = make::whole(&args.sources, profile, args.pdf, &progress)?;
            Ok(report.committed.into_iter().chain(report.beside).collect())
        } else {
            some(&args.sources, &numbers, profile, &progress)
        }
    })?;
    // What was there before is compared first: it is about to be replaced.
    let changes = if args.figure.is_empty() { changes(&out, &files) } else { Vec::new() };
    let sums_before = input::read(&out.join(sums::NAME)).unwrap_or_default();
    staging.place(&files, &progress)?;
    if args.figure.is_empty() {
        remove_stale(&out, &sums_before, &files)?;
    }
    // A closed standard output is no failure: the files are written.
    let mut told = std::io::stdout().lock();
    for line in changes {
        let _ = writeln!(told, "{line}");
    }
    let time = duration(began.elapsed());
    let _ = writeln!(told, "{}: {} files in {time}", out.display(), files.len());
    Ok(())
}

/// Where a profile writes unless told otherwise.
fn default_folder(profile: Profile) -> PathBuf {
    match profile {
        Profile::Full | Profile::Deep => "paper".into(),
        Profile::Ci => "target/paper-ci".into(),
        Profile::Quick => "target/paper-quick".into(),
    }
}

/// The values of the report in a folder, if there is one.
fn values_in(folder: &Path) -> Option<Registry> {
    compare::read(&input::read(&folder.join(VALUES)).ok()?).ok()
}

/// Lesser samples must not take the place of the committed report.
fn refuse_over_full(profile: Profile, out: &Path) -> Result<(), Failure> {
    let is_full = |values: Registry| {
        values.get("profile").is_some_and(|v| v.number == Number::Text("full".into()))
    };
    if profile == Profile::Full || !values_in(out).is_some_and(is_full) {
        return Ok(());
    }
    Err(Failure::input(format!(
        "--out: {} holds a report of the full profile; give another folder, or --profile full",
        out.display()
    )))
}

/// The figures that were asked for, and nothing else.
fn some(
    sources: &Sources,
    numbers: &BTreeSet<figures::Number>,
    profile: Profile,
    progress: &Progress,
) -> Result<Files, Failure> {
    let needs = numbers.iter().flat_map(|&number| figures::needs(number)).copied().collect();
    let results = sources.run(&needs, profile, &sources.templates()?, progress)?;
    let mut files = Files::new();
    for &number in numbers {
        progress.check()?;
        let figure = figures::draw(number, &results).map_err(|e| Failure::run(e.to_string()))?;
        files.extend(report::files_of(&figure));
    }
    Ok(files)
}

/// Which values changed against the report in `out`, or else against the committed one.
fn changes(out: &Path, files: &Files) -> Vec<String> {
    let committed = default_folder(Profile::Full);
    let Some((folder, before)) = [out, &committed]
        .into_iter()
        .find_map(|folder| Some((folder.join(VALUES), values_in(folder)?)))
    else {
        return vec!["there is no earlier report to compare with".into()];
    };
    let after = files.get(VALUES).and_then(|bytes| std::str::from_utf8(bytes).ok());
    let Some(Ok(after)) = after.map(compare::read) else { return Vec::new() };
    let changes = compare::changes(&before, &after);
    let number = changes.len();
    let summary = match number {
        0 => format!("no value differs from {}", folder.display()),
        1 => format!("1 value differs from {}", folder.display()),
        _ => format!("{number} values differ from {}", folder.display()),
    };
    changes.iter().map(ToString::to_string).chain([summary]).collect()
}

/// `3 min 20 s` or `4.2 s`.
fn duration(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    if seconds < 60.0 {
        return format!("{seconds:.1} s");
    }
    format!("{} min {} s", time.as_secs() / 60, time.as_secs() % 60)
}

//! `impact-paper paper`.

use super::diff::{count, fate};
use super::judged::Judged;
use super::output::{self, Staging, VALUES};
use super::places::{holds_report, refuse_prose, refuse_report};
use super::sources::Sources;
use super::{Failure, folder, make, shown, signals, stdout, threads, work};
use impact_paper::claims::Verdict;
use impact_paper::experiments::{ALL, Need, Progress, Store};
use impact_paper::figures;
use impact_paper::params::Profile;
use impact_paper::report::compare::{self, Parts};
use impact_paper::report::values::Number;
use impact_paper::report::{self, Files, PROGRAM, Registry};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Runs every experiment, draws all figures and writes the report.
///
/// Results of long runs are saved and used again as long as parameters and simulating code are the
/// same. Files are moved into place at the very end: Ctrl-C (exit code 130) leaves the report as it was, or,
/// where the disk is slow, between two files, from where the next run goes on. Only files
/// that an earlier run wrote, and nobody changed since, are replaced; folders .staging-impact-paper-* in --out, which
/// killed runs leave, are removed. Ends with exit code 1 if a claim,
/// a target of accuracy or counted work, or a check fails; the report is written all the same.
#[derive(clap::Args)]
pub struct Args {
    /// Sample sizes.
    #[arg(long, default_value = "full", value_parser = work::profiles())]
    profile: Profile,
    #[arg(long, value_name = "N", allow_hyphen_values = true, help = figure_help())]
    figure: Vec<String>,
    /// Folder to write into [default: paper for the full profile, else target/paper-PROFILE].
    #[arg(long, value_name = "DIR", value_parser = work::folder())]
    out: Option<PathBuf>,
    /// Say which experiments would be run, and why (exit code 3 if any), and run nothing.
    #[arg(long)]
    dry_run: bool,
    #[command(flatten)]
    force: output::Force,
    #[command(flatten)]
    sources: Sources,
}

/// The file in which a report keeps its verdicts.
const LEDGER: &str = "ledger.json";

fn figure_help() -> String {
    let (paper, own) = (figures::Number::PAPER, figures::Number::OWN);
    format!(
        "Draw this figure only (1 to {paper}, s1 to s{own}; may be repeated): its SVG and its CSV are written"
    )
}

/// Of more verdicts that changed only so many are told: the whole is one screen.
const MOVED: usize = 6;

pub fn run(args: Args) -> Result<(), Failure> {
    let began = Instant::now();
    let profile = args.profile;
    let out = args.out.clone().unwrap_or_else(|| default_folder(profile));
    let read = |text: &String| text.parse().map_err(|e| Failure::input(format!("--figure: {e}")));
    let numbers =
        args.figure.iter().map(read).collect::<Result<BTreeSet<figures::Number>, Failure>>()?;
    if args.dry_run {
        return dry_run(&args.sources, profile, &needs(&numbers));
    }
    refuse_over_other(profile, &out, !args.figure.is_empty(), args.force)?;
    args.sources.refuse_strange()?;
    let templates = args.sources.templates.as_deref();
    refuse_report("--results", &args.sources.results, templates)?;
    refuse_prose("--out", &out, templates)?;
    let progress = signals::progress();
    let staging = Staging::below(&out, "--out", args.force)?;
    if folder::resolved(&args.sources.results).starts_with(folder::resolved(&out)) {
        let message = "--results is --out, or lies in it; give another folder, since a report has no other files";
        return Err(Failure::input(message));
    }
    let whole = args.figure.is_empty();
    if whole {
        staging.refuse_changed()?;
    }
    let made = threads::run(args.sources.threads, || {
        if whole {
            let (report, judged) = make::whole(&args.sources, profile, &progress)?;
            let files: Files = report.committed.into_iter().chain(report.beside).collect();
            Ok((files, judged))
        } else {
            Ok((some(&args.sources, &numbers, profile, &progress)?, Judged::default()))
        }
    });
    let (files, judged) = made?;
    // What was there before is compared first: it is about to be replaced.
    let told = if whole { told(&out, &files, &judged) } else { String::new() };
    staging.place(&files, &progress)?;
    let time = duration(began.elapsed());
    let pages: Vec<&str> = PROGRAM.documents.iter().map(|document| document.page).collect();
    let documents = if whole { format!(": {}", pages.join(", ")) } else { String::new() };
    let number = count(files.len(), "file");
    let place = shown(&out);
    let head = format!("{place}: {number} in {time}{documents}\n");
    // It is told also where a check fails.
    let printed = stdout::print(&(head + &told));
    let more = |failure: Failure| Failure {
        message: format!("{}; `impact-paper check` of the same says more", failure.message),
        ..failure
    };
    judged.verdict().map_err(more).and(printed)
}

/// What holds, and what came out otherwise than in the report before: some lines.
fn told(out: &Path, files: &Files, judged: &Judged) -> String {
    let count = |verdict| judged.targets.iter().filter(|one| one.verdict == verdict).count();
    let [met, missed, open] =
        [Verdict::Reproduced, Verdict::Differs, Verdict::CannotBeJudged].map(count);
    let timed = judged.targets.iter().filter(|one| one.verdict == Verdict::Differs && !one.fails());
    let mut lines = judged.scores();
    lines.push(format!(
        "{} targets: {met} met, {missed} missed ({} of these by the clock), {open} not measured",
        judged.targets.len(),
        timed.count()
    ));
    lines.extend(changes(out, files));
    lines.into_iter().map(|line| format!("{line}\n")).collect()
}

/// What the report in `out` said otherwise, if there is one.
fn changes(out: &Path, files: &Files) -> Vec<String> {
    let read = |name: &str| Some((name.to_string(), folder::read(out, name).ok()?));
    let Some(before) = [VALUES, LEDGER].into_iter().map(read).collect::<Option<Files>>() else {
        return Vec::new();
    };
    let parts = (Parts::of("before", before), Parts::of("now", files.clone()));
    let (Ok(old), Ok(new)) = parts else { return Vec::new() };
    let diff = compare::diff(&old, &new);
    let before = shown(out);
    if diff.numbers.is_empty() && diff.verdicts.is_empty() {
        return vec![format!(
            "no number and no verdict differs from the report before in {before}"
        )];
    }
    let moved: Vec<_> =
        diff.verdicts.iter().filter(|change| change.before != change.after).collect();
    let line = |change: &&compare::ClaimChange| format!("  {}", fate(change));
    let mut lines = vec![format!(
        "{} and {} differ from the report before in {before}; `impact-paper diff OLD NEW` tells them",
        count(diff.numbers.len(), "number"),
        count(moved.len(), "verdict"),
    )];
    lines.extend(moved.iter().take(MOVED).map(line));
    if moved.len() > MOVED {
        lines.push(format!("  and {} more", moved.len() - MOVED));
    }
    lines
}

/// Where a profile writes unless told otherwise.
fn default_folder(profile: Profile) -> PathBuf {
    match profile {
        Profile::Full => "paper".into(),
        Profile::Quick => "target/paper-quick".into(),
    }
}

/// Is it where a profile writes, and nothing of worth is lost?
fn is_usual(profile: Profile, out: &Path) -> bool {
    let usual = || folder::resolved(out) == folder::resolved(&default_folder(profile));
    profile != Profile::Full && usual()
}

/// The values of the report in a folder, if there is one.
fn values_in(out: &Path) -> Result<Option<Registry>, Failure> {
    match folder::text(out, VALUES) {
        Ok(text) => Ok(compare::read(&text).ok()),
        Err(error) => {
            Failure::of_the_system(&error, format!("--out: {}", out.join(VALUES).display()))?;
            Ok(None)
        }
    }
}

/// Lesser samples must not take the place of the committed report, and single figures not stand among those
/// of other samples.
fn refuse_over_other(
    profile: Profile,
    out: &Path,
    figures: bool,
    output::Force { force }: output::Force,
) -> Result<(), Failure> {
    let name = |values: Registry| match &values.get("profile")?.number {
        Number::Text(name) => Some(name.clone()),
        _ => None,
    };
    // As it will be: what is missing before a `..` is about to be made.
    let there = &folder::resolved(out);
    let found = values_in(there)?.and_then(name);
    // Of a report that does not tell what it is, a lesser one would take the place unseen, and figures might be of
    // other samples.
    let lesser = profile != Profile::Full || figures;
    let asked = figures || !force;
    if found.is_none()
        && lesser
        && asked
        && holds_report(there).unwrap_or(true)
        && !is_usual(profile, out)
    {
        let remedy = match figures {
            true => "restore it, or give another folder",
            false => "--force writes the report anew",
        };
        return Err(Failure::input(format!(
            "--out: {} holds a report whose {VALUES} cannot be read; {remedy}",
            out.display()
        )));
    }
    match found {
        Some(name) if name != profile.name() && (figures || name == Profile::Full.name()) => {
            Err(Failure::input(format!(
                "--out: {} holds a report of the {name} profile; give another folder",
                out.display()
            )))
        }
        _ => Ok(()),
    }
}

/// The experiments of figures, or all if none is named.
fn needs(numbers: &BTreeSet<figures::Number>) -> Vec<Need> {
    match numbers.is_empty() {
        true => ALL.to_vec(),
        false => numbers.iter().flat_map(|&number| figures::needs(number)).copied().collect(),
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
        stale => Err(Failure::stale(format!("{} to be run", count(stale, "experiment")))),
    }
}

/// The figures that were asked for, and nothing else.
fn some(
    sources: &Sources,
    numbers: &BTreeSet<figures::Number>,
    profile: Profile,
    progress: &Progress,
) -> Result<Files, Failure> {
    let results = sources.run(&needs(numbers), profile, &sources.templates()?, progress)?;
    let mut files = Files::new();
    for &number in numbers {
        progress.check()?;
        files.extend(report::files_of(&make::figure(number, &results)?));
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

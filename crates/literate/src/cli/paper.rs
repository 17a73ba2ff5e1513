//! Runs the verb `paper`: makes the report, or says what would be run.

use super::common::{Run, RunOptions, profile_in, scores, verdict};
use super::terminal::{display_path, print};
use crate::build::make_report;
use crate::experiments::{AnyExperiment, Profile, Session};
use crate::failure::Failure;
use crate::input::{count, one_line};
use crate::paper::{FigureSpec, Paper};
use crate::report::{Files, files_of, folder};
use crate::table::no_such;
use std::path::PathBuf;
use std::time::Instant;

/// Run all experiments, draw all figures and write the report
///
/// Examples:
///   paper                                    the report of the full profile, into paper/
///   paper --dry-run                          what would be run, and why
///   paper --profile quick                    small samples, into target/paper-quick/
///   paper --figure 3 --out target/figure     one figure and its data
///   paper --rerun sweep                      with one result computed again, even if fresh
///
/// Stop it whenever you like: files are moved into place at the very end, results of long runs are
/// saved, and used again as long as parameters and source are the same. Only files that an earlier
/// run wrote, and nobody edited since, are replaced. Exit code 1 says that a statement or a
/// relation failed; the report is still written.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// Draw this figure only, by name or number (may be repeated), and write its SVG and CSV.
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    figure: Vec<String>,
    /// Write into this folder [default: paper in the project for the full profile, else
    /// target/paper-PROFILE].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Say which experiments would be run, and why, or that the report is not as prose and results
    /// would make it (exit code 1 for both), and run nothing.
    #[arg(long)]
    dry_run: bool,
    /// Run this experiment again, even if its result is fresh (may be repeated), or `all`.
    #[arg(long, value_name = "NAME", conflicts_with = "dry_run")]
    rerun: Vec<String>,
    /// Overwrite files that this program did not make, or that were edited since.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    options: RunOptions,
}

pub(super) fn run(paper: &Paper, args: Args) -> Result<(), Failure> {
    let began = Instant::now();
    let Args { options, force, .. } = args;
    let find = |name: &String| paper.find_figure(name).map_err(|e| e.in_context("--figure"));
    let figures = args.figure.iter().map(find).collect::<Result<Vec<&FigureSpec>, Failure>>()?;
    let is_whole = figures.is_empty();
    let mut needs = paper.experiments.clone();
    if !is_whole {
        needs = figures.iter().flat_map(|figure| figure.needs).copied().collect();
    }
    let mut run = options.open(paper, args.out.as_deref())?;
    if args.dry_run {
        return dry_run(&run, &needs);
    }
    let earlier = profile_in(&run.out);
    // Nothing is written over the full report, or among the figures of another profile.
    if let Some(other) = earlier
        && other != options.profile
        && (!is_whole || other == Profile::Full)
    {
        let (place, name) = (run.out.display(), other.name());
        let problem = format!("--out: {place} holds a report of the {name} profile");
        return Err(Failure::input(format!("{problem}; give another folder")));
    }
    // A report has one state, so a figure is drawn into one that is as the results make it, but for
    // the files of such figures.
    let is_of_figures = |path: &String| {
        let name = path.split(['/', '.']).nth(1).unwrap_or_default();
        figures.iter().any(|figure| name.starts_with(figure.name))
    };
    let apart = !is_whole
        && (args.out.is_none() || earlier.is_some())
        && !run.outdated()?.is_some_and(|paths| paths.iter().all(is_of_figures));
    if apart {
        run.out = paper.project.place("target/figures");
    }
    let Run { session, out, .. } = run;
    let at_option = |error: folder::Error| Failure::from(error).in_context("--out");
    if !force {
        folder::refuse(&out, &Files::new(), is_whole).map_err(at_option)?;
    }
    forget(&args.rerun, paper, &session)?;
    let (report, checks) = options.threads.run(|| {
        if is_whole {
            return make_report(paper, &session, &out);
        }
        let (results, mut report) = (paper.results(&needs, &session)?, Files::new());
        for figure in figures {
            report.extend(files_of(&figure.figure(&results)?, paper.edition.license));
        }
        report.retain(|path, _| !folder::is_generated(path));
        Ok((report, Vec::new()))
    })?;
    folder::write(&out, &report, force).map_err(at_option)?;
    let number = count(report.len(), "file");
    let (place, seconds) = (display_path(&out), began.elapsed().as_secs_f64());
    let mut line = format!("{place}: {number} in {seconds:.1} s");
    if is_whole {
        let pages: Vec<&str> = paper.edition.documents.iter().map(|one| one.page).collect();
        line += &format!(": {}", pages.join(", "));
    }
    if apart {
        line += "; the report is not up to date, so it was left alone";
    }
    let lines: Vec<String> = [line].into_iter().chain(scores(&checks)).collect();
    // Printed also if a check fails.
    let printed = print(&(lines.join("\n") + "\n"));
    let with_advice = |failure: Failure| {
        let message = format!("{}; `check` says more", failure.message);
        Failure { message, ..failure }
    };
    verdict(&checks).map_err(with_advice).and(printed)
}

fn forget(names: &[String], paper: &Paper, session: &Session<'_>) -> Result<(), Failure> {
    let known: Vec<&str> = paper.experiments.iter().map(|experiment| experiment.name()).collect();
    for name in names {
        if name != "all" && !known.contains(&name.as_str()) {
            let problem = no_such("experiment", &one_line(name, 60), known.into_iter());
            return Err(Failure::input(format!("--rerun: {problem}")));
        }
    }
    for experiment in &paper.experiments {
        if names.iter().any(|name| name == "all" || name == experiment.name()) {
            session.store.remove(&experiment.identity(session)?, true)?;
        }
    }
    Ok(())
}

fn dry_run(run: &Run<'_>, needs: &[&'static dyn AnyExperiment]) -> Result<(), Failure> {
    let stale = needs.iter().map(|need| need.why_stale(&run.session));
    let stale = stale.collect::<Result<Vec<_>, _>>()?;
    let stale: Vec<String> = stale.into_iter().flatten().map(|line| line + "\n").collect();
    print(&stale.concat())?;
    match stale.len() {
        0 => run.refuse_outdated().map(drop),
        stale => Err(Failure::check(format!("{} to be run", count(stale, "experiment")))),
    }
}

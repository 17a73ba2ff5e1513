//! Gives the verbs the options, scores and verdict that they share.

use super::terminal::{Threads, display_path};
use crate::build::make_report;
use crate::claims::{Basis, Check, Kind, Verdict, score};
use crate::experiments::{AnyExperiment, Profile, Progress, Session, Store};
use crate::failure::Failure;
use crate::input::{count, read_text};
use crate::paper::Paper;
use crate::report::{ValueRegistry, folder};
use std::path::{Path, PathBuf};

#[derive(clap::Args)]
pub(super) struct RunOptions {
    /// Use these sample sizes.
    #[arg(long, default_value = "full")]
    pub profile: Profile,
    #[command(flatten)]
    pub threads: Threads,
    /// Read the prose from this folder [default: that of the project, or the copy inside the
    /// program].
    #[arg(long, value_name = "DIR")]
    pub templates: Option<PathBuf>,
    /// Keep results of long runs in this folder [default: target/results in the project].
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
}

impl RunOptions {
    pub fn results(&self, paper: &Paper) -> PathBuf {
        self.results.clone().unwrap_or_else(|| paper.project.place("target/results"))
    }

    /// Opens a run for the report in a folder, which is that of the profile if none is given.
    pub fn open<'a>(&self, paper: &'a Paper, out: Option<&Path>) -> Result<Run<'a>, Failure> {
        let usual = match self.profile {
            Profile::Full => "paper",
            Profile::Quick => "target/paper-quick",
        };
        let out = out.map_or_else(|| paper.project.place(usual), Path::to_path_buf);
        let (templates, store) = (self.templates.as_deref(), Store::open(&self.results(paper)));
        let session = paper.session(templates, self.profile, store, Progress::on_stderr())?;
        Ok(Run { paper, session, out })
    }
}

/// What a verb works with: the paper, how it is made, and the folder of its report.
pub(super) struct Run<'a> {
    pub paper: &'a Paper,
    pub session: Session<'a>,
    pub out: PathBuf,
}

impl Run<'_> {
    /// Returns the files of the report, of those that are committed, that are not as prose, printed
    /// numbers and saved results make them, or `None` if there is no report or a result is stale.
    pub fn outdated(&self) -> Result<Option<Vec<String>>, Failure> {
        let Run { paper, session, out } = self;
        let stale = |one: &&'static dyn AnyExperiment| one.why_stale(session).transpose();
        if profile_in(out) != Some(session.profile)
            || paper.experiments.iter().find_map(stale).transpose()?.is_some()
        {
            return Ok(None);
        }
        let silent = Session { progress: Progress::silent(), ..session.clone() };
        let (report, _) = make_report(paper, &silent, out)?;
        let committed = report.into_iter().filter(|(path, _)| !folder::is_generated(path));
        let faults = folder::compare(out, &committed.collect())?.1;
        let paths = faults.iter().filter(|fault| !fault.starts_with("unlisted"));
        Ok(Some(paths.filter_map(|fault| Some(fault.split_once("  ")?.1.to_string())).collect()))
    }

    /// Fails if files of the report are [outdated](Run::outdated). Returns whether that is known.
    pub fn refuse_outdated(&self) -> Result<bool, Failure> {
        let names = match self.outdated()?.as_deref() {
            None => return Ok(false),
            Some([]) => return Ok(true),
            Some([path]) => path.clone(),
            Some([first, others @ ..]) => format!("{first} and {} more", others.len()),
        };
        let problem = "not as prose, published numbers and results make it; `paper` writes it anew";
        Err(Failure::check(format!("{}: {names}: {problem}", display_path(&self.out))))
    }
}

/// Returns the profile of the report in a folder, or `None` if there is no report.
pub(super) fn profile_in(root: &Path) -> Option<Profile> {
    let json = read_text(&root.join("values.json")).ok()?;
    serde_json::from_str::<ValueRegistry>(&json).ok()?.profile()
}

/// Returns the scores, a line each: of statements, and of relations where there are any.
pub(super) fn scores(checks: &[Check]) -> Vec<String> {
    let mut lines = Vec::new();
    let of_kind = |kind: Kind| checks.iter().filter(move |check| check.kind == kind);
    let statements = of_kind(Kind::Statement);
    let number = statements.clone().count();
    if number > 0 {
        let mut counts = Vec::new();
        for (verdict, count) in Verdict::ALL.iter().zip(score(statements.clone())) {
            counts.push(format!("{} {count}", verdict.words()));
        }
        lines.push(format!("{} of the paper: {}", count(number, "statement"), counts.join(", ")));
        let mut bases = Vec::new();
        for basis in Basis::ALL {
            let counts = score(statements.clone().filter(|check| check.basis == basis));
            let total: usize = counts.iter().sum();
            if total > 0 {
                bases.push(format!("{} of {total} {}", counts[0], basis.words()));
            }
        }
        lines.push(format!("reproduced, by what the verdict rests on: {}", bases.join(", ")));
    }
    let [held, _, broken, open] = score(of_kind(Kind::Relation));
    let total = held + broken + open;
    if total > 0 {
        lines.push(format!("our own checks: {held} of {total} relations between numbers hold"));
    }
    lines
}

pub(super) fn verdict(checks: &[Check]) -> Result<(), Failure> {
    let mut faults = Vec::new();
    for (is_printed, problem) in [
        (true, "statements have no rule or differ without an explanation that holds"),
        (false, "relations between numbers of the report do not hold"),
    ] {
        let failed = |check: &&Check| check.fails() && check.kind.is_printed() == is_printed;
        let failed = checks.iter().filter(failed).map(|check| check.id.as_str());
        let ids: Vec<&str> = failed.collect();
        if !ids.is_empty() {
            faults.push(format!("{problem}: {}", ids.join(", ")));
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(Failure::check(faults.join("; "))) }
}

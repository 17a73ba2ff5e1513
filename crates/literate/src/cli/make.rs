//! Makes a whole report, from experiments to files in memory, and judges it.

use super::terminal::{Threads, progress, warn};
use crate::claims::{Basis, Check, Kind, Published, Verdict, judge_all, score};
use crate::experiments::{AnyExperiment, Error, Profile, Progress, Results, Session, Store};
use crate::failure::Failure;
use crate::figures::Figure;
use crate::input::count;
use crate::paper::{FigureSpec, Paper};
use crate::prose::Templates;
use crate::report::claims::printed;
use crate::report::filler::Filler;
use crate::report::{Input, Registry, Report, Value, assemble};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Options common to verbs that make a report or judge it.
#[derive(clap::Args)]
pub(super) struct Sources {
    /// Take these sample sizes.
    #[arg(long, default_value = "full", value_parser = profile())]
    pub profile: Profile,
    #[command(flatten)]
    pub threads: Threads,
    /// Read the prose from this folder [default: that of the project, or the copy inside the
    /// program].
    #[arg(long, value_name = "DIR")]
    pub templates: Option<PathBuf>,
    /// Keep results of long runs in this folder.
    #[arg(long, value_name = "DIR", default_value = "target/results")]
    pub results: PathBuf,
}

fn profile() -> impl TypedValueParser<Value = Profile> {
    let quick = PossibleValue::new("quick").help("To try out: small samples");
    let full = PossibleValue::new("full").help("The committed report");
    PossibleValuesParser::new([quick, full]).try_map(|name| name.parse::<Profile>())
}

impl Sources {
    /// Returns the run that is asked for.
    pub fn session<'a>(&self, paper: &'a Paper) -> Result<Session<'a>, Failure> {
        if let Some(file) = paper.project.changed() {
            warn(&format!(
                "{file} has changed since this program was built; build it again to see the change"
            ));
        }
        let store = Store::open(&self.results);
        paper.session(self.templates.as_deref(), self.profile, store, progress())
    }
}

impl Paper {
    /// Returns a run with the prose of a folder, or else that of the project, or the copy inside
    /// the program.
    ///
    /// # Errors
    /// If a file of an experiment is missing or not declared, if two experiments have one name, or
    /// if there is no prose that can be read.
    pub fn session(
        &self,
        prose: Option<&Path>,
        profile: Profile,
        store: Store,
        progress: Progress,
    ) -> Result<Session<'_>, Failure> {
        let project = &self.project;
        let shared = project.check_named(project.shared);
        shared.map_err(|(problem, remedy)| Error::input("project.shared", problem, remedy))?;
        for (at, experiment) in self.experiments.iter().enumerate() {
            experiment.check(project)?;
            let name = experiment.name();
            if self.experiments[..at].iter().any(|other| other.name() == name) {
                return Err(Failure::input(format!(
                    "two experiments are called {name}; rename one"
                )));
            }
        }
        let folder = prose.map(Path::to_path_buf).or_else(|| project.find(self.prose));
        let templates = match folder {
            Some(folder) => Templates::read(&folder)?,
            None => Templates::of(project.copy.iter().filter_map(|(path, text)| {
                Some((path.strip_prefix(self.prose)?.strip_prefix('/')?, *text))
            })),
        };
        let mut documents = self.edition.documents.iter();
        if documents.len() > 0 && documents.all(|one| one.files(&templates).is_empty()) {
            let names: Vec<&str> =
                self.edition.documents.iter().map(|document| document.prose).collect();
            let folder = prose.unwrap_or(Path::new(self.prose)).display();
            let what = format!("{folder}: no prose is there; give the folder of");
            return Err(Failure::input(format!("{what} {}", names.join(", "))));
        }
        Ok(Session { project, templates, profile, store, progress })
    }

    /// Runs those of the experiments that are needed, in the order of the paper, and returns their
    /// results.
    ///
    /// # Errors
    /// Of the first run that fails or is interrupted.
    pub fn results(
        &self,
        needs: &[&'static dyn AnyExperiment],
        session: &Session<'_>,
    ) -> Result<Results, Error> {
        let mut experiments = self.experiments.clone();
        experiments.retain(|one| needs.iter().any(|need| need.name() == one.name()));
        Results::run(&experiments, &self.derived, session)
    }

    /// Returns what was printed; nothing without a file `published.toml`.
    pub fn published(&self, session: &Session<'_>) -> Result<Published, Failure> {
        let read = Published::parse(session.templates.text("published.toml")?);
        read.map_err(|error| {
            let failure = Failure::from(error);
            Failure { message: session.templates.place(&failure.message), ..failure }
        })
    }

    /// Returns all checks: statements, those that rest on a measure of the author first, then
    /// relations.
    pub fn checks(&self, results: &Results, published: &Published) -> Result<Vec<Check>, Failure> {
        let mut checks = judge_all(published, &self.rules, results)?;
        // First what rests on a measure of the author, where a reader may judge otherwise.
        checks.sort_by_key(|check| (check.kind, check.basis != Basis::OurMeasure));
        Ok(checks)
    }

    /// Returns all values that the prose may name.
    pub fn registry(&self, results: &Results, published: &Published) -> Result<Registry, Failure> {
        let mut registry = Registry::default();
        registry.extend(printed(published))?;
        let profile = Value::text("profile", results.profile.name());
        registry.add(profile.source(crate::value::origin(Paper::registry), "").data_only())?;
        for values in &self.values {
            for value in values(results, published)? {
                registry.put(value);
            }
        }
        results.tables()?.values().try_for_each(|table| registry.add_table(Arc::clone(table)))?;
        Ok(registry)
    }
}

/// Runs every experiment that is not in the store, and makes every file of a report in the folder
/// `out`. Returns also what was judged.
pub fn whole(
    paper: &Paper,
    session: &Session<'_>,
    out: &Path,
) -> Result<(Report, Vec<Check>), Failure> {
    let Session { templates, progress, .. } = session;
    Filler::new(templates)?;
    let published = paper.published(session)?;
    let results = paper.results(&paper.experiments, session)?;
    results.tables()?;
    let figure = |drawing: &FigureSpec| {
        progress.check()?;
        drawn(drawing, &results)
    };
    let figures = paper.figures.par_iter().map(figure).collect::<Result<Vec<Figure>, _>>()?;
    let checks = paper.checks(&results, &published)?;
    let statements: Vec<Check> =
        checks.iter().filter(|check| check.kind.is_printed()).cloned().collect();
    let values = paper.registry(&results, &published)?;
    let mut rows = BTreeMap::new();
    for more in &paper.rows {
        rows.extend(more(&results, &statements)?);
    }
    let lab = paper.lab.map(|lab| lab(session, &results)).transpose()?.flatten();
    progress.check()?;
    let report = assemble(&Input {
        templates,
        values: &values,
        rows: &rows,
        claims: &statements,
        figures: &figures,
        lab: lab.as_deref(),
        top: paper.project.way_up(out).as_deref(),
        edition: &paper.edition,
        project: &paper.project,
        experiments: &paper.experiments,
    })?;
    Ok((report, checks))
}

/// Draws a figure of the results; an error names it.
pub(super) fn drawn(drawing: &FigureSpec, results: &Results) -> Result<Figure, Failure> {
    let named = |error| Failure::from(error).of(format!("figure {}", drawing.name));
    drawing.figure(results).map_err(named)
}

pub(super) fn of(checks: &[Check], kind: Kind) -> impl Iterator<Item = &Check> + Clone {
    checks.iter().filter(move |check| check.kind == kind)
}

/// Returns the scores, a line each: of statements, and of relations where there are any.
pub(super) fn scores(checks: &[Check]) -> Vec<String> {
    let mut lines = Vec::new();
    let statements = of(checks, Kind::Statement);
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
            let all: usize = counts.iter().sum();
            if all > 0 {
                bases.push(format!("{} of {all} {}", counts[0], basis.words()));
            }
        }
        lines.push(format!("reproduced, by what the verdict rests on: {}", bases.join(", ")));
    }
    let [held, _, broken, open] = score(of(checks, Kind::Relation));
    let all = held + broken + open;
    if all > 0 {
        lines.push(format!("our own checks: {held} of {all} relations between numbers hold"));
    }
    lines
}

/// Returns a failure that names all that does not hold.
pub(super) fn verdict(checks: &[Check]) -> Result<(), Failure> {
    let mut faults = Vec::new();
    for (is_printed, what) in [
        (true, "statements have no rule or differ without an explanation that holds"),
        (false, "relations between numbers of the report do not hold"),
    ] {
        let failed = |check: &&Check| check.fails() && check.kind.is_printed() == is_printed;
        let failed = checks.iter().filter(failed).map(|check| check.id.as_str());
        let ids: Vec<&str> = failed.collect();
        if !ids.is_empty() {
            faults.push(format!("{what}: {}", ids.join(", ")));
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(Failure::check(faults.join("; "))) }
}

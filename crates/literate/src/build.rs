//! Builds a report: opens a run of a paper, judges its results, and makes every file in memory.

use crate::claims::{Check, Judge, Published, Words, check_rules};
use crate::code::Code;
use crate::experiments::{AnyExperiment, Error, Profile, Progress, Results, Session, Store};
use crate::failure::Failure;
use crate::figures::Figure;
use crate::paper::{FigureSpec, Paper};
use crate::prose::Templates;
use crate::report::claims::printed_values;
use crate::report::filler::Filler;
use crate::report::{Files, Input, ValueRegistry, assemble};
use crate::value::Value;
use rayon::prelude::*;
use std::path::Path;

impl Paper {
    /// Returns a run with the prose of a folder, or else of the project or its copy. Fails if
    /// names are not unique, a file is missing, or the program is older than its code.
    pub fn session(
        &self,
        prose: Option<&Path>,
        profile: Profile,
        store: Store,
        progress: Progress,
    ) -> Result<Session<'_>, Failure> {
        let project = &self.project;
        self.check_names()?;
        self.experiments.iter().try_for_each(|experiment| experiment.check_files(project))?;
        let folder = prose.map(Path::to_path_buf).or_else(|| project.find(self.prose));
        let templates = match folder {
            Some(folder) => Templates::read(&folder)?,
            None => Templates::from_files(project.copy.iter().filter_map(|(path, text)| {
                Some((path.strip_prefix(self.prose)?.strip_prefix('/')?, *text))
            })),
        };
        let mut documents = self.edition.documents.iter();
        if documents.len() > 0 && documents.all(|document| document.files(&templates).is_empty()) {
            let names: Vec<&str> = self.edition.documents.iter().map(|one| one.prose).collect();
            let folder = prose.unwrap_or(Path::new(self.prose)).display();
            let problem = format!("{folder}: no prose is there; give the folder of");
            return Err(Failure::input(format!("{problem} {}", names.join(", "))));
        }
        let own = self.experiments.iter().flat_map(|one| one.own()).copied().collect();
        let code = Code::of_program(project, self.prose, own).map_err(Failure::input)?;
        Ok(Session { project, templates, profile, store, progress, code })
    }

    /// Runs the experiments that are needed, in the order of the paper, and returns their results.
    pub fn results(
        &self,
        needs: &[&'static dyn AnyExperiment],
        session: &Session<'_>,
    ) -> Result<Results, Error> {
        let mut experiments = self.experiments.clone();
        experiments.retain(|experiment| needs.iter().any(|need| need.name() == experiment.name()));
        Results::run(&experiments, &self.derived, session)
    }

    /// Returns what was printed, with the texts of the checks; nothing without a file.
    pub fn published(&self, session: &Session<'_>) -> Result<Published, Failure> {
        let templates = &session.templates;
        let fault = |problem: String| Failure::input(templates.place(&problem));
        let published = Published::parse(templates.text("published.toml")?);
        let ids: Vec<&str> = self.rules.iter().map(|rule| rule.id).collect();
        let words = Words::read(templates, &ids).map_err(fault)?;
        let published = Published { words, ..published.map_err(|error| fault(error.to_string()))? };
        check_rules(&published, &self.rules)?;
        Ok(published)
    }

    fn registry(&self, results: &Results, published: &Published) -> Result<ValueRegistry, Failure> {
        let mut registry = ValueRegistry::default();
        registry.extend(printed_values(published))?;
        let profile = Value::words("profile", results.profile.name());
        registry.add(profile.source(crate::value::origin(Paper::registry)))?;
        for values in &self.values {
            registry.extend(values(results, published)?)?;
        }
        registry.add_tables(results.tables()?)?;
        Ok(registry)
    }
}

/// Makes every file of a report, in memory, with links that hold in the folder `out`, and judges.
pub fn make_report(
    paper: &Paper,
    session: &Session<'_>,
    out: &Path,
) -> Result<(Files, Vec<Check>), Failure> {
    let Session { templates, progress, .. } = session;
    let filler = Filler::new(templates)?;
    let declared = filler.declared.clone();
    let published = paper.published(session)?;
    let results = paper.results(&paper.experiments, session)?;
    results.tables()?;
    let figure = |figure: &FigureSpec| {
        progress.check()?;
        figure.figure(&results)
    };
    let figures =
        || paper.figures.par_iter().with_max_len(1).map(figure).collect::<Result<Vec<Figure>, _>>();
    let judge = || {
        let checks = Judge::new(&published, &paper.rules, &results).checks()?;
        let mut statements = checks.clone();
        statements.retain(|check| check.kind.is_printed());
        let rows = paper.rows.map(|rows| rows(&results, &statements)).transpose()?;
        let lab = paper.lab.map(|lab| lab(session, &results)).transpose()?.flatten();
        let values = paper.registry(&results, &published)?;
        Ok::<_, Failure>((checks, values, rows.unwrap_or_default(), lab))
    };
    let (figures, judged) = rayon::join(figures, judge);
    let (figures, (checks, values, rows, lab)) = (figures?, judged?);
    progress.check()?;
    let report = assemble(
        filler,
        &Input {
            templates,
            values: &values,
            declared: &declared,
            rows: &rows,
            claims: &checks,
            figures: &figures,
            lab: lab.as_deref(),
            top: paper.project.way_up(out).as_deref(),
            edition: &paper.edition,
            project: &paper.project,
            experiments: &paper.experiments,
            warn: &|line| progress.say(line),
        },
    )?;
    Ok((report, checks))
}

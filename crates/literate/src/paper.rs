//! Defines a paper: its experiments, figures, checks and documents.

use crate::claims::{Check, Evidence, Judged, Published, Rule};
use crate::experiments::{AnyExperiment, DerivedTables, Results, Session};
use crate::failure::Failure;
use crate::figures::{self, Figure};
use crate::input;
use crate::names::{self, Names};
use crate::project::Project;
use crate::report::Edition;
use crate::source::Sources;
use crate::value::Value;
use serde_json::Value as Json;
use std::collections::{BTreeMap, BTreeSet};
use std::panic::Location;

type Needs = &'static [&'static dyn AnyExperiment];
type Draw = fn(&Results) -> Result<Figure, figures::Error>;

/// A figure of the paper before it is drawn.
#[derive(Clone, Copy)]
pub struct FigureSpec {
    /// Its name; its picture is `figures/NAME.svg`.
    pub name: &'static str,
    /// The experiments whose results it shows.
    pub needs: Needs,
    pub(crate) draw: Draw,
    place: &'static Location<'static>,
}

impl FigureSpec {
    /// Lists a figure with its name, what it needs, and the function that draws it.
    #[track_caller]
    pub const fn new(name: &'static str, needs: Needs, draw: Draw) -> Self {
        FigureSpec { name, needs, draw, place: Location::caller() }
    }

    /// Draws it from results, and names its files; it is an error if it cannot be drawn.
    pub fn figure(&self, results: &Results) -> Result<Figure, Failure> {
        let named = |error| Failure::from(error).in_context(format!("figure {}", self.name));
        let mut figure = (self.draw)(results).map_err(named)?;
        figure.data.iter_mut().for_each(|file| file.name.insert_str(0, self.name));
        let mut names = BTreeSet::new();
        if let Some(file) = figure.data.iter().find(|file| !names.insert(&file.name)) {
            let problem = format!("figure {}: two panels name their data {}", self.name, file.name);
            return Err(Failure::input(format!("{problem}; give each a letter (`set_suffix`)")));
        }
        let experiments = self.needs.iter().map(|need| need.name()).collect();
        // The item that draws it has its name.
        let source = format!("figures::{}", self.name);
        Ok(Figure { id: self.name.into(), source, experiments, ..figure })
    }
}

type MakeValues = fn(&Results, &Published) -> Result<Vec<Value>, Failure>;
type MakeRows = fn(&Results, &[Check]) -> Result<BTreeMap<&'static str, Json>, Failure>;
type MakeLab = fn(&Session<'_>, &Results) -> Result<Option<String>, Failure>;

/// A paper: all that it is made of.
pub struct Paper {
    /// Title, authors and documents.
    pub edition: Edition,
    /// Its source, and the files that it reads.
    pub project: Project,
    /// Folder of the prose, from the top of the project.
    pub prose: &'static str,
    /// All experiments, in the order in which they run.
    pub experiments: Vec<&'static dyn AnyExperiment>,
    /// Tables that need results of several experiments.
    pub derived: Vec<DerivedTables>,
    /// All figures, in their order.
    pub figures: Vec<FigureSpec>,
    /// How each statement of `published.toml` is judged, and relations between numbers.
    pub rules: Vec<Rule>,
    /// Make values that the prose may use like the cells of tables.
    pub values: Vec<MakeValues>,
    /// Makes rows of tables that are neither values nor checks, by the names that the prose uses.
    pub rows: Option<MakeRows>,
    /// Makes `lab.js`, which a page loads to compute, or returns `None` if it cannot be made here.
    pub lab: Option<MakeLab>,
}

impl Paper {
    /// Makes a paper with one document, `report`, and its prose in the folder `prose`.
    pub fn new(title: &'static str, sources: Sources) -> Self {
        Paper {
            edition: Edition::new(title),
            project: Project::new(sources),
            prose: "prose",
            experiments: Vec::new(),
            derived: Vec::new(),
            figures: Vec::new(),
            rules: Vec::new(),
            values: Vec::new(),
            rows: None,
            lab: None,
        }
    }

    /// Adds an author with an affiliation, which may be empty.
    pub fn author(mut self, name: &'static str, affiliation: &'static str) -> Self {
        self.edition.authors.push((name, affiliation));
        self
    }

    /// Adds an experiment, which runs after those before it.
    pub fn experiment(mut self, experiment: &'static dyn AnyExperiment) -> Self {
        self.experiments.push(experiment);
        self
    }

    /// Adds the rule that judges the statement with this id.
    #[track_caller]
    pub fn check(
        self,
        id: &'static str,
        judge: impl Fn(&Evidence<'_>) -> Judged + Send + Sync + 'static,
    ) -> Self {
        self.rule(Rule::new(id, judge))
    }

    /// Adds a rule.
    pub fn rule(mut self, rule: Rule) -> Self {
        self.rules.push(rule);
        self
    }

    /// Adds a figure with its name, the experiments that it needs, and what draws it.
    #[track_caller]
    pub fn figure(mut self, name: &'static str, needs: Needs, draw: Draw) -> Self {
        self.figures.push(FigureSpec::new(name, needs, draw));
        self
    }

    /// Refuses two experiments, figures, rules or documents of one name, with the places of both.
    pub(crate) fn check_names(&self) -> Result<(), Failure> {
        let mut named = Vec::new();
        for (experiment, number) in self.experiments.iter().zip(1..) {
            let item = experiment.item();
            let place = if item.is_empty() { format!("number {number}") } else { item };
            named.push(("experiments", experiment.name(), place));
        }
        for FigureSpec { name, place, .. } in &self.figures {
            named.push(("figures", name, input::source_line(place)));
        }
        for Rule { id, place, .. } in &self.rules {
            named.push(("rules", id, input::source_line(place)));
        }
        for document in &self.edition.documents {
            for name in [document.markdown, document.page] {
                named.push(("documents", name, format!("the document {}", document.prose)));
            }
        }
        let mut kinds: BTreeMap<&str, Names> = BTreeMap::new();
        for (kind, name, place) in named {
            let fault = names::fault(name).map(|fault| format!("{place}: {fault}"));
            let same = || kinds.entry(kind).or_default().add(name, &place).err();
            if let Some(problem) = fault.or_else(same) {
                return Err(Failure::input(format!("{kind}: {problem}")));
            }
        }
        Ok(())
    }

    /// Finds a figure by its name or number: `spread`, `3` for `fig03`, `s1` for `s01`.
    pub(crate) fn find_figure(&self, asked: &str) -> Result<&FigureSpec, Failure> {
        let lower = asked.to_lowercase();
        let digits = lower.trim_start_matches(char::is_alphabetic);
        let letters = lower.strip_suffix(digits).filter(|letters| !letters.is_empty());
        let numbered = format!("{}{digits:0>2}", letters.unwrap_or("fig"));
        let mut figures = self.figures.iter();
        figures.find(|figure| [asked, &numbered].contains(&figure.name)).ok_or_else(|| {
            let names: Vec<&str> = self.figures.iter().map(|figure| figure.name).collect();
            let names = names.join(", ");
            Failure::input(format!("there is no figure {asked:?}; there are {names}"))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::Experiment;
    use crate::source::toy;
    use crate::table::DataFile;

    #[test]
    fn a_figure_is_found_by_its_name_and_its_number() {
        let draw = |_: &Results| Err(crate::experiments::Error::input("", "", "").into());
        let paper = Paper::new("toy", toy()).figure("fig03", &[], draw);
        let paper = paper.figure("s01", &[], draw).figure("spread", &[], draw);
        paper.check_names().unwrap();
        for (asked, name) in
            [("3", "fig03"), ("fig03", "fig03"), ("S1", "s01"), ("spread", "spread")]
        {
            assert_eq!(paper.find_figure(asked).map(|figure| figure.name).unwrap(), name);
        }
        assert!(paper.find_figure("16").err().unwrap().message.contains("fig03, s01, spread"));
        let twice = paper.figure("s01", &[], draw).check_names().unwrap_err().message;
        assert!(twice.starts_with("figures: the name s01: "), "{twice}");
        assert_eq!(twice.matches("src/paper.rs:").count(), 2, "{twice}");
        let open = |e: &Evidence<'_>| Ok(e.open("–"));
        let paper = Paper::new("toy", toy()).check("a", open).check("a", open);
        let twice = paper.check_names().unwrap_err().message;
        assert!(twice.starts_with("rules: the name a: "), "{twice}");
        const WALK: Experiment<(), ()> =
            Experiment::new("walk", |_| (), |(), _| Ok(()), |()| Vec::new());
        let paper = Paper::new("toy", toy()).experiment(&WALK).experiment(&WALK);
        let twice = paper.check_names().unwrap_err().message;
        assert_eq!(twice, "experiments: the name walk: number 1 and number 2; rename one");
        let outside = Paper::new("toy", toy()).figure("../../escaped", &[], draw);
        let fault = outside.check_names().unwrap_err().message;
        assert!(fault.contains("the name \"../../escaped\" has '/' in it"), "{fault}");
    }

    #[test]
    fn panels_with_one_file_of_data_are_refused() {
        let draw = |_: &Results| {
            let file = || DataFile { name: ".csv".into(), header: Vec::new(), rows: Vec::new() };
            Ok(Figure { data: vec![file(), file()], ..Figure::default() })
        };
        let paper = Paper::new("toy", toy()).figure("twins", &[], draw);
        let error = paper.figures[0].figure(&Results::made_up(Vec::new())).unwrap_err().message;
        assert!(error.contains("two panels name their data twins.csv"), "{error}");
    }
}

//! A paper: what it is made of. [`Paper::cli`] gives it a command line.

use crate::claims::{Case, Check, Judged, Published, Rule};
use crate::experiments::{AnyExperiment, DerivedTables, Results, Session};
use crate::failure::Failure;
use crate::figures::{self, Figure};
use crate::project::{Project, Sources};
use crate::report::ledger::EquationEntry;
use crate::report::{Document, Value};
use serde_json::Value as Json;
use std::collections::BTreeMap;

/// A figure of a paper: its name, the experiments whose results it shows, and how it is drawn.
#[derive(Clone, Copy)]
pub struct FigureSpec {
    /// Its name; its picture is `figures/NAME.svg`.
    pub name: &'static str,
    /// The experiments that it needs.
    pub needs: &'static [&'static dyn AnyExperiment],
    /// Draws it.
    pub draw: fn(&Results) -> Result<Figure, figures::Error>,
}

impl FigureSpec {
    /// Draws it, and gives it its name.
    pub fn figure(&self, results: &Results) -> Result<Figure, figures::Error> {
        let mut figure = (self.draw)(results)?;
        figure.data.iter_mut().for_each(|file| file.name.insert_str(0, self.name));
        let experiments = self.needs.iter().map(|need| need.name()).collect();
        // The item that draws it has its name.
        let source = format!("figures::{}", self.name);
        Ok(Figure { id: self.name.into(), source, experiments, ..figure })
    }

    /// Whether it is asked for by `text`: its name, or `3` for `fig03`.
    fn is(&self, text: &str) -> bool {
        let lower = text.to_lowercase();
        let digits = lower.trim_start_matches(char::is_alphabetic);
        let letters = lower.strip_suffix(digits).filter(|letters| !letters.is_empty());
        self.name == text || self.name == format!("{}{digits:0>2}", letters.unwrap_or("fig"))
    }
}

/// Holds numbers of the paper against one another.
pub type Judge = fn(&Results, &Published) -> Result<Vec<Check>, Failure>;

/// Values with names, which the prose may use like the cells of tables.
pub type Values = fn(&Results, &Published) -> Result<Vec<Value>, Failure>;

/// Rows of tables in the prose that are neither values nor checks, by the names that the prose uses.
pub type Rows = fn(&Results, &[Check]) -> Result<BTreeMap<&'static str, Json>, Failure>;

/// Makes the text of `lab.js`, which a page loads when a reader asks it to compute; none if it cannot be had here.
pub type Lab = fn(&Session<'_>, &Results) -> Result<Option<String>, Failure>;

/// A paper: its description, its experiments, figures and checks, and the documents that are written.
#[expect(missing_docs, reason = "the names tell")]
pub struct Paper {
    /// What it is, in a line of the help.
    pub title: &'static str,
    /// Name and affiliation of each author.
    pub authors: Vec<(&'static str, &'static str)>,
    /// Day of this version, YYYY-MM-DD; may be empty.
    pub date: &'static str,
    /// Its licence in words; may be empty.
    pub license: &'static str,
    pub project: Project,
    /// Folder of the prose, from the top of the project.
    pub prose: &'static str,
    /// Crates as paths of items name them, and the folders of their source; an empty name for the program.
    pub crates: Vec<(&'static str, &'static str)>,
    /// All experiments, in the order in which they run.
    pub experiments: Vec<&'static dyn AnyExperiment>,
    /// Tables that need several experiments.
    pub derived: Vec<DerivedTables>,
    pub figures: Vec<FigureSpec>,
    /// How each statement of `published.toml` is judged, by its id.
    pub rules: Vec<(&'static str, Box<Rule<'static>>)>,
    /// Judge what is no statement: relations between numbers.
    pub relations: Vec<Judge>,
    /// Path of the item that judges the statement with this id, for its card.
    pub judged_by: fn(&str) -> String,
    pub values: Vec<Values>,
    pub rows: Vec<Rows>,
    /// Equations that must have their place in the documents.
    pub equations: Vec<EquationEntry>,
    /// What pages load to compute.
    pub lab: Option<Lab>,
    pub documents: Vec<Document>,
}

impl std::fmt::Debug for Paper {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Paper {:?}", self.title)
    }
}

impl Paper {
    /// A paper with this title and source, one document `report`, and its prose in the folder `prose`.
    pub fn new(title: &'static str, sources: Sources) -> Self {
        Paper {
            title,
            authors: Vec::new(),
            date: "",
            license: "",
            project: Project::new(sources),
            prose: "prose",
            crates: vec![("", "src")],
            experiments: Vec::new(),
            derived: Vec::new(),
            figures: Vec::new(),
            rules: Vec::new(),
            relations: Vec::new(),
            judged_by: |_| String::new(),
            values: Vec::new(),
            rows: Vec::new(),
            equations: Vec::new(),
            lab: None,
            documents: vec![Document::REPORT],
        }
    }

    /// With one author more.
    pub fn author(mut self, name: &'static str, affiliation: &'static str) -> Self {
        self.authors.push((name, affiliation));
        self
    }

    /// With one experiment more.
    pub fn experiment(mut self, experiment: &'static dyn AnyExperiment) -> Self {
        self.experiments.push(experiment);
        self
    }

    /// With a rule that judges the statement with this id.
    pub fn check<C: Into<Judged>>(
        mut self,
        id: &'static str,
        rule: impl Fn(&Case<'_>) -> C + Send + Sync + 'static,
    ) -> Self {
        self.rules.push((id, Box::new(move |case| rule(case).into())));
        self
    }

    /// With one figure more, which shows results of these experiments.
    pub fn figure(
        mut self,
        name: &'static str,
        needs: &'static [&'static dyn AnyExperiment],
        draw: fn(&Results) -> Result<Figure, figures::Error>,
    ) -> Self {
        self.figures.push(FigureSpec { name, needs, draw });
        self
    }

    /// The figure that is asked for by its name or number: `spread`, `3`, `s1`.
    pub fn find_figure(&self, text: &str) -> Result<&FigureSpec, Failure> {
        self.figures.iter().find(|figure| figure.is(text)).ok_or_else(|| {
            let names: Vec<&str> = self.figures.iter().map(|figure| figure.name).collect();
            Failure::input(format!("there is no figure {text:?}; there are {}", names.join(", ")))
        })
    }

    pub(crate) fn byline(&self) -> String {
        let author = |(name, affiliation): &(&str, &str)| match affiliation.is_empty() {
            true => name.to_string(),
            false => format!("{name} ({affiliation})"),
        };
        let date = Some(self.date.to_string()).filter(|date| !date.is_empty());
        self.authors.iter().map(author).chain(date).collect::<Vec<_>>().join(", ")
    }

    /// Metadata in the head of each page: names of `<meta>` and their content.
    pub(crate) fn about(&self) -> Vec<(&'static str, String)> {
        let Sources { name, version, .. } = self.project.sources;
        let authors: Vec<&str> = self.authors.iter().map(|author| author.0).collect();
        let about = [
            ("author", authors.join(", ")),
            ("citation_author", authors.join("; ")),
            ("citation_title", name.into()),
            ("citation_publication_date", self.date.into()),
            ("version", version.into()),
            ("license", self.license.into()),
        ];
        about.into_iter().filter(|(_, words)| !words.is_empty()).collect()
    }

    /// A path as the documents show it, from that of the compiler.
    pub(crate) fn short<'a>(&self, path: &'a str) -> &'a str {
        let (first, rest) = path.split_once("::").unwrap_or(("", path));
        if first == self.project.sources.name.replace('-', "_") { rest } else { path }
    }

    /// The listing of an item: what stands in its file between the lines `// listing: NAME`, with the last name of its path,
    /// and `// end`, moved to the left edge.
    pub fn listing(&self, item: &str) -> Result<String, String> {
        let file = self.file(item);
        let text = self.project.sources.files.iter().find(|(path, _)| Some(*path) == file);
        let name = item.rsplit("::").next().unwrap_or_default();
        let mark = format!("// listing: {name}");
        let lines = text.map_or("", |(_, text)| text).lines();
        let inside = lines.skip_while(|line| line.trim() != mark).skip(1);
        let lines: Vec<&str> = inside.take_while(|line| line.trim() != "// end").collect();
        if lines.is_empty() {
            let marks = format!("the lines `{mark}` and `// end` in its file");
            return Err(format!("there is no listing `{item}`; it needs {marks}"));
        }
        let indent = lines.first().map_or(0, |line| line.len() - line.trim_start().len());
        let lines = lines.iter().map(|line| line.get(indent..).unwrap_or_default());
        Ok(lines.collect::<Vec<_>>().join("\n"))
    }

    /// The file of an item or a module, by its path: `impact_circuits::jump::p_jump` is in
    /// `crates/circuits/src/jump.rs`. None if the program has no such file.
    pub fn file(&self, item: &str) -> Option<&'static str> {
        let inside =
            |(name, folder): &(&str, &'static str)| Some((*folder, item.strip_prefix(name)?));
        let (folder, rest) = self.crates.iter().find_map(inside)?;
        let mut parts: Vec<&str> = rest.split("::").filter(|part| !part.is_empty()).collect();
        loop {
            let module = format!("{folder}/{}", parts.join("/"));
            let is = |path: &str| match path.strip_prefix(&module) {
                Some(".rs" | "/mod.rs") => true,
                Some("lib.rs" | "main.rs") => parts.is_empty(),
                _ => false,
            };
            let mut files = self.project.sources.files.iter();
            if let Some((path, _)) = files.find(|(path, _)| is(path)) {
                return Some(path);
            }
            parts.pop()?;
        }
    }
}

/// Name and setting of each parameter, the seed among them, field by field. Fields of fields get both names; a field with
/// several values has them all, of many the first and the last.
pub(crate) fn settings(parameters: &Json) -> Vec<(String, String)> {
    let mut all = Vec::new();
    collect("", parameters, &mut all);
    let listed = |values: &[String]| match values {
        [first, .., last] if values.len() > 8 => format!("{} from {first} to {last}", values.len()),
        few => few.join(", "),
    };
    all.into_iter().map(|(name, values)| (name, listed(&values))).collect()
}

/// Adds the values of a field, each once.
fn collect(name: &str, value: &Json, into: &mut Vec<(String, Vec<String>)>) {
    let shown = match value {
        Json::Null => return,
        Json::Array(list) => return list.iter().for_each(|one| collect(name, one, into)),
        Json::Object(fields) => {
            return fields.iter().for_each(|(field, value)| {
                let whole = format!("{name} {}", field.replace('_', " "));
                collect(whole.trim_start(), value, into);
            });
        }
        Json::String(text) => text.clone(),
        Json::Number(number) if number.is_f64() => number.as_f64().unwrap_or(f64::NAN).to_string(),
        other => other.to_string(),
    };
    match into.iter_mut().find(|(own, _)| own == name) {
        Some((_, values)) if values.contains(&shown) => (),
        Some((_, values)) => values.push(shown),
        None => into.push((name.into(), vec![shown])),
    }
}

#[cfg(test)]
pub(crate) fn toy() -> Paper {
    const FLIGHT: &str = "//! Free flight.\n\nimpl Motion {\n    // listing: kick\n    /// A jump of the velocity by ω \
               `kick`.\n    pub fn kick<const M: usize>(&mut self, kick: f64, p: &Phases<M>) {\n        self.a -= kick * \
               p.sin;\n        self.b += kick * p.cos;\n    }\n    // end\n}\n";
    let files = &[("src/flight.rs", FLIGHT), ("src/flight/drag/mod.rs", ""), ("src/lib.rs", "")];
    let sources = Sources { name: "toy-paper", version: "1", files };
    let paper =
        Paper { crates: vec![("toy", "src")], date: "2026-11-24", ..Paper::new("toy", sources) };
    paper.author("A. Uthor", "R & D").author("B. Uthor", "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_listing_is_what_stands_between_its_marks() {
        let kick = toy().listing("toy::flight::Motion::kick").unwrap();
        assert!(kick.starts_with("/// A jump") && kick.ends_with("p.cos;\n}"), "{kick}");
        let error = toy().listing("toy::flight::kik").unwrap_err();
        assert!(
            error.contains("`toy::flight::kik`") && error.contains("// listing: kik"),
            "{error}"
        );
    }

    #[test]
    fn an_item_has_the_file_of_its_module() {
        for (item, file) in [
            ("toy::flight::Motion::kick", Some("src/flight.rs")),
            ("toy::flight::drag::of", Some("src/flight/drag/mod.rs")),
            ("toy::Chain", Some("src/lib.rs")),
            ("other::kick", None),
        ] {
            assert_eq!(toy().file(item), file, "{item}");
        }
        assert_eq!(toy().short("toy_paper::claims::sec2"), "claims::sec2");
    }

    #[test]
    fn a_figure_is_found_by_its_name_and_its_number() {
        let named = |name| FigureSpec {
            name,
            needs: &[],
            draw: |_| Err(figures::Error::Drawing(String::new())),
        };
        let figures = ["fig03", "s01", "spread"].map(named).to_vec();
        let paper = Paper { figures, ..toy() };
        for (text, name) in
            [("3", "fig03"), ("fig03", "fig03"), ("S1", "s01"), ("spread", "spread")]
        {
            assert_eq!(paper.find_figure(text).map(|own| own.name).unwrap(), name);
        }
        assert!(paper.find_figure("16").err().unwrap().message.contains("fig03, s01, spread"));
    }

    #[test]
    fn parameters_of_parameters_have_both_names() {
        let parameters = serde_json::json!({"seed": 7, "chain": {"masses": 3}, "r": [0.5, 0.25],
            "runs": [{"from": 1.0, "to": 2}, {"from": 1.0, "to": 3}], "none": null});
        let shown: Vec<String> =
            settings(&parameters).iter().map(|(k, v)| format!("{k}={v}")).collect();
        let all = ["chain masses=3", "r=0.5, 0.25", "runs from=1", "runs to=2, 3", "seed=7"];
        assert_eq!(shown, all);
    }
}

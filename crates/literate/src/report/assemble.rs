//! Results and prose → every file of paper/, as bytes. Nothing is written here.

use super::Templates;
use super::bibliography::Library;
use super::card::Cards;
use super::claims::{Row, scorecard};
use super::document::{self, Block, Inline};
use super::filler::Filler;
use super::labels::Labels;
use super::ledger::EquationEntry;
use super::mark::Mark;
use super::uses::uses;
use super::values::Registry;
use super::{Error, appendix, html, labels, latex, ledger, lint, markdown, parse, sums};
use crate::claims::Check;
use crate::figures::Figure;
use crate::source::Program;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Paths relative to the report's folder, and their bytes.
pub type Files = BTreeMap<String, Vec<u8>>;

/// What a report is made of.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// The prose.
    pub templates: &'a Templates,
    /// The numbers that it may name.
    pub values: &'a Registry,
    /// Rows of tables that are not values or claims, by the name that templates use.
    pub rows: &'a BTreeMap<&'static str, serde_json::Value>,
    /// The judged statements.
    pub claims: &'a [Check],
    /// The figures.
    pub figures: &'a [Figure],
    /// The numbered equations of the paper.
    pub equations: &'a [EquationEntry],
    /// What moves in report.html.
    pub scene: Option<&'a html::Moving>,
    /// Whether report.pdf is wanted; the feature `pdf` makes it.
    pub pdf: bool,
    /// The program that makes it.
    pub program: Program,
}

/// A report in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Files that are committed; SHA256SUMS covers them.
    pub committed: Files,
    /// Files that stand beside them and are not committed: report.html, report.pdf if it was
    /// asked for, figures/*.pdf for LaTeX.
    pub beside: Files,
}

/// Makes the whole report.
///
/// # Errors
/// A naked numeral, an unknown or unused value, a reference to nothing, a figure that is missing
/// or not shown, markup or a character that a format lacks.
pub fn assemble(input: &Input<'_>) -> Result<Report, Error> {
    lint::check(input.templates)?;
    skins(input.templates)?;
    let mut values = input.values.clone();
    values.extend(scorecard(input.claims))?;
    let mut filler = Filler::new(input.templates, &values, input.program)?;
    let rows: Vec<Row> = input.claims.iter().map(Row::of).collect();
    filler.insert("claims", &rows);
    for (name, rows) in input.rows {
        filler.insert(name, rows);
    }
    let filled = filler.prose("report.md")?;
    let marks: Vec<Mark> = Mark::split(&filled.text).into_iter().flatten().collect();
    check_unused(&values, &marks)?;
    values.keep_cells(marks.iter().map(|mark| mark.id.as_str()));
    values.shorten(input.program);

    let (mut blocks, places) = parse::parse(&filled, &values, input.program)?;
    let tell = |error| places.tell(error);
    illustrate(&mut blocks, input.figures, input.program).map_err(tell)?;
    let library = Library::read(input.templates.text("references.bib")?)?;
    let labels = labels::resolve(&mut blocks, &library).map_err(tell)?;

    let mut committed = Files::new();
    let mut put = |path: String, text: String| committed.insert(path, text.into_bytes());
    put("report.md".into(), markdown::write(&blocks));
    filler.insert("title", &latex::title(&blocks)?);
    let uses = uses(input.claims, &values, &blocks);
    let ledger = ledger::ledger(input.claims, input.figures, input.equations, &uses);
    let cards = Cards { values: &values, ledger: &ledger, program: input.program };
    let printed = [blocks.as_slice(), &appendix::values(&blocks, cards)].concat();
    filler.insert("body", &latex::write(&printed)?);
    filler.insert("listings", &latex::listings(&blocks)?);
    put("report.tex".into(), filler.fill("report.tex")?);
    let json = |e: serde_json::Error| Error::Template(format!("values.json: {e}"));
    put("values.json".into(), serde_json::to_string_pretty(&values).map_err(json)? + "\n");
    put("ledger.json".into(), ledger::json(&ledger).map_err(json)?);
    put("ledger.md".into(), ledger::markdown(&ledger));
    let mut beside = Files::new();
    let moving = |scene| Ok((scene, input.templates.text("scene.js")?));
    let moving = input.scene.map(moving).transpose()?;
    filler.insert("page", &html::write(&blocks, input.figures, moving, cards)?);
    filler.insert("style", &input.templates.text("report.css")?);
    let page = filler.fill("report.html")?;
    html::is_whole(&page)?;
    beside.insert("report.html".into(), page.into_bytes());
    for figure in input.figures {
        committed.extend(files_of(figure));
    }
    let pdf =
        |figure: &Figure| (format!("figures/{}.pdf", figure.id), figure.drawing.pdf(&figure.title));
    beside.extend(input.figures.par_iter().map(pdf).collect::<Vec<_>>());
    if input.pdf {
        beside.insert("report.pdf".into(), typeset(&printed, input)?);
    }
    committed.insert(sums::NAME.into(), sums::write(&committed).into_bytes());
    check_links(&blocks, &labels, &committed, input.program).map_err(tell)?;
    Ok(Report { committed, beside })
}

#[cfg(feature = "pdf")]
fn typeset(blocks: &[Block], input: &Input<'_>) -> Result<Vec<u8>, Error> {
    super::typeset::pdf(blocks, input.figures, input.templates)
}

#[cfg(not(feature = "pdf"))]
fn typeset(_: &[Block], _: &Input<'_>) -> Result<Vec<u8>, Error> {
    Err(Error::NoTypesetter)
}

/// What stands around the text of the documents: it has a place for the text, and leaves nothing open and
/// nothing outside the one file that the page is.
fn skins(templates: &Templates) -> Result<(), Error> {
    let fault = |what: String| Err(Error::Template(what));
    // The text, the cards that its buttons open, the end of a document, and where the page's first link leads.
    let once = [
        ("report.tex", "«body»"),
        ("report.tex", "\\end{document}"),
        ("report.html", "«page.body»"),
        ("report.html", "«page.cards»"),
        ("report.html", "id=\"text\""),
    ];
    for (path, what) in once {
        let times = templates.text(path)?.matches(what).count();
        if times != 1 {
            return fault(format!("{path}: it has {what} {times} times; write it once"));
        }
    }
    if templates.text("report.html")?.contains("<script src") {
        return fault("report.html: <script src: the page is one file; put the script here".into());
    }
    for path in ["report.css", "scene.js"] {
        let Ok(text) = templates.text(path) else { continue };
        // It would end the element that it stands in.
        if text.contains("</") {
            return fault(format!("{path}: </ ends it in the page; write <\\/"));
        }
        let [open, close] = ['{', '}'].map(|brace| text.matches(brace).count());
        if open != close {
            return fault(format!("{path}: {open} times {{ and {close} times }}; one is missing"));
        }
    }
    let style = templates.text("report.css").unwrap_or_default();
    match ["@import", "url(http", "url(//", "url(\"http", "url('http"]
        .iter()
        .find(|what| style.contains(**what))
    {
        Some(what) => fault(format!(
            "report.css: {what}: the page is one file; put here what is to be imported"
        )),
        None => Ok(()),
    }
}

/// The picture of a figure and its data.
pub fn files_of(figure: &Figure) -> Files {
    let picture = (format!("figures/{}.svg", figure.id), figure.svg.clone().into_bytes());
    let data = figure.data.iter().map(|d| (format!("data/{}", d.name), d.csv().into_bytes()));
    std::iter::once(picture).chain(data).collect()
}

fn check_unused(values: &Registry, marks: &[Mark]) -> Result<(), Error> {
    let used: BTreeSet<&str> = marks.iter().map(|mark| values.id(&mark.id)).collect();
    let unused: Vec<&str> = values
        .iter()
        .filter(|value| !value.for_data_only && !used.contains(value.id.as_str()))
        .map(|value| value.id.as_str())
        .collect();
    if unused.is_empty() { Ok(()) } else { Err(Error::Unused(unused.join(", "))) }
}

/// Each link leads to a place of the report, a file or folder of it, a file of the project, or out.
fn check_links(
    blocks: &[Block],
    labels: &Labels,
    files: &Files,
    program: Program,
) -> Result<(), Error> {
    let leads =
        |to: &str| match (to.split_once("://"), to.strip_prefix('#'), to.strip_prefix("../")) {
            (Some(_), ..) => true,
            (_, Some(id), _) => labels.number(&id.replacen('-', ":", 1)).is_some(),
            (.., Some(path)) => (program.exists)(path),
            _ => files.keys().any(|path| path == to || path.starts_with(&format!("{to}/"))),
        };
    let mut result = Ok(());
    document::visit(blocks, &mut |inline| {
        if let Inline::Link { to, .. } = inline
            && result.is_ok()
            && !leads(to)
        {
            result = Err(Error::NoFile(to.clone()));
        }
    });
    result
}

/// Gives the figures in the prose their alternative text and data; each is shown exactly once
/// ([`labels::resolve`] refuses twice).
fn illustrate(blocks: &mut [Block], figures: &[Figure], program: Program) -> Result<(), Error> {
    let mut shown = BTreeSet::new();
    for block in blocks {
        if let Block::Figure { path, alt, data, code, experiments, .. } = block {
            let figure =
                figures.iter().find(|figure| *path == format!("figures/{}.svg", figure.id));
            let figure = figure.ok_or_else(|| Error::NoFile(path.clone()))?;
            *alt = figure.description.clone();
            *data = figure.data.iter().map(|d| format!("data/{}", d.name)).collect();
            *code = program.file(&figure.source).map(|file| format!("../{file}"));
            *experiments = figure.experiments.clone();
            shown.insert(figure.id.as_str());
        }
    }
    match figures.iter().find(|figure| !shown.contains(figure.id.as_str())) {
        Some(figure) => Err(Error::NotShown(figure.id.clone())),
        None => Ok(()),
    }
}

//! Assembles a report: from results and prose makes every file of it, as bytes. It writes no file.

use super::bibliography::Library;
use super::card::{Cards, link_to_line};
use super::claims::{scorecard, to_row};
use super::document::{self, Block, Inline};
use super::edition::Document;
use super::error::{Error, Thing};
use super::filled::{Filled, Part};
use super::filler::Filler;
use super::folder::{self, Files, SUMS, is_generated};
use super::input::Input;
use super::labels::Labels;
use super::ledger::{EquationEntry, FigureEntry, Ledger};
use super::mark;
use super::values::ValueRegistry;
use super::{coded, html, latex, ledger, markdown, parse, search, tex};
use crate::claims::Check;
use crate::figures::Figure;
use crate::input::Place;
use crate::names::Names;
use crate::table::{DataFile, Table};
use rayon::iter::Either;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Makes the whole report in memory. What is wrong with the prose of all documents is reported at
/// once: first what Tera says, then what can be read and resolved, then what can be written.
pub fn assemble(mut filler: Filler, input: &Input<'_>) -> Result<Files, Error> {
    let tables: Vec<&Table> = input.values.tables().collect();
    let data_of_tables = tables.par_iter().map(|table| data(&DataFile::from_table(table)));
    let figure = |figure: &Figure| files_of(figure, input.edition.license);
    let figures = input.figures.par_iter().flat_map_iter(figure);
    let data_and_figures = || data_of_tables.chain(figures).collect::<Files>();
    let (filled, mut files) = rayon::join(|| fill(input, &mut filler), data_and_figures);
    let (values, filled) = filled?;
    check_files(&tables, input.figures)?;

    let of_parts = Input { values: &values, ..*input };
    let read_parts = || parts(&of_parts, &filled);
    let (read_parts, hard_coded) = rayon::join(read_parts, || coded::check(input));
    all_in_order(hard_coded)?;
    let (parts, labels, ledger) = read_parts?;
    let cover = input.edition.cover.and_then(|cover| input.figure(cover));
    let style = input.templates.text("report.css")?;
    files.extend(cover.and_then(|figure| dark(figure, style)));
    let jsons = [serde_json::to_vec_pretty(&values), serde_json::to_vec_pretty(&ledger)];
    for (name, json) in ["values.json", "ledger.json"].into_iter().zip(jsons) {
        files.insert(name.into(), [json.unwrap_or_default(), b"\n".into()].concat());
    }
    let mut errors = Vec::new();
    let opened = write_documents(input, &parts, &mut filler, &mut files, &mut errors)?;
    for part in &parts {
        errors.extend(check_links(part, &labels, &files, input));
    }
    all_in_order(errors)?;
    let Input { edition, project, experiments, .. } = *input;
    let (values, ledger, shared) = (&values, &ledger, Default::default());
    let cards = Cards { values, ledger, edition, project, experiments, shared };
    files.extend(html::shared::files(&opened, &cards, input, &labels)?);
    folder::add_lists(&mut files);
    Ok(files)
}

/// Fills the prose of each document; returns also the values, with the scorecard and the cells that
/// the prose shows among them.
fn fill(input: &Input<'_>, filler: &mut Filler) -> Result<(ValueRegistry, Vec<Filled>), Error> {
    let mut values = input.values.clone();
    let (printed, relations): (Vec<Check>, Vec<Check>) =
        input.claims.iter().cloned().partition(|claim| claim.kind.is_printed());
    values.extend(scorecard(&printed))?;
    filler.insert_values(&values);
    for (name, checks) in [("claims", printed), ("relations", relations)] {
        filler.context.insert(name, &checks.iter().map(to_row).collect::<Vec<_>>());
    }
    filler.context.insert("figures", &ledger::figures(input.figures));
    filler.context.insert("equations", &input.edition.equations);
    for (name, rows) in input.rows {
        filler.context.insert(*name, rows);
    }
    let documents = input.edition.documents.par_iter().with_max_len(1);
    let prose = documents.map(|document| filler.prose(document));
    let (filled, errors): (Vec<Filled>, Vec<Error>) =
        prose.partition_map(|prose| prose.map_or_else(Either::Right, Either::Left));
    all_in_order(errors)?;
    let shown = filled.iter().flat_map(|filled| mark::values(&filled.text));
    values.list(shown.map(|(id, ..)| id), &input.project.sources);
    Ok((values, filled))
}

/// Fails if there are errors, with each of them once, in the order of their places.
fn all_in_order(mut errors: Vec<Error>) -> Result<(), Error> {
    errors.sort_by(|a, b| a.place().cmp(&b.place()));
    errors.dedup_by_key(|error| error.to_string());
    if errors.is_empty() { Ok(()) } else { Err(Error::Several(errors)) }
}

/// Reads all documents into trees, with figures, numbers and references, and makes the ledger.
fn parts<'a>(
    input: &Input<'a>,
    filled: &'a [Filled],
) -> Result<(Vec<Part<'a>>, Labels, Ledger), Error> {
    let path = input.templates.place("references.bib");
    let library = Library::read(&path, input.templates.text("references.bib")?)?;
    let (mut labels, mut errors) = (Labels::new(input.claims), Vec::new());
    let read = |(filled, document): (&'a Filled, &Document)| parse::parse(filled, *document, input);
    let documents = filled.par_iter().zip(&input.edition.documents);
    let mut parts: Vec<Part<'_>> = documents.with_max_len(1).map(read).collect();
    let is_broken = parts.iter().any(|part| !part.errors.is_empty());
    let linked = |inline| match inline {
        Inline::Code(item) if item.contains("::") => link_to_line(&item, input.project),
        other => other,
    };
    let relative = &mut |inline| document::relative_link(linked(inline), input.top);
    for part in &mut parts {
        errors.append(&mut part.errors);
        document::rewrite(&mut part.blocks, relative);
        let numbered = labels.number_all(&mut part.blocks, part.document).into_iter();
        errors.extend(numbered.map(|error| part.locate(error)));
    }
    let ledger = ledger_of(input, &parts, &labels);
    // What a block with an error shows or names is not known.
    if !is_broken {
        let not_shown = ledger.figures.iter().filter(|figure| figure.label.is_empty());
        errors.extend(not_shown.map(|FigureEntry { id, .. }| {
            let remedy = format!("put ![caption](figures/{id}.svg) into the prose");
            Error::Rule(format!("figure {id} is not shown; {remedy}"))
        }));
        for EquationEntry { number, .. } in &input.edition.equations {
            if labels.get(&format!("eq:{number}")).is_none() {
                let remedy = format!("add \\tag{{{number}}} to it in the prose");
                errors.push(Error::Message(format!("equation ({number}) is not shown; {remedy}")));
            }
        }
    }
    errors.extend(labels.add_keys(library.keys()));
    // What stands in a block with an error has an id without a number.
    for part in parts.iter().filter(|_| is_broken) {
        labels.add_missing(part);
    }
    for part in &mut parts {
        let unresolved = labels.resolve(&mut part.blocks, part.document, &library).into_iter();
        errors.extend(unresolved.map(|error| part.locate(error)));
    }
    all_in_order(errors)?;
    library.warnings().for_each(|line| (input.warn)(&line));
    Ok((parts, labels, ledger))
}

/// Makes the ledger, in which figures have the labels and numbers that the documents give them.
fn ledger_of(input: &Input<'_>, parts: &[Part<'_>], labels: &Labels) -> Ledger {
    let mut figures = ledger::figures(input.figures);
    for block in parts.iter().filter(|part| !part.document.repeats).flat_map(|part| &part.blocks) {
        let Block::Figure { id, number, name, .. } = block else { continue };
        if let Some(entry) = figures.iter_mut().find(|figure| figure.id == *name) {
            (entry.label, entry.number) = (id.clone(), number.clone());
        }
    }
    let mut claims = input.claims.to_vec();
    // A relation that has no place in a document is one of `check` alone.
    let is_shown = |claim: &Check| labels.get(&format!("claim:{}", claim.id)).is_some();
    claims.retain(|claim| claim.kind.is_printed() || is_shown(claim));
    Ledger { claims, figures, equations: input.edition.equations.clone() }
}

/// Adds each document in its formats; returns the ids of all things of which a page opens the card.
fn write_documents(
    input: &Input<'_>,
    parts: &[Part<'_>],
    filler: &mut Filler,
    files: &mut Files,
    errors: &mut Vec<Error>,
) -> Result<BTreeSet<String>, Error> {
    let edition = input.edition;
    let write = |part: &Part<'_>| {
        let Part { document, blocks, .. } = part;
        let print = latex::write(blocks, *document, edition);
        let passages = search::passages(blocks, document.name);
        (print, html::write(part, input), markdown::write(blocks), passages)
    };
    let written = || parts.par_iter().with_max_len(1).map(write).collect::<Vec<_>>();
    let (written, (index, points)) = rayon::join(written, || {
        rayon::join(|| html::shared::data_index(files, edition), || points_of(input.figures))
    });
    let (mut opened, mut texts) = (BTreeSet::new(), Vec::new());
    for (part, written) in parts.iter().zip(written) {
        let document = part.document;
        let (print, (page, values, faults), mut markdown, passages) = written;
        let unknown = tex::unknown(&print.to_string()).into_iter();
        errors.extend(unknown.map(|c| Error::no_latex(c).with_place(part.place_of(c))));
        errors.extend(faults.into_iter().map(|error| part.locate(error)));
        let byline = edition.byline(document);
        if !byline.is_empty() {
            let byline = format!("\n\n*{}*\n\n", markdown::escape_text(&byline));
            markdown = markdown.replacen("\n\n", &byline, 1);
        }
        files.insert(document.markdown.into(), markdown.into_bytes());
        if let Some(name) = document.print {
            filler.context.insert("print", &print);
            let tex = filler.fill("report.tex")?;
            files.insert(format!("{name}.tex"), tex.into_bytes());
        }
        filler.context.insert("page", &page);
        files.insert(document.page.into(), filler.fill("report.html")?.into_bytes());
        opened.extend(values);
        texts.push(serde_json::json!([document.page, document.name, passages]));
    }
    filler.context.insert("page", &index);
    files.insert("data/index.html".into(), filler.fill("data.html")?.into_bytes());
    let texts = format!("TEXTS = {};\n", serde_json::Value::from(texts));
    files.insert("search.js".into(), texts.into_bytes());
    files.insert("points.js".into(), format!("POINTS = {points};\n").into_bytes());
    for name in ["report.css", "report.js"] {
        files.insert(name.into(), input.templates.text(name)?.as_bytes().to_vec());
    }
    if let Some(lab) = input.lab {
        files.insert("lab.js".into(), lab.as_bytes().to_vec());
    }
    Ok(opened)
}

/// Returns what the figures show, for readers who point at it, if it is not too long.
fn points_of(figures: &[Figure]) -> serde_json::Value {
    let points = figures.iter().map(|figure| {
        let short = figure.data.iter().filter(|file| file.rows.len() < 2000);
        (figure.id.as_str(), short.map(DataFile::to_csv).collect::<Vec<_>>())
    });
    serde_json::json!(points.collect::<BTreeMap<_, _>>())
}

/// Returns a figure's picture for a dark page, in the colours of the style sheet, if it has any.
fn dark(figure: &Figure, style: &str) -> Option<(String, Vec<u8>)> {
    let (_, dark) = style.split_once("prefers-color-scheme: dark")?;
    let (dark, _) = dark.split_once('}')?;
    let colours = dark.split("--").filter_map(|rule| rule.split(';').next()?.split_once(": "));
    let rule =
        |(name, colour)| format!(".fill-{name}{{fill:{colour}}}.stroke-{name}{{stroke:{colour}}}");
    let rules: String = colours.map(rule).collect();
    let picture = figure.svg().replacen("</style>", &(rules + "</style>"), 1);
    Some((format!("figures/{}-dark.svg", figure.id), picture.into_bytes()))
}

/// Returns the files of a figure: its picture, which names this licence, and its data.
pub fn files_of(figure: &Figure, license: &str) -> Files {
    let files = figure.files(license).into_iter();
    let picture = files.map(|(name, bytes)| (format!("figures/{name}"), bytes));
    picture.chain(figure.data.iter().map(data)).collect()
}

/// Refuses two files of data with one name.
fn check_files(tables: &[&Table], figures: &[Figure]) -> Result<(), Error> {
    let table = |table: &&Table| (DataFile::file_name(table.name()), table.place());
    let figure = |figure: &Figure| {
        let place = format!("the figure {}", figure.id);
        figure.data.iter().map(|file| (file.name.clone(), place.clone())).collect::<Vec<_>>()
    };
    let mut files = tables.iter().map(table).chain(figures.iter().flat_map(figure));
    let mut names = Names::default();
    let outcome = files.try_for_each(|(name, place)| names.add(&name, &place));
    outcome.map_err(|problem| Error::Message(format!("data: {problem}")))
}

fn data(file: &DataFile) -> (String, Vec<u8>) {
    (format!("data/{}", file.name), file.to_csv().into_bytes())
}

/// Returns an error for each link that leads neither to a place or a file nor to the web.
fn check_links(part: &Part<'_>, labels: &Labels, files: &Files, input: &Input<'_>) -> Vec<Error> {
    let committed = || files.keys().map(String::as_str).filter(|path| !is_generated(path));
    let is_page = |to: &str| input.edition.documents.iter().any(|document| document.page == to);
    let is_good = |to: &str| match (to.split_once("://"), to.strip_prefix('#')) {
        (Some((scheme, _)), _) => ["https", "http"].contains(&scheme),
        (_, Some(id)) => {
            let label = labels.get(&id.replacen('-', ":", 1));
            !id.contains(':') && label.is_some_and(|label| label.document == part.document)
        }
        _ if to.starts_with("../") => input.project.exists(&to[3..]),
        _ if to.starts_with("mailto:") || is_page(to) || to == SUMS => true,
        _ => committed().any(|path| path == to || path.starts_with(&format!("{to}/"))),
    };
    let error = |(to, place): (&str, Place)| {
        let problem =
            format!("a link to {to}: there is no such file or place; correct or remove it");
        Error::unknown(Thing::Link, to, &problem, committed()).with_place(place)
    };
    part.named(Thing::Link).filter(|(to, _)| !is_good(to)).map(error).collect()
}

//! Assembles a report: from results and prose makes every file of it, as bytes. It writes no file.

use super::bibliography::Library;
use super::card::{Cards, links};
use super::claims::{row, scorecard};
use super::document::{self, Block, Inline};
use super::edition::{Document, Edition};
use super::error::Error;
use super::filled::{Filled, Places};
use super::filler::Filler;
use super::folder::{self, Files, Report, SUMS};
use super::input::{Input, LAB};
use super::labels::Labels;
use super::ledger::{EquationEntry, Ledger};
use super::lint::Declared;
use super::mark::ids;
use super::values::{Registry, Value};
use super::{html, latex, ledger, lint, markdown, parse, search, tex};
use crate::figures::{DataFile, Figure};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// A document as a tree.
struct Part<'a> {
    document: Document,
    blocks: Vec<Block>,
    places: Places<'a>,
}

/// Makes the whole report in memory.
pub fn assemble(input: &Input<'_>) -> Result<Report, Error> {
    let (mut values, mut filler, filled) = fill(input)?;
    let used: BTreeSet<String> = filled.iter().flat_map(|filled| ids(&filled.text)).collect();
    let is_unused = |value: &&Value| !value.for_data_only && !used.contains(&value.id);
    let unused: Vec<&str> = values.iter().filter(is_unused).map(|v| v.id.as_str()).collect();
    if !unused.is_empty() {
        return Err(Error::Unused(unused.join(", ")));
    }
    values.keep_cells(used.iter().map(String::as_str));
    values.shorten(&input.project.sources);

    let declared = filler.declared.clone();
    let (parts, labels) = parts(input, &filled, &values, &declared)?;
    let ledger = ledger_of(input, &parts);
    let mut report = Report::default();
    data_files(input, &values, &ledger, &mut report)?;
    let shown = write_documents(input, &parts, &mut filler, &mut report)?;
    let Input { edition, project, experiments, .. } = *input;
    let cards = Cards { values: &values, ledger: &ledger, edition, project, experiments };
    report.generated.extend(html::shared::files(&shown, cards, input, &labels)?);
    report.committed.insert(SUMS.into(), folder::sums(&report.committed).into_bytes());
    for Part { document, blocks, places } in &parts {
        check_links(blocks, *document, &labels, &report.committed, edition)
            .map_err(|error| places.locate(error))?;
    }
    Ok(report)
}

/// Fills the prose of each document; returns the values with the scorecard among them, the filler
/// with all names that templates use, and the filled prose.
fn fill(input: &Input<'_>) -> Result<(Registry, Filler, Vec<Filled>), Error> {
    let mut values = input.values.clone();
    values.extend(scorecard(input.claims))?;
    let mut filler = Filler::new(input.templates)?.with(&values);
    check_texts(input, &filler.declared)?;
    filler.insert("claims", &input.claims.iter().map(row).collect::<Vec<_>>());
    filler.insert("figures", &ledger::figures(input.figures));
    filler.insert("equations", &input.edition.equations);
    for (name, rows) in input.rows {
        filler.insert(name, rows);
    }
    let filled = input.edition.documents.iter().map(|document| filler.prose(document));
    let filled = filled.collect::<Result<_, _>>()?;
    Ok((values, filler, filled))
}

/// Refuses hard-coded numbers in the reasons of checks and the descriptions of figures.
fn check_texts(input: &Input<'_>, declared: &Declared) -> Result<(), Error> {
    let mut errors = Vec::new();
    for claim in input.claims {
        let place = format!("the reason of {}", claim.id);
        errors.extend(lint::check(&place, &claim.reason, declared).err());
    }
    for figure in input.figures {
        // What stands in braces is computed where the figure is drawn.
        let parts = figure.description.typed.split('{');
        let typed = parts.map(|part| part.split_once('}').map_or(part, |(_, typed)| typed));
        let place = format!("what {} shows", figure.id);
        errors.extend(lint::check(&place, &typed.collect::<String>(), declared).err());
    }
    Error::all(errors)
}

/// Reads all documents into trees, with their figures, numbers and references.
fn parts<'a>(
    input: &Input<'a>,
    filled: &'a [Filled],
    values: &'a Registry,
    declared: &'a Declared,
) -> Result<(Vec<Part<'a>>, Labels), Error> {
    let library = Library::read(input.templates.text("references.bib")?)
        .map_err(|error| Error::Template(input.templates.place(&error.to_string())))?;
    let (mut labels, mut shown) = (Labels::default(), BTreeSet::new());
    let mut parts = Vec::new();
    let read = |filled| parse::parse(filled, values, declared, &input.project.sources);
    let read = filled.par_iter().with_max_len(1).map(read).collect::<Vec<_>>();
    let (read, errors): (Vec<_>, Vec<_>) = read.into_iter().partition(Result::is_ok);
    Error::all(errors.into_iter().filter_map(Result::err).collect())?;
    for ((document, filled), read) in input.edition.documents.iter().zip(filled).zip(read) {
        let (mut blocks, places) = read?;
        document::title(&blocks).map_err(|error| error.at(filled.place(0)))?;
        let locate = |error| places.locate(error);
        let figures = illustrate(&mut blocks, input).map_err(locate)?;
        labels.number_all(&mut blocks, *document).map_err(locate)?;
        if !document.repeats {
            shown.extend(figures);
        }
        parts.push(Part { document: *document, blocks, places });
    }
    if let Some(figure) = input.figures.iter().find(|figure| !shown.contains(&figure.id)) {
        return Err(Error::NotShown(figure.id.clone()));
    }
    let missing = |entry: &&EquationEntry| labels.get(&format!("eq:{}", entry.number)).is_none();
    if let Some(entry) = input.edition.equations.iter().find(missing) {
        return Err(Error::NoEquation(entry.number.to_string()));
    }
    labels.add_verdicts(input.claims).map_err(|error| {
        parts.iter().fold(error, |error, part: &Part<'_>| part.places.locate(error))
    })?;
    for Part { document, blocks, places } in &mut parts {
        labels.resolve(blocks, *document, &library).map_err(|error| places.locate(error))?;
    }
    Ok((parts, labels))
}

/// Makes the ledger, in which figures have the labels and numbers that the documents give them.
fn ledger_of(input: &Input<'_>, parts: &[Part<'_>]) -> Ledger {
    let mut figures = ledger::figures(input.figures);
    for block in parts.iter().filter(|part| !part.document.repeats).flat_map(|part| &part.blocks) {
        let Block::Figure { id, number, name, .. } = block else { continue };
        if let Some(entry) = figures.iter_mut().find(|figure| figure.id == *name) {
            (entry.label, entry.number) = (id.clone(), number.clone());
        }
    }
    let equations = input.edition.equations.clone();
    Ledger { claims: input.claims.to_vec(), figures, equations }
}

/// Adds values, ledger, tables and figures.
fn data_files(
    input: &Input<'_>,
    values: &Registry,
    ledger: &Ledger,
    report: &mut Report,
) -> Result<(), Error> {
    let jsons = [
        ("values.json", serde_json::to_string_pretty(values)),
        ("ledger.json", serde_json::to_string_pretty(ledger)),
    ];
    for (name, json) in jsons {
        let json = json.map_err(|error| Error::Template(format!("{name}: {error}")))? + "\n";
        report.committed.insert(name.into(), json.into_bytes());
    }
    for files in input.figures.par_iter().map(files_of).collect::<Vec<_>>() {
        report.committed.extend(files.committed);
        report.generated.extend(files.generated);
    }
    report.committed.extend(values.tables().map(|table| data(&DataFile::of(table))));
    Ok(())
}

/// Adds each document in its formats, and what its pages load; returns the ids of all values and
/// statements of which a page opens the card.
fn write_documents(
    input: &Input<'_>,
    parts: &[Part<'_>],
    filler: &mut Filler,
    report: &mut Report,
) -> Result<BTreeSet<String>, Error> {
    let edition = input.edition;
    let write = |part: &Part<'_>| {
        let latex = latex::write(&part.blocks, part.document)?;
        Ok((latex, html::write(&part.blocks, part.document, input)?))
    };
    let written = parts.par_iter().with_max_len(1).map(write);
    let written = written.collect::<Vec<Result<_, Error>>>();
    let mut authors = Vec::new();
    for (name, affiliation) in &edition.authors {
        authors.push([tex::text(name)?, tex::text(affiliation)?]);
    }
    filler.insert("authors", &authors);
    filler.insert("date", &edition.date);
    let (mut shown, mut texts) = (BTreeSet::new(), Vec::new());
    for (Part { document, blocks, places }, written) in parts.iter().zip(written) {
        let (print, (page, values)) = written.map_err(|error| places.locate(error))?;
        let mut text = markdown::write(blocks);
        if document.is_signed(edition) {
            let byline = format!("\n\n*{}*\n\n", markdown::escaped(&edition.byline()));
            text = text.replacen("\n\n", &byline, 1);
        }
        report.committed.insert(document.markdown.into(), text.into_bytes());
        if let Some(name) = document.print {
            filler.insert("print", &print);
            let text = filler.fill("report.tex")?;
            report.committed.insert(format!("{name}.tex"), text.into_bytes());
        }
        filler.insert("page", &page);
        report.generated.insert(document.page.into(), filler.fill("report.html")?.into_bytes());
        shown.extend(values);
        let passages = search::passages(blocks, document.name);
        texts.push(serde_json::json!([document.page, document.name, passages]));
    }
    let texts = format!("TEXTS = {};\n", serde_json::Value::from(texts));
    report.generated.insert("search.js".into(), texts.into_bytes());
    for name in ["report.css", "report.js"] {
        report.generated.insert(name.into(), input.templates.text(name)?.as_bytes().to_vec());
    }
    if let Some(lab) = input.lab {
        report.generated.insert(LAB.into(), lab.as_bytes().to_vec());
    }
    Ok(shown)
}

/// Returns the files of the picture of a figure, and its data.
pub fn files_of(figure: &Figure) -> Report {
    let mut report = Report::default();
    for (name, bytes) in figure.files() {
        let path = format!("figures/{name}");
        let is_generated = folder::is_generated(&path);
        let files = if is_generated { &mut report.generated } else { &mut report.committed };
        files.insert(path, bytes);
    }
    report.committed.extend(figure.data.iter().map(data));
    report
}

fn data(file: &DataFile) -> (String, Vec<u8>) {
    (format!("data/{}", file.name), file.csv().into_bytes())
}

/// Checks that each link leads to a place of its document, to a file or folder of the report or of
/// the project, or to the web.
fn check_links(
    blocks: &[Block],
    here: Document,
    labels: &Labels,
    files: &Files,
    edition: &Edition,
) -> Result<(), Error> {
    let is_page = |to: &str| edition.documents.iter().any(|document| document.page == to);
    let leads = |to: &str| match (to.split_once("://"), to.strip_prefix('#')) {
        (Some((scheme, _)), _) => ["https", "http"].contains(&scheme),
        (_, Some(id)) => {
            let label = labels.get(&id.replacen('-', ":", 1));
            !id.contains(':') && label.is_some_and(|label| label.document == here)
        }
        // `illustrate` has checked links to the project, which may be rewritten since.
        _ if to.starts_with('.') || to.starts_with("mailto:") || is_page(to) => true,
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

/// Adds alternative texts, data and code to the figures of a document, and makes links to files of
/// the project relative to the folder of the report; returns the names of the figures.
fn illustrate(blocks: &mut [Block], input: &Input<'_>) -> Result<Vec<String>, Error> {
    let mut shown = Vec::new();
    for block in blocks.iter_mut() {
        if let Block::Figure { name, files, alt, origin, .. } = block {
            let figure = input.figure(name)?;
            let names = figure.names();
            if files[0] != names[0] {
                return Err(Error::Picture(files[0].clone()));
            }
            *files = names;
            *alt = figure.description.text.clone();
            let words = |words: &str| Inline::Text(words.into());
            let data: Vec<String> =
                figure.data.iter().map(|file| format!("data/{}", file.name)).collect();
            let code = input.project.sources.file(&figure.source).map(|file| format!("../{file}"));
            for (name, files) in [("Data: ", data), ("Code: ", code.into_iter().collect())] {
                if !files.is_empty() {
                    origin.push(words(if origin.is_empty() { "" } else { " " }));
                    origin.push(words(name));
                    origin.extend(links(&files));
                    origin.push(words("."));
                }
            }
            shown.push(figure.id.clone());
        }
    }
    document::rewrite(blocks, &mut |inline| match &inline {
        Inline::Link { to, .. } => match to.strip_prefix("../") {
            Some(path) if !input.project.exists(path) => Err(Error::NoFile(to.clone())),
            _ => Ok(document::relative_link(inline, input.top)),
        },
        _ => Ok(vec![inline]),
    })?;
    Ok(shown)
}

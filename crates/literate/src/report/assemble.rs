//! Results and prose → every file of paper/, as bytes. Nothing is written here.

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
use super::values::Registry;
use super::{html, latex, ledger, lint, markdown, parse, search, tex};
use crate::figures::{DataFile, Figure};
use rayon::prelude::*;
use std::collections::BTreeSet;

struct Part<'a> {
    of: Document,
    blocks: Vec<Block>,
    places: Places<'a>,
}

/// The values with the scorecard among them, the filler with all names that templates use, and the prose of each
/// document as it was filled.
fn fill(input: &Input<'_>) -> Result<(Registry, Filler, Vec<Filled>), Error> {
    let mut values = input.values.clone();
    values.extend(scorecard(input.claims))?;
    let mut filler = Filler::new(input.templates)?.with(&values);
    let reasons =
        input.claims.iter().map(|c| (format!("the reason of {}", c.id), c.reason.clone()));
    // What stands in braces is computed where the figure is drawn.
    let shown = |figure: &Figure| {
        let parts = figure.description.typed.split('{');
        parts.map(|part| part.split_once('}').map_or(part, |(_, typed)| typed)).collect()
    };
    let shown = input.figures.iter().map(|f| (format!("what {} shows", f.id), shown(f)));
    let lint = |(place, text): (String, String)| lint::check(&place, &text, &filler.declared).err();
    Error::all(reasons.chain(shown).filter_map(lint).collect())?;
    filler.insert("claims", &input.claims.iter().map(row).collect::<Vec<_>>());
    filler.insert("figures", &ledger::figures(input.figures));
    filler.insert("equations", &input.edition.equations);
    for (name, rows) in input.rows {
        filler.insert(name, rows);
    }
    let filled = input.edition.documents.iter().map(|of| filler.prose(of));
    let filled = filled.collect::<Result<_, _>>()?;
    Ok((values, filler, filled))
}

/// Makes the whole report.
pub fn assemble(input: &Input<'_>) -> Result<Report, Error> {
    let (mut values, mut filler, filled) = fill(input)?;
    let used: BTreeSet<String> = filled.iter().flat_map(|filled| ids(&filled.text)).collect();
    let unused = values.iter().filter(|own| !own.for_data_only && !used.contains(&own.id));
    let unused: Vec<&str> = unused.map(|value| value.id.as_str()).collect();
    if !unused.is_empty() {
        return Err(Error::Unused(unused.join(", ")));
    }
    values.keep_cells(used.iter().map(String::as_str));
    values.shorten(&input.project.sources);

    let declared = filler.declared.clone();
    let (parts, labels) = parts(input, &filled, &values, &declared)?;
    let mut ledger = Ledger {
        claims: input.claims.to_vec(),
        figures: ledger::figures(input.figures),
        equations: input.edition.equations.clone(),
    };
    for block in parts.iter().filter(|part| !part.of.repeats).flat_map(|part| &part.blocks) {
        let Block::Figure { id, number, name, .. } = block else { continue };
        let entry = ledger.figures.iter_mut().find(|figure| figure.id == *name);
        if let Some(entry) = entry {
            (entry.label, entry.number) = (id.clone(), number.clone());
        }
    }

    let (mut committed, mut generated) = (Files::new(), Files::new());
    let [values_json, ledger_json] =
        [serde_json::to_string_pretty(&values), serde_json::to_string_pretty(&ledger)];
    for (name, json) in [("values.json", values_json), ("ledger.json", ledger_json)] {
        let json = json.map_err(|error| Error::Template(format!("{name}: {error}")))? + "\n";
        committed.insert(name.into(), json.into_bytes());
    }
    let Input { edition, project, experiments, .. } = *input;
    let cards = Cards { values: &values, ledger: &ledger, edition, project, experiments };
    let (mut shown, mut texts) = (BTreeSet::new(), Vec::new());
    let written = parts.par_iter().with_max_len(1).map(|Part { of, blocks, .. }| {
        Ok((latex::write(blocks, *of)?, html::write(blocks, *of, input)?))
    });
    let written = written.collect::<Vec<Result<_, Error>>>();
    let authors =
        edition.authors.iter().map(|(name, place)| Ok([tex::text(name)?, tex::text(place)?]));
    filler.insert("authors", &authors.collect::<Result<Vec<_>, Error>>()?);
    filler.insert("date", &edition.date);
    for (Part { of, blocks, places }, written) in parts.iter().zip(written) {
        let (print, (page, values)) = written.map_err(|error| places.locate(error))?;
        let mut text = markdown::write(blocks);
        if of.is_signed(edition) {
            let byline = format!("\n\n*{}*\n\n", markdown::escaped(&edition.byline()));
            text = text.replacen("\n\n", &byline, 1);
        }
        committed.insert(of.markdown.into(), text.into_bytes());
        if let Some(name) = of.print {
            filler.insert("print", &print);
            committed.insert(format!("{name}.tex"), filler.fill("report.tex")?.into_bytes());
        }
        filler.insert("page", &page);
        shown.extend(values);
        texts.push(serde_json::json!([of.page, of.name, search::passages(blocks, of.name)]));
        generated.insert(of.page.into(), filler.fill("report.html")?.into_bytes());
    }
    generated.extend(html::beside(&shown, cards, input, &labels)?);
    let texts = format!("TEXTS = {};\n", serde_json::Value::from(texts));
    generated.insert("search.js".into(), texts.into_bytes());
    for name in ["report.css", "report.js"] {
        generated.insert(name.into(), input.templates.text(name)?.as_bytes().to_vec());
    }
    generated.extend(input.lab.map(|lab| (LAB.to_string(), lab.as_bytes().to_vec())));
    for figure in input.figures {
        committed.extend(files_of(figure));
    }
    committed.extend(values.tables().map(|table| data(&DataFile::of(table))));
    let pdf =
        |figure: &Figure| (format!("figures/{}.pdf", figure.id), figure.drawing.pdf(&figure.title));
    generated.extend(input.figures.par_iter().map(pdf).collect::<Vec<_>>());
    committed.insert(SUMS.into(), folder::sums(&committed).into_bytes());
    for Part { of, blocks, places } in &parts {
        check_links(blocks, *of, &labels, &committed, edition).map_err(|e| places.locate(e))?;
    }
    Ok(Report { committed, generated })
}

/// All documents as trees, with their figures, numbers and references.
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
    let (read, faults): (Vec<_>, Vec<_>) = read.into_iter().partition(Result::is_ok);
    Error::all(faults.into_iter().filter_map(Result::err).collect())?;
    for ((of, filled), read) in input.edition.documents.iter().zip(filled).zip(read) {
        let (mut blocks, places) = read?;
        document::title(&blocks).map_err(|error| error.at(filled.place(0)))?;
        let own = illustrate(&mut blocks, input)
            .and_then(|own| labels.number_all(&mut blocks, *of).map(|()| own))
            .map_err(|error| places.locate(error))?;
        shown.extend(own.into_iter().filter(|_| !of.repeats));
        parts.push(Part { of: *of, blocks, places });
    }
    if let Some(figure) = input.figures.iter().find(|figure| !shown.contains(&figure.id)) {
        return Err(Error::NotShown(figure.id.clone()));
    }
    let missing = |entry: &&EquationEntry| labels.get(&format!("eq:{}", entry.number)).is_none();
    if let Some(entry) = input.edition.equations.iter().find(missing) {
        return Err(Error::NoEquation(entry.number.to_string()));
    }
    let tell = |error| parts.iter().fold(error, |error, part: &Part<'_>| part.places.locate(error));
    labels.add_verdicts(input.claims).map_err(tell)?;
    for Part { of, blocks, places } in &mut parts {
        labels.resolve(blocks, *of, &library).map_err(|error| places.locate(error))?;
    }
    Ok((parts, labels))
}

/// The picture of a figure and its data.
pub fn files_of(figure: &Figure) -> Files {
    let picture = (format!("figures/{}.svg", figure.id), figure.svg().into_bytes());
    std::iter::once(picture).chain(figure.data.iter().map(data)).collect()
}

fn data(file: &DataFile) -> (String, Vec<u8>) {
    (format!("data/{}", file.name), file.csv().into_bytes())
}

/// Each link leads to a place of its document, a file or folder of the report, a file of the project, or out.
fn check_links(
    blocks: &[Block],
    here: Document,
    labels: &Labels,
    files: &Files,
    edition: &Edition,
) -> Result<(), Error> {
    let is_page = |to: &str| edition.documents.iter().any(|of| of.page == to);
    let leads = |to: &str| match (to.split_once("://"), to.strip_prefix('#')) {
        (Some((scheme, _)), _) => ["https", "http"].contains(&scheme),
        (_, Some(id)) => {
            let label = labels.get(&id.replacen('-', ":", 1));
            !id.contains(':') && label.is_some_and(|label| label.document == here)
        }
        // Seen before it was led from where the report is written.
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

/// Gives the figures in the prose their alternative text and data, and leads what leads to files of the project; which
/// figures these are.
fn illustrate(blocks: &mut [Block], input: &Input<'_>) -> Result<Vec<String>, Error> {
    let mut shown = Vec::new();
    for block in blocks.iter_mut() {
        if let Block::Figure { name, alt, origin, .. } = block {
            let figure = input.figure(name)?;
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
            _ => Ok(document::led(inline, input.top)),
        },
        _ => Ok(vec![inline]),
    })?;
    Ok(shown)
}

//! Makes the files that all pages share: fonts, the cards of their numbers, and the index of data.

use super::super::card::Cards;
use super::super::document::{self, Inline};
use super::super::edition::Edition;
use super::super::error::Error;
use super::super::folder::Files;
use super::super::input::Input;
use super::super::labels::Labels;
use super::Page;
use crate::figures::escape;
use rayon::prelude::*;
use serde_json::{Value as Json, json};
use std::collections::{BTreeMap, BTreeSet};

const FONTS: [(&str, &[u8]); 4] = [
    ("LibertinusSerif-Regular", include_bytes!("../../../fonts/LibertinusSerif-Regular.woff2")),
    ("LibertinusSerif-Italic", include_bytes!("../../../fonts/LibertinusSerif-Italic.woff2")),
    ("LibertinusSerif-Bold", include_bytes!("../../../fonts/LibertinusSerif-Bold.woff2")),
    ("LibertinusMath-Regular", include_bytes!("../../../fonts/LibertinusMath-Regular.woff2")),
];

/// Returns fonts, and cards of values as a script: a page on a disk can load nothing else.
pub fn files(
    ids: &BTreeSet<String>,
    cards: &Cards<'_>,
    input: &Input<'_>,
    labels: &Labels,
) -> Result<Files, Error> {
    let write = |id: &String| {
        let unknown = || Error::Message(format!("there is no value {id}"));
        let (page, card) = (Page::new(input), cards.get(id).ok_or_else(unknown)?);
        let resolved = |inline: &Inline| match inline.clone() {
            Inline::Reference { to, label, .. } => {
                let within = labels.get(&to).map(|label| label.document);
                vec![Inline::Reference { to, within, label }]
            }
            other => document::relative_link(other, input.top),
        };
        let row = |(name, text): &(&str, Vec<Inline>)| {
            let words: Vec<Inline> = text.iter().flat_map(resolved).collect();
            let name = if name.is_empty() { "" } else { &format!("<dt>{name}</dt>") };
            format!("{name}<dd>{}</dd>", page.inlines(&words))
        };
        let rows: Vec<String> = card.rows.iter().map(row).collect();
        let title = page.inlines(&card.title);
        let fault = page.errors.into_inner().pop();
        fault.map_or(Ok((title, escape(&card.lead), rows)), Err)
    };
    let written = ids.par_iter().map(write).collect::<Vec<Result<_, Error>>>();
    let (mut rows, mut indices, mut cards_by_id) = (Vec::new(), BTreeMap::new(), BTreeMap::new());
    for (id, card) in ids.iter().zip(written) {
        let (title, lead, own) = card?;
        let mut row_indices = Vec::new();
        for row in own {
            row_indices.push(*indices.entry(row).or_insert_with_key(|row| {
                rows.push(row.clone());
                rows.len() - 1
            }));
        }
        cards_by_id.insert(id, (title, lead, row_indices));
    }
    let json = serde_json::to_string(&(rows, cards_by_id)).unwrap_or_default();
    let mut files = Files::from([("cards.js".into(), format!("CARDS = {json};\n").into_bytes())]);
    let font = |(name, bytes): (&str, &[u8])| (format!("fonts/{name}.woff2"), bytes.to_vec());
    files.extend(FONTS.map(font));
    Ok(files)
}

/// Returns what data.html inserts: the documents, and name, rows and columns of each file.
pub fn data_index(files: &Files, edition: &Edition) -> Json {
    let mut rows = Vec::new();
    for (path, bytes) in files {
        let Some(name) = path.strip_prefix("data/") else { continue };
        let table = String::from_utf8_lossy(bytes);
        let mut lines = table.lines();
        let columns = lines.next().unwrap_or_default().replace(',', ", ");
        rows.push([escape(name), lines.count().to_string(), escape(&columns)]);
    }
    let documents: Vec<_> = edition.documents.iter().map(|of| (of.page, escape(of.name))).collect();
    json!({ "documents": documents, "files": rows })
}

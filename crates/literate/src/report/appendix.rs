//! On paper nothing opens: an appendix says of each number, by number, what its card says elsewhere.

use super::card::{Card, Cards};
use super::document::{Align, Block, Inline, visit};
use super::valued::{Piece, pieces};
use super::values::{Kind, Value};
use std::collections::BTreeSet;

/// Id of the place in the appendix that tells of a value.
pub fn id(value: &str) -> String {
    // What an address has beside names would end a label of TeX.
    format!("value:{}", value.replace(['[', ']', '=', ','], "-"))
}

/// The appendix of values: those that the report shows, in the order of their first mention, and
/// the experiments that they come from. Empty if the report shows none.
pub fn values(blocks: &[Block], cards: Cards<'_>) -> Vec<Block> {
    let sections = mentions(blocks);
    if sections.iter().all(|section| section.values.is_empty()) {
        return Vec::new();
    }
    let mut out = vec![
        heading(2, vec![words("Values")]),
        Block::Paragraph(vec![words(
            "Each number of the report that was computed, read from the paper or measured, in the \
             order of its first mention: as it is shown, its id, all its digits, what kind of \
             number it is, and the item of the source that computes it. A number in the text is a \
             link to its line here.",
        )]),
    ];
    let mut number = 0;
    let mut experiments = BTreeSet::new();
    for Section { title, values } in sections {
        let mut rows = Vec::new();
        for (id, shown) in values {
            let (Some(value), Some(card)) = (cards.values.get(&id), cards.get(&id)) else {
                continue;
            };
            number += 1;
            experiments.insert(value.experiment.clone());
            rows.push(row(number, shown, value, &card));
        }
        if !rows.is_empty() {
            out.push(heading(3, title));
            out.push(table(&HEAD, rows));
        }
    }
    let rows: Vec<_> = experiments.iter().filter_map(|name| experiment(name, cards)).collect();
    if !rows.is_empty() {
        out.push(heading(3, vec![words("Experiments and their parameters")]));
        out.push(table(&["Name", "Item", "Parameters"], rows));
    }
    out
}

/// What is told of a value.
const HEAD: [&str; 5] = ["No.", "Shown", "Id", "In full", "Origin"];

/// A section with the values that it is the first to mention.
struct Section {
    title: Vec<Inline>,
    values: Vec<(String, Vec<Inline>)>,
}

fn mentions(blocks: &[Block]) -> Vec<Section> {
    let mut sections =
        vec![Section { title: vec![words("Before the first section")], values: vec![] }];
    let mut seen = BTreeSet::new();
    for block in blocks {
        if let Block::Heading { level: 2, number, text, .. } = block {
            let mut title: Vec<Inline> =
                number.iter().map(|n| words(&format!("{n}\u{a0}\u{a0}"))).collect();
            title.extend(text.iter().cloned());
            sections.push(Section { title, values: vec![] });
        }
        visit(std::slice::from_ref(block), &mut |inline| {
            let found = match inline {
                Inline::Value { id, shown } => vec![(id.clone(), shown.clone())],
                Inline::Maths(tex) | Inline::Display { tex, .. } => framed(tex),
                _ => return,
            };
            let fresh = found.into_iter().filter(|(id, _)| seen.insert(id.clone()));
            sections.last_mut().expect("begun with one").values.extend(fresh);
        });
    }
    sections
}

/// Values inside mathematics.
fn framed(tex: &str) -> Vec<(String, Vec<Inline>)> {
    pieces(tex)
        .into_iter()
        .filter_map(|piece| match piece {
            Piece::Value { id, digits } => {
                Some((id.to_string(), vec![Inline::Maths(digits.to_string())]))
            }
            Piece::Tex(_) => None,
        })
        .collect()
}

fn row(number: usize, shown: Vec<Inline>, value: &Value, card: &Card) -> Vec<Vec<Inline>> {
    let anchor = Inline::Anchor { id: id(&value.id), number: number.to_string() };
    let mut full = joined(card, &["in full"]);
    full.push(words(&format!("{}{}", if full.is_empty() { "" } else { "; " }, kind(&value.kind))));
    let origin = joined(card, &["computed by", "place", "equation"]);
    let origin = match recipe_name(value) {
        Some(name) => [origin, vec![words(&format!("; {name}"))]].concat(),
        None => origin,
    };
    vec![vec![anchor], shown, vec![Inline::Code(value.id.clone())], full, origin]
}

/// The experiment, unless it is the theory, which has no parameters worth a look.
fn recipe_name(value: &Value) -> Option<&str> {
    Some(value.experiment.as_str()).filter(|name| !matches!(*name, "" | "theory"))
}

/// The kind in a word, with what belongs to it.
fn kind(kind: &Kind) -> String {
    match kind {
        Kind::Exact => "exact".into(),
        Kind::Deterministic => "deterministic".into(),
        Kind::Ensemble { realisations, standard_error } => {
            format!("ensemble, n = {realisations}, standard error {standard_error}")
        }
        Kind::Printed { .. } => "printed".into(),
        Kind::Measured => "measured".into(),
    }
}

/// Rows of a card in one cell.
fn joined(card: &Card, names: &[&str]) -> Vec<Inline> {
    let mut out = Vec::new();
    for name in names {
        let Some(row) = card.rows.iter().find(|row| row.name == *name) else { continue };
        if !out.is_empty() {
            out.push(words("; "));
        }
        out.extend(row.text.iter().cloned());
    }
    out
}

fn experiment(name: &str, cards: Cards<'_>) -> Option<Vec<Vec<Inline>>> {
    let recipe = (cards.program.recipe)(name, cards.profile())?;
    let pairs: Vec<String> =
        recipe.parameters.iter().map(|(name, setting)| format!("{name}: {setting}")).collect();
    Some(vec![
        vec![words(&recipe.name)],
        vec![Inline::Code(recipe.item)],
        vec![words(&pairs.join("; "))],
    ])
}

fn heading(level: u8, text: Vec<Inline>) -> Block {
    Block::Heading { level, number: None, id: None, text }
}

fn table(head: &[&str], rows: Vec<Vec<Vec<Inline>>>) -> Block {
    Block::Table {
        id: None,
        number: None,
        caption: Vec::new(),
        columns: vec![Align::Left; head.len()],
        head: head.iter().map(|name| vec![words(name)]).collect(),
        rows,
    }
}

fn words(text: &str) -> Inline {
    Inline::Text(text.to_string())
}

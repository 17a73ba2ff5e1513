//! The verb `explain`.

use super::terminal::print;
use crate::failure::Failure;
use crate::input::{is_obeyed, one_line, regular_text};
use crate::paper::Paper;
use crate::report::card::{Card, Cards, Fact};
use crate::report::document::{Inline, spelt};
use crate::report::{Error, compare, ledger};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Say where a number, a figure, an equation or a statement of the report comes from
///
/// Examples:
///   explain "Fig. 3"            or "Eq. (18)", or the id of a statement
///   explain rise.half_height    an address of a value, or a part of it
///   explain 0.1159              a number as it is printed
///   explain                     a list of all
///
/// Nothing is run: the answer is read from the folder of the report.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// Explain these; without any, list all.
    #[arg(value_name = "ID")]
    ids: Vec<String>,
    /// Read the report in this folder.
    #[arg(long, value_name = "DIR", default_value = "paper")]
    paper: PathBuf,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

pub(super) fn run(paper: &Paper, args: Args) -> Result<(), Failure> {
    let values = compare::read(&read(&args.paper, "values.json")?).map_err(fault)?;
    let ledger = ledger::read(&read(&args.paper, "ledger.json")?).map_err(fault)?;
    let cards = Cards { values: &values, ledger: &ledger, paper };
    let of =
        |ids: Vec<String>| -> Vec<Card> { ids.iter().filter_map(|id| cards.get(id)).collect() };
    if args.ids.is_empty() {
        return print(&list(&of(cards.ids()), args.json));
    }
    let mut found = Vec::new();
    for asked in &args.ids {
        match of(cards.find(asked)).as_mut_slice() {
            [] => {
                let asked = one_line(asked, 60);
                let what = format!("there is no {asked:?}, nor anything of which it is a part");
                return Err(Failure::input(format!("explain: {what}; without it all are listed")));
            }
            [one] => found.push(one.clone()),
            many if args.ids.len() == 1 => return print(&list(many, args.json)),
            many => found.extend_from_slice(many),
        }
    }
    print(&if args.json {
        let one = |card: &Card| {
            let row = |row: &Fact| {
                let mut out = json!({"name": row.name, "text": words(&row.text)});
                file(row, paper).into_iter().for_each(|file| out["file"] = json!(file));
                out
            };
            let rows: Vec<_> = card.rows.iter().map(row).collect();
            json!({"id": card.id, "title": words(&card.title), "lead": card.lead, "rows": rows})
        };
        format!("{:#}\n", json!(found.iter().map(one).collect::<Vec<_>>()))
    } else {
        found.iter().map(|card| shown(card, paper)).collect::<Vec<_>>().join("\n")
    })
}

fn read(paper: &Path, name: &str) -> Result<String, Failure> {
    let place = || format!("--paper: {}", paper.join(name).display());
    let text = regular_text(&paper.join(name));
    text.map_err(|e| Failure::io(&e, place(), "give the folder of a report"))
}

fn fault(error: Error) -> Failure {
    Failure::input(format!("--paper: {error}; make the report anew with `paper`"))
}

/// One line for each thing.
fn list(cards: &[Card], as_json: bool) -> String {
    if as_json {
        let one = |card: &Card| json!({"id": card.id, "title": words(&card.title)});
        return format!("{:#}\n", json!(cards.iter().map(one).collect::<Vec<_>>()));
    }
    let line = |card: &Card| format!("{:28} {}\n", clean(&card.id), words(&card.title));
    cards.iter().map(line).collect()
}

/// All that is known of one thing.
fn shown(card: &Card, paper: &Paper) -> String {
    let mut out = format!("{}: {}\n", clean(&card.id), words(&card.title));
    if !card.lead.is_empty() {
        out += &format!("  {}\n", clean(&card.lead));
    }
    for row in card.rows.iter().filter(|row| row.name != "id") {
        let place = file(row, paper).map(|file| format!(" ({file})"));
        out += &format!("  {:15} {}{}\n", row.name, words(&row.text), place.unwrap_or_default());
    }
    out
}

/// Words of a report, without what a terminal would obey.
fn words(text: &[Inline]) -> String {
    clean(&spelt(text))
}

fn clean(text: &str) -> String {
    text.replace(is_obeyed, " ")
}

/// The file of the item that a row names.
fn file(row: &Fact, paper: &Paper) -> Option<&'static str> {
    paper.file(row.item.as_ref()?)
}

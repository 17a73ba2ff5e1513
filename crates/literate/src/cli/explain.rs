//! Runs the verb `explain`: prints the card of a value, figure, equation or statement.

use super::terminal::print;
use crate::experiments::{Command, Profile, Store};
use crate::failure::Failure;
use crate::input::{is_control, one_line, read_text};
use crate::paper::Paper;
use crate::report::ValueRegistry;
use crate::report::card::{Card, Cards};
use crate::report::document::{Inline, to_spelt_text};
use crate::report::ledger::Ledger;
use crate::table::{DataFile, table_name};
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};

/// Say where a number, a figure, an equation or a statement of the report comes from
///
/// Examples:
///   explain "Fig. 3"            or "Eq. (18)", or the id of a statement
///   explain rise.half_height    an address of a value, or a part of it
///   explain 0.1159              a number as it is printed
///   explain                     a list of all
///
/// Nothing is run: the answer is read from the folder of the report, and what a command said from
/// the saved results.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// Explain these; if none is given, list all.
    #[arg(value_name = "ID", allow_negative_numbers = true)]
    ids: Vec<String>,
    /// Read the report in this folder [default: paper in the project].
    #[arg(long, value_name = "DIR")]
    paper: Option<PathBuf>,
    /// Read what commands said from the saved results in this folder [default: target/results in
    /// the project].
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
}

pub(super) fn run(paper: &Paper, args: Args) -> Result<(), Failure> {
    let folder = args.paper.unwrap_or_else(|| paper.project.place("paper"));
    let values: ValueRegistry = read(&folder, "values.json")?;
    let ledger: Ledger = read(&folder, "ledger.json")?;
    let Paper { edition, project, experiments, .. } = paper;
    let (values, ledger, shared) = (&values, &ledger, Default::default());
    let cards = Cards { values, ledger, edition, project, experiments, shared };
    let mut rows = String::new();
    let mut ids = if args.ids.is_empty() { cards.ids() } else { Vec::new() };
    for asked in &args.ids {
        let matching = cards.find(asked);
        if matching.is_empty() {
            if let Some(written) = rows_of(asked, &folder) {
                rows += &written;
                continue;
            }
            let asked = one_line(asked, 60);
            let problem = format!("there is no {asked:?}, and no id contains it");
            return Err(Failure::input(format!("explain: {problem}; give no id to list all")));
        }
        ids.extend(matching);
    }
    let in_short = args.ids.len() < 2 && ids.len() > 1;
    let results = args.results.unwrap_or_else(|| paper.project.place("target/results"));
    let (store, profile) = (Store::open(&results), values.profile().unwrap_or(Profile::Full));
    for name in experiments.iter().map(|experiment| experiment.name()) {
        let mut explained = ids.iter().chain(&args.ids);
        if !in_short
            && explained.any(|id| id.trim_start_matches("v.").split('.').next() == Some(name))
        {
            let said = Command::said(name, profile, &store).unwrap_or_default();
            rows.extend(said.lines().map(|line| format!("{name} said: {}\n", clean(line))));
        }
    }
    let cards: Vec<Card> = ids.iter().filter_map(|id| cards.get(id)).collect();
    let cards: Vec<String> = if in_short {
        let line = |card: &Card| format!("{:28} {}\n", clean(&card.id), spelt_line(&card.title));
        vec![cards.iter().map(line).collect()]
    } else {
        cards.iter().map(card_text).collect()
    };
    print(&(cards.join("\n") + &rows))
}

/// Returns the rows of a data file that an address names, below the names and units of the columns,
/// or `None` if there is no such file or column: prose names few cells of most tables.
fn rows_of(asked: &str, folder: &Path) -> Option<String> {
    let address = asked.trim().trim_start_matches("v.").replace(['"', ' '], "");
    let path = format!("data/{}", DataFile::file_name(table_name(&address)?));
    let csv = read_text(&folder.join(&path)).ok()?;
    let (table, column) = address.rsplit_once('.')?;
    let (head, rows) = csv.split_once('\n')?;
    head.split(',').find(|name| name.split(" (").next() == Some(column))?;
    let keys = table.trim_end_matches(']').split_once('[').map_or("", |(_, keys)| keys);
    let given: Vec<&str> = keys.split(',').filter_map(|key| Some(key.split_once('=')?.1)).collect();
    let is_meant = |row: &&str| given.iter().all(|value| row.split(',').any(|cell| cell == *value));
    let lines = [head].into_iter().chain(rows.lines().filter(is_meant));
    let lines: String = lines.map(|line| format!("  {}\n", clean(line))).collect();
    Some(format!("{}: in {path}\n{lines}", clean(&address)))
}

fn read<T: DeserializeOwned>(paper: &Path, name: &str) -> Result<T, Failure> {
    let place = || format!("--paper: {}", paper.join(name).display());
    let json = read_text(&paper.join(name));
    let json = json.map_err(|e| Failure::io(&e, place(), "give the folder of a report"))?;
    let remedy = "make the report anew with `paper`";
    serde_json::from_str(&json)
        .map_err(|error| Failure::input(format!("--paper: {name}: {error}; {remedy}")))
}

fn card_text(card: &Card) -> String {
    let mut lines = format!("{}: {}\n", clean(&card.id), spelt_line(&card.title));
    if !card.lead.is_empty() {
        lines += &format!("  {}\n", clean(&card.lead));
    }
    for (name, words) in card.rows.iter().filter(|(name, _)| !["id", "ledger"].contains(name)) {
        // A link to a line of the source shows its item, and in brackets its file and line.
        let (words, source_place) = match words.as_slice() {
            [Inline::Link { to, words: link }] if to.starts_with("../") => {
                let source_place = to.trim_start_matches("../").replace("#L", ":");
                (link.get(..1).unwrap_or_default(), format!(" ({source_place})"))
            }
            all => (all, String::new()),
        };
        lines += &format!("  {name:15} {}{source_place}\n", spelt_line(words));
    }
    lines
}

/// Words of a report, without commands of a terminal.
fn spelt_line(inlines: &[Inline]) -> String {
    clean(&to_spelt_text(inlines))
}

fn clean(text: &str) -> String {
    text.replace(is_control, " ")
}

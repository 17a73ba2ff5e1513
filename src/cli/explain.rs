//! `impact-paper explain`.

use super::{Failure, stdout};
use impact_paper::experiments::alive;
use impact_paper::report::PROGRAM;
use impact_paper::report::card::{Card, Cards, Row};
use impact_paper::report::document::{Inline, spelt};
use impact_paper::report::ledger::Ledger;
use impact_paper::report::{Registry, compare};
use literate::input::{is_obeyed, one_line, regular_text};
use serde_json::json;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Says where a number, a figure, an equation or a claim of the report comes from.
///
/// An ID is the address of a value (sweep.rise.half_height), `fig:3`, `fig:s1`, `eq:18` or `claim:sec7_jump`;
/// without one, all are listed. Nothing is run: the answer is read from the report's folder, and
/// lines of the source are looked up in ./src, or else as they were when the program was built.
#[derive(clap::Args)]
pub struct Args {
    /// What to explain.
    #[arg(value_name = "ID")]
    ids: Vec<String>,
    /// Folder of the report.
    #[arg(long, value_name = "DIR", default_value = "paper")]
    paper: PathBuf,
    /// As JSON.
    #[arg(long)]
    json: bool,
}

pub fn run(args: Args) -> Result<(), Failure> {
    let _alive = alive(|| Some("explain: at work".into()));
    let values = values(&args.paper)?;
    let ledger = ledger(&args.paper)?;
    let cards = Cards { values: &values, ledger: &ledger, program: PROGRAM };
    // Templates have quotation marks in names of rows.
    let bare = |id: &String| id.replace('"', "");
    let get = |id: &String| cards.get(&bare(id)).ok_or_else(|| unknown(&bare(id), &cards.ids()));
    let result = if args.ids.is_empty() {
        let all: Vec<Card> = cards.ids().iter().filter_map(|id| cards.get(id)).collect();
        list(&all, args.json)
    } else {
        let found = args.ids.iter().map(get).collect::<Result<Vec<Card>, Failure>>()?;
        show(&found, args.json)
    };
    stdout::written(result)
}

fn read(paper: &Path, name: &str) -> Result<String, Failure> {
    let place = || format!("--paper: {}", paper.join(name).display());
    let text = regular_text(&paper.join(name));
    text.map_err(|e| Failure::io(&e, place(), "give the folder of a report"))
}

fn values(folder: &Path) -> Result<Registry, Failure> {
    compare::read(&read(folder, "values.json")?).map_err(fault)
}

fn fault(error: impact_paper::report::Error) -> Failure {
    Failure::input(format!("--paper: {error}; make the report anew with `impact-paper paper`"))
}

fn ledger(folder: &Path) -> Result<Ledger, Failure> {
    impact_paper::report::ledger::read(&read(folder, "ledger.json")?).map_err(fault)
}

/// One line for each thing.
fn list(cards: &[Card], as_json: bool) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    if as_json {
        let ids: Vec<_> =
            cards.iter().map(|card| json!({"id": card.id, "title": title(card)})).collect();
        writeln!(out, "{:#}", json!(ids))?;
        return out.flush();
    }
    for card in cards {
        writeln!(out, "{:28} {}", card.id.replace(is_obeyed, " "), title(card))?;
    }
    out.flush()
}

fn show(cards: &[Card], as_json: bool) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    if as_json {
        let one = |card: &Card| {
            let rows: Vec<_> = card.rows.iter().map(row_json).collect();
            json!({"id": card.id, "title": title(card), "lead": card.lead, "rows": rows})
        };
        let all: Vec<_> = cards.iter().map(one).collect();
        writeln!(out, "{:#}", json!(all))?;
        return out.flush();
    }
    for (i, card) in cards.iter().enumerate() {
        if i > 0 {
            writeln!(out)?;
        }
        writeln!(out, "{}: {}", card.id.replace(is_obeyed, " "), title(card))?;
        if !card.lead.is_empty() {
            writeln!(out, "  {}", card.lead.replace(is_obeyed, " "))?;
        }
        for row in card.rows.iter().filter(|row| row.name != "id") {
            write!(out, "  {:15} {}", row.name, words(&row.text))?;
            if let Some((file, line)) = stands(row) {
                write!(out, " ({file}:{line})")?;
            }
            writeln!(out)?;
        }
    }
    out.flush()
}

fn title(card: &Card) -> String {
    words(&card.title)
}

/// Words of a report, without what a terminal would obey.
fn words(text: &[Inline]) -> String {
    spelt(text).replace(is_obeyed, " ")
}

fn row_json(row: &Row) -> serde_json::Value {
    let mut out = json!({"name": row.name, "text": words(&row.text)});
    if let Some((file, line)) = stands(row) {
        out["file"] = json!(file);
        out["line"] = json!(line);
    }
    out
}

/// File and line of the item that a row names.
fn stands(row: &Row) -> Option<(&'static str, usize)> {
    let here = |file: &str| regular_text(Path::new(file)).ok();
    // What was moved in the working copy may still be found in the built one.
    let item = row.item.as_ref()?;
    let found = PROGRAM.place(item, here).or_else(|| PROGRAM.place(item, |_| None))?;
    Some((found.file, found.line))
}

/// One line with the ids that are spelt much alike: a third of the letters may differ.
fn unknown(id: &str, ids: &[String]) -> Failure {
    let asked: Vec<char> = id.chars().collect();
    let near = |known: &String| Some((distance(&asked, known)?, known.clone()));
    let mut near: Vec<(usize, String)> = ids.iter().filter_map(near).collect();
    near.sort_by_key(|(distance, _)| *distance);
    let near: Vec<String> = near.into_iter().take(3).map(|(_, id)| id).collect();
    let near = match near.as_slice() {
        [] => String::new(),
        near => format!("; the nearest ids are {}", near.join(", ")),
    };
    let id = match one_line(id, 60) {
        empty if empty.is_empty() => "the ID is empty".to_string(),
        id => format!("there is no {id:?}"),
    };
    Failure::input(format!("explain: {id}{near}; without an id all are listed"))
}

/// Letters of an id at most for which others that are alike are looked for: no id of ours is near that.
const LONGEST: usize = 200;

/// Fewest insertions, deletions and replacements between two words, unless they are too many; what stands behind
/// `claim:` may match alone.
fn distance(a: &[char], known: &str) -> Option<usize> {
    let most = a.len() / 3;
    let one = |b: &str| {
        let b: Vec<char> = b.chars().collect();
        if a.len().abs_diff(b.len()) > most || a.len() > LONGEST {
            return None;
        }
        let mut row: Vec<usize> = (0..=b.len()).collect();
        for (i, x) in a.iter().enumerate() {
            let mut before = row[0];
            row[0] = i + 1;
            for (j, y) in b.iter().enumerate() {
                let replaced = before + usize::from(x != y);
                before = row[j + 1];
                row[j + 1] = replaced.min(before + 1).min(row[j] + 1);
            }
        }
        Some(row[b.len()]).filter(|distance| *distance <= most)
    };
    let name = known.split_once(':').and_then(|(_, name)| one(name));
    [one(known), name].into_iter().flatten().min()
}

#[cfg(test)]
mod tests {
    #[test]
    fn words_that_are_alike_are_near() {
        let distance = |a: &str, b: &str| super::distance(&a.chars().collect::<Vec<char>>(), b);
        assert_eq!(distance("p_crit", "p_crit"), Some(0));
        assert_eq!(distance("p_krit", "p_crit"), Some(1));
        assert_eq!(distance("sec7_jump", "claim:sec7_jump"), Some(0));
        assert_eq!(distance("abc", "def"), None);
    }
}

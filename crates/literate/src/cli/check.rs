//! Runs the verb `check`: judges every statement and relation.

use super::common::{RunOptions, scores, verdict};
use super::terminal::print;
use crate::claims::{Check, Judge, Verdict};
use crate::failure::Failure;
use crate::input::one_line;
use crate::paper::Paper;
use crate::table::no_such;
use std::collections::BTreeMap;

/// Judge the statements of the paper, and relations between its numbers
///
/// Examples:
///   check                       a line for each statement that differs or cannot be judged
///   check -v                    everything about every statement
///   check 12 sec7_jump          these two, by number in the ledger or by id
///
/// Saved results are used where they are fresh; what is missing is run. Exit code 1 says that a
/// statement differs without an explanation that holds, that a relation between numbers does not
/// hold, or that the report is not as prose and results would make it. Each statement with a
/// printed number is judged once more with another first digit in it; those that are still
/// reproduced or explained are named. Each is judged from wrong results too: the numbers that its
/// rule reads are changed one after the other, and a verdict that stays the same is named. With -v
/// this is also done, in some seconds, where the verdict is open.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// Judge only these statements and relations, by id or by number in the ledger.
    #[arg(value_name = "ID")]
    ids: Vec<String>,
    /// Print all that is known of each, including those that are reproduced or hold.
    #[arg(long, short)]
    verbose: bool,
    #[command(flatten)]
    options: RunOptions,
}

pub(super) fn run(paper: &Paper, args: Args) -> Result<(), Failure> {
    let run = args.options.open(paper, None)?;
    let published = paper.published(&run.session)?;
    let relations = paper.rules.iter().filter(|rule| !rule.is_of_statement());
    let statements = published.statements.iter().map(|statement| statement.id.as_str());
    let ids: Vec<&str> = statements.chain(relations.map(|rule| rule.id)).collect();
    for asked in &args.ids {
        let is_number = asked.parse().is_ok_and(|n| (1..=published.statements.len()).contains(&n));
        if !is_number && !ids.contains(&asked.as_str()) {
            let ids = ids.iter().copied();
            let problem = no_such("statement or relation", &one_line(asked, 60), ids);
            return Err(Failure::input(format!("{problem}; `check -v` lists all")));
        }
    }
    let (mut checks, mut blind, mut unmoved) = args.options.threads.run(|| {
        let results = paper.results(&paper.experiments, &run.session)?;
        let judge = Judge::new(&published, &paper.rules, &results);
        Ok((judge.checks()?, judge.ids_blind_to_number(), judge.ids_never_moved(args.verbose)?))
    })?;
    let printed = checks.iter().filter(|check| check.kind.is_printed());
    let numbers: BTreeMap<String, String> =
        printed.zip(1..).map(|(check, number)| (check.id.clone(), number.to_string())).collect();
    if !args.ids.is_empty() {
        checks.retain(|Check { id, .. }| {
            args.ids.contains(id) || numbers.get(id).is_some_and(|number| args.ids.contains(number))
        });
    }
    for ids in [&mut blind, &mut unmoved] {
        ids.retain(|id| checks.iter().any(|check| check.id == *id));
    }
    let unfailing = [
        ("reproduced or explained also with another first digit in the printed number", &*blind),
        ("the same verdict with every wrong result that was tried", &*unmoved),
    ];
    print(&report_text(&checks, unfailing, &args, &numbers))?;
    verdict(&checks)?;
    run.refuse_outdated().map(drop)
}

/// Returns a line for each check that is not reproduced, failed ones first, and the scores; with
/// -v, or if some were asked for, all that is known of each.
fn report_text(
    checks: &[Check],
    unfailing: [(&str, &[&str]); 2],
    args: &Args,
    numbers: &BTreeMap<String, String>,
) -> String {
    let is_complete = args.verbose || !args.ids.is_empty();
    let mut listed: Vec<&Check> =
        checks.iter().filter(|check| is_complete || check.verdict != Verdict::Reproduced).collect();
    listed.sort_by_key(|check| !check.fails());
    let mut lines = String::new();
    for check in listed {
        let mark = if check.fails() { "FAILS" } else { &check.verdict.sign().to_string() };
        let number = numbers.get(&check.id).map_or("", String::as_str);
        lines += &format!("{mark:5} {number:>2} {}: {}", check.id, check.words());
        if let Some(why) = check.difference() {
            lines += &format!(" ({why})");
        }
        if is_complete {
            let place = if check.place.is_empty() { "" } else { &format!("{}, ", check.place) };
            lines += &format!(" ({place}{})\n         {}\n", check.basis.words(), check.statement);
            let reason = if check.reason.is_empty() { "" } else { &format!(" ({})", check.reason) };
            for (name, words) in [
                ("printed", check.expected.clone()),
                ("found", check.found.to_string()),
                ("tolerance", format!("{}{reason}", check.tolerance)),
                ("note", check.note.to_string()),
            ] {
                if !words.is_empty() {
                    lines += &format!("         {name:10} {words}\n");
                }
            }
        } else {
            for (side, words) in [("paper", &check.expected), ("here", &check.found.to_string())] {
                if !["", "–"].contains(&words.as_str()) {
                    lines += &format!("; {side}: {words}");
                }
            }
            lines += "\n";
        }
    }
    for line in scores(checks) {
        lines += &format!("{line}\n");
    }
    for (meaning, ids) in unfailing.into_iter().filter(|(_, ids)| !ids.is_empty()) {
        lines += &format!("{meaning}: {}\n", ids.join(", "));
    }
    if !is_complete {
        lines += "`check -v` prints all, `check ID` all of one\n";
    }
    lines
}

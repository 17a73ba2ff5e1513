//! Runs the verb `diff`: prints how two reports differ.

use super::terminal::{display_path, print};
use crate::claims::Check;
use crate::failure::Failure;
use crate::input::{count, is_control, one_line, read_file};
use crate::print::{Style, print as printed};
use crate::report::Files;
use crate::report::document::{to_spelt_text, words_and_maths};
use crate::report::folder::{self, SUMS};
use crate::report::ledger::Ledger;
use crate::report::values::{Digits, Value, ValueRegistry};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// Say what differs between two reports: verdicts, numbers, files
///
/// Examples:
///   diff paper target/paper          two folders
///   diff v1.0.0 paper                the folder paper/ of a git revision, and a folder
///
/// A difference is no failure: the exit code is 0.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// The earlier report.
    #[arg(value_name = "OLD")]
    old: String,
    /// The later one.
    #[arg(value_name = "NEW")]
    new: String,
}

pub(super) fn run(args: Args) -> Result<(), Failure> {
    let [before, after] = [parts(&args.old)?, parts(&args.new)?];
    let [old, new] = [&args.old, &args.new].map(|name| display_path(Path::new(name)));
    let checks = checks(&before.ledger, &after.ledger);
    let numbers = numbers(&before.values, &after.values);
    let counts = [count(checks.len(), "check"), count(numbers.len(), "number")];
    let differences = [checks, numbers, files(&before.files, &after.files)].concat();
    // A report, and the name of a file, may hold commands of a terminal.
    let lines = differences.iter().map(|line| line.replace(is_control, " ") + "\n");
    print(&if differences.is_empty() {
        format!("{old} and {new}: nothing differs\n")
    } else {
        format!("{} changed\n{}", counts.join(" and "), lines.collect::<String>())
    })
}

struct Parts {
    files: Files,
    values: ValueRegistry,
    ledger: Ledger,
}

/// Reads a report from a folder or a revision, without the files that are never committed.
fn parts(name: &str) -> Result<Parts, Failure> {
    let files = if Path::new(name).is_dir() { standing(name)? } else { committed(name)? };
    let fault = |problem: String| Failure::input(format!("{name}: {problem}; is it a report?"));
    let content = |path: &str| {
        let bytes = files.get(path).ok_or_else(|| fault(format!("{path} is missing")))?;
        std::str::from_utf8(bytes).map_err(|error| fault(format!("{path}: {error}")))
    };
    let unreadable = |name| move |error| fault(format!("{name}: {error}"));
    let values =
        content("values.json").map(serde_json::from_str)?.map_err(unreadable("values.json"))?;
    let ledger =
        content("ledger.json").map(serde_json::from_str)?.map_err(unreadable("ledger.json"))?;
    Ok(Parts { files, values, ledger })
}

fn standing(name: &str) -> Result<Files, Failure> {
    let root = Path::new(name);
    let paths = folder::walk(root)?;
    let read = |path: String| {
        let fault = |error| Failure::io(&error, format!("{name}: {path}"), "is it a report?");
        let bytes = read_file(&root.join(&path)).map_err(fault)?;
        Ok((path, bytes))
    };
    paths.into_iter().filter(|path| !folder::is_generated(path)).map(read).collect()
}

fn git(arguments: &[&str]) -> Result<Vec<u8>, String> {
    let output = Command::new("git").arg("--no-pager").args(arguments).output();
    let output = output.map_err(|error| format!("git: {error}"))?;
    let words = String::from_utf8_lossy(&output.stderr);
    if output.status.success() { Ok(output.stdout) } else { Err(words.into_owned()) }
}

fn committed(name: &str) -> Result<Files, Failure> {
    let neither = |reason: String| {
        let problem = "neither a folder nor a revision of git with a report in ./paper here";
        let reason = one_line(&reason, 200);
        let remedy = "give the folder of a report, a tag or a commit";
        Failure::input(format!("{name}: {problem} ({reason}); {remedy}"))
    };
    let git = |arguments: &[&str]| git(arguments).map_err(neither);
    let folder = format!("{name}:./paper");
    let tree = git(&["rev-parse", "--verify", "--end-of-options", &folder])?;
    let tree = String::from_utf8_lossy(&tree);
    let list = git(&["ls-tree", "-r", "-z", "--full-tree", "--name-only", tree.trim()])?;
    let list = String::from_utf8_lossy(&list);
    let paths = list.split_terminator('\0').filter(|path| !folder::is_generated(path));
    let blob = |path: &str| git(&["cat-file", "blob", &format!("{}:{path}", tree.trim())]);
    paths.map(|path| Ok((path.to_string(), blob(path)?))).collect()
}

fn files(before: &Files, after: &Files) -> Vec<String> {
    let paths: BTreeSet<&String> = before.keys().chain(after.keys()).collect();
    let line = |path: &String| match (before.get(path), after.get(path)) {
        (None, _) => Some(format!("  new      {path}")),
        (_, None) => Some(format!("  gone     {path}")),
        (Some(old), Some(new)) if old == new => None,
        (Some(old), Some(new)) if path.ends_with(".csv") => {
            Some(format!("  differs  {path}: {}", rows(old, new)))
        }
        _ => Some(format!("  differs  {path}")),
    };
    paths.into_iter().filter(|path| *path != SUMS).filter_map(line).collect()
}

/// Says how the rows of a data file changed: prose names few of their numbers.
fn rows(old: &[u8], new: &[u8]) -> String {
    let [old, new] = [old, new].map(String::from_utf8_lossy);
    let total = old.lines().count();
    if total != new.lines().count() {
        return format!("{total} -> {} lines", new.lines().count());
    }
    let pairs = old.lines().zip(new.lines()).filter(|(old, new)| old != new);
    let first = pairs.clone().map(|(old, new)| format!("the first {old} -> {new}")).next();
    format!("{} of {total} lines; {}", pairs.count(), first.unwrap_or_default())
}

/// Lists checks whose verdict, expected number or tolerance changed.
fn checks(before: &Ledger, after: &Ledger) -> Vec<String> {
    let checks = before.claims.iter().chain(&after.claims);
    let mut lines = Vec::new();
    for id in checks.map(|check| &check.id).collect::<BTreeSet<_>>() {
        let find = |ledger: &'_ Ledger| ledger.claims.iter().find(|check| check.id == *id).cloned();
        let (old, new) = (find(before), find(after));
        let words = [&old, &new].map(|check| check.as_ref().map(Check::words));
        let has_moved = words[0] != words[1];
        let mut details = String::new();
        if let (Some(old), Some(new)) = (&old, &new) {
            for (name, [old, new]) in [
                ("expected", [old, new].map(|check| check.expected.clone())),
                ("found", [old, new].map(|check| check.found.to_string())),
                ("tolerance", [old, new].map(|check| check.tolerance.to_string())),
            ] {
                if old != new && (has_moved || name != "found") {
                    details += &format!("; {name}: {old} -> {new}");
                }
            }
        }
        if has_moved || !details.is_empty() {
            lines.push(fate(id, words) + &details);
        }
    }
    lines
}

/// Lists numbers that changed, or changed their units: first what is no longer a number, then the
/// others by the difference in standard errors, and last what only one report has.
fn numbers(before: &ValueRegistry, after: &ValueRegistry) -> Vec<String> {
    let ids: BTreeSet<&str> = before.iter().chain(after.iter()).map(|v| v.id.as_str()).collect();
    let mut changes = Vec::new();
    for id in ids {
        let values = [before.get(id), after.get(id)];
        let [old, new] = values.map(|value| value.map(|value| (&value.number, &value.unit)));
        if old != new {
            changes.push(change(id, values));
        }
    }
    changes.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    changes.into_iter().map(|(_, line)| line).collect()
}

/// Returns by how many standard errors a number changed (infinitely many if it is no longer a
/// number, below 0 if only one report has it), and its line.
fn change(id: &str, values: [Option<&Value>; 2]) -> (f64, String) {
    let [old, new] = values.map(|value| value.map(Value::to_plain_text));
    // In full where their digits do not show the difference.
    let style = Style { digits: (old == new).then_some(Digits::Full), ..Style::default() };
    let digits = |value: &Value| {
        to_spelt_text(&words_and_maths(&printed(&value.number, style).to_plain_text()))
    };
    let [old, new] = values.map(|value| value.map(digits));
    let mut line = fate(id, [old.as_deref(), new.as_deref()]);
    let [Some(old), Some(new)] = values else { return (-1.0, line) };
    let Some((before, after)) = old.as_f64().zip(new.as_f64()) else {
        return (f64::INFINITY, line);
    };
    let difference = after - before;
    line += &format!("; Δ {}", signed(difference));
    // Runs with the same seed are correlated, and then this overestimates the error.
    let [a, b] = [old, new].map(Value::standard_error);
    let error = (a * a + b * b).sqrt();
    if error > 0.0 {
        line += &format!(", {} σ", signed(difference / error));
        return ((difference / error).abs(), line);
    }
    (0.0, line)
}

fn signed(value: f64) -> String {
    let sign = if value > 0.0 { "+" } else { "" };
    format!("{sign}{}", Value::real("", value, 3).to_plain_text())
}

/// Says how something changed: `x: old -> new`, `x: new, new`, `x: gone, was old`.
fn fate(id: &str, sides: [Option<&str>; 2]) -> String {
    let fate = match sides {
        [Some(before), Some(after)] if before == after => before.into(),
        [Some(before), Some(after)] => format!("{before} -> {after}"),
        [None, after] => format!("new, {}", after.unwrap_or_default()),
        [Some(before), None] => format!("gone, was {before}"),
    };
    format!("  {id}: {fate}")
}

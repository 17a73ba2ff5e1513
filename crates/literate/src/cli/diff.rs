//! The verb `diff`: what changed between two reports, in verdicts, numbers and files.

use super::terminal::{print, shown};
use crate::claims::{Check, Text, significant};
use crate::failure::Failure;
use crate::input::{count, is_obeyed, one_line};
use crate::report::folder::{self, SUMS};
use crate::report::ledger::{self, Ledger};
use crate::report::print::{Style, print as printed};
use crate::report::values::{self, Digits, Registry, Value};
use crate::report::{Error, Files, tex};
use crate::table::number;
use serde::Serialize;
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

/// Say what differs between two reports: verdicts, numbers, files
///
/// Examples:
///   diff paper target/paper          two folders
///   diff v1.0.0 paper --markdown     a revision of git, whose folder paper/ is meant, and a folder
///
/// A difference is no failure: the exit code is 0 unless --exit-code asks for more.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// The earlier report.
    #[arg(value_name = "OLD")]
    old: String,
    /// The later one.
    #[arg(value_name = "NEW")]
    new: String,
    /// Print the first lines for a comment on a pull request.
    #[arg(long)]
    markdown: bool,
    /// Print everything as JSON.
    #[arg(long, conflicts_with = "markdown")]
    json: bool,
    /// End with exit code 1 if anything differs.
    #[arg(long)]
    exit_code: bool,
}

pub(super) fn run(args: Args) -> Result<(), Failure> {
    let [before, after] = [parts(&args.old)?, parts(&args.new)?];
    let diff = diff(&before, &after);
    let same = diff == Diff::default();
    let [old, new] = [&args.old, &args.new].map(|name| shown(Path::new(name)));
    let json = || json!({"old": old, "new": new, "same": same, "diff": diff});
    let text = diff.text(&old, &new);
    let told = match (args.markdown, args.json) {
        // Hosts take comments of 65536 characters.
        (true, _) => {
            format!("~~~~\n{}\n~~~~\n", text.lines().take(300).collect::<Vec<_>>().join("\n"))
        }
        (_, true) => format!("{:#}\n", json()),
        _ => text,
    };
    print(&told)?;
    match same || !args.exit_code {
        true => Ok(()),
        false => Err(Failure::check(format!("{} and {} differ", args.old, args.new))),
    }
}

/// A report, with the parts that are compared as what they mean.
struct Parts {
    files: Files,
    values: Registry,
    ledger: Ledger,
}

/// A report by its folder or revision, without the files that are never committed.
fn parts(name: &str) -> Result<Parts, Failure> {
    let files = if Path::new(name).is_dir() { standing(name)? } else { committed(name)? };
    let fault = |what: String| Failure::input(format!("{name}: {what}; is it a report?"));
    let text = |path: &str| {
        let bytes = files.get(path).ok_or_else(|| fault(format!("{path} is missing")))?;
        std::str::from_utf8(bytes).map_err(|error| fault(format!("{path}: {error}")))
    };
    let wrong = |error: Error| fault(error.to_string());
    let values = values::read(text("values.json")?).map_err(wrong)?;
    let ledger = ledger::read(text("ledger.json")?).map_err(wrong)?;
    Ok(Parts { files, values, ledger })
}

/// The files in a folder.
fn standing(name: &str) -> Result<Files, Failure> {
    let root = Path::new(name);
    let paths = folder::walk(root)?;
    let read = |path: String| {
        let fault = |error| Failure::io(&error, format!("{name}: {path}"), "is it a report?");
        let bytes = folder::read(root, &path).map_err(fault)?;
        Ok((path, bytes))
    };
    paths.into_iter().filter(|path| !folder::is_beside(path)).map(read).collect()
}

/// What git prints, or why it does not.
fn git(arguments: &[&str]) -> Result<Vec<u8>, String> {
    let output = Command::new("git").arg("--no-pager").args(arguments).output();
    let output = output.map_err(|error| format!("git: {error}"))?;
    let words = String::from_utf8_lossy(&output.stderr);
    if output.status.success() { Ok(output.stdout) } else { Err(words.into_owned()) }
}

/// The files of a revision below paper/, from where the program runs, as git has stored them.
fn committed(name: &str) -> Result<Files, Failure> {
    let neither = |told: String| {
        let what = "neither a folder nor a revision of git with a report in ./paper here";
        let told = one_line(&told, 200);
        let remedy = "give the folder of a report, a tag or a commit";
        Failure::input(format!("{name}: {what} ({told}); {remedy}"))
    };
    let git = |arguments: &[&str]| git(arguments).map_err(neither);
    // What git would take for an option, a path or a range is no revision.
    let odd = |c: char| c.is_control() || c.is_whitespace() || c == ':';
    if name.is_empty() || name.starts_with('-') || name.contains(odd) || name.contains("..") {
        return Err(neither("the name is none".into()));
    }
    let list =
        git(&["ls-tree", "-r", "-z", "--full-tree", "--name-only", &format!("{name}:./paper")])?;
    let list = String::from_utf8_lossy(&list).into_owned();
    let paths = list.split_terminator('\0').filter(|path| !folder::is_beside(path));
    let read = |path: &str| {
        Ok((path.to_string(), git(&["cat-file", "blob", &format!("{name}:./paper/{path}")])?))
    };
    paths.map(read).collect()
}

/// A number or a check of which something differs.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Change {
    /// Its id.
    id: String,
    /// The number as it was printed, or the verdict; None for what is new.
    before: Option<String>,
    /// The same now; None for what is gone.
    after: Option<String>,
    /// After minus before, where both are numbers.
    difference: Option<f64>,
    /// The difference over the combined standard error, where there is one. Runs with the same seed
    /// share their chance, and then it overrates the error.
    sigmas: Option<f64>,
    /// What else differs, by its name, before and after.
    also: BTreeMap<&'static str, [String; 2]>,
}

/// What differs, part by part; all empty for the same bytes.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Diff {
    /// Checks with another verdict or another measure, gained and lost.
    verdicts: Vec<Change>,
    /// Values with another number or unit, gained and lost, the largest change first.
    numbers: Vec<Change>,
    /// Files that only the later report has.
    gained: Vec<String>,
    /// Files that only the earlier report has.
    lost: Vec<String>,
    /// Files with other bytes.
    differing: Vec<String>,
}

/// What differs.
fn diff(before: &Parts, after: &Parts) -> Diff {
    let known = |files: &'_ Files| -> BTreeSet<String> {
        files.keys().filter(|path| *path != SUMS).cloned().collect()
    };
    let (old, new) = (known(&before.files), known(&after.files));
    let differing = |path: &&String| before.files[*path] != after.files[*path];
    let by_id = |ledger: &'_ Ledger| -> BTreeMap<String, Check> {
        ledger.claims.iter().map(|check| (check.id.clone(), check.clone())).collect()
    };
    let (checks, were) = (by_id(&after.ledger), by_id(&before.ledger));
    let ids: BTreeSet<&String> = were.keys().chain(checks.keys()).collect();
    let verdicts = ids.into_iter().filter_map(|id| verdict(id, were.get(id), checks.get(id)));
    Diff {
        verdicts: verdicts.collect(),
        numbers: numbers(&before.values, &after.values),
        gained: new.difference(&old).cloned().collect(),
        lost: old.difference(&new).cloned().collect(),
        differing: old.intersection(&new).filter(differing).cloned().collect(),
    }
}

/// How a check changed: its verdict, and what it is held against.
fn verdict(id: &str, before: Option<&Check>, after: Option<&Check>) -> Option<Change> {
    let words = |check: &Check| check.words().to_string();
    let (old, new) = (before.map(words), after.map(words));
    let moved = old != new;
    let fields = |check: &Check| {
        let (found, tolerance) = (check.found.to_string(), check.tolerance.to_string());
        [("found", found), ("expected", check.expected.clone()), ("tolerance", tolerance)]
    };
    let pairs =
        before.map(fields).into_iter().flatten().zip(after.map(fields).into_iter().flatten());
    let also = pairs.filter(|((name, old), (_, new))| old != new && (moved || *name != "found"));
    let also: BTreeMap<_, _> = also.map(|((name, old), (_, new))| (name, [old, new])).collect();
    let same = !moved && also.is_empty();
    (!same).then(|| Change { id: id.into(), before: old, after: new, also, ..Change::default() })
}

/// All changes of numbers and units; other fields (notes, sources) do not count. What is a number no more
/// comes first, then the largest differences in standard errors, and last what only one report has.
fn numbers(before: &Registry, after: &Registry) -> Vec<Change> {
    let ids: BTreeSet<&str> = before.iter().chain(after.iter()).map(|v| v.id.as_str()).collect();
    let change = |id: &str| {
        let (old, new) = (before.get(id), after.get(id));
        let meant = |value: Option<&Value>| value.map(|v| (v.number.clone(), v.unit.clone()));
        if meant(old) == meant(new) {
            return None;
        }
        // In full where their digits do not show the difference.
        let hidden = old.map(Value::plain) == new.map(Value::plain);
        let style = Style { digits: hidden.then_some(Digits::Full), ..Style::default() };
        let shown = |value: &Value| tex::spelt(&printed(&value.number, style).plain());
        let both = old.zip(new);
        let difference = both.and_then(|(old, new)| Some(number(new)? - number(old)?));
        let difference = difference.filter(|difference| difference.is_finite());
        let error = both.map(|(old, new)| {
            let [old, new] = [old, new].map(Value::standard_error);
            (old * old + new * new).sqrt()
        });
        let sigmas = difference.zip(error).map(|(difference, error)| difference / error);
        Some(Change {
            id: id.to_string(),
            before: old.map(shown),
            after: new.map(shown),
            difference,
            sigmas: sigmas.filter(|sigmas| sigmas.is_finite()),
            ..Change::default()
        })
    };
    let mut changes: Vec<Change> = ids.into_iter().filter_map(change).collect();
    let weight = |change: &Change| match (change.sigmas, change.difference) {
        _ if change.before.is_none() || change.after.is_none() => -1.0,
        (Some(sigmas), _) => sigmas.abs(),
        (None, Some(_)) => 0.0,
        _ => f64::INFINITY,
    };
    changes.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    changes
}

/// A difference with its sign and three digits.
fn signed(value: f64) -> String {
    let sign = if value > 0.0 { "+" } else { "" };
    format!("{sign}{}", Text::from(significant(value, 3)))
}

impl Change {
    /// `x: reproduced -> differs`, `x: new, reproduced`, `x: gone, was reproduced`, and what else is known.
    fn line(&self) -> String {
        let fate = match (&self.before, &self.after) {
            (Some(before), Some(after)) if before == after => before.clone(),
            (Some(before), Some(after)) => format!("{before} -> {after}"),
            (None, after) => format!("new, {}", after.as_deref().unwrap_or_default()),
            (Some(before), None) => format!("gone, was {before}"),
        };
        let difference = self.difference.map(|own| format!("; Δ {}", signed(own)));
        let sigmas = self.sigmas.map(|own| format!(", {} σ", signed(own)));
        let also = self.also.iter().map(|(name, [old, new])| format!("; {name}: {old} -> {new}"));
        let more = difference.unwrap_or_default() + &sigmas.unwrap_or_default();
        format!("  {}: {fate}{more}{}", self.id, also.collect::<String>())
    }
}

impl Diff {
    /// For people: all of it.
    fn text(&self, old: &str, new: &str) -> String {
        if *self == Diff::default() {
            return format!("{old} and {new}: nothing differs\n");
        }
        let (verdicts, numbers) = (self.verdicts.len(), self.numbers.len());
        let (verdicts, numbers) = (count(verdicts, "check"), count(numbers, "number"));
        let changes = self.verdicts.iter().chain(&self.numbers).map(Change::line);
        let files = [("new", &self.gained), ("gone", &self.lost), ("differs", &self.differing)];
        let line = |what| move |path: &String| format!("  {what:8} {path}");
        let files = files.into_iter().flat_map(|(what, paths)| paths.iter().map(line(what)));
        // A report, and the name of a file, may hold what a terminal obeys.
        let lines = changes.chain(files).map(|line| line.replace(is_obeyed, " ") + "\n");
        format!("{verdicts} and {numbers} changed\n{}", lines.collect::<String>())
    }
}

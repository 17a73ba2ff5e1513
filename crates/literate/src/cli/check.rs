//! The verb `check`.

use super::make::{Sources, of, scores, verdict};
use super::terminal::print;
use crate::claims::{Check, Kind, Published, Verdict, score};
use crate::failure::Failure;
use crate::input::one_line;
use crate::paper::Paper;
use serde_json::{Value, json};

/// Judge the statements of the paper, and relations between its numbers
///
/// Examples:
///   check                       a line for each statement that differs or cannot be judged
///   check -v                    all that is known of all of them
///   check 12 sec7_jump          of two, by number in the ledger or by id
///   check --format github       annotations of a pull request
///
/// Saved results are used where they are fresh; what is missing is run. Exit code 1 says that a
/// statement differs without an explanation that holds, or that a relation between numbers does not
/// hold.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub(super) struct Args {
    /// Judge only these statements, by id or by number in the ledger.
    #[arg(value_name = "ID")]
    ids: Vec<String>,
    /// Print all that is known of each, and also those that are reproduced or hold.
    #[arg(long, short)]
    verbose: bool,
    /// Print in this form; `github` annotates what fails and the ten worst others.
    #[arg(long, default_value = "text")]
    format: Format,
    #[command(flatten)]
    sources: Sources,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    Text,
    Json,
    Github,
}

pub(super) fn run(paper: &Paper, args: Args) -> Result<(), Failure> {
    let session = args.sources.session(paper)?;
    let published = paper.published(&session)?;
    for asked in &args.ids {
        let number = asked.parse().is_ok_and(|n| (1..=published.statements.len()).contains(&n));
        if !number && !published.statements.iter().any(|own| own.id == *asked) {
            let asked = one_line(asked, 60);
            return Err(Failure::input(format!(
                "there is no statement {asked}; `check -v` lists all"
            )));
        }
    }
    let mut checks = args.sources.threads.run(|| {
        let results = paper.results(&paper.experiments, &session)?;
        paper.checks(&results, &published)
    })?;
    let printed = checks.iter().filter(|check| check.kind.is_printed());
    let order: Vec<String> = printed.map(|check| check.id.clone()).collect();
    let number = |id: &str| order.iter().position(|own| own == id).map(|i| i + 1);
    if !args.ids.is_empty() {
        checks.retain(|Check { id, .. }| {
            let number = number(id).map(|number| number.to_string());
            args.ids.iter().any(|asked| asked == id || Some(asked) == number.as_ref())
        });
    }
    let file = session.templates.place("published.toml");
    print(&match args.format {
        Format::Text => text(&checks, &args, number),
        Format::Json => json(&checks, &published, &file),
        Format::Github => github(&checks, &published, &file),
    })?;
    verdict(&checks)
}

/// What is known of a check, by names.
fn fields(check: &Check) -> impl Iterator<Item = (&'static str, String)> {
    let tolerance = match check.reason.as_str() {
        "" => check.tolerance.to_string(),
        reason => format!("{} ({reason})", check.tolerance),
    };
    let fields = [
        ("printed", check.expected.clone()),
        ("found", check.found.to_string()),
        ("tolerance", tolerance),
        ("note", check.note.to_string()),
    ];
    fields.into_iter().filter(|(_, text)| !text.is_empty())
}

/// A line for each check that is not simply reproduced or holds, what fails first, and the scores;
/// of those that were asked for, and with -v, all lines of all.
fn text(checks: &[Check], args: &Args, number: impl Fn(&str) -> Option<usize>) -> String {
    let all = args.verbose || !args.ids.is_empty();
    let mut listed: Vec<&Check> =
        checks.iter().filter(|check| all || check.verdict != Verdict::Reproduced).collect();
    listed.sort_by_key(|check| !check.fails());
    let mut out = String::new();
    for check in listed {
        let sign = if check.fails() { "FAILS" } else { &check.verdict.sign().to_string() };
        let number = number(&check.id).map_or_else(String::new, |number| number.to_string());
        let (id, words) = (&check.id, check.words());
        let why = check.difference().map_or_else(String::new, |why| format!(" ({why})"));
        out += &format!("{sign:5} {number:>2} {id}: {words}{why}");
        if !all {
            let sides = [("paper", check.expected.clone()), ("here", check.found.to_string())];
            let sides = sides.into_iter().filter(|(_, text)| !["", "–"].contains(&text.as_str()));
            sides.for_each(|(side, text)| out += &format!("; {side}: {text}"));
            out += "\n";
            continue;
        }
        let place = if check.place.is_empty() { "" } else { &format!("{}, ", check.place) };
        out += &format!(" ({place}{})\n         {}\n", check.basis.words(), check.statement);
        fields(check).for_each(|(name, text)| out += &format!("         {name:10} {text}\n"));
    }
    scores(checks).iter().for_each(|line| out += &format!("{line}\n"));
    if !all {
        out += "`check -v` prints all, `check ID` all of one\n";
    }
    out
}
/// All that is known, as JSON: checks as ledger.json has them, and the line of each statement.
fn json(checks: &[Check], published: &Published, file: &str) -> String {
    let one = |check: &Check| {
        let mut own = json!(check);
        own["fails"] = check.fails().into();
        own["words"] = check.words().into();
        if check.kind.is_printed() {
            (own["file"], own["line"]) = (file.into(), published.line(&check.id).into());
        }
        own
    };
    let list = |kind| of(checks, kind).map(one).collect::<Vec<Value>>();
    let printed = checks.iter().filter(|check| check.kind.is_printed());
    let counts = Verdict::ALL.iter().zip(score(of(checks, Kind::Statement)));
    let counts = counts.map(|(verdict, count)| (verdict.words().into(), count.into()));
    let all = json!({
        "score": counts.collect::<serde_json::Map<String, Value>>(),
        "claims": printed.map(one).collect::<Vec<Value>>(),
        "relations": list(Kind::Relation),
    });
    format!("{all:#}\n")
}

/// Most annotations that are worth a reader's time.
const ANNOTATIONS: usize = 10;

/// Commands of GitHub's log: what fails, and the worst statements, each at its line.
fn github(checks: &[Check], published: &Published, file: &str) -> String {
    let kind = |check: &Check| match check.verdict {
        _ if check.fails() => Some("error"),
        _ if !check.kind.is_printed() => None,
        Verdict::CannotBeJudged => Some("warning"),
        Verdict::DiffersAndExplained => Some("notice"),
        _ => None,
    };
    let mut worst: Vec<(&str, &Check)> =
        checks.iter().filter_map(|check| Some((kind(check)?, check))).collect();
    let order = ["error", "warning", "notice"];
    worst.sort_by_key(|(kind, _)| order.iter().position(|own| own == kind));
    let mut out = String::new();
    for (kind, check) in worst.into_iter().take(ANNOTATIONS) {
        let place = match check.kind.is_printed() {
            true => format!("file={},line={},", property(file), published.line(&check.id)),
            false => String::new(),
        };
        let title = property(&format!("{}: {}", check.id, check.words()));
        let more: String = fields(check).map(|(name, text)| format!("; {name}: {text}")).collect();
        let text = data(&format!("{}{more}", check.statement));
        out += &format!("::{kind} {place}title={title}::{text}\n");
    }
    out
}

/// Text of a workflow command.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// A property of a workflow command.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

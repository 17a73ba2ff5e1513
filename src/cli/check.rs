//! `impact-paper check`.

use super::sources::Sources;
use super::{Failure, judged, signals, stdout, threads, work};
use impact_paper::claims::{self, Check, Kind, Published, Verdict, score};
use impact_paper::experiments::ALL;
use impact_paper::params::Profile;
use serde_json::{Value, json};

/// Judges the statements of the paper, our targets, and relations between numbers.
///
/// Every quantitative statement of the paper is held against what is computed here, the targets of this edition for its
/// own speed and accuracy too, and the numbers of the report against one another.
///
/// Saved results are used where they are fresh; what is missing is run. Prints what fails first, then
/// what differs, and with --all the rest; ends with exit code 1 if one differs without an explanation that holds, if a target is
/// missed that does not depend on the clock, or if a relation between numbers does not hold.
#[derive(clap::Args)]
pub struct Args {
    /// Sample sizes.
    #[arg(long, default_value = "full", value_parser = work::profiles())]
    profile: Profile,
    /// Only this statement (may be repeated); runs no more than it needs.
    #[arg(long, value_name = "ID")]
    claim: Vec<String>,
    /// Print what is reproduced, met and held too.
    #[arg(long)]
    all: bool,
    /// Form of what is printed: `github` annotates what fails and the ten worst others.
    #[arg(long, default_value = "text")]
    format: Format,
    #[command(flatten)]
    sources: Sources,
}

/// Forms for people and machines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    Text,
    Json,
    Github,
}

pub fn run(args: Args) -> Result<(), Failure> {
    let templates = args.sources.templates()?;
    let published = args.sources.published(&templates)?;
    if let Some(id) = args.claim.iter().find(|id| published.statement(id).is_err()) {
        let known: Vec<&str> = published.statements.iter().map(|s| s.id.as_str()).collect();
        let known = known.join(", ");
        let message = format!("--claim: there is no statement {id:?}; there are {known}");
        return Err(Failure::input(message));
    }
    // Targets and relations belong to the whole.
    let needs = match args.claim.as_slice() {
        [] => ALL.to_vec(),
        asked => asked.iter().flat_map(|id| claims::needs(id)).copied().collect(),
    };
    let progress = signals::progress();
    let checks = threads::run(args.sources.threads, || {
        let results = args.sources.run(&needs, args.profile, &templates, &progress)?;
        if args.claim.is_empty() {
            let checks = claims::all(&results, &published)?;
            return Ok([checks, judged::own(&results)?].concat());
        }
        let one = |id: &String| claims::one(id, &results, &published);
        Ok(args.claim.iter().map(one).collect::<Result<Vec<Check>, claims::Error>>()?)
    })?;
    let prose = args.sources.templates.clone().unwrap_or_else(|| "templates".into());
    let here = std::env::current_dir().unwrap_or_default();
    let file = prose.strip_prefix(here).unwrap_or(&prose).join("published.toml");
    let file = file.display().to_string();
    stdout::print(&match args.format {
        Format::Text => text(&checks, args.all || !args.claim.is_empty()),
        Format::Json => json(&checks, &published, &file),
        Format::Github => github(&checks, &published, &file),
    })?;
    judged::verdict(&checks)
}

/// What is known of a check, by names.
fn fields(check: &Check) -> impl Iterator<Item = (&'static str, String)> {
    let tolerance = match check.reason.as_str() {
        "" => String::new(),
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

/// A block of lines for each check, what fails first, and the scores. Without `all` only for what is not simply
/// reproduced, met or held.
fn text(checks: &[Check], all: bool) -> String {
    let listed = |check: &&Check| all || check.verdict != Verdict::Reproduced;
    let mut listed: Vec<&Check> = checks.iter().filter(listed).collect();
    listed.sort_by_key(|check| !check.fails());
    let mut out = String::new();
    for check in listed {
        let mark = match check.verdict {
            _ if check.fails() => "FAILS",
            Verdict::CannotBeJudged => "open",
            Verdict::Differs => "late",
            _ => "ok",
        };
        let place = match check.place.as_str() {
            "" => String::new(),
            place => format!(" ({place})"),
        };
        let (id, words, basis) = (&check.id, check.words(), check.basis.words());
        out += &format!("{mark:5} {id}{place}: {words} ({basis})\n      {}\n", check.statement);
        for (name, text) in fields(check) {
            out += &format!("      {name:10} {text}\n");
        }
    }
    judged::scores(checks).iter().for_each(|line| out += &format!("{line}\n"));
    if !all {
        out += "what is reproduced, met and held is listed with --all\n";
    }
    out
}

/// All that is known, as JSON: checks as ledger.json has them, and the line of each statement.
fn json(checks: &[Check], published: &Published, file: &str) -> String {
    let one = |check: &Check| {
        let mut own = json!(check);
        own["fails"] = check.fails().into();
        own["words"] = check.words().into();
        if check.kind == Kind::Statement {
            (own["file"], own["line"]) = (file.into(), published.line(&check.id).into());
        }
        own
    };
    let list = |kind| judged::of(checks, kind).map(one).collect::<Vec<Value>>();
    let counts = Verdict::ALL.iter().zip(score(judged::of(checks, Kind::Statement)));
    let counts = counts.map(|(verdict, count)| (verdict.words().into(), count.into()));
    let all = json!({
        "score": counts.collect::<serde_json::Map<String, Value>>(),
        "claims": list(Kind::Statement),
        "targets": list(Kind::Target),
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
        _ if check.kind != Kind::Statement => None,
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
        let place = match check.kind {
            Kind::Statement => {
                format!("file={},line={},", property(file), published.line(&check.id))
            }
            _ => String::new(),
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

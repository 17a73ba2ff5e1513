//! `impact-paper check`.

mod forms;

use self::forms::Entry;
use super::judged::Judged;
use super::sources::Sources;
use super::{Failure, signals, stdout, threads, work};
use impact_paper::claims::{self, Check, Verdict};
use impact_paper::experiments::ALL;
use impact_paper::params::Profile;
use impact_paper::report::claims::plain;
use std::io::{self, Write};

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
    /// Only this claim (may be repeated); runs no more than it needs.
    #[arg(long, value_name = "ID")]
    claim: Vec<String>,
    /// Print what is reproduced, met and held too.
    #[arg(long)]
    all: bool,
    /// Form of what is printed: `github` annotates the ten worst claims, and adds the whole table
    /// to the summary of the step.
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
    Markdown,
}

pub fn run(args: Args) -> Result<(), Failure> {
    let profile = args.profile;
    let templates = args.sources.templates()?;
    let published = args.sources.published(&templates)?;
    if let Some(id) = args.claim.iter().find(|id| published.statement(id).is_err()) {
        let known: Vec<&str> = published.statements.iter().map(|s| s.id.as_str()).collect();
        let known = known.join(", ");
        let message = format!("--claim: there is no claim {id:?}; the claims are {known}");
        return Err(Failure::input(message));
    }
    let all: Vec<&str> = published.statements.iter().map(|s| s.id.as_str()).collect();
    let asked: Vec<&str> = match args.claim.as_slice() {
        [] => all,
        some => all.into_iter().filter(|id| some.iter().any(|one| one == id)).collect(),
    };
    let mut needs: Vec<_> = asked.iter().flat_map(|id| claims::needs(id)).copied().collect();
    // Targets and relations belong to the whole.
    let whole = args.claim.is_empty();
    if whole {
        needs = ALL.into();
    }
    let progress = signals::progress();
    let judged = threads::run(args.sources.threads, || {
        let results = args.sources.run(&needs, profile, &templates, &progress)?;
        let one = |id: &&str| claims::one(id, &results, &published);
        let claims = asked.iter().map(one).collect::<Result<Vec<Check>, claims::Error>>()?;
        if !whole {
            return Ok(Judged { claims, ..Judged::default() });
        }
        Judged::all(&results, &published, claims)
    })?;
    let prose = args.sources.templates.clone().unwrap_or_else(|| "templates".into());
    let here = std::env::current_dir().unwrap_or_default();
    let file = prose.strip_prefix(here).unwrap_or(&prose).join("published.toml");
    let file = file.display().to_string();
    let entry = |claim| Entry { claim, file: &file, line: published.line(&claim.id) };
    let entries: Vec<Entry> = judged.claims.iter().map(entry).collect();
    match args.format {
        Format::Text => stdout::written(print(&judged, args.all || !args.claim.is_empty()))?,
        Format::Json => stdout::print(&forms::json(&entries, &judged))?,
        Format::Markdown => stdout::print(&forms::markdown(&entries, &judged))?,
        Format::Github => {
            stdout::print(&forms::github(&entries, &judged))?;
            summarise(&forms::markdown(&entries, &judged))?;
        }
    }
    judged.verdict()
}

/// Adds to the summary of a step of GitHub's, if there is one.
fn summarise(text: &str) -> Result<(), Failure> {
    const NAME: &str = "GITHUB_STEP_SUMMARY";
    let Some(path) = std::env::var_os(NAME).filter(|path| !path.is_empty()) else { return Ok(()) };
    let add = || {
        // A pipe might wait for a reader for ever.
        if std::fs::metadata(&path).is_ok_and(|found| !found.is_file()) {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no file"));
        }
        let mut file = std::fs::OpenOptions::new().append(true).create(true).open(&path)?;
        let before = file.metadata()?.len();
        // Half a table would hide that there is more.
        file.write_all(text.as_bytes()).inspect_err(|_| drop(file.set_len(before)))
    };
    add().map_err(|error| {
        let path = path.display();
        let remedy = "name a file that can be written";
        Failure::io(&error, format!("{NAME} ({path})"), remedy)
    })
}

/// A block of lines for each claim, what fails first, and the scores. Without `all` only for what is not simply
/// reproduced.
fn print(judged: &Judged, all: bool) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    let listed = |check: &&Check| all || check.verdict != Verdict::Reproduced;
    let mut claims: Vec<&Check> = judged.claims.iter().filter(listed).collect();
    claims.sort_by_key(|claim| !claim.fails());
    for claim in claims {
        let mark = if claim.fails() { "FAILS" } else { "ok" };
        let (verdict, basis) = (claim.verdict.words(), claim.basis.words());
        writeln!(out, "{mark:5} {} ({}): {verdict} ({basis})", claim.id, claim.place)?;
        writeln!(out, "      {}", claim.statement)?;
        let fields = [
            ("printed", claim.printed.clone()),
            ("found", plain(&claim.ours)),
            (
                "tolerance",
                match claim.reason.as_str() {
                    "" => String::new(),
                    reason => format!("{} ({reason})", plain(&claim.tolerance)),
                },
            ),
            ("note", plain(&claim.note)),
        ];
        for (name, text) in fields.iter().filter(|(_, text)| !text.is_empty()) {
            writeln!(out, "      {name:10} {text}")?;
        }
    }
    for target in judged.targets.iter().filter(listed) {
        let (found, bound) = (plain(&target.ours), plain(&target.tolerance));
        let (id, what, met) = (&target.id, &target.statement, target.words());
        writeln!(out, "target {id}: {found} ({what}; {bound}): {met}")?;
    }
    for check in judged.relations.iter().filter(|check| check.fails()) {
        writeln!(out, "FAILS relation {}: {}", check.id, plain(&check.ours))?;
    }
    judged.scores().iter().try_for_each(|line| writeln!(out, "{line}"))?;
    if !all {
        writeln!(out, "what is reproduced, met and held is listed with --all")?;
    }
    out.flush()
}

//! `impact-paper check`.

mod forms;

use self::forms::Entry;
use super::sources::Sources;
use super::{Failure, stdout, work};
use impact_paper::claims::targets::{self, Standing, Target};
use impact_paper::claims::{self, Claim};
use impact_paper::params::Profile;
use impact_paper::report::claims::plain;
use std::collections::BTreeSet;
use std::io::{self, Write};

/// Holds every quantitative statement of the paper against what is computed here, and the targets
/// of this edition for its own speed and accuracy.
///
/// Saved results are used where they are fresh; what is missing is run. Prints a row for each
/// claim, and ends with exit code 1 if one differs without an explanation that holds, or if a
/// target is missed that does not depend on the clock.
#[derive(clap::Args)]
pub struct Args {
    /// Sample sizes.
    #[arg(long, default_value = "full")]
    profile: work::ProfileName,
    /// Only this claim (may be repeated); runs no more than it needs.
    #[arg(long, value_name = "ID")]
    claim: Vec<String>,
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
    Junit,
    Sarif,
    Github,
    Markdown,
}

/// Runs the verb.
pub fn run(args: Args) -> Result<(), Failure> {
    let profile = Profile::from(args.profile);
    let templates = args.sources.templates()?;
    let published = args.sources.published(&templates)?;
    if let Some(id) = args.claim.iter().find(|id| published.statement(id).is_err()) {
        let known: Vec<&str> = published.statements.iter().map(|s| s.id.as_str()).collect();
        let message = format!("--claim: there is no claim {id:?}; the claims are {known:?}");
        return Err(Failure::input(message));
    }
    let all: Vec<&str> = published.statements.iter().map(|s| s.id.as_str()).collect();
    let asked: Vec<&str> = match args.claim.as_slice() {
        [] => all,
        some => all.into_iter().filter(|id| some.iter().any(|one| one == id)).collect(),
    };
    let mut needs: BTreeSet<_> = asked.iter().flat_map(|id| claims::needs(id)).copied().collect();
    // The targets belong to the whole.
    let whole = args.claim.is_empty();
    if whole {
        needs.extend(targets::NEEDS);
    }
    let progress = work::progress();
    let (judged, targets) = work::on_threads(args.sources.threads, || {
        let results = args.sources.run(&needs, profile, &templates, &progress)?;
        let fault = |error: claims::Error| Failure::run(error.to_string());
        let one = |id: &&str| claims::one(id, &results, &published).map_err(fault);
        let judged = asked.iter().map(one).collect::<Result<Vec<Claim>, Failure>>()?;
        let targets = if whole { targets::targets(&results).map_err(fault)? } else { Vec::new() };
        Ok((judged, targets))
    })?;
    let line = |id: &str| Ok(published.line(templates.text("published.toml")?, id));
    let entry = |claim| Ok(Entry { claim, line: line(&claim.id)? });
    let entries: Result<Vec<Entry>, impact_paper::report::Error> =
        judged.iter().map(entry).collect();
    let entries = entries.map_err(|error| Failure::input(error.to_string()))?;
    match args.format {
        Format::Text => stdout::written(print(&judged, &targets))?,
        Format::Json => stdout::print(&forms::json(&entries, &targets))?,
        Format::Junit => stdout::print(&forms::junit(&entries))?,
        Format::Sarif => stdout::print(&forms::sarif(&entries))?,
        Format::Markdown => stdout::print(&forms::markdown(&entries, &targets))?,
        Format::Github => {
            stdout::print(&forms::github(&entries))?;
            summarise(&forms::markdown(&entries, &targets))?;
        }
    }
    let failing: Vec<&str> =
        judged.iter().filter(|claim| claim.fails()).map(|claim| claim.id.as_str()).collect();
    if failing.is_empty() {
        let missed = |target: &&Target| target.standing == Standing::Missed && !target.timed;
        let missed: Vec<&str> = targets.iter().filter(missed).map(|target| target.id).collect();
        if missed.is_empty() {
            return Ok(());
        }
        let message =
            format!("targets of accuracy or counted work are missed: {}", missed.join(", "));
        return Err(Failure { code: 1, message });
    }
    let message = format!(
        "{} of {} claims differ without an explanation that holds: {}",
        failing.len(),
        judged.len(),
        failing.join(", ")
    );
    Err(Failure { code: 1, message })
}

/// Adds to the summary of a step of GitHub's, if there is one.
fn summarise(text: &str) -> Result<(), Failure> {
    const NAME: &str = "GITHUB_STEP_SUMMARY";
    let Some(path) = std::env::var_os(NAME).filter(|path| !path.is_empty()) else { return Ok(()) };
    let file = std::fs::OpenOptions::new().append(true).create(true).open(&path);
    file.and_then(|mut file| file.write_all(text.as_bytes())).map_err(|error| {
        Failure::input(format!(
            "{NAME} ({}): {error}; name a file that can be written",
            path.display()
        ))
    })
}

/// A block of lines for each claim, and the scorecard.
fn print(judged: &[Claim], targets: &[Target]) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    for claim in judged {
        let mark = if claim.fails() { "FAILS" } else { "ok" };
        writeln!(out, "{:5} {} ({}): {}", mark, claim.id, claim.place, claim.verdict.words())?;
        writeln!(out, "      {}", claim.statement)?;
        let fields = [
            ("printed", claim.printed.clone()),
            ("ours", plain(&claim.ours)),
            ("within", format!("{} ({})", plain(&claim.tolerance), claim.reason)),
            ("note", plain(&claim.note)),
        ];
        for (name, text) in fields.iter().filter(|(_, text)| !text.is_empty()) {
            writeln!(out, "      {name:8} {text}")?;
        }
    }
    for target in targets {
        let (what, found, bound) = (target.what, plain(&target.found), plain(&target.bound));
        writeln!(
            out,
            "target {}: {found} ({what}; {bound}): {}",
            target.id,
            target.standing.words()
        )?;
    }
    let score: Vec<String> = claims::Verdict::ALL
        .iter()
        .zip(claims::scorecard(judged))
        .map(|(verdict, count)| format!("{count} {}", verdict.words()))
        .collect();
    let noun = if judged.len() == 1 { "claim" } else { "claims" };
    writeln!(out, "{} {noun}: {}", judged.len(), score.join(", "))?;
    out.flush()
}

//! `impact-paper check`.

mod forms;

use self::forms::Entry;
use super::sources::Sources;
use super::{Failure, stdout, work};
use impact_paper::claims::targets::{self, Standing, Target};
use impact_paper::claims::{self, Claim, Published};
use impact_paper::experiments::{Need, Results};
use impact_paper::params::Profile;
use impact_paper::report::claims::{plain, scorecard};
use impact_paper::report::contents;
use impact_paper::report::guards::{self, Failing, Look};
use std::collections::BTreeSet;
use std::io::{self, Write};

/// Holds every quantitative statement of the paper against what is computed here, the targets of
/// this edition for its own speed and accuracy, and the numbers of the report against one another.
///
/// Saved results are used where they are fresh; what is missing is run. Prints a row for each
/// claim, and ends with exit code 1 if one differs without an explanation that holds, if a target is
/// missed that does not depend on the clock, or if a guard fails, a relation that must hold.
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
    // Targets and guards belong to the whole.
    let whole = args.claim.is_empty();
    if whole {
        needs.extend(Need::ALL);
    }
    let progress = work::progress();
    let (judged, targets, failing) = work::on_threads(args.sources.threads, || {
        let results = args.sources.run(&needs, profile, &templates, &progress)?;
        let fault = |error: claims::Error| Failure::run(error.to_string());
        let one = |id: &&str| claims::one(id, &results, &published).map_err(fault);
        let judged = asked.iter().map(one).collect::<Result<Vec<Claim>, Failure>>()?;
        let targets = if whole { targets::targets(&results).map_err(fault)? } else { Vec::new() };
        let failing = if whole { guarding(&results, &published, &judged)? } else { Vec::new() };
        Ok((judged, targets, failing))
    })?;
    let line = |id: &str| Ok(published.line(templates.text("published.toml")?, id));
    let entry = |claim| Ok(Entry { claim, line: line(&claim.id)? });
    let entries: Result<Vec<Entry>, impact_paper::report::Error> =
        judged.iter().map(entry).collect();
    let entries = entries.map_err(|error| Failure::input(error.to_string()))?;
    match args.format {
        Format::Text => {
            let relations = whole.then(|| guards::all().count());
            stdout::written(print(&judged, &targets, &failing, relations))?
        }
        Format::Json => stdout::print(&forms::json(&entries, &targets, &failing))?,
        Format::Junit => stdout::print(&forms::junit(&entries, &failing))?,
        Format::Sarif => stdout::print(&forms::sarif(&entries))?,
        Format::Markdown => stdout::print(&forms::markdown(&entries, &targets, &failing))?,
        Format::Github => {
            stdout::print(&forms::github(&entries, &failing))?;
            summarise(&forms::markdown(&entries, &targets, &failing))?;
        }
    }
    verdict(&judged, &targets, &failing)
}

/// Relations between the numbers of the report that do not hold.
fn guarding(
    results: &Results,
    published: &Published,
    claims: &[Claim],
) -> Result<Vec<Failing>, Failure> {
    let fault = |error: &dyn std::error::Error| Failure::run(error.to_string());
    let mut values = contents::registry(results, published).map_err(|e| fault(&e))?;
    values.extend(scorecard(claims)).map_err(|e| fault(&e))?;
    Ok(guards::failing(Look { results, published, values: &values, claims }).collect())
}

/// Exit code 1 for what does not hold.
fn verdict(judged: &[Claim], targets: &[Target], failing: &[Failing]) -> Result<(), Failure> {
    let differ: Vec<&str> =
        judged.iter().filter(|claim| claim.fails()).map(|claim| claim.id.as_str()).collect();
    let missed = |target: &&Target| target.standing == Standing::Missed && !target.timed;
    let missed: Vec<&str> = targets.iter().filter(missed).map(|target| target.id).collect();
    let broken: Vec<&str> = failing.iter().map(|failing| failing.name).collect();
    let faults = [
        (
            format!(
                "{} of {} claims differ without an explanation that holds",
                differ.len(),
                judged.len()
            ),
            differ,
        ),
        ("targets of accuracy or counted work are missed".into(), missed),
        ("relations between numbers of the report do not hold".into(), broken),
    ];
    let told = faults.into_iter().filter(|(_, names)| !names.is_empty());
    let told: Vec<String> =
        told.map(|(what, names)| format!("{what}: {}", names.join(", "))).collect();
    if told.is_empty() { Ok(()) } else { Err(Failure { code: 1, message: told.join("; ") }) }
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

/// A block of lines for each claim, and the scores: of the paper's statements, and of our own checks
/// (`relations` of them, where they were asked).
fn print(
    judged: &[Claim],
    targets: &[Target],
    failing: &[Failing],
    relations: Option<usize>,
) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    for claim in judged {
        let mark = if claim.fails() { "FAILS" } else { "ok" };
        let (verdict, basis) = (claim.verdict.words(), claim.basis.words());
        writeln!(out, "{mark:5} {} ({}): {verdict} ({basis})", claim.id, claim.place)?;
        writeln!(out, "      {}", claim.statement)?;
        let fields = [
            ("printed", claim.printed.clone()),
            ("ours", plain(&claim.ours)),
            (
                "within",
                match claim.reason.as_str() {
                    "" => String::new(),
                    reason => format!("{} ({reason})", plain(&claim.tolerance)),
                },
            ),
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
    for Failing { name, what } in failing {
        writeln!(out, "FAILS guard {name}: {what}")?;
    }
    let score: Vec<String> = claims::Verdict::ALL
        .iter()
        .zip(claims::scorecard(judged))
        .map(|(verdict, count)| format!("{count} {}", verdict.words()))
        .collect();
    let noun = if judged.len() == 1 { "statement" } else { "statements" };
    writeln!(out, "{} {noun} of the paper: {}", judged.len(), score.join(", "))?;
    let bases = claims::Basis::ALL.iter().zip(claims::split(judged));
    let bases = bases.map(|(basis, counts)| (basis.words(), counts[0], counts.iter().sum()));
    let bases: Vec<String> = bases
        .filter(|(_, _, all): &(_, _, usize)| *all > 0)
        .map(|(basis, reproduced, all)| format!("{reproduced} of {all} {basis}"))
        .collect();
    writeln!(out, "reproduced, by what the verdict rests on: {}", bases.join(", "))?;
    if let Some(relations) = relations {
        let held = relations - failing.len();
        writeln!(out, "our own checks: {held} of {relations} relations between numbers hold")?;
    }
    out.flush()
}

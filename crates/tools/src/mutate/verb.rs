//! `impact-paper-tools mutate`.

use super::{Mutation, Mutations, Reasons, Subject, Tally, mutate, used};
use impact_paper::claims;
use impact_paper::experiments::{ALL, Error, Progress};
use impact_paper::params::Profile;
use impact_paper::program::sources::Sources;
use impact_paper::program::{Failure, signals, stdout, threads, work};
use impact_paper::report::{Value, contents};
use serde_json::json;
use std::fmt::Write as _;

/// Makes each number of the report wrong by more than its tolerance, and lists which check notices.
///
/// A number is moved to both sides, where the paper printed it or on its way to the report, and verdicts are computed
/// again; nothing is simulated. Comparisons with stored bytes are no checks here. Ends with exit code 1
/// if no check notices a number that prose or claims use and unguarded.toml gives no reason, or if
/// it gives one without need.
#[derive(clap::Args)]
pub struct Args {
    /// Sample sizes.
    #[arg(long, default_value = "full", value_parser = work::of_reports())]
    profile: Profile,
    /// Only this value (may be repeated); exit code 1 if nothing notices one.
    #[arg(long, value_name = "ID")]
    value: Vec<String>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    sources: Sources,
}

/// Each wanted number made wrong.
fn found(
    subject: Subject<'_>,
    wanted: &(dyn Fn(&Value) -> bool + Sync),
    progress: &Progress,
) -> Result<Mutations, Error> {
    let stage = progress.stage("mutations", 1);
    let found = mutate(subject, wanted, &|| !progress.stopped());
    stage.advance(1);
    progress.check()?;
    found.map_err(|error| Error::input("results", error.to_string(), "run a fuller profile"))
}

/// Runs the verb.
pub fn run(args: Args) -> Result<(), Failure> {
    let profile = args.profile;
    let templates = args.sources.templates()?;
    let published = args.sources.published(&templates)?;
    let reasons = Reasons::read(templates.text("unguarded.toml")?)?;
    let progress = signals::progress();
    let (found, used, values) = threads::run(args.sources.threads, || {
        let results = args.sources.run(&ALL, profile, &templates, &progress)?;
        results.look();
        let claims = claims::all(&results, &published)?;
        let values = contents::registry(&results, &published)?;
        let rows = contents::rows(&results, &claims)?;
        let mut used = used(&templates, &values, &rows, &claims)?;
        let asked: Vec<&str> = args.value.iter().map(String::as_str).collect();
        if let Some(id) = asked.iter().find(|id| !used.contains(**id)) {
            let message = format!("--value: neither prose nor a claim uses a number {id:?}");
            return Err(Failure::input(message));
        }
        let subject = Subject { results: &results, published: &published };
        if !asked.is_empty() {
            used.retain(|id| asked.contains(&id.as_str()));
        }
        let wanted = |value: &Value| asked.is_empty() || used.contains(&value.id);
        let found = found(subject, &wanted, &progress)?;
        Ok((found, used, values))
    })?;
    let reasons = if args.value.is_empty() { reasons } else { Reasons::default() };
    let tally = Tally::of(&used, &found, &reasons, &values);
    let form = if args.json { data } else { text };
    stdout::print(&form(&found, &tally, &reasons))?;
    failure(&tally).map_or(Ok(()), Err)
}

fn failure(tally: &Tally) -> Option<Failure> {
    let mut faults = Vec::new();
    if !tally.bare.is_empty() {
        let ids: Vec<&str> = tally.bare.iter().map(String::as_str).collect();
        faults.push(format!(
            "no check notices that these are wrong: {}; guard them, or give a reason in unguarded.toml",
            ids.join(", ")
        ));
    }
    if !tally.needless.is_empty() {
        faults.push(format!(
            "unguarded.toml has reasons without need: {}",
            tally.needless.join(", ")
        ));
    }
    (!faults.is_empty()).then(|| Failure::check(faults.join("; ")))
}

/// How a number stands, in a word or with its reason.
fn standing<'a>(id: &str, tally: &Tally, reasons: &'a Reasons) -> (&'static str, &'a str) {
    if tally.guarded.contains(id) {
        ("guarded", "")
    } else {
        reasons.of(id).map_or(("UNGUARDED", ""), |group| ("excused", group.why.as_str()))
    }
}

fn text(found: &Mutations, tally: &Tally, reasons: &Reasons) -> String {
    let mut out = String::new();
    for (id, mutation) in found.iter().filter(|(id, _)| tally.knows(id)) {
        let (word, why) = standing(id, tally, reasons);
        let Mutation { by, place, above, below } = mutation;
        let _ = write!(out, "{word:9} {id} ± {by:.1e} at {place}: ");
        let list = |red: &[String]| match red {
            [] => "nothing".to_string(),
            red => red.join(", "),
        };
        if above == below {
            let _ = write!(out, "{}", list(above));
        } else {
            let _ = write!(out, "above {}, below {}", list(above), list(below));
        }
        let _ = if why.is_empty() { writeln!(out) } else { writeln!(out, " ({why})") };
    }
    for (kind, ids) in &tally.excused {
        let _ = writeln!(out, "excused, {kind}: {}", ids.len());
    }
    let _ = writeln!(
        out,
        "{} numbers: {} guarded, {} not, {} of these without a reason",
        tally.used(),
        tally.guarded.len(),
        tally.unguarded(),
        tally.bare.len()
    );
    out
}

fn data(found: &Mutations, tally: &Tally, reasons: &Reasons) -> String {
    let one = |(id, mutation): (&String, &Mutation)| {
        let (word, why) = standing(id, tally, reasons);
        json!({
            "id": id, "by": mutation.by, "at": mutation.place, "above": mutation.above,
            "below": mutation.below, "standing": word.to_lowercase(), "reason": why,
        })
    };
    let values: Vec<_> = found.iter().filter(|(id, _)| tally.knows(id)).map(one).collect();
    let counts = json!({
        "used": tally.used(), "guarded": tally.guarded.len(), "unguarded": tally.unguarded(),
        "without_a_reason": tally.bare.len(),
    });
    format!("{:#}\n", json!({ "counts": counts, "needless": tally.needless, "values": values }))
}

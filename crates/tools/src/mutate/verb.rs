//! `impact-paper-tools mutate`.

use super::{Mutation, Mutations, Subject, Tally, mutate, used};
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
/// if no check notices a number that prose or claims use.
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
    let progress = signals::progress();
    let (found, used) = threads::run(args.sources.threads, || {
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
        Ok((found, used))
    })?;
    let tally = Tally::of(used, &found);
    let form = if args.json { data } else { text };
    stdout::print(&form(&found, &tally))?;
    if tally.unguarded.is_empty() {
        return Ok(());
    }
    let ids: Vec<&str> = tally.unguarded.iter().map(String::as_str).collect();
    let ids = ids.join(", ");
    Err(Failure::check(format!(
        "no check notices that these are wrong: {ids}; guard them, or show them nowhere"
    )))
}

fn standing(id: &str, tally: &Tally) -> &'static str {
    if tally.guarded.contains(id) { "guarded" } else { "UNGUARDED" }
}

fn text(found: &Mutations, tally: &Tally) -> String {
    let mut out = String::new();
    for (id, mutation) in found.iter().filter(|(id, _)| tally.knows(id)) {
        let word = standing(id, tally);
        let Mutation { by, place, above, below } = mutation;
        let _ = write!(out, "{word:9} {id} ± {by:.1e} at {place}: ");
        let list = |red: &[String]| match red {
            [] => "nothing".to_string(),
            red => red.join(", "),
        };
        if above == below {
            let _ = writeln!(out, "{}", list(above));
        } else {
            let _ = writeln!(out, "above {}, below {}", list(above), list(below));
        }
    }
    let Tally { guarded, unguarded } = tally;
    let (guarded, unguarded) = (guarded.len(), unguarded.len());
    let _ = writeln!(out, "{} numbers: {guarded} guarded, {unguarded} not", guarded + unguarded);
    out
}

fn data(found: &Mutations, tally: &Tally) -> String {
    let one = |(id, mutation): (&String, &Mutation)| {
        let word = standing(id, tally).to_lowercase();
        json!({
            "id": id, "by": mutation.by, "at": mutation.place, "above": mutation.above,
            "below": mutation.below, "standing": word,
        })
    };
    let values: Vec<_> = found.iter().filter(|(id, _)| tally.knows(id)).map(one).collect();
    let (guarded, unguarded) = (tally.guarded.len(), tally.unguarded.len());
    let counts = json!({ "used": guarded + unguarded, "guarded": guarded, "unguarded": unguarded });
    format!("{:#}\n", json!({ "counts": counts, "values": values }))
}

//! How good the checks are: each number of the report that is no cell of a table is made wrong, and some check must
//! notice. (What a cell is stands once, in its column, and the columns have tests.)
//!
//! A printed number is moved in what was printed, any other on its way to the report, by more than its tolerance
//! (`mutate::size`); claims, values and guards are computed again. Nothing is simulated.
//!
//! A check is what makes `impact-paper check` or `impact-paper paper` fail: a claim, a target that no clock
//! decides, a guard ([`impact_paper::report::guards`]), or a report that cannot be made. A comparison with stored bytes is
//! none. A number is guarded if one notices in both directions.

mod size;
mod tally;
pub mod verb;

use tally::{Tally, used};

use impact_paper::claims::{self, Check, Published, targets};
use impact_paper::experiments::Results;
use impact_paper::report::claims::scorecard;
use impact_paper::report::contents;
use impact_paper::report::guards::{self, Look};
use impact_paper::report::values::{Registry, Value};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicBool, Ordering};

/// One number that was made wrong, and which checks notice.
#[derive(Clone, Debug, PartialEq)]
pub struct Mutation {
    /// By how much it was moved to both sides.
    pub by: f64,
    /// Where it was moved.
    pub place: String,
    /// What turned red when it was larger.
    pub above: Vec<String>,
    /// What turned red when it was smaller.
    pub below: Vec<String>,
}

impl Mutation {
    /// Whether something notices in both directions.
    pub fn guarded(&self) -> bool {
        !self.above.is_empty() && !self.below.is_empty()
    }
}

/// For each number of the report, by id; words are left out.
pub type Mutations = BTreeMap<String, Mutation>;

/// What is made wrong.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// Results of all experiments.
    pub results: &'a Results,
    /// What the paper printed.
    pub published: &'a Published,
}

/// Claims, and the names of the claims and targets that fail.
struct Judged {
    claims: Vec<Check>,
    red: BTreeSet<String>,
}

/// Judges results with their values, to which the scorecard is added.
fn judged(subject: Subject<'_>, values: &mut Registry) -> Result<Judged, contents::Error> {
    let Subject { results, published } = subject;
    let claims = claims::all(results, published)?;
    scorecard(&claims).into_iter().for_each(|value| values.put(value));
    let mut red = BTreeSet::new();
    red.extend(claims.iter().filter(|c| c.fails()).map(|c| format!("claim {}", c.id)));
    let targets = targets::targets(results)?;
    red.extend(targets.iter().filter(|t| t.fails()).map(|t| format!("target {}", t.id)));
    Ok(Judged { claims, red })
}

/// The guards that fail.
fn failing(subject: Subject<'_>, values: &Registry, claims: &[Check]) -> BTreeSet<String> {
    let Subject { results, published } = subject;
    let look = Look { results, published, values, claims };
    let fails = guards::all().filter(|guard| (guard.find)(look).is_some());
    fails.map(|guard| format!("guard {}", guard.name)).collect()
}

/// Makes every wanted number wrong, one after the other; `go_on` is asked after each, and ends all by
/// a no.
///
/// # Errors
/// If the report cannot be made from the results as they are.
pub fn mutate(
    subject: Subject<'_>,
    wanted: &(dyn Fn(&Value) -> bool + Sync),
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Mutations, contents::Error> {
    let bench = Bench::new(subject)?;
    let values: Vec<&Value> = bench.values.iter().filter(|value| wanted(value)).collect();
    let stopped = AtomicBool::new(false);
    let one = |value: &&Value| {
        if stopped.load(Ordering::Relaxed) {
            return None;
        }
        let found = bench.one(value);
        stopped.fetch_or(!go_on(), Ordering::Relaxed);
        Some((value.id.clone(), found?))
    };
    Ok(values.par_iter().with_max_len(1).filter_map(one).collect())
}

/// The report as it is.
struct Bench<'a> {
    subject: Subject<'a>,
    values: Registry,
    before: Judged,
}

impl<'a> Bench<'a> {
    fn new(subject: Subject<'a>) -> Result<Self, contents::Error> {
        let mut values = contents::registry(subject.results, subject.published)?;
        let mut before = judged(subject, &mut values)?;
        let guards = failing(subject, &values, &before.claims);
        before.red.extend(guards);
        Ok(Bench { subject, values, before })
    }

    fn one(&self, value: &Value) -> Option<Mutation> {
        let by = size::step(value, claims::level())?;
        let printed = value.id.starts_with("paper.") || value.id.starts_with("printed.");
        let place = if printed { "published.toml" } else { "report" };
        let red = |by| if printed { self.misprinted(value, by) } else { self.moved(value, by) };
        Some(Mutation { by, place: place.into(), above: red(by), below: red(-by) })
    }

    /// What turns red where the paper had printed another number.
    fn misprinted(&self, value: &Value, by: f64) -> Vec<String> {
        let mut published = self.subject.published.clone();
        print(&mut published, &value.id, by);
        let subject = Subject { published: &published, ..self.subject };
        let again = contents::registry(subject.results, &published).and_then(|mut values| {
            let Judged { claims, mut red } = judged(subject, &mut values)?;
            red.extend(failing(subject, &values, &claims));
            Ok(self.new_in(&red))
        });
        again.unwrap_or_else(|error| vec![format!("report: {error}")])
    }

    /// What turns red where a number is another on its way to the report.
    fn moved(&self, value: &Value, by: f64) -> Vec<String> {
        let mut values = self.values.clone();
        values.put(value.clone().with_number(size::moved(&value.number, by)));
        self.new_in(&failing(self.subject, &values, &self.before.claims))
    }

    /// What is red that was not.
    fn new_in(&self, red: &BTreeSet<String>) -> Vec<String> {
        red.difference(&self.before.red).cloned().collect()
    }
}

/// Moves a number that the paper printed.
fn print(published: &mut Published, id: &str, by: f64) {
    let Some((group, id)) = id.split_once('.') else { return };
    if group == "paper" {
        published.parameters.iter_mut().filter(|p| p.id == id).for_each(|p| p.value += by);
    } else {
        let stated = published.statements.iter_mut().filter(|s| s.id == id);
        stated.for_each(|s| s.value = s.value.map(|value| value + by));
    }
}

//! How good the checks are: each number of the report is made wrong, and some check must notice.
//!
//! A number is made wrong where it comes from. It is looked for among the numbers of its own
//! experiment's results (a *leaf*), moved there by more than its tolerance (`mutate::size`), and claims, values
//! and guards are computed again from the wrong results; a printed number is moved in what
//! was printed. A number that no leaf carries was computed on the way to the report, and is moved
//! there. Nothing is simulated again.
//!
//! A check is what makes `impact-paper check` or `impact-paper paper` fail: a claim, a target that no clock
//! decides, a guard ([`impact_paper::report::guards`]), a report that cannot be made, or a type (no count is negative).
//! A comparison with stored bytes is none. A number is guarded if one notices in both directions.

mod part;
mod reasons;
mod sections;
mod site;
mod size;
mod tally;
pub mod verb;

use reasons::Reasons;
use tally::{Tally, used};

use self::part::Whole;
use self::sections::{Changed, Sections};
use self::site::Site;
use impact_paper::claims::{self, Check, Published, targets};
use impact_paper::experiments::Results;
use impact_paper::report::claims::scorecard;
use impact_paper::report::contents;
use impact_paper::report::guards::{self, Guard, Look};
use impact_paper::report::values::{Number, Registry, Value};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

/// What became of one number that was made wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Mutation {
    /// By how much it was moved to both sides.
    pub by: f64,
    /// Where it was moved.
    pub place: String,
    /// What turned red when it was larger: claims and the guards that relate it; others if these did not.
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

/// Claims, and the names of the checks that fail, guards only as far as they were asked.
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

impl Judged {
    /// Adds the guards that fail among some.
    fn guard(&mut self, subject: Subject<'_>, values: &Registry, among: impl Fn(&Guard) -> bool) {
        let Subject { results, published } = subject;
        let look = Look { results, published, values, claims: &self.claims };
        let fails = |guard: &&Guard| among(guard) && (guard.find)(look).is_some();
        self.red.extend(guards::all().filter(fails).map(|guard| format!("guard {}", guard.name)));
    }
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

/// The report as it is, and copies of it to be made wrong.
struct Bench<'a> {
    subject: Subject<'a>,
    whole: Whole,
    values: Registry,
    before: Judged,
    sections: Sections,
    idle: Mutex<Vec<Spare>>,
    /// What followed when leaves were moved by so much: many values are the same small integer.
    followers: Mutex<Known>,
}

/// A copy of the report.
struct Spare {
    results: Results,
    whole: Whole,
    values: Registry,
}

/// A copy of the report in which something is wrong.
struct Wrongly<'a> {
    subject: Subject<'a>,
    values: &'a mut Registry,
    /// Ids of the values that changed.
    changed: &'a Changed,
    /// Whether there is a report.
    outcome: Result<(), contents::Error>,
}

/// A number in the results: the index of its part, and its path there.
type Leaf = (usize, String);

/// A leaf, and by how much it is moved.
type Move = (Leaf, f64);

/// The numbers that are others when leaves are moved, by the ids of their values.
type Followers = Arc<BTreeMap<String, Number>>;

impl<'a> Bench<'a> {
    fn new(subject: Subject<'a>) -> Result<Self, contents::Error> {
        let Subject { results, published } = subject;
        // Copies take the tables over.
        results.tables();
        let mut values = contents::registry(results, published)?;
        let mut before = judged(subject, &mut values)?;
        before.guard(subject, &values, |_| true);
        Ok(Bench {
            subject,
            whole: Whole::of(results),
            values,
            before,
            sections: Sections::of(results)?,
            idle: Mutex::default(),
            followers: Mutex::default(),
        })
    }

    fn one(&self, value: &Value) -> Option<Mutation> {
        let by = size::step(value, claims::level())?;
        let site = Site::of(value, by, self);
        let [above, below] = [by, -by].map(|by| self.red(value, &site, by));
        Some(Mutation { by, place: site.to_string(), above, below })
    }

    /// What turns red that is not so without.
    fn red(&self, value: &Value, site: &Site, by: f64) -> Vec<String> {
        match self.at(value, site, by) {
            Wrong::Judged(red) => red.difference(&self.before.red).cloned().collect(),
            Wrong::Refused(why) => vec![why],
        }
    }

    /// What becomes of a report with a wrong number: claims, and the guards that relate it. The others are
    /// asked only if all of these are silent.
    fn wrong(&self, subject: Subject<'_>, values: &mut Registry, id: &str) -> Wrong {
        match judged(subject, values) {
            Ok(judged) => self.guarded(judged, subject, values, id),
            Err(error) => refused(&error),
        }
    }

    fn guarded(
        &self,
        mut judged: Judged,
        subject: Subject<'_>,
        values: &Registry,
        id: &str,
    ) -> Wrong {
        judged.guard(subject, values, |guard| guard.is_about(id));
        if judged.red.is_subset(&self.before.red) {
            judged.guard(subject, values, |guard| !guard.is_about(id));
        }
        Wrong::Judged(judged.red)
    }

    /// The report with this number moved.
    fn at(&self, value: &Value, site: &Site, by: f64) -> Wrong {
        match site {
            Site::Leaves(leaves) => {
                let judge = |wrong: Wrongly<'_>| match wrong.outcome {
                    Ok(()) => self.wrong(wrong.subject, wrong.values, &value.id),
                    Err(error) => refused(&error),
                };
                let shape = || Wrong::Refused("type of the result".into());
                self.with(&moved(leaves, |_| by), judge).unwrap_or_else(shape)
            }
            Site::Printed => {
                let mut published = self.subject.published.clone();
                site::print(&mut published, &value.id, by);
                let subject = Subject { published: &published, ..self.subject };
                match contents::registry(subject.results, &published) {
                    Ok(mut values) => self.wrong(subject, &mut values, &value.id),
                    Err(error) => refused(&error),
                }
            }
            Site::Report => {
                let mut values = self.values.clone();
                let mut wrong = value.clone();
                wrong.number = size::moved(&value.number, by);
                values.put(wrong);
                let claims = self.before.claims.clone();
                let mut red = self.before.red.clone();
                red.retain(|name| !name.starts_with("guard "));
                self.guarded(Judged { claims, red }, self.subject, &values, &value.id)
            }
        }
    }

    /// What becomes of a report with these leaves moved; None if results are of another shape then.
    fn with<T>(&self, moves: &[Move], judge: impl FnOnce(Wrongly<'_>) -> T) -> Option<T> {
        let idle = self.idle.lock().ok().and_then(|mut idle| idle.pop());
        let mut spare = idle.unwrap_or_else(|| Spare {
            results: self.subject.results.shared(),
            whole: self.whole.clone(),
            values: self.values.clone(),
        });
        let Spare { results, whole, values } = &mut spare;
        // Leaves of one part stand together.
        let parts = || moves.chunk_by(|a, b| a.0.0 == b.0.0).map(|moves| moves[0].0.0);
        moves.iter().for_each(|((index, path), by)| whole.add(*index, path, *by));
        let put = parts().try_for_each(|index| part::put(results, index, whole.part(index)));
        let found = put.ok().map(|()| {
            let (changed, outcome) = self.sections.exchange(values, results, parts());
            let subject = Subject { results, ..self.subject };
            let found = judge(Wrongly { subject, values, changed: &changed, outcome });
            Sections::restore(values, &changed, &self.values);
            found
        });
        moves.iter().for_each(|((index, path), _)| whole.restore(*index, path, &self.whole));
        parts().for_each(|index| part::restore(results, index, self.subject.results));
        if let Ok(mut idle) = self.idle.lock() {
            idle.push(spare);
        }
        found
    }

    /// The numbers that follow when leaves are moved; none if there is no report then.
    fn followers(&self, moves: &[Move]) -> Option<Followers> {
        let key: Vec<_> = moves.iter().map(|(leaf, by)| (leaf.clone(), by.to_bits())).collect();
        let known = self.followers.lock().ok().and_then(|known| known.get(&key).cloned());
        known.unwrap_or_else(|| {
            let found = self.follow(moves);
            if let Ok(mut known) = self.followers.lock() {
                known.insert(key, found.clone());
            }
            found
        })
    }

    fn follow(&self, moves: &[Move]) -> Option<Followers> {
        let other = |wrong: Wrongly<'_>| {
            wrong.outcome.ok()?;
            let found = wrong.changed.iter().filter_map(|id| {
                let number = &wrong.values.get(id)?.number;
                let same = self.values.get(id).is_some_and(|own| own.number == *number);
                (!same).then(|| (id.clone(), number.clone()))
            });
            Some(Arc::new(found.collect()))
        };
        self.with(moves, other)?
    }
}

/// Leaves moved by so much, given their places in the list.
fn moved(leaves: &[Leaf], by: impl Fn(usize) -> f64) -> Vec<Move> {
    leaves.iter().enumerate().map(|(i, leaf)| (leaf.clone(), by(i))).collect()
}

/// Followers by what was moved, with the bits of each step; none where there was no report.
type Known = BTreeMap<Vec<(Leaf, u64)>, Option<Followers>>;

/// What a wrong number leads to.
enum Wrong {
    /// A report, and what is red in it.
    Judged(BTreeSet<String>),
    /// None: by what it is refused.
    Refused(String),
}

fn refused(error: &contents::Error) -> Wrong {
    Wrong::Refused(format!("report: {error}"))
}

/// Whether two numbers are the same but for rounding, on the scale of a step.
fn same(a: &Number, b: &Number, step: f64) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-6 * step.abs();
    match (a, b) {
        (Number::Integer(a), Number::Integer(b)) => a == b,
        (Number::Real { value: a, .. }, Number::Real { value: b, .. }) => near(*a, *b),
        (Number::Interval { low, high }, Number::Interval { low: l, high: h }) => {
            near(*low, *l) && near(*high, *h)
        }
        _ => false,
    }
}

//! What this edition promises about its own speed and accuracy, and what is found.
//!
//! A target that rests on counted work or on accuracy is decided by the results; one that rests on
//! the clock by the committed measurements, and is open while nobody measured it.

use super::{Basis, Check, Error, Kind, Text, Verdict};
use crate::experiments::accuracy::race::{Entry, Race};
use crate::experiments::accuracy::trials::right;
use crate::experiments::measured::{Row, What};
use crate::experiments::{MEASURED, RACE, SCALE, TRIALS};
use crate::experiments::{Measured, Need, Results};
use crate::params::MethodName;

/// The experiments that the targets need.
pub const NEEDS: &[Need] = &[&RACE, &SCALE, &TRIALS, &MEASURED];

/// Largest error of a waiting time in units of ε (d + R₁ + R₂)/|Δ'| that is allowed.
pub const UNITS: f64 = 8.0;

/// All targets, those of the clock first.
pub fn targets(results: &Results) -> Result<Vec<Check>, Error> {
    let measured = results.of(&MEASURED)?;
    let race = results.of(&RACE)?;
    let mut all = clock(measured);
    all.extend(memory(measured));
    all.push(growth(results)?);
    all.extend(segments(race));
    all.push(scenes(results)?);
    Ok(all)
}

fn engine(measured: &Measured, n: u64) -> Option<&Row> {
    let own = measured.of(What::Engine).filter(|row| row.n == n && row.chains == 1);
    own.filter(|row| row.note.is_empty()).find(|row| row.microseconds_per_impact.is_some())
}

fn met(so: bool) -> Verdict {
    if so { Verdict::Reproduced } else { Verdict::Differs }
}

/// A target with its bound and what was found; times of the clock decide it, or counted work and accuracy.
fn target(
    (id, what): (&str, &str),
    bound: Text,
    found: Text,
    timed: bool,
    verdict: Verdict,
) -> Check {
    Check {
        kind: Kind::Target,
        id: id.into(),
        place: String::new(),
        statement: what.into(),
        printed: String::new(),
        ours: found,
        tolerance: bound,
        reason: "promised before it was measured".into(),
        basis: if timed { Basis::Clock } else { Basis::OurMeasure },
        verdict,
        note: Text::default(),
    }
}

/// A target of the form "at most".
fn at_most(
    (id, what): (&'static str, &'static str),
    (bound, unit): (f64, &str),
    found: Option<f64>,
    timed: bool,
) -> Check {
    let (text, verdict) = match found {
        Some(x) => (Text::default().significant(x, 3).say(unit), met(x <= bound)),
        None => (Text::words("–"), Verdict::CannotBeJudged),
    };
    let bound = if bound == 0.0 {
        Text::words("none")
    } else {
        Text::words("≤ ").chosen(bound).say(unit)
    };
    target((id, what), bound, text, timed, verdict)
}

fn clock(measured: &Measured) -> Vec<Check> {
    let time = |row: Option<&Row>| row.and_then(|row| row.microseconds_per_impact);
    let ensemble = measured
        .of(What::Ensemble)
        .filter(|row| row.threads == 1)
        .filter_map(|row| row.microseconds_per_impact)
        .min_by(f64::total_cmp);
    let command = |name: &str| {
        measured.of(What::Command).find(|row| row.name == name).and_then(|row| row.seconds)
    };
    let one = ("one_chain", "time of an impact, one chain of 100 masses");
    let many = ("ensemble", "time of an impact, an ensemble on one core");
    let mut all = vec![
        at_most(one, (0.25, " µs"), time(engine(measured, 100)), true),
        at_most(many, (0.25, " µs"), ensemble, true),
        against(
            measured,
            "heyoka_20",
            "time of heyoka at its tightest over ours, 20 masses",
            20,
            25.0,
        ),
        against(measured, "heyoka_100", "the same, 100 masses", 100, 100.0),
    ];
    for (name, what, bound) in [
        ("quick", "the quick profile", 5.0),
        ("full", "the full profile", 120.0),
        ("main sweep", "its main sweep alone", 60.0),
    ] {
        all.push(at_most((name, what), (bound, " s"), command(name), true));
    }
    all
}

/// How many times faster we are than heyoka at its tightest tolerance, with a horizon no shorter
/// and no more segments missed.
fn against(measured: &Measured, id: &'static str, what: &'static str, n: u64, bound: f64) -> Check {
    let peers = measured.of(What::Peer).filter(|row| row.n == n && row.name.starts_with("heyoka"));
    let tightest = peers.max_by_key(|row| row.horizon_impact.or(row.compared));
    let (found, verdict) = match tightest.zip(engine(measured, n)) {
        Some((peer, own)) => match peer.microseconds_per_impact.zip(own.microseconds_per_impact) {
            Some((theirs, ours)) => {
                let reach = |row: &Row| row.horizon_impact.or(row.compared);
                let faster = theirs / ours >= bound && reach(own) >= reach(peer);
                (Text::default().significant(theirs / ours, 3), met(faster))
            }
            None => (Text::words("–"), Verdict::CannotBeJudged),
        },
        None => (Text::words("–"), Verdict::CannotBeJudged),
    };
    target((id, what), Text::words("≥ ").chosen(bound), found, true, verdict)
}

fn memory(measured: &Measured) -> Vec<Check> {
    let full = measured.of(What::Command).find(|row| row.name == "full");
    let million = measured.of(What::Engine).filter(|row| row.n == 1_000_000);
    let million = million.filter_map(|row| row.peak_mib).min_by(f64::total_cmp);
    let whole = ("memory", "memory of the full profile");
    let large = ("million", "memory of a chain of a million masses");
    vec![
        at_most(whole, (300.0, " MiB"), full.and_then(|row| row.peak_mib), true),
        at_most(large, (1024.0, " MiB"), million, true),
    ]
}

/// Counted work of the largest chain over that of a hundred masses.
fn growth(results: &Results) -> Result<Check, Error> {
    let scale = results.of(&SCALE)?;
    let own = || scale.iter().filter(|row| row.0.method == MethodName::Certified);
    let largest = own().max_by_key(|row| row.1);
    let hundred = own().find(|row| row.1 == 100);
    let ratio = largest.zip(hundred).map(|(a, b)| a.2 / b.2);
    let name =
        ("work", "evaluations per impact in the largest chain over those at a hundred masses");
    Ok(at_most(name, (2.0, ""), ratio, false))
}

/// The certified engine among the methods.
pub(crate) fn own_entry(race: &Race) -> Option<&Entry> {
    race.entries.iter().find(|entry| entry.setting.method == MethodName::Certified)
}

fn segments(race: &Race) -> Vec<Check> {
    let own = own_entry(race);
    let misses = own.map(|entry| entry.misses as f64);
    let units = own.and_then(|entry| entry.units);
    let missed = ("misses", "impacts missed from exact states");
    let waiting = (
        "waiting",
        "largest error of a waiting time, in units of ε (d + R₁ + R₂) over the closing speed",
    );
    vec![at_most(missed, (0.0, ""), misses, false), at_most(waiting, (UNITS, ""), units, false)]
}

fn scenes(results: &Results) -> Result<Check, Error> {
    let trials = results.of(&TRIALS)?;
    // The engine is the first of the methods.
    let own = trials.scenes.iter().map(|(_, trials)| &trials[0]);
    let wrong: usize = own.map(|trial| trial.len() - right(trial)).sum();
    let name = ("scenes", "cases of the scenes of failure with another outcome than expected");
    Ok(at_most(name, (0.0, ""), Some(wrong as f64), false))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::{Progress, Store, run::run};
    use crate::params::Profile;

    fn results() -> Results {
        let none = |_: &str| Err("not needed".to_string());
        run(NEEDS, Profile::Quick, &none, &Store::nowhere(), &Progress::silent()).unwrap()
    }

    fn verdict(results: &Results, id: &str) -> Verdict {
        targets(results).unwrap().iter().find(|target| target.id == id).unwrap().verdict
    }

    /// Each target can be missed: make the results worse and it is.
    #[test]
    fn targets_follow_the_numbers() {
        let mut results = results();
        for id in ["misses", "waiting", "scenes", "work"] {
            assert_eq!(verdict(&results, id), Verdict::Reproduced, "{id}");
        }
        let race = results.of_mut(&RACE).unwrap();
        race.entries[0].misses += 1;
        race.entries[0].units = Some(9.0);
        results.of_mut(&TRIALS).unwrap().scenes[0].1[0][0] =
            crate::experiments::accuracy::case::Verdict::Missed;
        let scale = results.of_mut(&SCALE).unwrap();
        let own = |m: MethodName| m == MethodName::Certified;
        scale.iter_mut().filter(|row| own(row.0.method)).last().unwrap().2 *= 3.0;
        for id in ["misses", "waiting", "scenes", "work"] {
            assert_eq!(verdict(&results, id), Verdict::Differs, "{id}");
        }
    }

    #[test]
    fn times_decide_and_their_absence_leaves_open() {
        let mut results = results();
        let measured = results.of_mut(&MEASURED).unwrap();
        let mut row = measured.of(What::Engine).find(|row| row.n == 100).unwrap().clone();
        measured.rows.clear();
        for id in ["one_chain", "ensemble", "heyoka_20", "full", "memory"] {
            assert_eq!(verdict(&results, id), Verdict::CannotBeJudged, "{id}");
        }
        row.microseconds_per_impact = Some(0.2);
        let peer = Row {
            what: What::Peer,
            name: "heyoka".into(),
            microseconds_per_impact: Some(19.0),
            ..row.clone()
        };
        results.of_mut(&MEASURED).unwrap().rows = vec![row, peer];
        assert_eq!(verdict(&results, "one_chain"), Verdict::Reproduced);
        assert_eq!(verdict(&results, "heyoka_100"), Verdict::Differs, "95 times faster");
        results.of_mut(&MEASURED).unwrap().rows[1].microseconds_per_impact = Some(21.0);
        assert_eq!(verdict(&results, "heyoka_100"), Verdict::Reproduced);
        results.of_mut(&MEASURED).unwrap().rows[0].horizon_impact = Some(2);
        assert_eq!(verdict(&results, "heyoka_100"), Verdict::Differs, "a shorter horizon");
    }
}

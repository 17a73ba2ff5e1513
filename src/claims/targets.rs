//! What this edition promises about its own speed and accuracy, and what is found.
//!
//! A target that rests on counted work or on accuracy is decided by the results; one that rests on
//! the clock by the committed measurements, and is open while nobody measured it.

use super::{Basis, Check, Kind, Published, Text, chosen, significant};
use crate::experiments::accuracy::trials::right;
use crate::experiments::measured::{Measurement, What};
use crate::experiments::{MEASURED, RACE, SCALE, TRIALS};
use crate::experiments::{Measured, Results};
use crate::params::MethodName;
use literate::Failure;

/// A target: id, what it says, bound and unit.
type Said = (&'static str, &'static str, f64, &'static str);

/// A target of the form "at most"; times of the clock decide it, or counted work and accuracy.
fn at_most((id, what, bound, unit): Said, found: Option<f64>, basis: Basis) -> Check {
    let allowed = match bound == 0.0 {
        true => "none".into(),
        false => Text::of("≤ {}", [chosen(bound)]).then(unit),
    };
    let text = found.map_or("–".into(), |x| Text::from(significant(x, 3)).then(unit));
    target((id, what), allowed, text, found.map(|x| x <= bound), basis)
}

fn target(
    (id, what): (&str, &str),
    bound: Text,
    found: Text,
    met: Option<bool>,
    basis: Basis,
) -> Check {
    let check = Check::new(Kind::Target, id, what, found).on(basis);
    let check = check.within(bound, "promised before it was measured");
    match met {
        Some(met) => check.judged(met),
        None => check,
    }
}

/// All targets, those of the clock first.
pub fn targets(results: &Results, _: &Published) -> Result<Vec<Check>, Failure> {
    let measured = results.of(&MEASURED)?;
    let ensemble = measured.of(What::Ensemble).filter(|row| row.threads == 1);
    let ensemble = ensemble.filter_map(|row| row.microseconds_per_impact).min_by(f64::total_cmp);
    let command = |name: &str| measured.of(What::Command).find(|row| row.name == name);
    let seconds = |name| command(name).and_then(|row| row.seconds);
    let million = measured.of(What::Engine).filter(|row| row.n == 1_000_000);
    let million = million.filter_map(|row| row.peak_mib).min_by(f64::total_cmp);
    let one = engine(measured, 100).and_then(|row| row.microseconds_per_impact);
    let clock = |said, found| at_most(said, found, Basis::Clock);
    let mut all = vec![
        clock(("one_chain", "time of an impact, one chain of 100 masses", 0.25, " µs"), one),
        clock(("ensemble", "time of an impact, an ensemble on one core", 0.25, " µs"), ensemble),
        against(
            measured,
            ("heyoka_20", "time of heyoka at its tightest over ours, 20 masses"),
            20,
            25.0,
        ),
        against(measured, ("heyoka_100", "the same, 100 masses"), 100, 100.0),
        clock(("quick", "the quick profile", 5.0, " s"), seconds("quick")),
        clock(("full", "the full profile", 120.0, " s"), seconds("full")),
        clock(("main sweep", "its main sweep alone", 60.0, " s"), seconds("main sweep")),
        clock(
            ("memory", "memory of the full profile", 300.0, " MiB"),
            command("full").and_then(|row| row.peak_mib),
        ),
        clock(("million", "memory of a chain of a million masses", 1024.0, " MiB"), million),
    ];
    all.extend(exact(results)?);
    Ok(all)
}

fn engine(measured: &Measured, n: u64) -> Option<&Measurement> {
    let own = measured.of(What::Engine).filter(|row| row.n == n && row.chains == 1);
    own.filter(|row| row.note.is_empty()).find(|row| row.microseconds_per_impact.is_some())
}

/// How many times faster we are than heyoka at its tightest tolerance, with a horizon no shorter
/// and no more segments missed.
fn against(measured: &Measured, said: (&str, &str), n: u64, bound: f64) -> Check {
    let reach = |row: &Measurement| row.horizon_impact.or(row.compared);
    let peers = measured.of(What::Peer).filter(|row| row.n == n && row.name.starts_with("heyoka"));
    let both = peers.max_by_key(|row| reach(row)).zip(engine(measured, n));
    let found = both.and_then(|(peer, own)| {
        let times = peer.microseconds_per_impact? / own.microseconds_per_impact?;
        Some((times, times >= bound && reach(own) >= reach(peer)))
    });
    let text = found.map_or("–".into(), |(times, _)| significant(times, 3).into());
    let bound = Text::of("≥ {}", [chosen(bound)]);
    target(said, bound, text, found.map(|(_, met)| met), Basis::Clock)
}

/// Targets of counted work and of accuracy.
fn exact(results: &Results) -> Result<Vec<Check>, Failure> {
    let (scale, race) = (results.of(&SCALE)?, results.of(&RACE)?);
    let own = || scale.iter().filter(|row| row.0.method == MethodName::Certified);
    let largest = own().max_by_key(|row| row.1).zip(own().find(|row| row.1 == 100));
    let entry = race.entries.iter().find(|own| own.setting.method == MethodName::Certified);
    // The engine is the first of the methods.
    let own = results.of(&TRIALS)?.scenes.iter().map(|(_, trials)| &trials[0]);
    let wrong: usize = own.map(|trial| trial.len() - right(trial)).sum();
    let work = "evaluations per impact in the largest chain over those at a hundred masses";
    let waiting =
        "largest error of a waiting time, in units of ε (d + R₁ + R₂) over the closing speed";
    let scenes = "cases of the scenes of failure with another outcome than expected";
    let all = [
        (("work", work, 2.0, ""), largest.map(|(a, b)| a.2 / b.2)),
        (
            ("misses", "impacts missed from exact states", 0.0, ""),
            entry.map(|entry| entry.misses as f64),
        ),
        (("waiting", waiting, 8.0, ""), entry.and_then(|entry| entry.units)),
        (("scenes", scenes, 0.0, ""), Some(wrong as f64)),
    ];
    Ok(all.map(|(said, found)| at_most(said, found, Basis::OurMeasure)).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::Verdict;
    use crate::experiments::quick;

    fn results() -> Results {
        quick(&[&RACE, &SCALE, &TRIALS, &MEASURED])
    }

    fn verdict(results: &Results, id: &str) -> Verdict {
        targets(results, &Published::default())
            .unwrap()
            .iter()
            .find(|target| target.id == id)
            .unwrap()
            .verdict
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
}

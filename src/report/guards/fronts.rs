//! What becomes of one seed in time, how its fronts advance, and which gaps hold them.

use super::{Guard, Look, far, unless};
use crate::experiments::seeds::{ByDistance, Fronts, Seeds, Spread, Waits};
use crate::numerics::statistics::Estimate;
use crate::report::values::cell;
use std::f64::consts::TAU;

pub const GUARDS: &[Guard] = &[
    Guard { name: "course_as_counted", ids: &["course.*", "spread.*"], find: course },
    Guard { name: "waits_as_reached", ids: &["fronts_*"], find: waits },
    Guard { name: "speeds_of_fronts", ids: &["fronts.*"], find: speeds },
    Guard { name: "standing_by_redistribution", ids: &["fronts.*"], find: stands },
    Guard { name: "obstacles_that_hold", ids: &["fronts.*", "fronts_holds_*"], find: obstacles },
    Guard { name: "course_as_tabled", ids: &["course.*", "seeds_active_*"], find: course_tabled },
    Guard { name: "fronts_as_tabled", ids: &["fronts.*", "fronts_*"], find: tabled },
];

fn seeds(look: Look<'_>) -> Option<&Seeds> {
    look.results.seeds().ok()
}

/// Complains about an estimate that is not this number; none at all agrees.
fn off(what: &str, found: Option<Estimate>, expected: f64) -> Option<String> {
    far(what, found?.value, expected)
}

/// The members of a histogram beyond a place.
fn beyond(counts: &[u64], place: usize) -> u64 {
    counts.iter().skip(place + 1).sum()
}

/// Means over runs are sums over distances from the seed.
fn course(look: Look<'_>) -> Option<String> {
    let seeds = seeds(look)?;
    seeds.rows.iter().zip(&seeds.seen).find_map(|(row, seen)| {
        let runs = seen.places[0] as f64;
        let transients = &seeds.parameters.transients;
        row.course.iter().zip(transients).find_map(|(own, transient)| {
            let end = transient + seeds.parameters.window;
            let windows = seen.reached.get(end).zip(seen.active.get(*transient));
            let (Some((reached, active)), Some(alive)) = (windows, seen.alive.get(*transient))
            else {
                return Some(format!("no window ends with bin {end}"));
            };
            let mean = |counts: &[u64]| counts.iter().rev().sum::<u64>() as f64 / runs;
            let shares = || {
                (1..seen.places.len())
                    .rev()
                    .map(|l| (l as f64, reached[l] as f64 / seen.places[l].max(1) as f64))
            };
            let [all, squares] = shares().fold([0.0; 2], |[all, squares], (l, share)| {
                [all + share, squares + l * l * share]
            });
            far("the end of a window", own.until, end as f64 * seeds.parameters.bin)
                .or_else(|| off("gaps reached", own.reached, mean(reached)))
                .or_else(|| off("active gaps", own.active, mean(active)))
                .or_else(|| far("runs alive", own.alive as f64, *alive as f64))
                .or_else(|| far("a radius", own.radius * own.radius * all, squares))
        })
    })
}

/// Every gap that was reached, but for the seed itself, is a step of a front; there is a front on each side on which the
/// seed has a neighbour; and what stands longer than a window, holds.
fn waits(look: Look<'_>) -> Option<String> {
    let seeds = seeds(look)?;
    let window = seeds.parameters.window_ticks();
    let rows = seeds.rows.iter().zip(&seeds.seen).zip(&seeds.waits);
    let one = |((row, seen), own): ((&Spread, &ByDistance), &Waits)| {
        let steps: u64 = row.spreads.iter().map(|gaps| gaps.saturating_sub(1)).sum();
        let long = beyond(&own.ended, window) + beyond(&own.cut, window);
        let met: u64 = own.crossed.iter().map(|counts| counts[0]).sum();
        let held: u64 = own.crossed.iter().map(|counts| counts[1]).sum();
        far("steps", own.ended.iter().sum::<u64>() as f64, steps as f64)
            .or_else(|| far("fronts", own.fronts as f64, seen.places[1] as f64))
            .or_else(|| {
                far("obstacles that hold", own.held.iter().sum::<u64>() as f64, long as f64)
            })
            .or_else(|| far("obstacles that hold", held as f64, long as f64))
            .or_else(|| far("obstacles", own.met.iter().sum::<u64>() as f64, met as f64))
    };
    rows.clone().find_map(one).or_else(|| {
        let steps = rows
            .clone()
            .flat_map(|((row, _), _)| &row.spreads)
            .map(|gaps| gaps.saturating_sub(1))
            .sum::<u64>();
        let fronts = rows.clone().map(|((_, seen), _)| seen.places[1]).sum::<u64>();
        look.are([("fronts_steps", steps as f64), ("fronts_number", fronts as f64)])
    })
}

fn each<'a>(
    look: Look<'a>,
    find: impl Fn(&'a Seeds, &'a Fronts, &'a Waits) -> Option<String>,
) -> Option<String> {
    let seeds = seeds(look)?;
    seeds.fronts.iter().zip(&seeds.waits).find_map(|(own, tally)| find(seeds, own, tally))
}

/// The time of all waits is how many still wait, summed tick by tick.
fn speeds(look: Look<'_>) -> Option<String> {
    each(look, |seeds, own, tally| {
        let parameters = &seeds.parameters;
        let chain = &parameters.chain;
        let (mut waiting, mut time) = (0, 0);
        for (ended, cut) in tally.ended.iter().zip(&tally.cut).skip(1).rev() {
            waiting += ended + cut;
            time += waiting;
        }
        let steps = beyond(&tally.ended, 0) + tally.ended[0];
        // A beat later one phase is a turn ahead of the other.
        let in_beat = |tick: usize| {
            let turned = (chain.forcing_frequency - chain.natural_frequency) * parameters.tick;
            turned.abs() * tick as f64 <= TAU
        };
        let fast: u64 =
            (0..tally.ended.len()).filter(|k| in_beat(*k)).map(|k| tally.ended[k]).sum();
        let beat = TAU / (chain.forcing_frequency - chain.natural_frequency).abs();
        let late = beyond(&tally.cut, parameters.ticks() / 2);
        off("steps", own.speed.map(|own| scaled(own, time as f64 * parameters.tick)), steps as f64)
            .or_else(|| {
                off("steps in bursts", own.bursts.map(|own| scaled(own, steps as f64)), fast as f64)
            })
            .or_else(|| far("even waits", -pxfm::f_log1p(-own.even) / beat, own.speed?.value))
            .or_else(|| off("fronts that stand", own.standing, late as f64 / tally.fronts as f64))
    })
}

fn scaled(own: Estimate, by: f64) -> Estimate {
    Estimate { value: own.value * by, ..own }
}

/// How long fronts stand, by Efron's other way to the same estimate: each wait has the same mass, and that of one
/// which was cut off goes to those that lasted longer, in equal parts.
fn stands(look: Look<'_>) -> Option<String> {
    each(look, |seeds, own, tally| {
        let mut left: u64 = tally.ended.iter().chain(&tally.cut).sum();
        let (mut mass, mut gone) = (1.0 / left as f64, 0.0);
        let mut lasting = Vec::new();
        for (ended, cut) in tally.ended.iter().zip(&tally.cut) {
            if left == 0 {
                break;
            }
            gone += mass * *ended as f64;
            left -= ended + cut;
            if left > 0 {
                mass += mass * *cut as f64 / left as f64;
            }
            lasting.push(1.0 - gone);
        }
        let window = seeds.parameters.window_ticks();
        let mut past = 1.0;
        (1..).zip(own.stands).find_map(|(windows, found)| {
            let now = lasting.get(windows * window).copied();
            let told = off("a share that stands on", found, now.unwrap_or(0.0) / past);
            past = now.unwrap_or(0.0);
            told
        })
    })
}

/// Chances by counts, and the variance of holds by completing the square.
fn obstacles(look: Look<'_>) -> Option<String> {
    each(look, |_, own, tally| {
        let [first, passed, after] =
            std::array::from_fn(|i| [tally.held[i], tally.met[i]].map(|n| n as f64));
        let [held, met] = [0, 1].map(|i| first[i] + passed[i] + after[i]);
        let ratio = after[0] * passed[1] / (after[1] * passed[0]);
        let [holds, both, all] = tally.products.map(|sum| sum as f64);
        let s = held / met;
        let best = both / all;
        let squares = all * (s - best) * (s - best) + (holds - best * both);
        let parts = own.holds.iter().zip(tally.crossed).find_map(|(found, [met, held])| {
            off("a chance to hold", *found, held as f64 / met as f64)
        });
        let squares_of = |[met, held]: &[u64; 2]| (held * held) as f64 / (*met).max(1) as f64;
        let like = tally.crossed.iter().map(squares_of).sum::<f64>();
        let told = || far("what gaps of a like do", own.alike * held * held, like * met);
        off("steps between holds", own.between, 1.0 / s - 1.0)
            .or_else(|| off("what held before", own.memory, ratio))
            .or_else(|| off("a dispersion", own.dispersion, squares / (s * (met - held))))
            .or(parts)
            .or_else(|| if held > 0.0 { told() } else { None })
    })
}

/// The text and the table of one σ say what the results do.
fn course_tabled(look: Look<'_>) -> Option<String> {
    let seeds = seeds(look)?;
    let sigma = look.number("growth_sigma")?;
    let row = seeds.rows.iter().find(|row| row.sigma == sigma)?;
    let line = row.course.iter().find_map(|own| {
        let id = |name: &str| format!("course.t{}_{name}", own.until as u64);
        look.is(&id("until"), own.until)
            .or_else(|| look.is(&id("reached"), own.reached?.value))
            .or_else(|| look.is(&id("active"), own.active?.value))
            .or_else(|| look.is(&id("alive"), own.alive as f64 / row.seeds as f64))
            .or_else(|| look.is(&id("radius"), own.radius))
    });
    let ends = [("seeds_active_low", seeds.seen.first()), ("seeds_active_high", seeds.seen.last())];
    line.or_else(|| {
        ends.into_iter().find_map(|(id, seen)| {
            let [active, reached] = [&seen?.active, &seen?.reached].map(|all| all.last());
            look.is(id, active?.iter().sum::<u64>() as f64 / reached?.iter().sum::<u64>() as f64)
        })
    })
}

/// The tables and the text of fronts say what the results do; times by the fastest fronts are ways over their speed.
fn tabled(look: Look<'_>) -> Option<String> {
    let seeds = seeds(look)?;
    let parameters = &seeds.parameters;
    let line = |own: &Fronts| {
        let id = |name: &str| cell("fronts", own.sigma, name);
        let is = |name: &str, found: Option<Estimate>| look.is(&id(name), found?.value);
        let [a, b, c] = own.stands;
        look.is(&id("sigma"), own.sigma)
            .or_else(|| look.is(&id("even"), own.even))
            .or_else(|| is("speed", own.speed))
            .or_else(|| is("bursts", own.bursts))
            .or_else(|| is("standing", own.standing))
            .or_else(|| is("stands_a", a))
            .or_else(|| is("stands_b", b))
            .or_else(|| is("stands_c", c))
            .or_else(|| is("between", own.between))
            .or_else(|| is("memory", own.memory))
            .or_else(|| is("dispersion", own.dispersion))
    };
    let turns = || {
        let chain = &parameters.chain;
        let turn = (chain.forcing_frequency - chain.natural_frequency).abs() / TAU;
        far("turns in a beat", look.number("fronts_beat")? * turn, 1.0)
    };
    let holds = || {
        let sigma = look.number("growth_sigma")?;
        let own = seeds.fronts.iter().find(|own| own.sigma == sigma)?;
        let ids = ["a", "b", "c", "d"].map(|letter| format!("fronts_holds_{letter}"));
        let holds = ids.iter().zip(own.holds);
        let chances = holds.into_iter().find_map(|(id, found)| look.is(id, found?.value));
        chances.or_else(|| look.is("fronts_alike", own.alike))
    };
    let far_away = || {
        let speed = seeds.fronts.last()?.speed?.value;
        let seeded: f64 = seeds.closing.last()?[1].iter().rev().sum();
        far("a long way", look.number("fronts_far_time")? * speed, look.number("fronts_far")?)
            .or_else(|| look.is("fronts_spacing", 1.0 / seeded))
            .or_else(|| {
                let both = 2.0 * look.number("fronts_meet")? * speed;
                far("the way between seeds", both, look.number("fronts_spacing")?)
            })
    };
    let hold = parameters.bin * parameters.window as f64;
    look.is("fronts_hold", hold)
        .or_else(|| unless(seeds.fronts.len() == seeds.rows.len(), || "rows without fronts".into()))
        .or_else(|| seeds.fronts.iter().find_map(line))
        .or_else(turns)
        .or_else(holds)
        .or_else(far_away)
}

//! The long run and the two segments, counted once more from their records.

use super::{Guard, Look, unless};
use crate::experiments::spacetime::SpaceTime;
use crate::figures::Scene;
use std::collections::BTreeMap;

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "record_of_the_run",
        ids: &["run_impacts", "run_reached*", "run_starts", "run_first", "run_half", "run_quarter"],
        find: run,
    },
    Guard { name: "fronts_of_the_run", ids: &["run_advance_*"], find: fronts },
    Guard { name: "silence_of_the_run", ids: &["run_silen*"], find: silence },
    Guard { name: "busiest_of_the_run", ids: &["run_busiest*"], find: busiest },
    Guard { name: "late_impacts", ids: &["run_until", "run_last"], find: late },
    Guard { name: "counts_of_the_scene", ids: &["scene_*"], find: scene },
];

/// Times of the impacts of each gap, for those that have any.
fn by_gap(run: &SpaceTime) -> Vec<(u32, Vec<f64>)> {
    let width = run.gaps.iter().map(|gap| *gap as usize + 1).max().unwrap_or(0);
    let mut found: Vec<Vec<f64>> = vec![Vec::new(); width];
    for (&time, &gap) in run.times.iter().zip(&run.gaps) {
        found[gap as usize].push(time);
    }
    (0..).zip(found).filter(|(_, times)| !times.is_empty()).collect()
}

/// Gaps by the time of their first impact, earliest first.
fn order(own: &[(u32, Vec<f64>)]) -> Vec<(f64, u32)> {
    let firsts = own.iter().filter_map(|(gap, times)| Some((*times.first()?, *gap)));
    let mut order: Vec<(f64, u32)> = firsts.collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    order
}

/// How much later than the earlier of its neighbours, and when, each gap has its first impact; and
/// the number of those that come first among their neighbours. Gaps are taken as they come.
fn spreading(order: &[(f64, u32)]) -> (Vec<(f64, u32, f64)>, usize) {
    let mut seen: BTreeMap<u32, f64> = BTreeMap::new();
    let (mut delays, mut starts) = (Vec::new(), 0);
    for &(time, gap) in order {
        let beside = [gap.checked_sub(1), Some(gap + 1)].into_iter().flatten();
        let before = beside.filter_map(|gap| seen.get(&gap)).copied().reduce(f64::min);
        match before {
            Some(before) => delays.push((time - before, gap, time)),
            None => starts += 1,
        }
        seen.insert(gap, time);
    }
    delays.sort_by(|a, b| a.0.total_cmp(&b.0));
    (delays, starts)
}

/// Impacts, gaps reached in all and within parts of the time, and starts, from a list of each gap's times.
fn run(look: Look<'_>) -> Option<String> {
    let run = look.results.spacetime().ok()?;
    let own = by_gap(run);
    let order = order(&own);
    let until = run.parameters.until;
    let reached = |part: &str| {
        let end = look.number(part).unwrap_or(f64::NAN);
        order.iter().filter(|(time, _)| *time <= end).count() as f64
    };
    let width = run.parameters.chain.masses as f64 + 1.0;
    look.are([
        ("run_impacts", own.iter().map(|(_, times)| times.len()).sum::<usize>() as f64),
        ("run_reached", own.len() as f64),
        ("run_reached_share", own.len() as f64 / width),
        ("run_starts", spreading(&order).1 as f64),
        ("run_first", order.first()?.0),
        ("run_reached_half", reached("run_half")),
        ("run_reached_quarter", reached("run_quarter")),
        ("run_half", until - until / 2.0),
        ("run_quarter", until - 3.0 * until / 4.0),
    ])
}

/// The waits of the fronts, from gaps in the order in which they are reached.
fn fronts(look: Look<'_>) -> Option<String> {
    let run = look.results.spacetime().ok()?;
    let (delays, _) = spreading(&order(&by_gap(run)));
    let (longest, gap, time) = *delays.last()?;
    look.are([
        ("run_advance_median", delays[delays.len() / 2].0),
        ("run_advance_longest", longest),
        ("run_advance_gap", f64::from(gap)),
        ("run_advance_time", time),
    ])
}

/// The longest time between two impacts of one gap, gap by gap.
fn silence(look: Look<'_>) -> Option<String> {
    let run = look.results.spacetime().ok()?;
    let waits = by_gap(run).into_iter().flat_map(|(gap, times)| {
        let waits: Vec<(f64, u32, f64)> =
            times.windows(2).map(|w| (w[1] - w[0], gap, w[1])).collect();
        waits
    });
    let (wait, gap, end) = waits.max_by(|a, b| a.0.total_cmp(&b.0))?;
    look.are([("run_silence", wait), ("run_silent_gap", f64::from(gap)), ("run_silence_end", end)])
}

/// The share of the gaps with most impacts: so many gaps have it, and one gap more or less has
/// another share.
fn busiest(look: Look<'_>) -> Option<String> {
    let run = look.results.spacetime().ok()?;
    let mut counts: Vec<usize> = by_gap(run).iter().map(|(_, times)| times.len()).collect();
    counts.sort_unstable();
    let many = look.number("run_busiest")? as usize;
    let own: usize = counts.iter().rev().take(many).sum();
    look.is("run_busiest_share", own as f64 / counts.iter().sum::<usize>() as f64)
}

/// The run was chosen because it has impacts in its last part, and ends at its end.
fn late(look: Look<'_>) -> Option<String> {
    let run = look.results.spacetime().ok()?;
    let (until, last) = look.number("run_until").zip(look.number("run_last"))?;
    let end = *run.times.last()?;
    unless(until - last < end && end <= until, || {
        format!("the last impact is at {end}, not within the last {last} before {until}")
    })
}

/// The row of the scene: its impacts from the events of its gaps, and halves that make up the whole
/// but for a gap in the middle; masses that are neighbours; times that follow one another.
fn scene(look: Look<'_>) -> Option<String> {
    let run = look.results.spacetime().ok()?;
    let scene = Scene::of(run)?;
    let [first, last, masses] =
        ["scene_first", "scene_last", "scene_masses"].map(|id| look.number(id).unwrap_or(0.0));
    // Gap g lies between masses g and g + 1.
    let own: Vec<usize> = run
        .scene
        .events
        .iter()
        .map(|event| event.gap as usize)
        .filter(|&gap| first - 1.0 <= gap as f64 && gap as f64 <= last)
        .collect();
    let middle = (first - 1.0 + last) / 2.0;
    let side = |left: bool| {
        own.iter()
            .filter(|&&gap| if left { (gap as f64) < middle } else { gap as f64 > middle })
            .count()
    };
    look.are([
        ("scene_impacts", own.len() as f64),
        ("scene_left", side(true) as f64),
        ("scene_right", side(false) as f64),
        ("scene_masses", scene.bodies.len() as f64 - 2.0),
        ("scene_last", first + masses - 1.0),
        ("scene_from", run.scene.from.floor()),
        ("scene_until", run.scene.until.floor()),
        ("scene_length", run.scene.until.floor() - run.scene.from.floor()),
    ])
}

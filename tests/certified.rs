//! Segments: from one state, is the next impact the right one, and at the right time?
//!
//! The state is what the doubles of the scenario say, exactly; chaos has no time to act. C of
//! |δs| ≤ C ε (d + R1 + R2) / |Δ'|, ε = 2^-52, is measured, and misses and ghosts are counted.

mod reference;

use impact_paper::dynamics::{Engine, Impact, Initial, Scenario, Simultaneous};
use impact_paper::numerics::random::NormalPairs;
use impact_paper::params::{Boundary, Chain};
use reference::{Dd, Hit, Real, Reference};

/// The C that is stated.
const C: f64 = 4.0;

/// What was seen.
#[derive(Debug, Default)]
struct Tally {
    segments: usize,
    impacts: usize,
    /// Segments whose outcome hangs on a dip within C ε (d + R1 + R2) of zero.
    undecidable: usize,
    worst: f64,
    worst_speed: f64,
}

fn first(scenario: &Scenario, until: f64) -> Option<Impact> {
    let mut found = None;
    Engine::new(scenario)
        .unwrap()
        .run(until, |impact| {
            found = Some(impact);
            false
        })
        .unwrap();
    found
}

/// Holds one segment against the reference.
fn hold(scenario: &Scenario, until: f64, tally: &mut Tally) {
    let start = Reference::<Dd>::new(scenario);
    let mut chain = start.clone();
    let Ok(theirs) = chain.step(&Dd::of(until)) else { return };
    let ours = first(scenario, until);
    tally.segments += 1;
    let unit = |hit: &Hit<Dd>| f64::EPSILON * start.gap(hit.gap).scale();
    match (ours, theirs) {
        (None, None) => {}
        (Some(a), Some(b)) if a.gap == b.gap => {
            let speed = b.closing_speed.near();
            let time = b.time.near();
            // Half a unit in the last place of t is lost in writing t down.
            let error = (Dd::of(a.time) - b.time).near().abs();
            let error = (error - 0.5 * (time.next_up() - time)).max(0.0);
            let units = error * speed / unit(&b);
            // A wrong root of the same gap may only be a dip in the band.
            if units > C && speed * speed < 1e-12 {
                tally.undecidable += 1;
                return;
            }
            assert!(units <= C, "C = {units} at t = {time}, gap {}: {scenario:?}", b.gap);
            tally.impacts += 1;
            tally.worst = tally.worst.max(units);
            let off = (Dd::of(a.closing_speed) - b.closing_speed).near().abs();
            tally.worst_speed = tally.worst_speed.max(off * speed.min(1.0) / unit(&b));
        }
        (ours, theirs) => {
            // Allowed only if one of the two is a graze, or both fall together.
            let graze = |speed: f64, gap: usize| {
                let scale = start.gap(gap).scale();
                speed * speed < 8.0 * C * f64::EPSILON * scale * scale
            };
            let tie = match (&ours, &theirs) {
                (Some(a), Some(b)) => (Dd::of(a.time) - b.time).near().abs() < 1e-13,
                (Some(a), None) => until - a.time < 1e-12,
                (None, Some(b)) => until - b.time.near() < 1e-12,
                (None, None) => true,
            };
            let ours_grazes = ours.is_some_and(|a| graze(a.closing_speed, a.gap));
            let theirs_graze =
                theirs.as_ref().is_some_and(|b| graze(b.closing_speed.near(), b.gap));
            assert!(
                tie || ours_grazes || theirs_graze,
                "a miss or a ghost: {ours:?}, not {theirs:?}: {scenario:?}"
            );
            tally.undecidable += 1;
        }
    }
}

/// A random scenario of few masses, with a taste for corners: sizes over decades, gaps that
/// nearly or just cannot close, masses that start touching, frequencies near and far.
fn corner(index: u64) -> Option<Scenario> {
    let mut normals = NormalPairs::new("segments", 3, index);
    let mut pick = |n: usize| {
        let [x, y] = normals.pair();
        ((x.atan2(y) / std::f64::consts::TAU + 0.5) * n as f64) as usize % n
    };
    let n = [1, 1, 2, 3, 3, 5][pick(6)];
    let omega = [1.0, 1.0, 1.0, 1.3, 0.25][pick(5)];
    let forcing = [std::f64::consts::SQRT_2, std::f64::consts::SQRT_2, 0.7, 2.0, 1.001, 6.3];
    let forcing = forcing[pick(6)];
    let restitution = [0.8, 0.2, 0.0, 1.0][pick(4)];
    let boundary = if n > 2 && pick(4) == 0 { Boundary::Ring } else { Boundary::Walls };
    let spacing = [1.0, 1.0, 0.5, 2.0][pick(4)];
    let sizes = [0.3, 0.3, 0.1, 1.0, 1e-3, 1e-8, 0.0];
    let (free_size, forced_size) = (sizes[pick(7)], sizes[pick(7)]);
    let touch = pick(4) == 0;
    let factor = (omega * omega - forcing * forcing).abs();
    let draw = |normals: &mut NormalPairs, size: f64| -> Vec<[f64; 2]> {
        (0..n).map(|_| normals.pair().map(|x| x * size * spacing)).collect()
    };
    let mut free = draw(&mut normals, free_size);
    let forced = draw(&mut normals, forced_size * factor);
    if touch {
        // The first mass starts a hair off the left wall, whatever it does then.
        let hair = 10f64.powf(-3.0 - 3.0 * normals.pair()[0].abs());
        let c = forced[0][0] / (omega * omega - forcing * forcing);
        free[0][0] = spacing * (hair - 1.0) - c;
    }
    let scenario = Scenario {
        spacing,
        natural_frequency: omega,
        forcing_frequency: forcing,
        restitution,
        boundary,
        initial: Initial::Free(free),
        forcing: forced,
        overtones: Vec::new(),
        simultaneous: Simultaneous::default(),
    };
    Engine::new(&scenario).is_ok().then_some(scenario)
}

fn corners(from: u64, count: u64) -> Tally {
    let mut tally = Tally::default();
    for scenario in (from..from + count).filter_map(corner) {
        hold(&scenario, 12.0, &mut tally);
    }
    println!("{tally:?}");
    tally
}

#[test]
fn corner_biased_segments_have_no_miss_and_no_ghost() {
    let tally = corners(0, 16_000);
    assert!(tally.segments >= 10_000 && tally.impacts > 4000, "{tally:?}");
    assert!(tally.undecidable * 100 < tally.segments, "{tally:?}");
    assert!(tally.worst_speed < 64.0, "closing speeds: {tally:?}");
}

#[test]
#[ignore = "a million segments: a quarter of an hour"]
fn a_million_corner_biased_segments() {
    let count = std::env::var("SEGMENTS").ok().and_then(|n| n.parse().ok()).unwrap_or(2_000_000);
    let tally = corners(1_000_000, count);
    assert!(count < 2_000_000 || tally.segments >= 1_000_000, "{tally:?}");
    assert!(tally.undecidable * 100 < tally.segments, "{tally:?}");
}

/// The state of the reference just after an impact as a scenario that starts there.
fn restart(chain: &Reference<Dd>, like: &Scenario, hit: usize) -> Scenario {
    let t = *chain.time();
    let [w, big_w] = [like.natural_frequency, like.forcing_frequency].map(Dd::of);
    let factor = w * w - big_w * big_w;
    let turn = |[a, b]: [Dd; 2], w: Dd| {
        let (s, c) = (w * t).sin_cos();
        [a * c + b * s, b * c - a * s]
    };
    let parts: Vec<[[Dd; 2]; 2]> = (0..like.forcing.len())
        .map(|j| {
            let [free, forced] = [chain.mass(j)[0], chain.mass(j)[1]];
            [turn(free, w), turn(forced, big_w).map(|x| x * factor)]
        })
        .collect();
    let mut free: Vec<[f64; 2]> = parts.iter().map(|p| p[0].map(|x| x.near())).collect();
    // Rounding may have pushed the two into one another: a hair of room.
    let room = 2f64.powi(-44);
    if hit < like.forcing.len() {
        free[hit][0] += room
    } else {
        free[hit - 1][0] -= room
    }
    let forcing = parts.iter().map(|p| p[1].map(|x| x.near())).collect();
    Scenario { initial: Initial::Free(free), forcing, ..like.clone() }
}

#[test]
fn from_the_state_after_each_impact_the_next_is_found() {
    let mut tally = Tally::default();
    for (index, sigma) in [(0, 0.3), (1, 0.2)] {
        let chain = Chain { masses: 8, ..Chain::default() };
        let mut normals = NormalPairs::new("restart", 1, index);
        let scenario = Scenario::draw(&chain, sigma, &mut normals);
        let mut chain = Reference::<Dd>::new(&scenario);
        for _ in 0..300 {
            let Some(hit) = chain.step(&Dd::of(1e4)).unwrap() else { break };
            let scenario = restart(&chain, &scenario, hit.gap);
            hold(&scenario, 20.0, &mut tally);
        }
    }
    println!("{tally:?}");
    assert!(tally.segments > 300 && tally.impacts > 300, "{tally:?}");
}

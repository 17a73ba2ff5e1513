//! Compares chains that are simulated side by side with the engine.

use crate::{drawn, first, given};
use impact_chain::abreast::{Abreast, Realisation};
use impact_chain::{Boundary, Chain, Counts, Engine, Overtone, Protocol, Scenario, Start, Watch};
use impact_chain::{NormalPairs, Seed};

const END: f64 = 30.0;

fn chains() -> Vec<Chain> {
    let default = Chain::default();
    let twenty = Chain { masses: 20, ..default.clone() };
    let ring = Chain { boundary: Boundary::Ring, ..twenty.clone() };
    vec![
        Chain { masses: 1, ..default.clone() },
        Chain { masses: 2, ..default.clone() },
        Chain { masses: 3, ..ring.clone() },
        Chain { masses: 4, ..ring.clone() },
        Chain { masses: 6, ..ring.clone() },
        Chain { start: Start::Random, ..ring },
        Chain { start: Start::Zero, restitution: 0.3, ..twenty.clone() },
        Chain { forcing_frequency: 1.6, restitution: 0.95, ..twenty.clone() },
        Chain { forcing_frequency: 0.6, ..twenty.clone() },
        Chain { forcing_frequency: 2.9, ..twenty.clone() },
        Chain { spacing: 3.0, natural_frequency: 1.7, forcing_frequency: 2.3, ..twenty },
        default,
    ]
}

/// Forces of about the strength at which some of the gaps of a chain close.
fn strength(chain: &Chain) -> f64 {
    let [w, big_w] = [chain.natural_frequency, chain.forcing_frequency];
    0.2 * chain.spacing * (w * w - big_w * big_w).abs()
}

fn scenarios(chain: &Chain, factor: f64) -> Vec<Scenario> {
    (0..16).map(|i| drawn(chain, factor * strength(chain), "abreast", i)).collect()
}

/// Windows that follow one another: they tell impacts apart by time, and gaps by their number.
fn windows(length: f64) -> Vec<Protocol> {
    let number = (END / length) as u32;
    let at = |i: u32| Protocol { transient: f64::from(i) * length, window: length };
    (0..number).map(at).collect()
}

fn run(
    chain: &Chain,
    windows: &[Protocol],
    until: f64,
    scenarios: &[Scenario],
) -> Vec<Option<Realisation>> {
    Abreast::new(chain, windows, until).unwrap().run(scenarios, &|| false)
}

fn by_engine(chain: &Chain, windows: &[Protocol], until: f64, scenario: &Scenario) -> Counts {
    Watch::new(chain, windows).run(Engine::new(scenario), 0, until, &|| false).unwrap()
}

/// Before rounding parts them, all counts are those of the engine, whatever the chain.
#[test]
fn impacts_are_those_of_the_engine() {
    let (mut impacts, mut handed_over) = (0, 0);
    for chain in chains() {
        let windows = windows(0.5 / chain.natural_frequency);
        for factor in [0.6, 1.0, 1.6, 5.0] {
            // Strong forces press masses together, and chaos is fast.
            let (starts, is_strong) = (scenarios(&chain, factor), factor > 2.0);
            let until = if is_strong { 7.0 } else { END };
            for (place, (realisation, scenario)) in
                run(&chain, &windows, until, &starts).into_iter().zip(&starts).enumerate()
            {
                let expected = by_engine(&chain, &windows, until, scenario);
                let Some(mut realisation) = realisation else {
                    handed_over += if is_strong { 0 } else { 1 - expected.rejected };
                    continue;
                };
                impacts += expected.total.impacts;
                let counts = realisation.counts();
                assert_eq!(counts.distinct, expected.distinct, "{chain:?} {factor} {place}");
                assert_eq!(counts.impacts, expected.impacts, "{chain:?} {factor} {place}");
                assert_eq!(counts.masses, expected.masses, "{chain:?} {factor} {place}");
                assert_eq!(counts.total, expected.total, "{chain:?} {factor} {place}");
            }
        }
    }
    assert!(impacts > 40_000 && handed_over < 5, "{impacts} {handed_over}");
}

/// At any time no gap is below zero, and the free parts are those of the engine.
#[test]
fn no_gap_is_below_zero() {
    for chain in chains().into_iter().filter(|chain| chain.boundary == Boundary::Walls) {
        let starts = scenarios(&chain, 1.0);
        for until in [0.1, 3.37, 9.0, 14.2] {
            for (realisation, scenario) in run(&chain, &[], until, &starts).into_iter().zip(&starts)
            {
                let Some(realisation) = realisation else { continue };
                let mut engine = Engine::new(scenario).unwrap();
                engine.advance(until).unwrap();
                let (sin, cos) = (chain.natural_frequency * until).sin_cos();
                let mut positions = engine.state(until).unwrap().positions;
                let parts = realisation.free_parts(&chain).into_iter().zip(engine.free_parts());
                for (position, (ours, theirs)) in positions.iter_mut().zip(parts) {
                    let [a, b] = [ours[0] - theirs[0], ours[1] - theirs[1]];
                    let error = a.hypot(b) / chain.spacing;
                    assert!(error < 1e-7, "{chain:?} {until}: {error:e}");
                    *position += a * cos + b * sin;
                }
                positions.insert(0, 0.0);
                positions.push((chain.masses + 1) as f64 * chain.spacing);
                for pair in positions.windows(2) {
                    let gap = (pair[1] - pair[0]) / chain.spacing;
                    assert!(gap > -1e-11, "{chain:?} {until}: {gap:e}");
                }
            }
        }
    }
}

/// A mass without forces reaches the wall by little, or not: f'' is as large as its bound there,
/// so a bound that is too small by half misses impacts in the middle of a step.
#[test]
fn dips_to_zero_are_seen() {
    let chain = Chain { masses: 1, ..Chain::default() };
    let windows = [Protocol { transient: 0.0, window: 6.0 }];
    let (mut hits, mut handed_over) = (0, 0);
    for decade in 1..=12 {
        let depth = 0.1_f64.powi(decade);
        for over in [depth, -depth] {
            let starts: Vec<Scenario> = (2..202)
                .map(|i| {
                    // The turn is in the middle of a step at every second of these phases.
                    let phase = 0.0625 * f64::from(i % 2) + 0.125 * f64::from(i / 2) * 0.5;
                    let radius = 1.0 + over;
                    given(vec![[-radius * phase.cos(), -radius * phase.sin()]], vec![[0.0; 2]])
                })
                .filter(|scenario| Engine::new(scenario).is_ok())
                .collect();
            for (realisation, scenario) in
                run(&chain, &windows, 6.0, &starts).into_iter().zip(&starts)
            {
                let hit = first(&mut Engine::new(scenario).unwrap(), 6.0).is_some();
                let Some(mut realisation) = realisation else {
                    handed_over += 1;
                    assert!(decade >= 9, "{depth:e} {scenario:?}");
                    continue;
                };
                let impacts = realisation.counts().total.impacts;
                assert_eq!(impacts > 0, hit, "{depth:e} {over:e} {scenario:?}");
                hits += impacts;
            }
        }
    }
    assert!(hits > 500 && handed_over > 50, "{hits} {handed_over}");
}

/// Returns the amplitudes of cos ωt and sin ωt of an oscillation with this value and rate at t.
fn amplitudes(omega: f64, t: f64, [value, rate]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = (omega * t).sin_cos();
    [value * cos - rate / omega * sin, value * sin + rate / omega * cos]
}

/// A mass leaves the wall so slowly, against such a force, that it turns near the wall within the
/// same step: its distance after the impact is about j s (s − τ)²/6.
#[test]
fn dips_after_an_impact_of_the_same_gap_are_seen() {
    let (big_w, start, mut returned) = (1.99, 0.02, 0);
    let factor = 1.0 - big_w * big_w;
    for i in 0..3000 {
        let (turn, jerk) = (0.05 + 0.01 * f64::from(i % 15), f64::from(2 << (i / 15 % 5)));
        let restitution = [0.1, 0.8][i as usize / 75 % 2];
        let speed = jerk * turn * turn / 6.0 * (1.0 + 0.01 * f64::from(i / 150 - 10));
        let forced = [(-jerk * turn / 1.5 - 1.0) / factor, (jerk + speed) / factor];
        let free = amplitudes(1.0, start, [-1.0 - forced[0], -speed / restitution - forced[1]]);
        let forces = amplitudes(big_w, start, forced).map(|x| x * factor);
        let mut chain = Chain { masses: 1, restitution, ..Chain::default() };
        let mut scenario = Scenario { restitution, ..given(vec![free], vec![forces]) };
        (chain.forcing_frequency, scenario.forcing_frequency) = (big_w, big_w);
        let Ok(mut engine) = Engine::new(&scenario) else { continue };
        let impacts = engine.impacts(0.25).unwrap().len() as u64;
        let realisation =
            run(&chain, &windows(0.25), 0.25, std::slice::from_ref(&scenario)).pop().flatten();
        let Some(mut realisation) = realisation else { continue };
        returned += usize::from(impacts > 1);
        assert_eq!(realisation.counts().total.impacts, impacts, "{i} {scenario:?}");
    }
    assert!(returned > 500, "{returned}");
}

/// Gaps that turn within the first step about a width of zero, also after an impact beside them.
/// With forces their acceleration changes its sign: tangents and signs at the ends prove nothing.
#[test]
fn dips_beside_an_impact_are_seen() {
    let mut hits = [0; 2];
    for i in 0..40_000u64 {
        let mut normals = NormalPairs::new("turns", Seed(1), i);
        let ([c, s], [place, depth]) = (normals.pair(), normals.pair());
        let big_w: f64 = [0.6, 1.2, 1.99][i as usize % 3];
        let rebounds = i % 2 == 0;
        let chain = Chain { masses: 2, forcing_frequency: big_w, ..Chain::default() };
        // Mass 1 rests, or has rebounded from the wall at the time `start`.
        let (start, fast) = (0.02, 0.3);
        let after = |t: f64| {
            let (sin, cos) = (t - start).sin_cos();
            let [x, v] = if rebounds { [-1.0, 0.8 * fast] } else { [0.0; 2] };
            [1.0 + x * cos + v * sin, v * cos - x * sin]
        };
        // Mass 2 turns near it at `turn`.
        let (turn, factor) = (0.13 + 0.04 * place, 1.0 - big_w * big_w);
        let [c, s] = [c, s].map(|x| if i / 6 % 4 == 0 { 0.0 } else { 2.0 * x });
        let forced = |t: f64| {
            let (sin, cos) = (big_w * t).sin_cos();
            [c * cos + s * sin, big_w * (s * cos - c * sin)]
        };
        let [x, v] = [0, 1].map(|k| after(turn)[k] - forced(turn)[k]);
        let second = amplitudes(1.0, turn, [x + 1e-3 * depth - 2.0, v]);
        let first = if rebounds { amplitudes(1.0, start, [-1.0, -fast]) } else { [0.0; 2] };
        let mut scenario = given(vec![first, second], vec![[0.0; 2], [c * factor, s * factor]]);
        scenario.forcing_frequency = big_w;
        let Ok(mut engine) = Engine::new(&scenario) else { continue };
        let impacts = engine.impacts(0.25).unwrap();
        if rebounds && impacts.first().is_none_or(|hit| hit.gap != 0) {
            continue;
        }
        let realisation = run(&chain, &windows(0.25), 0.25, std::slice::from_ref(&scenario));
        let Some(mut realisation) = realisation.into_iter().next().flatten() else { continue };
        hits[usize::from(rebounds)] += usize::from(impacts.len() > usize::from(rebounds));
        assert_eq!(realisation.counts().total.impacts, impacts.len() as u64, "{i} {scenario:?}");
    }
    assert!(hits.iter().all(|hits| *hits > 300), "{hits:?}");
}

/// What the proofs do not cover is left to the engine.
#[test]
fn chains_that_are_handed_over() {
    let chain = Chain { masses: 3, ..Chain::default() };
    for other in [
        Chain { restitution: 0.0, ..chain.clone() },
        Chain { restitution: 1.0, ..chain.clone() },
        Chain { boundary: Boundary::Ring, masses: 2, ..chain.clone() },
        Chain { masses: 0, ..chain.clone() },
        Chain { natural_frequency: 1e-4, ..chain.clone() },
    ] {
        assert!(Abreast::new(&other, &windows(1.0), END).is_none(), "{other:?}");
    }
    assert!(
        Abreast::new(&chain, &windows(1.0), 1e9)
            .is_some_and(|abreast| !abreast.run(&[], &|| true).len() > 0)
    );
    let set = |free: [[f64; 2]; 3]| given(free.to_vec(), vec![[0.0; 2]; 3]);
    let moving = set([[0.0, 1.5], [0.0; 2], [0.0; 2]]);
    // One is slow at a wall; one goes too far.
    let slow = set([[0.0, -1.0 - 1e-12], [0.0; 2], [0.0; 2]]);
    let overlapping = set([[-1.5, 0.0], [0.0; 2], [0.0; 2]]);
    let far = set([[0.0, 70.0], [0.0; 2], [0.0; 2]]);
    let overtone = Overtone { frequency: 3.0, amplitudes: vec![[0.0; 2]; 3] };
    let overtones = Scenario { overtones: vec![overtone], ..moving.clone() };
    let places = Scenario { places: Some(vec![0.0, 1.1, 2.0, 3.0, 4.0]), ..moving.clone() };
    let longer = drawn(&Chain { masses: 4, ..chain.clone() }, 0.1, "longer", 0);
    assert!(matches!(run(&chain, &windows(1.0), END, &[moving])[..], [Some(_)]));
    for scenario in [slow, overlapping, far, overtones, places, longer] {
        let runs = run(&chain, &windows(1.0), END, std::slice::from_ref(&scenario));
        assert!(matches!(runs[..], [None]), "{scenario:?}");
    }
    // Both outer masses hit the inner one at once, and again until they part.
    let lively = Chain { restitution: 0.95, ..chain.clone() };
    let outer = set([[0.0, 1.5], [0.0; 2], [0.0, -1.5]]);
    let mirrored = Scenario { restitution: 0.95, ..outer };
    assert!(matches!(run(&lively, &windows(1.0), END, &[mirrored])[..], [None]));
    // The second impact makes an amplitude of 104.
    let faster = set([[0.0, 60.0], [0.0; 2], [0.0, -50.0]]);
    assert!(run(&chain, &[], 0.05, &[faster])[0].is_none());
    // Impacts beside one another: errors of 1e-12 in the widths move each by 1.25e-11.
    let back = |x: f64, v: f64| amplitudes(1.0, 0.3, [x, v]);
    for (apart, is_certain) in [(2e-11, false), (3e-11, true)] {
        let near = set([back(1.0, 0.1), [0.0; 2], back(-1.0 + 0.1 * apart, -0.01)]);
        assert_eq!(run(&chain, &[], 0.4, &[near])[0].is_some(), is_certain, "{apart:e}");
    }
    // It hits the wall at 5e-5 and leaves it at 5e-6.
    let weak = Chain { restitution: 0.1, ..chain.clone() };
    let rebound = Scenario { restitution: 0.1, ..set([[0.0, -1.0 - 1.25e-9], [0.0; 2], [0.0; 2]]) };
    assert!(matches!(run(&weak, &windows(1.0), END, &[rebound])[..], [None]));
    let stopped = Abreast::new(&chain, &windows(1.0), END).unwrap();
    assert!(matches!(stopped.run(&[drawn(&chain, 0.3, "a", 0)], &|| true)[..], [None]));
}

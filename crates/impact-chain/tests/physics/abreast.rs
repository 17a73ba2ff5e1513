//! Compares chains that are simulated side by side with the engine.

use crate::{drawn, given, unforced};
use impact_chain::abreast::{Abreast, Realisation};
use impact_chain::{
    Boundary, Chain, Counts, Engine, Impact, NormalPairs, Overtone, Protocol, Scenario, Seed,
    Start, Watch,
};

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

/// Chains with forces of about the strength at which some of the gaps close, times a factor.
fn scenarios(chain: &Chain, factor: f64) -> Vec<Scenario> {
    let [w, big_w] = [chain.natural_frequency, chain.forcing_frequency];
    let sigma = 0.2 * factor * chain.spacing * (w * w - big_w * big_w).abs();
    (0..16).map(|i| drawn(chain, sigma, "abreast", i)).collect()
}

/// Windows that follow one another: they tell impacts apart by time, and gaps by their number.
fn windows(length: f64) -> Vec<Protocol> {
    let number = (END / length) as u32;
    let window = |i: u32| Protocol { transient: f64::from(i) * length, window: length };
    (0..number).map(window).collect()
}

type Runs = Vec<Option<Realisation>>;

fn run(chain: &Chain, windows: &[Protocol], until: f64, scenarios: &[Scenario]) -> Runs {
    Abreast::new(chain, windows, until).unwrap().run(scenarios, &|| false)
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
                let mut watch = Watch::new(&chain, &windows);
                let expected = watch.run(Engine::new(scenario), 0, until, &|| false).unwrap();
                let Some(mut realisation) = realisation else {
                    handed_over += if is_strong { 0 } else { 1 - expected.rejected };
                    continue;
                };
                impacts += expected.total.impacts;
                let compared = |of: Counts| (of.distinct, of.impacts, of.masses, of.total);
                let counts = realisation.counts();
                assert_eq!(compared(counts), compared(expected), "{chain:?} {factor} {place}");
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

/// The impacts of a chain by the engine, after comparison with those side by side, or `None` if the
/// chain starts overlapped or is handed over.
fn compared(chain: &Chain, scenario: &Scenario, until: f64) -> Option<Vec<Impact>> {
    let impacts = Engine::new(scenario).ok()?.impacts(until).unwrap();
    let runs = run(chain, &windows(until), until, std::slice::from_ref(scenario));
    let counts = runs.into_iter().flatten().next()?.counts().total.impacts;
    assert_eq!(counts, impacts.len() as u64, "{scenario:?}");
    Some(impacts)
}

/// Returns the amplitudes of cos ωt and sin ωt of an oscillation with this value and rate at t.
fn amplitudes(omega: f64, t: f64, [value, rate]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = (omega * t).sin_cos();
    [value * cos - rate / omega * sin, value * sin + rate / omega * cos]
}

/// A mass leaves the wall and turns near it: its distance is about j s (s − τ)²/6.
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
        let Some(impacts) = compared(&chain, &scenario, 0.25) else { continue };
        returned += usize::from(impacts.len() > 1);
    }
    assert!(returned > 500, "{returned}");
}

/// The acceleration changes its sign: tangents and signs at the ends prove nothing.
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
        let depth = depth * 0.1_f64.powi((i / 24 % 10) as i32 + 3);
        let second = amplitudes(1.0, turn, [x + depth - 2.0, v]);
        let first = if rebounds { amplitudes(1.0, start, [-1.0, -fast]) } else { [0.0; 2] };
        let mut scenario = given(vec![first, second], vec![[0.0; 2], [c * factor, s * factor]]);
        scenario.forcing_frequency = big_w;
        let Some(impacts) = compared(&chain, &scenario, 0.25) else { continue };
        let is_as_meant = !rebounds || impacts.first().is_some_and(|hit| hit.gap == 0);
        let is_hit = is_as_meant && impacts.len() > usize::from(rebounds);
        hits[usize::from(rebounds)] += usize::from(is_hit);
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
    assert!(Abreast::new(&chain, &windows(1.0), 1e9).unwrap().run(&[], &|| true).is_empty());
    let moving = unforced(&[[0.0, 1.5], [0.0; 2], [0.0; 2]], 0.8);
    let overtone = Overtone { frequency: 3.0, amplitudes: vec![[0.0; 2]; 3] };
    let overtones = Scenario { overtones: vec![overtone], ..moving.clone() };
    let places = Scenario { places: Some(vec![0.0, 1.1, 2.0, 3.0, 4.0]), ..moving.clone() };
    let longer = drawn(&Chain { masses: 4, ..chain.clone() }, 0.1, "longer", 0);
    let back = |x: f64, v: f64| amplitudes(1.0, 0.3, [x, v]);
    let beside =
        |apart| unforced(&[back(1.0, 0.1), [0.0; 2], back(-1.0 + 0.1 * apart, -0.01)], 0.8);
    for (case, scenario, until, is_certain) in [
        ("one moves", moving, END, true),
        ("slow", unforced(&[[0.0, -1.0 - 1e-12], [0.0; 2], [0.0; 2]], 0.8), END, false),
        ("overlapping", unforced(&[[-1.5, 0.0], [0.0; 2], [0.0; 2]], 0.8), END, false),
        ("too far", unforced(&[[0.0, 70.0], [0.0; 2], [0.0; 2]], 0.8), END, false),
        ("overtones", overtones, END, false),
        ("places", places, END, false),
        ("longer", longer, END, false),
        // Both outer masses hit the inner one at once, and again until they part.
        ("a tie", unforced(&[[0.0, 1.5], [0.0; 2], [0.0, -1.5]], 0.95), END, false),
        // The second impact makes an amplitude of 104.
        ("fast", unforced(&[[0.0, 60.0], [0.0; 2], [0.0, -50.0]], 0.8), 0.05, false),
        // Errors of 1e-12 in the widths move each of two impacts by 1.25e-11.
        ("impacts 2e-11 apart", beside(2e-11), 0.4, false),
        ("impacts 3e-11 apart", beside(3e-11), 0.4, true),
        // It hits the wall at 5e-5 and leaves it at 5e-6.
        ("weak", unforced(&[[0.0, -1.0 - 1.25e-9], [0.0; 2], [0.0; 2]], 0.1), END, false),
    ] {
        let chain = Chain { restitution: scenario.restitution, ..chain.clone() };
        let runs = run(&chain, &[], until, &[scenario]);
        assert_eq!(runs[0].is_some(), is_certain, "{case}");
    }
    let stopped = Abreast::new(&chain, &windows(1.0), END).unwrap();
    assert!(matches!(stopped.run(&[drawn(&chain, 0.3, "a", 0)], &|| true)[..], [None]));
}

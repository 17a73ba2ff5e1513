//! Tests laws that hold for any arithmetic: conservation, symmetry, and the impact law.

use crate::reference::{Dd, Reference, sin_cos};
use crate::traces::{EIGHT, several};
use crate::{drawn, trace};
use impact_chain::{Chain, Engine, Impact, Scenario, State};

fn draw(masses: usize, sigma: f64, index: u64) -> Scenario {
    drawn(&Chain { masses, ..Chain::default() }, sigma, "physics", index)
}

#[test]
fn elastic_impacts_conserve_energy() {
    // Fast masses, a little out of place, have the energy of the free motions and no more.
    let parts: Vec<_> = draw(20, 1.0, 0).forcing.iter().map(|[x, y]| [0.05 * x, 1.5 * y]).collect();
    let mut engine = Engine::new(&crate::unforced(&parts, 1.0)).unwrap();
    let energy = |engine: &Engine| -> f64 {
        engine.free_parts().iter().map(|[a, b]| 0.5 * (a * a + b * b)).sum()
    };
    let start = energy(&engine);
    let mut worst = 0.0f64;
    for impacts in 1..=1_000_000 {
        assert!(engine.next_impact(1e8).unwrap().is_some(), "the chain keeps on hitting");
        if impacts % 1000 == 0 {
            worst = worst.max((energy(&engine) / start - 1.0).abs());
        }
    }
    assert!(worst < 8.0 * f64::EPSILON, "{worst:e}");
}

/// It changes by the work of the forces and (1 − r²)/2 of the reduced mass times v².
#[test]
fn forces_and_impacts_balance_the_energy() {
    let scenario = draw(9, 0.5, 3);
    let energy = |State { positions, velocities, .. }: &State| {
        let each = (1..).zip(positions.iter().zip(velocities));
        each.map(|(j, (x, v))| 0.5 * (v * v + (x - f64::from(j)).powi(2))).sum::<f64>()
    };
    let power = |State { time, velocities, .. }: &State| {
        let (sin, cos) = (scenario.forcing_frequency * time).sin_cos();
        let each = velocities.iter().zip(&scenario.forcing);
        each.map(|(v, [alpha, beta])| v * (alpha * cos + beta * sin)).sum::<f64>()
    };
    let mut engine = Engine::new(&scenario).unwrap();
    let (mut work, mut loss, mut time, mut impacts) = (0.0, 0.0, 0.0, 0);
    while time < 40.0 {
        // Gauss's rule for three points is right to 1e-13 on so short a piece of flight.
        let end = engine.next_event_time(40.0).unwrap().unwrap_or(40.0).min(time + 0.02);
        let half = 0.5 * (end - time);
        for (node, weight) in [(-0.6_f64.sqrt(), 5.0), (0.0, 8.0), (0.6_f64.sqrt(), 5.0)] {
            let state = engine.state(time + half + node * half).unwrap();
            work += half * weight / 9.0 * power(&state);
        }
        for Impact { gap, closing_speed, .. } in engine.impacts(end).unwrap() {
            let reduced_mass = if gap == 0 || gap == 9 { 1.0 } else { 0.5 };
            loss += 0.5 * reduced_mass * (1.0 - 0.8 * 0.8) * closing_speed * closing_speed;
            impacts += 1;
        }
        time = end;
    }
    let error =
        energy(&engine.state(40.0).unwrap()) - energy(&State::from_scenario(&scenario)) - work
            + loss;
    assert!(impacts > 100 && loss > 1.0 && error.abs() < 1e-10, "{impacts} {loss} {error:e}");
}

/// The angle whose sine is 1/x.
fn arcsine_of_inverse(x: f64) -> Dd {
    let sine = Dd::from(1.0) / Dd::from(x);
    let newton = |angle: Dd, _| {
        let [s, c] = sin_cos(angle);
        angle - (s - sine) / c
    };
    (0..3).fold(Dd::from((1.0 / x).asin()), newton)
}

/// Errors add up as √k; a bias by a hundredth of a last bit would add up as k or k².
#[test]
fn orbits_that_repeat_themselves_keep_their_times() {
    // Between two walls; a pair, which is a mass and a wall; three, with one at rest.
    let two_walls = [1.05, 1.3, 2.3, 5.0, 10.0].map(|a| (a, vec![a]));
    let one_wall = [1.05, 1.5, 1.9].map(|a| (a, vec![0.5 * a, -0.5 * a]));
    let three = [2.3, 5.0].map(|a| (a, vec![a, 0.0, -a]));
    let mut largest = 0.0f64;
    for (amplitude, parts) in two_walls.into_iter().chain(one_wall).chain(three) {
        let first = arcsine_of_inverse(amplitude);
        let rest = if parts.len() == 2 {
            Dd { hi: std::f64::consts::PI, lo: 1.2246467991473532e-16 }
        } else {
            Dd::from(0.0)
        };
        let period = first + first + rest;
        let free: Vec<_> = parts.iter().map(|b| [0.0, *b]).collect();
        let last = if parts == [2.3] { 1e6 } else { 1e5 };
        let mut k = 0.0;
        let mut see = |impact: Impact| {
            let number = ((impact.time - first.hi) / period.hi).round();
            assert!(number == k || number == k + 1.0, "{amplitude}: {impact:?} after {k}");
            k = number;
            let error = (Dd::from(impact.time) - (first + period * Dd::from(k))).hi.abs();
            // A time is rounded once.
            let excess = (error - 0.5 * (impact.time.next_up() - impact.time)).max(0.0);
            let units = excess / (f64::EPSILON * period.hi * (k + 1.0).sqrt());
            largest = largest.max(units);
            assert!(units < 20.0, "{amplitude} of {parts:?}: {units} at {impact:?}, {k}");
            k < last
        };
        let mut engine = Engine::new(&crate::unforced(&free, 1.0)).unwrap();
        while see(engine.next_impact(1e9).unwrap().unwrap()) {}
        assert_eq!(k, last);
    }
}

#[test]
fn the_mirrored_chain_has_the_mirrored_trace_to_the_last_bit() {
    for (n, r, until) in [(20, 0.8, 300.0), (7, 0.0, 300.0), (8, 1.0, 100.0)] {
        let scenario = Scenario { restitution: r, ..draw(n, 0.3, 1) };
        let here = trace(&scenario, until);
        assert!(here.len() > 100, "{}", here.len());
        let forcing = scenario.forcing.iter().rev().map(|[x, y]| [-x, -y]).collect();
        let mut there = trace(&Scenario { forcing, ..scenario }, until);
        there.iter_mut().for_each(|impact| impact.gap = n - impact.gap);
        assert_eq!(here, there, "n = {n}, r = {r}");
    }
}

#[test]
fn phases_keep_their_digits_at_any_time() {
    let mut worst: f64 = 0.0;
    let plain = [(1.0, std::f64::consts::SQRT_2), (1.3, 0.7), (0.77, 5.1)].map(|(w, big_w)| {
        Scenario { natural_frequency: w, forcing_frequency: big_w, ..draw(6, 0.05, 4) }
    });
    // And with eight components.
    let eight = several(&Chain { masses: 4, ..Chain::default() }, 0.03, &EIGHT, 0);
    for scenario in plain.into_iter().chain([eight]) {
        let mut engine = Engine::new(&scenario).unwrap();
        for t in [1.0, 12345.678, 1e8 + 0.1, 1e10 / 3.0, 1e12 - 0.7] {
            engine.advance(t).unwrap();
            let exact = Reference::new(&scenario).state(Dd::from(t));
            let State { positions: x, velocities: v, .. } = engine.state(t).unwrap();
            for (j, [u, speed]) in exact.iter().enumerate() {
                let place = Dd::from((j + 1) as f64);
                worst = worst.max((Dd::from(x[j]) - place - *u).hi.abs() / x[j]);
                worst = worst.max((Dd::from(v[j]) - *speed).hi.abs());
            }
        }
        assert_eq!(engine.counters().impacts, 0, "the phases are looked at in one flight");
    }
    assert!(worst < 4.0 * f64::EPSILON, "{worst:e}");
}

//! Follows an orbit while the amplitude of the response moves slowly, up and down again: each step
//! goes on from the last state. Up to the graze at 1 there is no impact; down they go on to a fold.

use impact_chain::{Engine, Error, Scenario, State};
use std::f64::consts::TAU;

/// Returns the amplitudes with the last closing speed of 100 periods, 0 without impact.
fn sweep() -> Result<Vec<[f64; 2]>, Error> {
    let (mut rows, mut last, until) = (Vec::new(), None, 100.0 * TAU / 1.5);
    for step in (0..12).chain((0..12).rev()) {
        let amplitude = 0.05 + 0.1 * f64::from(step);
        let scenario = Scenario::from_json(&format!(
            r#"{{"forcing": [[{}, 0]], "forcing_frequency": 1.5, "walls": [0, 100]}}"#,
            amplitude * (1.0 - 1.5 * 1.5)
        ))?;
        // The force has the same phase after whole periods, so each step starts at t = 0.
        let mut engine = Engine::from_state(
            &scenario,
            last.as_ref().unwrap_or(&State::from_scenario(&scenario)),
        )?;
        let impact = engine.impacts(until)?.pop().filter(|impact| impact.time > 0.99 * until);
        rows.push([amplitude, impact.map_or(0.0, |impact| impact.closing_speed)]);
        last = Some(State { time: 0.0, ..engine.state(until)? });
    }
    Ok(rows)
}

fn main() -> Result<(), Error> {
    sweep()?.iter().for_each(|[amplitude, speed]| println!("{amplitude:.2} {speed:.6}"));
    Ok(())
}

/// (1 + κ v)² + (ν v)² = A², κ = (1 + r) / (2 tan(T/2)) < 0 and ν = (1 - r) / 2Ω, has a root v down
/// to the fold at A² = ν² / (κ² + ν²). Below it they die out slowly.
#[test]
fn impacts_begin_at_the_graze_and_end_at_the_fold() {
    let (kappa, nu) = (0.9 / (TAU / 3.0).tan(), 0.2 / 3.0);
    let squares: f64 = kappa * kappa + nu * nu;
    for (k, [amplitude, speed]) in sweep().unwrap().into_iter().enumerate() {
        let root = amplitude * amplitude * squares - nu * nu;
        let on_branch = amplitude > 1.0 || k >= 12 && root > 0.0;
        let expected = if on_branch { (root.sqrt() - kappa) / squares } else { 0.0 };
        let bound = if on_branch || k < 12 { 1e-8 } else { 0.01 };
        assert!((speed - expected).abs() < bound, "step {k}: {amplitude}, {speed}, {expected}");
    }
}

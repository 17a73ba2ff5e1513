//! Tests counts of ensembles, their start, and the rise, which was measured elsewhere too.

use impact_chain::mode_jump::{Histogram, Sample, mode_jump};
use impact_chain::{Counts, Engine, Scenario, State};
use impact_numerics::random::{NormalPairs, Seed};
use impact_paper::experiments::{Progress, ensembles::CUTTING};
use impact_paper::params::{Beyond, Chain, Ensemble, Protocol, Start, lowered};

fn small() -> Ensemble {
    let times = [(20.0, 20.0), (20.0, 50.0), (50.0, 20.0), (100.0, 50.0)];
    Ensemble {
        chain: Chain { masses: 20, ..Chain::default() },
        sigmas: vec![0.16],
        protocols: times.map(|(transient, window)| Protocol { transient, window }).to_vec(),
        ..Ensemble::default()
    }
}

fn run(ensemble: &Ensemble, sigma: f64, realisations: u64) -> Counts {
    ensemble.prepare(sigma, &|| false).count(0..realisations).unwrap().into_iter().collect()
}

#[test]
fn pieces_add_up_to_the_chain() {
    let whole = run(&small(), 0.16, 4);
    let pieces = run(&Ensemble { pieces: 2, ..small() }, 0.16, 4);
    for (whole, pieces) in whole.distinct.iter().zip(&pieces.distinct) {
        assert!(pieces.chunks(2).map(|pair| Some(pair[0]? + pair[1]?)).eq(whole.iter().copied()));
    }
}

#[test]
fn beyond_the_rise_runs_are_fewer_and_shorter() {
    let beyond = Beyond { above: 0.15, realisations: Some(2), until: Some(60.0) };
    let short = Ensemble { beyond: Some(beyond), ..small() };
    assert_eq!([0.15, 0.16].map(|sigma| short.realisations_at(sigma)), [100, 2]);
    assert_eq!([0.15, 0.16].map(|sigma| short.until(sigma)), [150.0, 60.0]);
    let (cut, whole) = (run(&short, 0.16, 2), run(&small(), 0.16, 2));
    assert_eq!(cut.distinct[0], whole.distinct[0]);
    assert_eq!(cut.distinct[1..], vec![vec![None; 2]; 3]);
}

#[test]
fn where_many_starts_overlap_there_is_no_place_of_the_rise() {
    let one = |distinct, rejected| Counts {
        distinct: vec![vec![distinct]],
        impacts: vec![vec![1]],
        masses: vec![vec![1]],
        rejected,
        ..Counts::default()
    };
    let overlapping = |k| (0..6).map(|_| one(Some(k), 0)).chain([one(None, 1)]).collect::<Counts>();
    let ensemble = Ensemble {
        chain: Chain { masses: 9, ..Chain::default() },
        sigmas: vec![0.1, 0.2],
        realisations: 7,
        ..Ensemble::default()
    };
    let parts = vec![vec![overlapping(0)], vec![overlapping(10)]];
    let counted = (CUTTING.join)(&vec![ensemble], parts, &Progress::silent()).unwrap();
    let curve = counted[0].first_curve();
    assert_eq!((curve.rise.half_height_all, curve.rows[1].ran), (None, 6));
}

#[test]
fn the_rise_lies_where_it_was_measured_elsewhere() {
    // An independent simulator, 1000 realisations, rest start, T = 500, W = 200: 0.1165(4).
    let ensemble = Ensemble {
        sigmas: (18..=28).map(|i| f64::from(i) / 200.0).collect(),
        realisations: 60,
        stream: "sweep".into(),
        ..Ensemble::default()
    };
    assert_eq!(ensemble.chain.start, Start::Rest);
    let counted = CUTTING.run(&vec![ensemble], "test", &Progress::silent()).unwrap();
    let rise = &counted[0].first_curve().rise;
    let half = rise.half_height.unwrap();
    // Four standard errors of both together; a wrong law of impact moves it by ten.
    let error = (half.error * half.error + 4e-4 * 4e-4).sqrt();
    assert!(half.error < 2e-3, "{half:?}");
    assert!((half.value - 0.1165).abs() < 4.0 * error, "{half:?}");
    let onset = rise.kept_half.unwrap().value;
    assert!(onset < half.value, "half of the chains impact long before half of the gaps: {onset}");
}

/// From rest until the force is lowered there is no impact.
#[test]
fn positions_and_velocities_are_continuous_when_the_force_is_lowered() {
    let chain = Chain { masses: 5, ..Chain::default() };
    let scenario = Scenario::draw(&chain, 0.05, &mut NormalPairs::new("history", Seed(1), 1));
    let (mut engine, time) = (Engine::new(&scenario).unwrap(), 7.3);
    assert_eq!(engine.impacts(time).unwrap(), []);
    let before = engine.state(time).unwrap();
    let after = State::from_scenario(&lowered(&scenario, &engine.free_parts(), time, 0.4));
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
    assert!(near(&before.positions, &after.positions), "{before:?} {after:?}");
    assert!(near(&before.velocities, &after.velocities), "{before:?} {after:?}");
}

#[test]
fn the_mode_jumps_where_it_was_measured_elsewhere() {
    // A simulator of a reader, 22 000 chains at each σ: all gaps overtake the bulk near 0.118.
    let sigmas = [0.11, 0.115, 0.12, 0.125];
    let counts = [0, 1, 2, 3].map(|i| {
        let chains = Ensemble { first: 1000 * i, stream: "test".into(), ..Ensemble::default() };
        run(&chains, sigmas[i as usize], 1000).distinct.remove(0)
    });
    let samples =
        [0, 1, 2, 3].map(|i| Sample { sigma: sigmas[i], counts: &counts[i], seed: i as u64 });
    let all_gaps = mode_jump(&samples, Histogram { gaps: 101, half_width: 6 }).all_gaps;
    let (place, peak) = (all_gaps.sigma.unwrap(), all_gaps.peak.unwrap());
    assert!(place.error < 3e-3, "{place:?}");
    assert!((place.value - 0.118).abs() < 4.0 * place.error, "{place:?}");
    // A step of a tenth of all gaps.
    assert!(peak.value > 20.0 && peak.interval[1] < 90.0, "{peak:?}");
}

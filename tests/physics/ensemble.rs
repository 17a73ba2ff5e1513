//! An ensemble against the half height of an independent simulator.

use impact_chain::{Ensemble, Start};
use impact_paper::experiments::{Progress, ensembles::CUTTING};

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
    let found = CUTTING.run(&vec![ensemble], "test", &Progress::silent()).unwrap();
    let rise = &found[0].first().rise;
    let half = rise.half_height.unwrap();
    // Four standard errors of both together; a wrong law of impact moves it by ten.
    let error = (half.error * half.error + 4e-4 * 4e-4).sqrt();
    assert!(half.error < 2e-3, "{half:?}");
    assert!((half.value - 0.1165).abs() < 4.0 * error, "{half:?}");
    let onset = rise.kept_half.unwrap().value;
    assert!(onset < half.value, "half of the chains impact long before half of the gaps: {onset}");
}

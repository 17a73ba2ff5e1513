//! Runs the saved scenarios of Figs. 5 and 6 with the second simulator.

use crate::reference::{Hit, Reference};
use impact_chain::Scenario;
use impact_paper::experiments::segments::FILES;

/// They were searched for, as random motions do not show the impacts of Fig. 6 in order (none in
/// 10^7): for given times of the impacts amplitudes and kicks obey linear equations. The impacts
/// L-1, 1-2, 2-3 and 3-R are gaps 0 to 3. That of Sec. 5 is not simple; both close.
#[test]
fn figures_5_and_6_show_their_circuits() {
    for (file, order) in FILES.into_iter().zip([&[0, 1, 3, 0][..], &[0, 0, 1, 0, 2, 1, 3, 3, 0]]) {
        let path = format!("{}/templates/{file}", env!("CARGO_MANIFEST_DIR"));
        let json = std::fs::read_to_string(&path).unwrap();
        let saved: serde_json::Value = serde_json::from_str(&json).unwrap();
        let scenario = Scenario::from_json(&saved["scenario"].to_string()).unwrap();
        let until = saved["until"].as_f64().unwrap();
        let hits = Reference::new(&scenario).run(until).unwrap();
        assert_eq!(saved["order"], serde_json::json!(order));
        assert_eq!(hits.iter().map(|hit| hit.gap).collect::<Vec<_>>(), order);
        // A grazing impact is no clear picture, nor are two at once.
        assert!(hits.iter().all(|hit| hit.closing_speed.hi > 0.1), "{hits:?}");
        assert!(hits[0].time.hi >= saved["from"].as_f64().unwrap());
        let apart = |pair: &[Hit]| (pair[1].time - pair[0].time).hi > 0.15;
        assert!(hits.windows(2).all(apart), "{hits:?}");
    }
}

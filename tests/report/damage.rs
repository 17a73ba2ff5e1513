//! Damages scenarios and printed statements: no reader panics or hangs.

#[path = "../../crates/literate/src/report/tests/damaged.rs"]
mod damaged;

use damaged::survives;
use impact_chain::Scenario;
use impact_paper::claims::Published;

const SCENARIO: &str = r#"{"restitution": 0.8, "boundary": "ring", "initial": {"free": [[0.1, 0], [0, 0.1]]},
    "forcing_frequencies": [1.5, 2.5], "forcing": [[[0.1, 0.2], [0.3, 0.4]], [[0.5, 0.6], [0.7, 0.8]]]}"#;

#[test]
fn no_reader_panics_or_hangs() {
    survives("statements", include_str!("../../templates/published.toml"), 100, Published::parse);
    let scenario = |text: &str| Scenario::from_json(text).and_then(|read| read.validate());
    survives("scenario", SCENARIO, 2000, scenario);
}

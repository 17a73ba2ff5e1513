//! Damages scenarios and printed statements: no reader panics or hangs, and each fault is one line.

#[path = "../../crates/literate/src/report/tests/damaged.rs"]
mod damaged;

use damaged::survives;
use impact_chain::Scenario;
use impact_paper::claims::Published;
use literate::input::one_line;

const SCENARIO: &str = r#"{"restitution": 0.8, "boundary": "ring", "initial": {"free": [[0.1, 0], [0, 0.1]]},
    "forcing_frequencies": [1.5, 2.5], "forcing": [[[0.1, 0.2], [0.3, 0.4]], [[0.5, 0.6], [0.7, 0.8]]]}"#;

fn line<T>(read: Result<T, impl std::fmt::Display>) -> Result<(), String> {
    read.map(drop).map_err(|error| one_line(&error.to_string(), 1000))
}

#[test]
fn no_reader_panics_or_hangs() {
    let published = include_str!("../../templates/published.toml");
    survives("published.toml", published.into(), 100, |text| line(Published::parse(text)));
    let scenario = |text: &str| line(Scenario::from_json(text).and_then(|read| read.validate()));
    survives("scenario", SCENARIO.into(), 2000, scenario);
}

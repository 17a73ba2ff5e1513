//! Reads `scenes/scenes.json` (see `scenes/README.md`), runs a method on a case, and judges it.

use crate::experiments::prelude::*;
use impact_chain::Error as Failure;
use impact_chain::Sink;
use impact_chain::methods::{Cost, Task};
use serde_json::Value as Json;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    pub id: String,
    #[serde(rename = "what")]
    pub title: String,
    /// Why the outcome is what it is.
    pub why: String,
    pub cases: Vec<Case>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Unique in the file, and never given to another case.
    pub id: String,
    pub difficulty: f64,
    /// The chain and its forcing, as [`Scenario::parse_json`] reads them.
    pub scenario: Json,
    pub start: State,
    pub until: f64,
    pub expected: Expected,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Expected {
    /// The impacts that count, in the order of time.
    Impacts {
        impacts: Vec<(f64, usize)>,
        within: f64,
        /// Slower impacts do not count: the last bounces of a chatter depend on the method.
        #[serde(default)]
        faster: f64,
        /// Only impacts of these gaps count; those of all gaps if it is empty.
        #[serde(default)]
        among: Vec<usize>,
        /// Whether no other impact may follow to the end of the run.
        #[serde(default)]
        only: bool,
    },
    /// That many impacts, all at this closing speed.
    Speed {
        impacts: usize,
        speed: f64,
        /// How far off it may be, relative to it.
        within: f64,
    },
    /// From that time on no impact with more than this closing speed.
    Rest { since: f64, slower: f64 },
    /// Three masses meet: none passes another, momentum is kept, and energy does not grow.
    Law,
}

/// How far off the velocities of [`Expected::Law`] may be.
const LAWFUL: f64 = 0.02;

/// Impacts within this time of each other may come in any order.
const TIE: f64 = 1e-9;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    Right,
    /// An impact was not found, or another gap was hit before it.
    Missed,
    /// An impact where there is none, or one too early.
    Ghost,
    Late,
    WrongSpeed,
    WrongRest,
    GaveUp,
    /// The method does not support the case, and says so.
    Refused,
    /// Not as expected, but the method reported that it could not decide an impact.
    Warned,
}

impl Outcome {
    /// Returns the words that tables have for it.
    pub fn label(self) -> &'static str {
        match self {
            Outcome::Right => "right",
            Outcome::Missed => "missed",
            Outcome::Ghost => "ghosts",
            Outcome::Late => "late or early",
            Outcome::WrongSpeed => "wrong speed",
            Outcome::WrongRest => "wrong rest",
            Outcome::GaveUp => "gave up",
            Outcome::Refused => "refused",
            Outcome::Warned => "warned",
        }
    }
}

/// Returns the scenes with which the program was built.
pub fn scenes() -> Vec<Scene> {
    let read = serde_json::from_str(include_str!("../../../scenes/scenes.json"));
    read.unwrap_or_else(|error| panic!("scenes/scenes.json: {error}; mend it and build again"))
}

pub type Run<'a> = dyn Fn(Task, Sink) -> Result<Cost, Failure> + 'a;

impl Case {
    /// Returns the simulated time from its start to its end.
    pub fn length(&self) -> f64 {
        self.until - self.start.time
    }

    /// Returns the chain of the case; the engine may refuse to run it.
    pub fn chain(&self) -> Result<Scenario, Failure> {
        Scenario::parse_json(&self.scenario.to_string())
    }

    /// Runs the case by a method, and returns the outcome and the least speed at which a gap opened
    /// by the law, infinity if none did.
    pub fn run(&self, method: &Run) -> (Outcome, f64) {
        let Ok(scenario) = self.chain() else { return (Outcome::Refused, f64::INFINITY) };
        let (mut seen, mut slowest) = (Vec::new(), f64::INFINITY);
        let task = Task { scenario: &scenario, start: &self.start, until: self.until };
        let ran = method(task, &mut |impact| {
            slowest = slowest.min(scenario.restitution * impact.closing_speed);
            if self.expected.counts(&impact) {
                seen.push(impact);
            }
            seen.len() < self.expected.enough()
        });
        let outcome = match ran.map(|cost| (self.judge(&seen), cost.undecided)) {
            Ok((Outcome::Right, _)) => Outcome::Right,
            Ok((_, undecided)) if undecided > 0 => Outcome::Warned,
            Ok((outcome, _)) => outcome,
            Err(Failure::Work { .. }) => Outcome::GaveUp,
            Err(_) => Outcome::Refused,
        };
        (outcome, slowest)
    }

    pub fn judge(&self, impacts: &[Impact]) -> Outcome {
        let counts = |impact: &Impact| impact.time <= self.until && self.expected.counts(impact);
        let relevant = impacts.iter().copied().filter(counts);
        let seen: Vec<Impact> = relevant.take(self.expected.enough()).collect();
        match &self.expected {
            Expected::Impacts { impacts, within, .. } => in_order(impacts, *within, &seen),
            Expected::Speed { impacts, .. } if seen.len() < *impacts => Outcome::Missed,
            Expected::Speed { speed, within, .. } => {
                let off = |impact: &Impact| (impact.closing_speed / speed - 1.0).abs() > *within;
                if seen.iter().any(off) { Outcome::WrongSpeed } else { Outcome::Right }
            }
            Expected::Rest { .. } if seen.is_empty() => Outcome::Right,
            Expected::Rest { .. } => Outcome::WrongRest,
            Expected::Law => lawful(&self.start.velocities, &seen),
        }
    }
}

impl Expected {
    fn counts(&self, impact: &Impact) -> bool {
        match self {
            Expected::Impacts { faster, among, .. } => {
                impact.closing_speed > *faster && (among.is_empty() || among.contains(&impact.gap))
            }
            Expected::Rest { since, slower } => {
                impact.time >= *since && impact.closing_speed > *slower
            }
            Expected::Speed { .. } | Expected::Law => impact.closing_speed > 0.0,
        }
    }

    fn enough(&self) -> usize {
        match self {
            Expected::Impacts { impacts, only, .. } => impacts.len() + usize::from(*only),
            Expected::Speed { impacts, .. } => *impacts,
            Expected::Rest { .. } => 1,
            Expected::Law => usize::MAX,
        }
    }
}

/// Compares impacts one after the other; those of one instant may come in any order.
fn in_order(expected: &[(f64, usize)], within: f64, seen: &[Impact]) -> Outcome {
    let mut seen = seen.to_vec();
    let mut from = 0;
    for tied in expected.chunk_by(|a, b| b.0 - a.0 <= TIE) {
        let to = (from + tied.len()).min(seen.len());
        seen[from..to].sort_by_key(|impact| tied.iter().position(|(_, gap)| *gap == impact.gap));
        from = to;
    }
    for (i, (time, gap)) in expected.iter().enumerate() {
        let Some(impact) = seen.get(i) else { return Outcome::Missed };
        let late = impact.time - time;
        if impact.gap != *gap {
            return if late < -within { Outcome::Ghost } else { Outcome::Missed };
        }
        if late.abs() > within {
            return Outcome::Late;
        }
    }
    if seen.len() > expected.len() { Outcome::Ghost } else { Outcome::Right }
}

/// Judges the first impacts of three masses with the walls by their velocities before they met.
fn lawful(before: &[f64], seen: &[Impact]) -> Outcome {
    let speed = |gap| Some(seen.iter().find(|impact| impact.gap == gap)?.closing_speed);
    let Some((left, right)) = speed(0).zip(speed(before.len())) else { return Outcome::Missed };
    let left = -left;
    let middle = before.iter().sum::<f64>() - left - right;
    let energy = |velocities: &[f64]| velocities.iter().map(|v| v * v).sum::<f64>();
    let apart = left <= middle + LAWFUL && middle <= right + LAWFUL;
    let grows = energy(&[left, middle, right]) > energy(before) + LAWFUL;
    if apart && !grows { Outcome::Right } else { Outcome::WrongSpeed }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_chain::methods::{Certified, Method};

    /// The engine with another time and closing speed of each impact, or without any.
    fn wrong(by: f64, task: Task, sink: Sink) -> Result<Cost, Failure> {
        if by == 0.0 {
            return Ok(Cost::default());
        }
        Certified.run(task, &mut |Impact { time, gap, closing_speed }| {
            sink(Impact { time: time + by, gap, closing_speed: closing_speed * (1.0 + by) })
        })
    }

    #[test]
    fn a_method_that_errs_is_not_right() {
        for scene in scenes() {
            for case in scene.cases.iter().filter(|case| case.until < 1e3) {
                let [late, blind] =
                    [0.05, 0.0].map(|by| case.run(&|task, sink| wrong(by, task, sink)).0);
                if late == Outcome::Refused {
                    continue;
                }
                let expected = match &case.expected {
                    Expected::Impacts { impacts, .. } if impacts.is_empty() => [Outcome::Right; 2],
                    Expected::Impacts { .. } => [Outcome::Late, Outcome::Missed],
                    Expected::Speed { .. } => [Outcome::WrongSpeed, Outcome::Missed],
                    Expected::Rest { .. } => [Outcome::Right; 2],
                    Expected::Law => [Outcome::Right, Outcome::Missed],
                };
                assert_eq!([late, blind], expected, "{} {}", scene.id, case.difficulty);
            }
        }
    }

    #[test]
    fn velocities_are_lawful_or_not() {
        let hit = |gap, closing_speed| Impact { time: 1.0, gap, closing_speed };
        let judged = |left, right| lawful(&[1.0, 0.0, -1.0], &[hit(0, left), hit(3, right)]);
        assert_eq!(judged(0.8, 0.8), Outcome::Right);
        // The middle mass passes the right one; more energy than before.
        assert_eq!(judged(0.9, 0.1), Outcome::WrongSpeed);
        assert_eq!(judged(1.1, 1.1), Outcome::WrongSpeed);
    }
}

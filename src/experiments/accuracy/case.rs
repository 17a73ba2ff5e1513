//! A run, what must come out of it, and what a method made of it.

use impact_chain::methods::{Method, State};
use impact_chain::{Error, Impact, Scenario};
use serde::{Deserialize, Serialize};

/// One run and its outcome.
#[derive(Clone, Debug)]
pub struct Case {
    /// What is special about it: `depth 1e-3`.
    pub name: String,
    /// The chain.
    pub scenario: Scenario,
    /// Where it starts.
    pub start: State,
    /// When it ends.
    pub until: f64,
    /// What must come out.
    pub expected: Expected,
}

/// What must come out of a case.
#[derive(Clone, Debug, PartialEq)]
pub enum Expected {
    /// The first impact.
    First {
        /// Its gap.
        gap: usize,
        /// Its time.
        time: f64,
        /// How far off a time may be.
        within: f64,
    },
    /// No impact at all.
    Nothing,
    /// Two gaps are hit at the same time, in any order, before anything else.
    Together {
        /// The gaps.
        gaps: [usize; 2],
        /// The time.
        time: f64,
        /// How far off a time may be.
        within: f64,
    },
    /// Some of the impacts, in order; bounces that die out and what happens within a cluster are
    /// a matter of the method.
    Sequence {
        /// Time and gap of each.
        impacts: Vec<(f64, usize)>,
        /// Slower impacts are passed over.
        faster: f64,
        /// Impacts of other gaps are passed over.
        among: Vec<usize>,
        /// How far off a time may be.
        within: f64,
    },
    /// Some of the impacts, in order, and none after them to the end: bounces that die out.
    Rest {
        /// Time and gap of each.
        impacts: Vec<(f64, usize)>,
        /// Slower impacts are passed over.
        faster: f64,
        /// How far off a time may be.
        within: f64,
    },
    /// For each impact at gap k one at gap N − 1 − k at the same time.
    Mirror {
        /// How far off a time may be.
        within: f64,
    },
    /// All impacts at the same closing speed.
    Steady {
        /// How many impacts, at least.
        impacts: u64,
        /// The speed.
        speed: f64,
        /// How far off, relative to it.
        within: f64,
    },
    /// An error, before anything is run.
    Refused,
}

/// What a method made of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// In one word.
    pub verdict: Verdict,
    /// How far off its time (or, for steady speeds, its relative speed) was, where that was seen.
    pub error: Option<f64>,
}

/// An outcome in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// As expected.
    Right,
    /// An impact was not seen, or far too late.
    Missed,
    /// An impact where there is none, or one too early.
    Ghost,
    /// The right impact at a wrong time.
    Displaced,
    /// Another gap.
    WrongGap,
    /// The speed changed.
    Drifted,
    /// The method gave up, with an error.
    GaveUp,
    /// What is outside the model was run.
    Accepted,
}

impl Verdict {
    /// The verdict in words, as a table gives it.
    pub fn words(self) -> &'static str {
        match self {
            Verdict::Right => "right",
            Verdict::Missed => "missed",
            Verdict::Ghost => "ghosts",
            Verdict::Displaced => "late or early",
            Verdict::WrongGap => "wrong gap",
            Verdict::Drifted => "drift",
            Verdict::GaveUp => "gave up",
            Verdict::Accepted => "accepted",
        }
    }
}

impl Case {
    /// Runs a method on this case and judges what it did.
    pub fn judge(&self, method: &dyn Method) -> Outcome {
        let mut judge = Judge { case: self, seen: Vec::new(), count: 0, worst: 0.0 };
        let ran = method.run(&self.scenario, &self.start, self.until, &mut |i| judge.see(i));
        match (ran, &self.expected) {
            (Err(Error::Input { .. } | Error::Overlap { .. }), Expected::Refused) => {
                Outcome { verdict: Verdict::Right, error: None }
            }
            (Ok(_), Expected::Refused) => Outcome { verdict: Verdict::Accepted, error: None },
            (Err(_), _) => Outcome { verdict: Verdict::GaveUp, error: None },
            (Ok(_), _) => judge.end(),
        }
    }
}

/// What was seen of a run so far, as far as the expectation needs it.
struct Judge<'a> {
    case: &'a Case,
    seen: Vec<Impact>,
    count: u64,
    worst: f64,
}

impl Judge<'_> {
    /// Whether the run should go on.
    fn see(&mut self, impact: Impact) -> bool {
        self.count += 1;
        match &self.case.expected {
            Expected::First { .. } | Expected::Nothing | Expected::Refused => {
                self.seen.push(impact);
                false
            }
            Expected::Together { .. } => {
                self.seen.push(impact);
                self.seen.len() < 2
            }
            Expected::Sequence { impacts, faster, among, .. } => {
                if impact.closing_speed > *faster && among.contains(&impact.gap) {
                    self.seen.push(impact);
                }
                self.seen.len() < impacts.len()
            }
            Expected::Rest { impacts, faster, .. } => {
                if impact.closing_speed > *faster {
                    self.seen.push(impact);
                }
                self.seen.len() <= impacts.len()
            }
            Expected::Mirror { .. } => {
                self.seen.push(impact);
                true
            }
            Expected::Steady { speed, .. } => {
                self.worst = self.worst.max((impact.closing_speed / speed - 1.0).abs());
                true
            }
        }
    }

    fn end(&self) -> Outcome {
        match &self.case.expected {
            Expected::First { gap, time, within } => self.in_order(&[(*time, *gap)], *within),
            Expected::Sequence { impacts, within, .. } => self.in_order(impacts, *within),
            Expected::Rest { impacts, within, .. } => match self.in_order(impacts, *within) {
                found if found.verdict == Verdict::Right && self.seen.len() > impacts.len() => {
                    Outcome { verdict: Verdict::Ghost, error: None }
                }
                found => found,
            },
            Expected::Nothing if self.seen.is_empty() => right(None),
            Expected::Nothing => Outcome { verdict: Verdict::Ghost, error: None },
            Expected::Refused => Outcome { verdict: Verdict::Accepted, error: None },
            Expected::Together { gaps, time, within } => {
                let mut seen: Vec<usize> = self.seen.iter().map(|impact| impact.gap).collect();
                seen.sort_unstable();
                if seen != gaps {
                    let verdict = if seen.len() < 2 { Verdict::Missed } else { Verdict::WrongGap };
                    return Outcome { verdict, error: None };
                }
                let off = |impact: &Impact| (impact.time - time).abs();
                timed(self.seen.iter().map(off).fold(0.0, f64::max), *within)
            }
            Expected::Mirror { within } => self.mirror(*within),
            Expected::Steady { impacts, within, .. } => {
                let verdict = match (self.count >= *impacts, self.worst <= *within) {
                    (false, _) => Verdict::Missed,
                    (true, false) => Verdict::Drifted,
                    (true, true) => Verdict::Right,
                };
                Outcome { verdict, error: Some(self.worst) }
            }
        }
    }

    /// Impacts one after the other.
    fn in_order(&self, expected: &[(f64, usize)], within: f64) -> Outcome {
        let mut worst: f64 = 0.0;
        for (i, (time, gap)) in expected.iter().enumerate() {
            let Some(seen) = self.seen.get(i) else {
                return Outcome { verdict: Verdict::Missed, error: None };
            };
            let early = seen.time - time;
            worst = worst.max(early.abs());
            if seen.gap != *gap {
                let verdict = if early < -within { Verdict::Ghost } else { Verdict::WrongGap };
                return Outcome { verdict, error: None };
            }
            if early.abs() > within {
                return Outcome { verdict: Verdict::Displaced, error: Some(worst) };
            }
        }
        right(Some(worst))
    }

    fn mirror(&self, within: f64) -> Outcome {
        let last = self.case.scenario.gaps() - 1;
        let until = self.case.until;
        let mut worst: f64 = 0.0;
        for impact in self.seen.iter().filter(|impact| impact.time < until - within) {
            let partners = self.seen.iter().filter(|other| other.gap == last - impact.gap);
            let nearest = partners.map(|other| (other.time - impact.time).abs());
            worst = worst.max(nearest.fold(f64::INFINITY, f64::min));
        }
        match self.seen.is_empty() {
            true => Outcome { verdict: Verdict::Missed, error: None },
            false if worst <= within => right(Some(worst)),
            false => Outcome { verdict: Verdict::WrongGap, error: None },
        }
    }
}

fn right(error: Option<f64>) -> Outcome {
    Outcome { verdict: Verdict::Right, error }
}

fn timed(worst: f64, within: f64) -> Outcome {
    let verdict = if worst <= within { Verdict::Right } else { Verdict::Displaced };
    Outcome { verdict, error: Some(worst) }
}

#[cfg(test)]
mod tests {
    use super::super::scenes;
    use super::*;
    use impact_chain::methods::{Certified, Cost};

    /// A judge that lets everything pass would be no judge: a false copy of the engine fails.
    #[test]
    fn a_method_that_errs_is_told() {
        struct Late(f64);
        impl Method for Late {
            fn name(&self) -> &'static str {
                "late"
            }
            fn run(
                &self,
                scenario: &Scenario,
                start: &State,
                until: f64,
                sink: &mut dyn FnMut(Impact) -> bool,
            ) -> Result<Cost, Error> {
                Certified.run(scenario, start, until, &mut |impact| {
                    sink(Impact {
                        time: impact.time + self.0,
                        closing_speed: impact.closing_speed * (1.0 + self.0),
                        gap: impact.gap,
                    })
                })
            }
        }
        struct Blind;
        impl Method for Blind {
            fn name(&self) -> &'static str {
                "blind"
            }
            fn run(
                &self,
                _: &Scenario,
                _: &State,
                _: f64,
                _: &mut dyn FnMut(Impact) -> bool,
            ) -> Result<Cost, Error> {
                Ok(Cost::default())
            }
        }
        for scene in scenes::all(true, &[3]).unwrap() {
            for case in &scene.cases {
                let late = case.judge(&Late(0.05)).verdict;
                let blind = case.judge(&Blind).verdict;
                let quiet = case.expected == Expected::Nothing;
                match scene.id {
                    "bad-input" => assert_eq!((late, blind), (Verdict::Right, Verdict::Accepted)),
                    "elastic" => assert_eq!((late, blind), (Verdict::Drifted, Verdict::Missed)),
                    // A common delay leaves a mirror image a mirror image.
                    "mirror" => assert_eq!((late, blind), (Verdict::Right, Verdict::Missed)),
                    _ if quiet => assert_eq!((late, blind), (Verdict::Right, Verdict::Right)),
                    id => {
                        assert_eq!((late, blind), (Verdict::Displaced, Verdict::Missed), "{id}");
                    }
                }
            }
        }
    }
}

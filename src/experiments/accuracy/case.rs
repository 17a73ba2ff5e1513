//! A run, its expected outcome, and the verdict on a method.

use crate::experiments::prelude::*;
use impact_chain::methods::Method;

/// One run and its expected outcome.
#[derive(Clone, Debug)]
pub struct Case {
    /// The chain.
    pub scenario: Scenario,
    pub start: State,
    /// When it ends.
    pub until: f64,
    /// The expected outcome.
    pub expected: Expected,
}

/// How far off a time may be in most scenes, in units of 1/ω: coarse enough for every method at
/// its usual step.
pub const NEAR: f64 = 1e-2;

/// How far off a speed may be that should not change, relative to it.
pub const STEADY: f64 = 1e-6;

/// The expected outcome of a case.
#[derive(Clone, Debug, PartialEq)]
pub enum Expected {
    /// The impacts that count, in order. The last bounces of a chatter and those within a cluster
    /// do not: they depend on the method.
    Impacts {
        /// Time and gap of each.
        impacts: Vec<(f64, usize)>,
        /// Slower impacts do not count.
        faster: f64,
        /// Impacts of other gaps do not count either; all gaps do if this is empty.
        among: Vec<usize>,
        /// Whether none may follow to the end of the run.
        all: bool,
        /// How far off a time may be.
        within: f64,
    },
    /// At least `impacts` impacts, the first of them all at this closing speed.
    Speed {
        /// How many.
        impacts: usize,
        /// The closing speed.
        speed: f64,
        /// How far off it may be, relative to it.
        within: f64,
    },
}

impl Expected {
    /// The first impact.
    pub fn first(gap: usize, time: f64, within: f64) -> Expected {
        let (impacts, faster, among) = (vec![(time, gap)], -1.0, Vec::new());
        Expected::Impacts { impacts, faster, among, all: false, within }
    }

    /// No impact at all.
    pub fn nothing() -> Expected {
        let (impacts, faster, among) = (Vec::new(), -1.0, Vec::new());
        Expected::Impacts { impacts, faster, among, all: true, within: 0.0 }
    }
}

/// An outcome in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// As expected.
    Right,
    /// An impact was not found, or far too late.
    Missed,
    /// An impact where there is none, or one too early.
    Ghost,
    /// The right impact at a wrong time.
    Displaced,
    /// Another gap.
    WrongGap,
    /// Another closing speed.
    WrongSpeed,
    /// The method gave up, with an error.
    GaveUp,
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
            Verdict::WrongSpeed => "wrong speed",
            Verdict::GaveUp => "gave up",
        }
    }
}

impl Case {
    /// Runs a method on this case and judges its impacts.
    pub fn judge(&self, method: &dyn Method) -> Verdict {
        let mut seen = Vec::new();
        let ran = method.run((&self.scenario, &self.start, self.until), &mut |impact| {
            if self.counts(&impact) {
                seen.push(impact);
            }
            match &self.expected {
                Expected::Impacts { impacts, all, .. } => {
                    seen.len() < impacts.len() + usize::from(*all)
                }
                Expected::Speed { impacts, .. } => seen.len() < *impacts,
            }
        });
        ran.map_or(Verdict::GaveUp, |_| self.judged(&seen))
    }

    fn counts(&self, impact: &Impact) -> bool {
        let Expected::Impacts { faster, among, .. } = &self.expected else { return true };
        impact.closing_speed > *faster && (among.is_empty() || among.contains(&impact.gap))
    }

    fn judged(&self, seen: &[Impact]) -> Verdict {
        match &self.expected {
            Expected::Impacts { impacts, within, .. } => in_order(impacts, *within, seen),
            Expected::Speed { impacts, .. } if seen.len() < *impacts => Verdict::Missed,
            Expected::Speed { speed, within, .. } => {
                let off = |impact: &Impact| (impact.closing_speed / speed - 1.0).abs() > *within;
                if seen.iter().any(off) { Verdict::WrongSpeed } else { Verdict::Right }
            }
        }
    }
}

/// Impacts one after the other, and no more.
fn in_order(expected: &[(f64, usize)], within: f64, seen: &[Impact]) -> Verdict {
    for (i, (time, gap)) in expected.iter().enumerate() {
        let Some(seen) = seen.get(i) else { return Verdict::Missed };
        match (seen.gap == *gap, seen.time - time) {
            (false, late) if late < -within => return Verdict::Ghost,
            (false, _) => return Verdict::WrongGap,
            (true, late) if late.abs() > within => return Verdict::Displaced,
            _ => (),
        }
    }
    if seen.len() > expected.len() { Verdict::Ghost } else { Verdict::Right }
}

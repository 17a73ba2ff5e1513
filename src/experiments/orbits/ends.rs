//! Where long runs from rest end.

use super::Found;
use crate::dynamics::orbit::{Solver, Stability, replay};
use crate::dynamics::{self, Engine, Scenario};
use crate::params::OrbitsParams;
use serde::{Deserialize, Serialize};

/// Where one run ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum End {
    /// No impact in the last part.
    Silent,
    /// The same impacts again and again.
    Periodic {
        /// Period, in periods of the forcing.
        periods: usize,
        /// Gaps of the impacts of one period.
        gaps: Vec<usize>,
        /// Newton's method finds this orbit from its times, the engine confirms it, and it is stable.
        solved: bool,
        /// It is of a simple circuit, which was sought with this period.
        sought: bool,
        /// It is among those that were found.
        listed: bool,
    },
    /// Impacts without a recognised period.
    Neither,
    /// The engine gave up.
    Failed,
}

/// All ends at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ends {
    /// Runs without late impacts.
    pub silent: u64,
    /// Runs that became periodic.
    pub periodic: u64,
    /// Runs that did neither.
    pub neither: u64,
    /// Runs that the engine ended.
    pub failed: u64,
    /// Periodic ones that are stable solutions of the equations.
    pub solved: u64,
    /// Periodic ones of simple circuits.
    pub simple: u64,
    /// Periodic ones of simple circuits whose period was searched.
    pub sought: u64,
    /// Those of them that the search had found.
    pub listed: u64,
    /// Impacts in a period, over the periodic ones.
    pub impacts: u64,
    /// Each run.
    pub ends: Vec<End>,
}

impl Ends {
    /// Counts.
    pub fn of(ends: Vec<End>) -> Ends {
        let count = |is: &dyn Fn(&End) -> bool| ends.iter().filter(|end| is(end)).count() as u64;
        let length = |end: &End| match end {
            End::Periodic { gaps, .. } => gaps.len() as u64,
            _ => 0,
        };
        Ends {
            silent: count(&|end| *end == End::Silent),
            periodic: count(&|end| matches!(end, End::Periodic { .. })),
            neither: count(&|end| *end == End::Neither),
            failed: count(&|end| *end == End::Failed),
            solved: count(&|end| matches!(end, End::Periodic { solved: true, .. })),
            simple: count(&|end| matches!(end, End::Periodic { gaps, .. } if simple(gaps))),
            sought: count(&|end| matches!(end, End::Periodic { sought: true, .. })),
            listed: count(&|end| matches!(end, End::Periodic { listed: true, .. })),
            impacts: ends.iter().map(length).sum(),
            ends,
        }
    }
}

/// No gap twice.
pub fn simple(gaps: &[usize]) -> bool {
    (1..gaps.len()).all(|i| !gaps[..i].contains(&gaps[i]))
}

/// How many times a period must be seen.
const SEEN: usize = 4;

/// Times that agree to this repeat, in units of time.
const REPEATS: f64 = 1e-6;

/// Runs start to be looked at off the beat of the forcing, so that no impact of a symmetric orbit lies on an edge.
const OFF_BEAT: f64 = 0.123;

pub fn end(
    parameters: &OrbitsParams,
    scenario: &Scenario,
    circuits: &[Vec<usize>],
    found: &[Found],
) -> Result<End, dynamics::Error> {
    let forcing = std::f64::consts::TAU / scenario.forcing_frequency;
    let mut engine = Engine::new(scenario)?;
    let last = SEEN * parameters.recognised;
    let from = (parameters.until.saturating_sub(last) as f64 + OFF_BEAT) * forcing;
    let mut late = Vec::new();
    let ended = engine.run(from, |_| true).and_then(|()| {
        engine.run(from + last as f64 * forcing, |impact| {
            late.push((impact.time - from, impact.gap));
            true
        })
    });
    match ended {
        Err(dynamics::Error::Work { .. }) => return Ok(End::Failed),
        other => other?,
    }
    if late.is_empty() {
        return Ok(End::Silent);
    }
    let repeats = |periods: &usize| {
        let period = *periods as f64 * forcing;
        let k = late.iter().filter(|(time, _)| *time < period).count();
        let again = |i: usize| {
            let ((time, gap), (before, other)) = (late[i], late[i - k]);
            gap == other && (time - before - period).abs() < REPEATS
        };
        k > 0 && (k..late.len()).all(again)
    };
    let Some(periods) = (1..=parameters.recognised).find(repeats) else { return Ok(End::Neither) };
    let period = periods as f64 * forcing;
    let own: Vec<_> = late.iter().filter(|(time, _)| *time < period).collect();
    let gaps: Vec<usize> = own.iter().map(|(_, gap)| *gap).collect();
    // The phase of the forcing at the beginning is that of OFF_BEAT.
    let times: Vec<f64> = own.iter().map(|(time, _)| time + OFF_BEAT * forcing).collect();
    let orbit = match Solver::new(scenario, &gaps, periods) {
        // More impacts than the solver takes: then it is not solved.
        Err(dynamics::Error::Input { .. }) => None,
        solver => solver?.from(&times),
    };
    let stability = match &orbit {
        Some(orbit) if replay(scenario, orbit)?.is_some() => Stability::new(scenario, orbit),
        _ => None,
    };
    let sought = simple(&gaps) && periods <= parameters.periods;
    let listed = sought
        && stability.as_ref().is_some_and(|own| {
            let mut turned = gaps.clone();
            let least = (0..turned.len()).min_by_key(|&i| turned[i]).unwrap_or(0);
            turned.rotate_left(least);
            found.iter().any(|f| {
                let near = (f.radius - own.radius()).abs() < REPEATS;
                circuits[f.circuit] == turned && f.periods == periods && near
            })
        });
    let solved = stability.as_ref().is_some_and(Stability::stable);
    Ok(End::Periodic { periods, gaps, solved, sought, listed })
}

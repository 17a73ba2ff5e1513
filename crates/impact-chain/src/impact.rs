//! Defines the events of a run, the receivers of impacts, and the impact law.

use crate::search::outcome::Graze;

/// The impact of two neighbours, or of a mass and a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
pub struct Impact {
    /// Time t, in the units of the scenario.
    pub time: f64,
    /// The gap that closed: 0 lies between the left wall and mass 1, j between masses j and j + 1.
    pub gap: usize,
    /// Closing speed −Δ' just before the impact, ≥ 0.
    pub closing_speed: f64,
}

/// What happens to the gaps of a chain, in the order of time; gaps are numbered as in [`Impact`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "lowercase"))]
#[non_exhaustive]
pub enum Event {
    /// A gap closed, and its neighbours parted at once.
    Impact(Impact),
    /// Gaps are shut and pressed from now on, as a chattering or a slow impact ended, or at the
    /// start.
    Stick {
        /// Time t, in the units of the scenario.
        time: f64,
        /// The gaps that were not pressed before, rising.
        gaps: Vec<usize>,
    },
    /// Gaps in contact are pressed no longer, as their contact force vanished or a mass was hit.
    Release {
        /// Time t, in the units of the scenario.
        time: f64,
        /// The gaps that were pressed before, rising.
        gaps: Vec<usize>,
    },
    /// A dip of which rounding cannot tell whether it reaches zero was taken for a miss.
    Graze(Graze),
}

impl Event {
    /// Returns the time of the event, in the units of the scenario.
    #[must_use]
    pub fn time(&self) -> f64 {
        match self {
            Event::Impact(Impact { time, .. }) | Event::Graze(Graze { time, .. }) => *time,
            Event::Stick { time, .. } | Event::Release { time, .. } => *time,
        }
    }
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At its time: there is no further event up to then.
    Reached,
    /// Right after an event, as the observer asked for.
    Stopped,
}

/// Receives the impacts of a run in order; returns false to stop it.
#[cfg(feature = "methods")]
pub type Sink<'a> = &'a mut dyn FnMut(Impact) -> bool;

// listing: jumps
/// Returns the jumps of velocity (left, right) of two neighbours whose gap closes at `speed` ≥ 0.
///
/// Newton's restitution: the gap opens at r `speed` afterwards, and momentum is shared by the
/// inverse masses: 1 for a mass, 0 for a wall. Equal masses exchange; at a wall v → −r v.
#[inline(always)]
pub fn jumps(speed: f64, restitution: f64, inverse_masses: [f64; 2]) -> [f64; 2] {
    let [left, right] = inverse_masses;
    let share = (1.0 + restitution) * speed / (left + right);
    [-(share * left), share * right]
}
// end

/// Returns the jumps of velocity (left, right) that make the rate of a gap grow by `change`.
#[cfg(feature = "methods")]
#[inline(always)]
pub fn share_change(change: f64, inverse_masses: [f64; 2]) -> [f64; 2] {
    let [left, right] = inverse_masses;
    let share = change / (left + right);
    [-(share * left), share * right]
}

/// How many gaps have to be hit until a question is answered.
#[cfg(any(feature = "ensembles", feature = "methods"))]
#[derive(Clone, Copy, Debug)]
pub enum HitGaps {
    /// One gap.
    One,
    /// All gaps.
    All,
}

//! Defines the events of a run, and how a run ends.

use crate::{Graze, Impact};

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

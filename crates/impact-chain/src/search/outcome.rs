//! Defines what a search returns, and the counters of its work.

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// The first root, at `s`, where f falls with `speed` = −f'(s) ≥ 0.
    Root { s: f64, speed: f64 },
    /// No root in (0, s].
    Clear { s: f64 },
}

/// Counted work of a run, the same on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
#[must_use]
pub struct Counters {
    /// Impacts.
    pub impacts: u64,
    /// Contact phases begun, one per gap.
    pub contact_phases: u64,
    /// Searches of a gap for its first root.
    pub searches: u64,
    /// Pieces screened: one polynomial certificate each, without a sine.
    pub pieces: u64,
    /// Evaluations of a gap: by the polynomial of a node, or with sines (the start costs none).
    pub evaluations: u64,
    /// Dips of a gap of which rounding cannot tell whether they reach zero, taken for misses. One
    /// that an impact next to the gap prevents is counted too.
    pub undecided: u64,
    /// The time of the last of these dips, in the frame of its gap.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) dip: f64,
    /// Impacts at exactly the same instant as one of a neighbouring gap.
    pub simultaneous: u64,
}

/// A dip of a gap of which rounding cannot tell whether it reaches zero.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[non_exhaustive]
pub struct Graze {
    /// Time t of the dip, in the units of the scenario.
    pub time: f64,
    /// The gap, as in [`Impact`](crate::Impact).
    pub gap: usize,
}

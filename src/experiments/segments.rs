//! The motions of Figs. 5(b) and 6(b): saved scenarios, replayed by the engine.

use serde::{Deserialize, Serialize};

/// The two segments.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Segments {
    /// Fig. 5(b): L-1, 1-2, 3-R.
    pub fig05: Segment,
    /// Fig. 6(b): L-1, L-1, 1-2, L-1, 2-3, 1-2, 3-R, 3-R.
    pub fig06: Segment,
}

/// A stretch of a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Segment {
    /// Distance d between equilibria.
    pub spacing: f64,
    /// Number of masses n.
    pub masses: usize,
    /// Its beginning, after the start of the run.
    pub from: f64,
    /// Its end.
    pub until: f64,
    /// A grid of times from `from` to `until` that includes every impact.
    pub times: Vec<f64>,
    /// Positions on that grid, `positions[mass][time]`.
    pub positions: Vec<Vec<f64>>,
    /// The impacts of the segment, in order.
    pub impacts: Vec<SegmentImpact>,
}

/// One impact of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SegmentImpact {
    /// Time.
    pub time: f64,
    /// Gap: 0 is left wall–mass 1.
    pub gap: usize,
    /// Where the two bodies touch.
    pub position: f64,
    /// Closing speed.
    pub closing_speed: f64,
}

//! Defines what a search returns, and the counters of its work.

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// The first root, at `s`, where f falls with `speed` = −f'(s) ≥ 0.
    Root {
        /// Time since the frame's instant.
        s: f64,
        speed: f64,
    },
    /// No root in (0, s].
    Clear { s: f64 },
}

/// Counted work of a run, the same on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    pub impacts: u64,
    /// Contact phases begun, one per gap.
    pub contact_phases: u64,
    /// Searches started.
    pub searches: u64,
    /// Pieces screened: one polynomial certificate each, without a sine.
    pub pieces: u64,
    /// Evaluations of a gap: by the polynomial of a node, or with sines (the start costs none).
    pub evaluations: u64,
    /// Decisions taken inside the undecidable band of the search.
    pub undecided: u64,
    /// Instants at which two or more neighbouring gaps closed together.
    pub simultaneous: u64,
}

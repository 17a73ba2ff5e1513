//! Names the circuits that are possible.

/// The circuits that are possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleSpace {
    /// Simple circuits only (Sec. 6).
    Simple,
    /// Simple circuits and the four classes of Sec. 9, counted as primitive circuits.
    FiveClasses,
    /// The same with the printed formulas of Sec. 9 taken at every length, although they fail for
    /// one and for two different vertices.
    FiveClassesPrinted,
}

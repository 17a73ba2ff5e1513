//! Names the quantities on the axes that several figures share.

/// The label of an axis of σ.
pub const FORCING: &str = "*σ* (*d ω*^{2})";

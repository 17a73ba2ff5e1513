//! The influence of the counting protocol: half height against transient T and window W.

use crate::numerics::statistics::Estimate;
use crate::params::ProtocolParams;
use serde::{Deserialize, Serialize};

/// Half height for every pair of a transient and a window.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProtocolMap {
    /// What was run.
    pub parameters: ProtocolParams,
    /// One cell for each pair, transients outer, windows inner.
    pub cells: Vec<ProtocolCell>,
    /// Realisations that the engine ended early; they are counted in no window that they missed.
    pub failed: usize,
}

/// The rise under one protocol.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProtocolCell {
    /// Transient T.
    pub transient: f64,
    /// Window W.
    pub window: f64,
    /// Half height of the mean of the kept.
    pub half_height: Option<Estimate>,
    /// Half height of the mean of all.
    pub half_height_all: Option<Estimate>,
    /// Whether `half_height` rounds to the printed threshold, σ ≈ 0.12.
    pub prints_as_published: bool,
}

impl ProtocolMap {
    /// The cell of a transient and a window.
    pub fn cell(&self, transient: f64, window: f64) -> Option<&ProtocolCell> {
        self.cells.iter().find(|cell| cell.transient == transient && cell.window == window)
    }
}

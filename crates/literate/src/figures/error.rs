//! Says why a figure cannot be drawn.

use crate::experiments;
use thiserror::Error;

/// Why a figure cannot be drawn.
#[derive(Debug, Error)]
pub enum Error {
    #[error("a figure lacks its data: {0}")]
    Data(#[from] experiments::Error),
    #[error("{series}: the point ({x}, {y}) lies outside its frame")]
    Outside { series: String, x: f64, y: f64 },
    #[error("the shipped fonts have no glyph for {character:?} in the label {label:?}")]
    Glyph { character: char, label: String },
    #[error("drawing failed: {0}")]
    Drawing(String),
}

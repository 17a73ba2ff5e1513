//! Says why a figure cannot be drawn.

use crate::experiments;
use plotters::drawing::DrawingAreaErrorKind;
use plotters_backend::DrawingErrorKind;
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

/// Whether something could be drawn.
pub type Drawn = Result<(), Error>;

impl From<Error> for DrawingErrorKind<Error> {
    fn from(error: Error) -> Self {
        DrawingErrorKind::DrawingError(error)
    }
}

impl From<DrawingAreaErrorKind<Error>> for Error {
    fn from(error: DrawingAreaErrorKind<Error>) -> Self {
        match error {
            DrawingAreaErrorKind::BackendError(DrawingErrorKind::DrawingError(error)) => error,
            other => Error::Drawing(other.to_string()),
        }
    }
}

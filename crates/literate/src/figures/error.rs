//! Says why a figure cannot be drawn.

use crate::experiments;
use crate::table::Missing;
use plotters::drawing::DrawingAreaErrorKind;
use plotters_backend::DrawingErrorKind;

/// Why a figure cannot be drawn; its message says what to change.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct Error(pub(crate) Fault);

#[derive(Debug, thiserror::Error)]
pub(crate) enum Fault {
    #[error("a figure lacks its data: {0}")]
    Data(experiments::Error),
    #[error("row {row} of the series {series:?}, ({x}, {y}), {}", outside(*x, *y))]
    Outside { series: String, row: usize, x: f64, y: f64 },
    #[error(
        "the axis {label:?} from {low:e} to {high:e} has no numbers that are exact and differ; \
         give it another range"
    )]
    Axis { label: String, low: f64, high: f64 },
    #[error(
        "the series {0:?} has no point to draw; ask for columns of numbers, within the ranges of the axes, \
         and for a logarithmic axis of positive ones"
    )]
    Empty(String),
    #[error("row {row} of the series {series:?} has the error {error}; give one of 0 or more")]
    NegativeError { series: String, row: usize, error: f64 },
    #[error("two lines or sets of points have the name {0:?}; give each its own")]
    SameName(String),
    #[error("the words {0:?} leave the sheet; shorten them, or make room")]
    OffSheet(String),
    #[error(
        "{0} names find no room at the ends of their curves; name fewer, or place them by hand"
    )]
    NoRoom(usize),
    #[error("the plot has no series; add one")]
    NoSeries,
    #[error("the picture {0}")]
    Picture(&'static str),
    #[error("the shipped fonts have no glyph for {character:?} in the label {label:?}")]
    Glyph { character: char, label: String },
    #[error("drawing failed: {0}")]
    Drawing(String),
}

fn outside(x: f64, y: f64) -> &'static str {
    if x.is_finite() && y.is_finite() {
        "lies outside its frame; give the axes a wider range, or cut the series"
    } else {
        "is not finite; leave it out, or correct the table that it comes from"
    }
}

/// The outcome of drawing something on a sheet or a panel.
pub type Drawn = Result<(), Error>;

impl From<experiments::Error> for Error {
    fn from(error: experiments::Error) -> Self {
        Error(Fault::Data(error))
    }
}

impl From<Missing> for Error {
    fn from(missing: Missing) -> Self {
        experiments::Error::from(missing).into()
    }
}

impl From<Error> for DrawingErrorKind<Error> {
    fn from(error: Error) -> Self {
        DrawingErrorKind::DrawingError(error)
    }
}

impl From<DrawingAreaErrorKind<Error>> for Error {
    fn from(error: DrawingAreaErrorKind<Error>) -> Self {
        match error {
            DrawingAreaErrorKind::BackendError(DrawingErrorKind::DrawingError(error)) => error,
            other => Error(Fault::Drawing(other.to_string())),
        }
    }
}

//! The fifteen figures of the paper, one a file; each returns an SVG string and its data.

mod axis;
mod backend;
mod chart;
mod clip;
mod data;
mod element;
mod fig01;
mod fig02;
mod fig03;
mod fig04;
mod fig05;
mod fig06;
mod fig07;
mod fig08;
mod fig09;
mod fig10;
mod fig11;
mod fig12;
mod fig13;
mod fig14;
mod fig15;
mod font;
mod graph;
mod markup;
mod motion;
mod panel;
mod series;
mod sheet;
mod simulated;
mod style;

pub use data::DataFile;

use plotters::drawing::DrawingAreaErrorKind;
use plotters_backend::DrawingErrorKind;
use thiserror::Error;

use crate::experiments::{self, Need, Results};
use crate::params::Profile;

/// The numbers of all figures.
pub const ALL: std::ops::RangeInclusive<u8> = 1..=15;

/// A figure: the picture, what it shows in words, and its data.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// `fig01` … `fig15`; the picture's file name without its ending.
    pub id: String,
    /// A short name.
    pub title: String,
    /// What is seen, with its numbers, for those who do not see it.
    pub description: String,
    /// The picture, a whole SVG document.
    pub svg: String,
    /// Its data.
    pub data: Vec<DataFile>,
}

/// Why a figure cannot be drawn.
#[derive(Debug, Error)]
pub enum Error {
    /// Not one of the fifteen.
    #[error("there is no figure {0}; figures are numbered from 1 to 15")]
    Number(u8),
    /// Its experiment was not run.
    #[error("a figure lacks its data: {0}")]
    Experiment(#[from] experiments::Error),
    /// A result has another shape than the figure was made for.
    #[error("figure {figure} expects {expected}")]
    Shape {
        /// The figure.
        figure: u8,
        /// What it expects.
        expected: &'static str,
    },
    /// Data lies outside its frame.
    #[error("{series}: the point ({x}, {y}) lies outside its frame; widen the axis")]
    Outside {
        /// The series.
        series: String,
        /// Horizontal value.
        x: f64,
        /// Vertical value.
        y: f64,
    },
    /// A label has a character that the shipped fonts lack.
    #[error("the shipped fonts have no glyph for {character:?} in the label {label:?}")]
    Glyph {
        /// The character.
        character: char,
        /// The label.
        label: String,
    },
    /// Anything else that went wrong while drawing.
    #[error("drawing failed: {0}")]
    Drawing(String),
}

impl From<DrawingAreaErrorKind<Error>> for Error {
    fn from(error: DrawingAreaErrorKind<Error>) -> Self {
        match error {
            DrawingAreaErrorKind::BackendError(DrawingErrorKind::DrawingError(inner)) => inner,
            other => Error::Drawing(other.to_string()),
        }
    }
}

/// The experiments that a figure needs, beside the theory, which costs nothing.
pub fn needs(number: u8) -> &'static [Need] {
    match number {
        2 | 3 | 12 | 15 => &[Need::Sweep],
        5 | 6 => &[Need::Segments],
        _ => &[],
    }
}

/// Draws one figure.
///
/// # Errors
/// [`Error::Number`] beyond 15, [`Error::Experiment`] without the results that it needs.
pub fn draw(number: u8, results: &Results) -> Result<Figure, Error> {
    let note = match results.profile {
        Profile::Full => None,
        Profile::Ci => Some("profile ci: not for citation"),
        Profile::Quick => Some("profile quick: not for citation"),
    };
    match number {
        1 => fig01::draw(),
        2 => fig02::draw(results.sweep()?, note),
        3 => fig03::draw(results.sweep()?, note),
        4 => fig04::draw(),
        5 => fig05::draw(results.segments()?),
        6 => fig06::draw(results.segments()?),
        7 => fig07::draw(&results.theory),
        8 => fig08::draw(&results.theory),
        9 => fig09::draw(&results.theory),
        10 => fig10::draw(&results.theory),
        11 => fig11::draw(&results.theory),
        12 => fig12::draw(results.sweep()?, &results.theory, note),
        13 => fig13::draw(&results.theory),
        14 => fig14::draw(&results.theory),
        15 => fig15::draw(results.sweep()?, &results.theory, note),
        _ => Err(Error::Number(number)),
    }
}

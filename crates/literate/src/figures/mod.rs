//! Figures: frames, axes, curves and labels as one list of shapes, written as SVG, into a page and as PDF.

mod axis;
mod chart;
mod clip;
mod data;
mod drawing;
mod font;
mod markup;
mod panel;
mod pdf;
mod plot;
mod record;
mod series;
mod sheet;
mod style;
mod svg;

pub use data::DataFile;
pub use drawing::{Drawing, Glyphs};
pub use svg::{escape, outlines};

/// What a figure is drawn with, for one line of imports.
pub mod prelude {
    pub use super::axis::{Axis, Scale, Tick, number};
    pub use super::chart::*;
    pub use super::panel::{Frame, Panel};
    pub use super::plot::Plot;
    pub use super::series::{Marker, Outside};
    pub use super::sheet::Sheet;
    pub use super::style::*;
    pub use super::{DataFile, Error, Figure, Seen};
    pub use crate::seen;
    pub use plotters::style::text_anchor::{HPos, VPos};
}

use crate::{experiments, report};
use thiserror::Error;

/// A figure: the picture, what it shows in words, and its data.
#[derive(Clone, Debug, Default, PartialEq)]
#[expect(missing_docs, reason = "the names tell")]
pub struct Figure {
    /// Its name in the list of the paper, with which the names of its files begin.
    pub id: String,
    pub title: String,
    /// What is seen, for those who do not see it.
    pub description: Seen,
    pub drawing: Drawing,
    pub data: Vec<DataFile>,
    /// Path of the item that draws it.
    pub source: String,
    /// Names of the experiments whose results it shows.
    pub experiments: Vec<&'static str>,
}

impl Figure {
    /// The picture as a file.
    pub fn svg(&self) -> String {
        self.drawing.svg(&self.id, &self.title, &self.description.text)
    }

    /// The figure of a name, among these.
    pub fn named<'a>(name: &str, figures: &'a [Figure]) -> Result<&'a Figure, report::Error> {
        let found = figures.iter().find(|figure| figure.id == name);
        found.ok_or_else(|| report::Error::Picture(name.into()))
    }
}

/// What is seen in a figure: with its numbers, and as it was typed, so that a typed numeral is found. [`seen!`](crate::seen)
/// makes both.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names tell")]
pub struct Seen {
    pub text: String,
    pub typed: &'static str,
}

/// What is seen in a figure, written like the arguments of `format!`.
#[macro_export]
macro_rules! seen {
    ($words:literal $(, $value:expr)* $(,)?) => {
        $crate::figures::Seen { text: format!($words $(, $value)*), typed: $words }
    };
}

/// Why a figure cannot be drawn.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages tell")]
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

/// The colours of all figures: the name that style sheets use, and the colour as `#rrggbb`.
pub(crate) fn palette() -> impl Iterator<Item = (&'static str, String)> {
    let shown = |style::Colour(r, g, b)| format!("#{r:02x}{g:02x}{b:02x}");
    style::PALETTE.into_iter().map(move |(name, colour)| (name, shown(colour)))
}

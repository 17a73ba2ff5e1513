//! Figures: frames, axes, curves and labels as one list of shapes, written as SVG, into a page and as PDF.

mod axis;
mod drawing;
mod font;
mod markup;
mod panel;
mod pdf;
mod plot;
mod record;
mod series;
mod style;
mod svg;

pub use drawing::{Drawing, Glyphs};
pub use record::DataFile;
pub use svg::{escape, outlines};

/// What a figure is drawn with, for one line of imports.
pub mod prelude {
    pub use super::axis::{Axis, Scale, Tick, number};
    pub use super::panel::{Frame, Panel, Sheet};
    pub use super::plot::Plot;
    pub use super::series::{Marker, Outside};
    pub use super::style::*;
    pub use super::{
        DataFile, Error, FOUR, Figure, LETTERS, Seen, heading, largest, over_k, short,
        upwards_from_zero,
    };
    pub use crate::seen;
    pub use plotters::style::text_anchor::{HPos, VPos};
}

use crate::{experiments, report};
use axis::{Axis, number};
use panel::{Frame, Panel};
use plotters::style::text_anchor::{HPos, VPos};
use style::SMALL;
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

// What several figures share: columns over integers, round axis ends, corner notes, numbers.

/// Points (k, value) of a series whose first value belongs to k = 1.
pub fn over_k(values: &[f64]) -> Vec<(f64, f64)> {
    values.iter().enumerate().map(|(i, &v)| ((i + 1) as f64, v)).collect()
}

/// An axis from zero to a round number at or above `largest`, with about four labelled steps.
pub fn upwards_from_zero(largest: f64, label: &str) -> Axis {
    let mut unit = 1.0;
    while unit > largest {
        unit /= 10.0;
    }
    while unit * 10.0 <= largest {
        unit *= 10.0;
    }
    for step in [0.2, 0.25, 0.5, 1.0, 2.0, 2.5] {
        let step = step * unit;
        let steps = (largest / step - 1e-9).ceil();
        if steps <= 5.0 {
            return Axis::linear(0.0, steps * step, step, 1, label);
        }
    }
    Axis::linear(0.0, 10.0 * unit, 5.0 * unit, 1, label)
}

/// Largest of a series, zero if it is empty.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// Four panels, two by two, on a sheet 6750 high.
pub const FOUR: [Frame; 4] = [
    Frame::new(1080, 480, 4050, 2580),
    Frame::new(5230, 480, 8200, 2580),
    Frame::new(1080, 3780, 4050, 5880),
    Frame::new(5230, 3780, 8200, 5880),
];

/// The letters of panels.
pub const LETTERS: [&str; 4] = ["(a)", "(b)", "(c)", "(d)"];

/// The letter of a panel and the parameter it is drawn for, above its frame.
pub fn heading(panel: &Panel, letter: &str, parameter: &str) -> Result<(), Error> {
    panel.letter(letter)?;
    let corner = (panel.frame.right, panel.frame.top - 80);
    panel.text(parameter, corner, SMALL, HPos::Right, VPos::Bottom)
}

/// A number with about `digits` significant decimals, for notes and descriptions; a tiny one as a
/// multiple of a power of ten.
pub fn short(value: f64, digits: usize) -> String {
    if value != 0.0 && value.abs() < 1e-3 {
        let shown = format!("{:.*e}", digits.saturating_sub(1), value);
        return shown.replace('-', "−").replace('e', "·10^");
    }
    let mut decimals = digits.saturating_sub(1);
    let mut size = value.abs();
    while size >= 10.0 && decimals > 0 {
        size /= 10.0;
        decimals -= 1;
    }
    while size > 0.0 && size < 1.0 && decimals < 12 {
        size *= 10.0;
        decimals += 1;
    }
    let shown = number(value, decimals);
    if shown.contains('.') {
        shown.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        shown
    }
}

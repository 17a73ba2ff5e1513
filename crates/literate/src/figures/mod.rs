//! Draws figures as lists of shapes, which are written as SVG, into pages and as PDF.

mod axis;
mod drawing;
mod elements;
mod error;
mod figure;
mod font;
mod markup;
mod panel;
mod path;
mod pdf;
mod plot;
mod record;
mod series;
mod style;
mod svg;

pub(crate) use drawing::Glyphs;
pub use error::{Drawn, Error};
pub use figure::{Description, Figure};
pub(crate) use markup::plain;
pub(crate) use svg::{escape, outlines};

/// What a figure is drawn with, for one line of imports.
pub mod prelude {
    pub use super::axis::{Axis, Tick, in_powers, number, power_of_ten, short};
    pub use super::drawing::Frame;
    pub use super::elements::{Marker, arrow, line, markers, ticks};
    pub use super::panel::{LETTERS, Outside, Panel, Sheet, SheetArea};
    pub use super::plot::Plot;
    pub use super::series::{largest, over_k};
    pub use super::style::*;
    pub use super::{Description, Drawn, Error, Figure};
    pub use crate::describe;
    pub use plotters::element::{PathElement, Polygon, Rectangle, Text};
    pub use plotters::style::text_anchor::{HPos, VPos};
    pub use plotters::style::{Color, FontTransform, RGBColor};
}

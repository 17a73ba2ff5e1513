//! Lists the shapes of a figure, which [`super::svg`] and [`super::pdf`] write.
//!
//! The grid is a hundredth of a millimetre at column width, so whole numbers are fine enough for
//! smooth curves. Labels are outlines (see [`super::font`]); nothing depends on the machine.

use super::font::{self, Placed};
use super::path::{Point, Step, inside};
use super::style::Stroke;
use plotters::style::RGBColor;
use std::collections::BTreeMap;

/// A rectangle of the sheet in grid units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    pub left: i32,
    pub top: i32,
    pub right: i32,
    pub bottom: i32,
}

impl Frame {
    pub const fn new(left: i32, top: i32, right: i32, bottom: i32) -> Self {
        Frame { left, top, right, bottom }
    }
}

/// The inside of a shape: its colour, and its opacity in hundredths; none if it is clear.
pub type Fill = Option<(RGBColor, u8)>;

/// Words as glyphs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The words, for screen readers.
    pub words: String,
    /// The anchor.
    pub at: Point,
    /// The em, in grid units.
    pub size: i32,
    pub colour: RGBColor,
    /// Whether they read from bottom to top.
    pub upwards: bool,
    /// Whether a rim of the page's colour keeps them off what they stand on.
    pub rim: bool,
    /// The glyphs, in units of the em around the anchor, y upwards.
    pub glyphs: Vec<Placed>,
}

/// Outlines of glyphs by their names, in units of the em, y upwards.
pub type Glyphs = BTreeMap<String, Vec<Step>>;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Element {
    /// The series of this name begins, in this frame.
    Open(String, Frame),
    Close,
    /// A path, filled and along its edge; an edge without a fill has round corners.
    Shape(Vec<Step>, Fill, Option<Stroke>),
    Label(Label),
}

/// A drawing of column width.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Drawing {
    pub height: u32,
    /// From back to front.
    pub elements: Vec<Element>,
    /// Outlines of the glyphs in its labels.
    pub glyphs: Glyphs,
}

impl Drawing {
    pub(super) fn shape(&mut self, path: Vec<Step>, fill: Fill, stroke: Option<Stroke>) {
        self.elements.push(Element::Shape(path, fill, stroke));
    }

    /// Tells whether a rectangle is free of lines, of symbols and of words that read from left to
    /// right.
    pub fn is_free(&self, frame: Frame) -> bool {
        self.elements.iter().all(|element| match element {
            Element::Shape(path, _, Some(_)) => !crosses(path, frame),
            Element::Label(label) if !label.upwards => !stands_in(label, frame),
            _ => true,
        })
    }
}

/// Tells whether a letter of a label stands in a frame; each is taken to be half an em wide.
fn stands_in(label: &Label, frame: Frame) -> bool {
    let scaled = |units: i32| units * label.size / font::EM;
    label.glyphs.iter().any(|placed| {
        let (x, y) = (label.at.0 + scaled(placed.x), label.at.1 - scaled(placed.y));
        let (right, top) = (x + label.size / 2, y - scaled(font::CAP_HEIGHT));
        x < frame.right && right > frame.left && top < frame.bottom && y > frame.top
    })
}

/// Tells whether a path enters a frame; curves count as their chords.
fn crosses(path: &[Step], frame: Frame) -> bool {
    let float = |(x, y): Point| (f64::from(x), f64::from(y));
    let across = float((frame.left, frame.right));
    let down = float((frame.top, frame.bottom));
    let mut at = (0.0, 0.0);
    path.iter().any(|step| {
        let (from, to) = match *step {
            Step::Move(to) => (float(to), float(to)),
            Step::Line(to) | Step::Curve([.., to]) => (at, float(to)),
            Step::Close => return false,
        };
        at = to;
        inside(from, to, across, down).is_some()
    })
}

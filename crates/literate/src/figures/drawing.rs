//! Lists the shapes of a figure, which [`super::svg`] and [`super::pdf`] write.
//!
//! The grid is a hundredth of a millimetre at column width, so whole numbers are fine enough for
//! smooth curves. Labels are outlines (see [`super::font`]); nothing depends on the machine.

use super::font::{self, Placed};
use super::path::{Point, Step};
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

    /// Tells whether a point lies in it, edges included.
    pub fn contains(&self, (x, y): Point) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
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
    /// Makes an empty drawing.
    pub fn new(height: u32) -> Self {
        Drawing { height, ..Drawing::default() }
    }

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
    let mut from = None;
    for step in path {
        let (to, drawn) = match step {
            Step::Move(to) => (*to, false),
            Step::Line(to) | Step::Curve([_, _, to]) => (*to, true),
            Step::Close => continue,
        };
        let enters = match from {
            Some(from) if drawn => chord_enters(from, to, frame),
            _ => frame.contains(to),
        };
        if enters {
            return true;
        }
        from = Some(to);
    }
    false
}

/// Tells whether a straight line enters a frame, judged at 200 places on it.
fn chord_enters(from: Point, to: Point, frame: Frame) -> bool {
    // Most lines of a drawing lie on one side of the frame.
    let left_or_right = from.0.max(to.0) < frame.left || from.0.min(to.0) > frame.right;
    let above_or_below = from.1.max(to.1) < frame.top || from.1.min(to.1) > frame.bottom;
    if left_or_right || above_or_below {
        return false;
    }
    let between = |a: i32, b: i32, i: i32| a + (b - a) * i / 200;
    (0..=200).any(|i| frame.contains((between(from.0, to.0, i), between(from.1, to.1, i))))
}

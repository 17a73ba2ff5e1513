//! What a figure draws, as one list of shapes; [`super::svg`] and [`super::pdf`] write it.
//!
//! The grid is a hundredth of a millimetre at column width, so whole numbers are fine enough for smooth curves.
//! Labels become outlines (see [`super::font`]); nothing in the list depends on the machine.

use super::error::Error;
use super::font::{self, Placed};
use super::markup;
use super::path::{Point, Step, circle, polygon, polyline};
use super::style::{Colour, Stroke, Symbol, WHITE};
use plotters::style::text_anchor::{HPos, VPos};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// A rectangle of the sheet in grid units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    pub left: i32,
    pub top: i32,
    pub right: i32,
    pub bottom: i32,
}

impl Frame {
    /// A frame from its edges.
    pub const fn new(left: i32, top: i32, right: i32, bottom: i32) -> Self {
        Frame { left, top, right, bottom }
    }

    /// Whether a place lies in it, edges included.
    pub fn contains(&self, (x, y): Point) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }
}

/// What is inside a shape: a colour, and its opacity in hundredths.
pub type Fill = Option<(Colour, u8)>;

/// Size of an em and colour of words, and where their place is.
pub type Look = (i32, Colour, HPos, VPos);

/// Words as glyphs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The words, for readers of screens.
    pub words: String,
    /// Where they are anchored.
    pub at: Point,
    pub size: i32,
    pub colour: Colour,
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
    /// A path, filled and along its edge; corners of one that encloses nothing are round.
    Shape(Vec<Step>, Fill, Option<Stroke>),
    Label(Label),
}

/// A drawing of column width.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Drawing {
    /// Its height.
    pub height: u32,
    /// Its elements, from back to front.
    pub elements: Vec<Element>,
    /// Outlines of the glyphs that its labels use.
    pub glyphs: Glyphs,
}

/// Whether a path enters a frame. Curves count as their chords; a chord is looked at in 200 places.
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

/// Whether a straight line enters a frame, as far as 200 places on it tell.
fn chord_enters(from: Point, to: Point, frame: Frame) -> bool {
    // Most lines of a drawing lie on one side of the frame.
    let beside = from.0.max(to.0) < frame.left || from.0.min(to.0) > frame.right;
    let above_or_below = from.1.max(to.1) < frame.top || from.1.min(to.1) > frame.bottom;
    if beside || above_or_below {
        return false;
    }
    let between = |a: i32, b: i32, i: i32| a + (b - a) * i / 200;
    (0..=200).any(|i| frame.contains((between(from.0, to.0, i), between(from.1, to.1, i))))
}

impl Drawing {
    /// An empty drawing.
    pub fn new(height: u32) -> Self {
        Drawing { height, ..Drawing::default() }
    }

    fn shape(&mut self, path: Vec<Step>, fill: Fill, stroke: Option<Stroke>) {
        self.elements.push(Element::Shape(path, fill, stroke));
    }

    /// A line through points; repetitions are left out.
    pub fn line(&mut self, mut points: Vec<Point>, stroke: Stroke) {
        points.dedup();
        self.shape(polyline(points), None, Some(stroke));
    }

    /// A straight stroke from each first point to the second.
    pub fn strokes(&mut self, ends: &[Point], stroke: Stroke) {
        let pairs = ends.chunks_exact(2);
        let path = pairs.flat_map(|pair| polyline([pair[0], pair[1]])).collect();
        self.shape(path, None, Some(stroke));
    }

    /// A polygon without an edge.
    pub fn area(&mut self, points: impl IntoIterator<Item = Point>, fill: Colour, opacity: u8) {
        self.shape(polygon(points), Some((fill, opacity)), None);
    }

    /// A filled rectangle.
    pub fn rectangle(&mut self, frame: Frame, fill: Colour) {
        let Frame { left, top, right, bottom } = frame;
        self.area([(left, top), (right, top), (right, bottom), (left, bottom)], fill, 100);
    }

    /// A filled circle with an edge.
    pub fn disc(&mut self, centre: Point, radius: i32, fill: Colour, edge: Stroke) {
        self.shape(circle(centre, radius), Some((fill, 100)), Some(edge));
    }

    /// A line that ends in an arrow head. The line ends inside the head; a short last stretch must not turn the head,
    /// so its direction is taken over at least its own length.
    pub fn arrow(&mut self, mut path: Vec<Point>, stroke: Stroke) {
        let Some(&tip) = path.last() else { return };
        let width = f64::from(stroke.width);
        let (length, half) = (90.0 + 2.6 * width, 34.0 + 1.1 * width);
        let distance = |p: &Point| {
            let (dx, dy) = (f64::from(tip.0 - p.0), f64::from(tip.1 - p.1));
            (dx, dy, (dx * dx + dy * dy).sqrt())
        };
        while path.len() > 1 && path.last().is_some_and(|p| distance(p).2 < length) {
            path.pop();
        }
        let Some((dx, dy, d)) = path.last().map(distance).filter(|&(.., d)| d > 0.0) else {
            return;
        };
        let (ux, uy) = (dx / d, dy / d);
        let at = |along: f64, aside: f64| {
            let x = f64::from(tip.0) - along * ux - aside * uy;
            let y = f64::from(tip.1) - along * uy + aside * ux;
            (x.round() as i32, y.round() as i32)
        };
        path.push(at(0.75 * length, 0.0));
        self.line(path, stroke);
        let head = [tip, at(length, half), at(0.75 * length, 0.0), at(length, -half)];
        self.area(head, stroke.colour, 100);
    }

    /// Upright ticks of a width, as high as the stroke is thick; those in one row that touch are one stroke.
    pub fn ticks(&mut self, points: impl IntoIterator<Item = Point>, width: i32, stroke: Stroke) {
        let mut places: Vec<Point> = points.into_iter().map(|(x, y)| (y, x)).collect();
        places.sort_unstable();
        let mut ends = Vec::new();
        for run in places.chunk_by(|a, b| a.0 == b.0 && b.1 - a.1 <= width) {
            let (first, last) = (run[0].1 - width / 2, run[run.len() - 1].1 - width / 2 + width);
            ends.extend([(first, run[0].0), (last, run[0].0)]);
        }
        self.strokes(&ends, stroke);
    }

    /// Equal markers: shape, half their width, line of open shapes and colour of filled ones.
    pub fn markers(
        &mut self,
        points: impl IntoIterator<Item = Point>,
        (mark, r, stroke): (Symbol, i32, Stroke),
    ) {
        let one = |(x, y): Point| match mark {
            Symbol::Cross => [
                polyline([(x - r, y - r), (x + r, y + r)]),
                polyline([(x + r, y - r), (x - r, y + r)]),
            ]
            .concat(),
            Symbol::Plus => {
                [polyline([(x - r, y), (x + r, y)]), polyline([(x, y - r), (x, y + r)])].concat()
            }
            Symbol::Disc | Symbol::Ring => circle((x, y), r),
            Symbol::OpenSquare => {
                polygon([(x - r, y - r), (x + r, y - r), (x + r, y + r), (x - r, y + r)])
            }
            Symbol::OpenTriangle => polygon([(x - r, y + r), (x, y - r), (x + r, y + r)]),
            Symbol::OpenDiamond => polygon([(x, y - r), (x + r, y), (x, y + r), (x - r, y)]),
        };
        let inside = match mark {
            Symbol::Disc => Some(stroke.colour),
            Symbol::Cross | Symbol::Plus => None,
            _ => Some(WHITE),
        };
        let path = points.into_iter().flat_map(one).collect();
        let fill = inside.map(|colour| (colour, 100));
        self.shape(path, fill, Some(stroke));
    }

    /// Whether no line, no mark and no words that are read from left to right stand in a rectangle.
    pub fn is_free(&self, frame: Frame) -> bool {
        self.elements.iter().all(|element| match element {
            Element::Shape(path, _, Some(_)) => !crosses(path, frame),
            Element::Label(label) if !label.upwards => {
                let of = |own: i32| own * label.size / font::EM;
                let place = |own: &Placed| (label.at.0 + of(own.x), label.at.1 - of(own.y));
                let letter = |(x, y): (i32, i32)| {
                    let (right, top) = (x + label.size / 2, y - of(font::CAP_HEIGHT));
                    x < frame.right && right > frame.left && top < frame.bottom && y > frame.top
                };
                !label.glyphs.iter().map(place).any(letter)
            }
            _ => true,
        })
    }

    /// Words.
    ///
    /// # Errors
    /// If they have a character that the shipped fonts lack.
    pub fn label(
        &mut self,
        text: &str,
        at: Point,
        (size, colour, h, v): Look,
        upwards: bool,
    ) -> Result<(), Error> {
        let font::Line { mut glyphs, width } = font::set(text)?;
        let dx = match h {
            HPos::Left => 0,
            HPos::Center => -width / 2,
            HPos::Right => -width,
        };
        let dy = match v {
            VPos::Top => -font::CAP_HEIGHT,
            VPos::Center => -font::CAP_HEIGHT / 2,
            VPos::Bottom => 0,
        };
        for placed in &mut glyphs {
            (placed.x, placed.y) = (placed.x + dx, placed.y + dy);
            if let Entry::Vacant(place) = self.glyphs.entry(font::id(placed)) {
                place.insert(font::outline(placed)?);
            }
        }
        let words = markup::plain(text);
        let rim = false;
        self.elements.push(Element::Label(Label { words, at, size, colour, upwards, rim, glyphs }));
        Ok(())
    }

    /// Words with a rim of the page's colour, for places where something may stand behind them.
    ///
    /// # Errors
    /// As [`Drawing::label`].
    pub fn rimmed(&mut self, text: &str, at: Point, look: Look) -> Result<(), Error> {
        self.label(text, at, look, false)?;
        if let Some(Element::Label(label)) = self.elements.last_mut() {
            label.rim = true;
        }
        Ok(())
    }
}

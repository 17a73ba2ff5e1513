//! Collects what plotters draws as a list of shapes, which [`super::svg`] and [`super::pdf`] write:
//! the backend of all figures.
//!
//! plotters has coordinates, drawing areas, elements and series. Axes ([`super::axis`]), a few
//! elements ([`super::elements`]), fonts and the writers are ours, because of these limits of
//! plotters, none of which a figure of ours meets:
//!
//! - An area moves points outside it onto its edge, so that a curve is silently wrong. Ours are as
//!   large as the sheet, and [`super::panel::Panel::cut`] cuts curves at the frame.
//! - `DashedPathElement` has dashes of one length, takes the platform's `hypot`, and makes hundreds
//!   of paths of a curve. A dashed curve of ours is one path.
//! - `LogCoord` and `TriangleMarker` take the platform's mathematics, so that bytes differ between
//!   machines. Ours take portable functions or none.
//! - `ErrorBar` draws a disc over the symbol. Ours has caps only.
//! - A style has no fill with an edge, no dash, and no rim of words ([`super::style::rimmed`]).

use super::error::{Error, Fault};
use super::font::{self, Placed};
use super::markup;
use super::path::{Point, Step, circle, inside, polygon, polyline};
use super::style::{PALETTE, Stroke, WIDTH};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{FontTransform, RGBColor};
use plotters_backend::{
    BackendColor, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// A rectangle of the sheet in grid units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Distance of the left side from the left edge of the sheet.
    pub left: i32,
    /// Distance of the upper side from the upper edge.
    pub top: i32,
    /// Distance of the right side from the left edge.
    pub right: i32,
    /// Distance of the lower side from the upper edge.
    pub bottom: i32,
}

impl Frame {
    /// Makes the rectangle with these sides.
    pub const fn new(left: i32, top: i32, right: i32, bottom: i32) -> Self {
        Frame { left, top, right, bottom }
    }
}

/// The inside of a shape: its colour, and its opacity in hundredths, or `None` if it is clear.
pub type Fill = Option<(RGBColor, u8)>;

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
    /// The series of this name begins, in this frame, with these axes: `0 1 false 0 101 false`.
    Open(String, Frame, String),
    Close,
    /// A path, filled and along its edge; an edge without a fill has round corners.
    Shape(Vec<Step>, Fill, Option<Stroke>),
    Label(Label),
}

/// A drawing of column width.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Drawing {
    pub(crate) height: u32,
    /// From back to front.
    pub(crate) elements: Vec<Element>,
    /// Outlines of the glyphs in its labels.
    pub(crate) glyphs: Glyphs,
}

pub(super) type Outcome = Result<(), DrawingErrorKind<Error>>;

/// Returns a colour, which must be one of ours: others have no form for light and for dark pages.
fn in_palette(colour: BackendColor) -> Result<RGBColor, Error> {
    let (r, g, b) = colour.rgb;
    if PALETTE.iter().any(|(_, known)| *known == RGBColor(r, g, b)) {
        return Ok(RGBColor(r, g, b));
    }
    let problem = format!("#{r:02x}{g:02x}{b:02x} is no colour of the prelude");
    Err(Error(Fault::Drawing(problem)))
}

impl Drawing {
    pub(super) fn shape(&mut self, path: Vec<Step>, fill: Fill, stroke: Option<Stroke>) {
        self.elements.push(Element::Shape(path, fill, stroke));
    }

    /// Adds a path, filled or as a line; one of an invisible colour is left out.
    fn path(&mut self, path: Vec<Step>, style: &impl BackendStyle, filled: bool) -> Outcome {
        let alpha = style.color().alpha;
        if alpha == 0.0 {
            return Ok(());
        }
        let colour = in_palette(style.color())?;
        if filled {
            self.shape(path, Some((colour, (100.0 * alpha).round() as u8)), None);
        } else {
            self.shape(path, None, Some(Stroke::solid(colour, style.stroke_width())));
        }
        Ok(())
    }

    /// Returns whether a rectangle is free of lines, symbols and words from left to right.
    pub(crate) fn is_free(&self, frame: Frame) -> bool {
        self.elements.iter().all(|element| match element {
            Element::Shape(path, _, Some(_)) => !crosses(path, frame),
            Element::Label(label) if !label.upwards => !stands_in(label, frame),
            _ => true,
        })
    }
}

impl DrawingBackend for Drawing {
    type ErrorType = Error;

    fn get_size(&self) -> (u32, u32) {
        (WIDTH, self.height)
    }

    fn ensure_prepared(&mut self) -> Outcome {
        Ok(())
    }

    fn present(&mut self) -> Outcome {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): Point, colour: BackendColor) -> Outcome {
        self.draw_rect((x, y), (x + 1, y + 1), &colour, true)
    }

    /// Draws a line from its upper end, as part of the stroke before it if both look alike.
    fn draw_line<S: BackendStyle>(&mut self, a: Point, b: Point, style: &S) -> Outcome {
        let (from, to) = if a.1 <= b.1 { (a, b) } else { (b, a) };
        self.path(polyline([from, to]), style, false)?;
        if let [.., Element::Shape(path, None, before), Element::Shape(more, None, stroke)] =
            &mut self.elements[..]
            && before == stroke
        {
            path.append(more);
            self.elements.pop();
        }
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (left, top): Point,
        (right, bottom): Point,
        style: &S,
        fill: bool,
    ) -> Outcome {
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
        self.path(polygon(corners), style, fill)
    }

    /// Draws a line through points; repeated points are left out.
    fn draw_path<S: BackendStyle, I: IntoIterator<Item = Point>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Outcome {
        let mut points: Vec<Point> = points.into_iter().collect();
        points.dedup();
        self.path(polyline(points), style, false)
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        centre: Point,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Outcome {
        self.path(circle(centre, radius as i32), style, fill)
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = Point>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Outcome {
        self.path(polygon(points), style, true)
    }

    /// Sets words in the shipped fonts, whatever the font of the style; see `markup`. Nothing is
    /// drawn for no words, and words that leave the sheet are an error.
    fn draw_text<S: BackendTextStyle>(&mut self, words: &str, style: &S, at: Point) -> Outcome {
        let (mut glyphs, width) = font::set(words, style.size() as i32)?;
        if glyphs.is_empty() {
            return Ok(());
        }
        let dx = match style.anchor().h_pos {
            HPos::Left => 0,
            HPos::Center => -width / 2,
            HPos::Right => -width,
        };
        let dy = match style.anchor().v_pos {
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
        let colour = in_palette(style.color())?;
        let upwards = match style.transform() {
            FontTransform::None => false,
            FontTransform::Rotate270 => true,
            _ => return Err(Error(Fault::Drawing(format!("upside down: {words:?}"))).into()),
        };
        let scaled = |units: i32| units * style.size() as i32 / font::EM;
        let ((along, size), up) = if upwards {
            ((-at.1, (-(self.height as i32), 0)), (-at.0, (-(WIDTH as i32), 0)))
        } else {
            ((at.0, (0, WIDTH as i32)), (at.1, (0, self.height as i32)))
        };
        let (start, base) = (along + scaled(dx), up.0 - scaled(dy));
        let ends = [start, start + scaled(width)];
        let heights = [base - scaled(font::CAP_HEIGHT), base];
        let is_in = |place: i32, (low, high): (i32, i32)| (low..=high).contains(&place);
        if !ends.iter().all(|end| is_in(*end, size)) || !heights.iter().all(|y| is_in(*y, up.1)) {
            return Err(Error(Fault::OffSheet(markup::plain(words))).into());
        }
        self.elements.push(Element::Label(Label {
            words: markup::plain(words),
            at,
            size: style.size() as i32,
            colour,
            upwards,
            rim: style.family().as_str() == "rimmed",
            glyphs,
        }));
        Ok(())
    }
}

/// Returns whether a letter of a label stands in a frame; each is taken to be half an em wide.
fn stands_in(label: &Label, frame: Frame) -> bool {
    let scaled = |units: i32| units * label.size / font::EM;
    label.glyphs.iter().any(|placed| {
        let (x, y) = (label.at.0 + scaled(placed.x), label.at.1 - scaled(placed.y));
        let (right, top) = (x + label.size / 2, y - scaled(font::CAP_HEIGHT));
        x < frame.right && right > frame.left && top < frame.bottom && y > frame.top
    })
}

/// Returns whether a path enters a frame; curves count as their chords.
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

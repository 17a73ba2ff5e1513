//! What a figure draws, as one list; [`super::svg`] and [`super::pdf`] write it.
//!
//! The grid is a hundredth of a millimetre at column width, so whole numbers are fine enough for smooth curves.
//! Labels become outlines (see [`super::font`]); nothing in the list depends on the machine. It is filled as
//! a backend of plotters.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontTransform,
};

use super::font::Placed;
use super::panel::Frame;
use super::style::{Colour, Stroke, WIDTH};
use super::{Error, font, markup};

/// A place on the grid, y downwards.
pub type Point = BackendCoord;

/// A step of a path; those with small letters in SVG are relative to where the last one ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// M: begin at a place.
    Begin(Point),
    /// m: begin at some distance.
    BeginBy(Point),
    /// L: a line to a place.
    Line(Point),
    /// l: a line by a distance.
    LineBy(Point),
    /// h: a line to the side.
    Side(i32),
    /// v: a line downwards.
    Down(i32),
    /// C: a cubic curve, two controls and its end.
    Curve([Point; 3]),
    /// a: half a circle counter-clockwise, its end so far to the side.
    HalfCircle(i32),
    /// Z: back to where the path began.
    Close,
}

/// Where ink goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Geometry {
    /// A line through points.
    Polyline(Vec<Point>),
    /// A closed polygon.
    Polygon(Vec<Point>),
    /// A path.
    Path(Vec<Step>),
    /// Upper left corner, width and height.
    Rectangle(Point, [u32; 2]),
    /// Centre and radius.
    Circle(Point, u32),
}

/// What ink it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Paint {
    /// Inside: colour and opacity in hundredths.
    pub fill: Option<(Colour, u8)>,
    /// Along the edge.
    pub stroke: Option<Stroke>,
}

/// Words as glyphs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The words, for readers of screens.
    pub words: String,
    /// Where they are anchored.
    pub at: Point,
    /// Size of an em.
    pub size: i32,
    /// Colour.
    pub colour: Colour,
    /// Whether they read from bottom to top.
    pub upwards: bool,
    /// The glyphs, in units of the em around the anchor, y upwards.
    pub glyphs: Vec<Placed>,
}

/// Outlines of glyphs by their names, in units of the em, y upwards.
pub type Glyphs = BTreeMap<String, Vec<Step>>;

/// An element of a drawing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Element {
    /// The series of this name begins, in this frame.
    Open(String, Frame),
    /// It ends.
    Close,
    /// A shape.
    Shape(Geometry, Paint),
    /// Words.
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

type Drawn = Result<(), DrawingErrorKind<Error>>;

fn colour_of(color: BackendColor) -> Colour {
    let (r, g, b) = color.rgb;
    Colour(r, g, b)
}

/// The paint of one of plotters' own elements.
fn paint<S: BackendStyle>(style: &S, fill: bool) -> Paint {
    let colour = colour_of(style.color());
    if fill {
        Paint { fill: Some((colour, (style.color().alpha * 100.0).round() as u8)), stroke: None }
    } else {
        Paint { fill: None, stroke: Some(Stroke::solid(colour, style.stroke_width())) }
    }
}

impl Drawing {
    /// An empty drawing.
    pub fn new(height: u32) -> Self {
        Drawing { height, ..Drawing::default() }
    }

    /// Adds a shape.
    pub fn shape(&mut self, geometry: Geometry, paint: Paint) {
        self.elements.push(Element::Shape(geometry, paint));
    }

    /// Adds a line through points.
    pub fn polyline(&mut self, path: Vec<Point>, stroke: Stroke) {
        self.shape(Geometry::Polyline(path), Paint { fill: None, stroke: Some(stroke) });
    }

    fn label(
        &mut self,
        text: &str,
        (at, size, colour): (Point, i32, Colour),
        (h, v): (HPos, VPos),
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
            let id = font::id(placed);
            if let Entry::Vacant(place) = self.glyphs.entry(id) {
                place.insert(font::outline(placed)?);
            }
        }
        let words = markup::plain(text);
        self.elements.push(Element::Label(Label { words, at, size, colour, upwards, glyphs }));
        Ok(())
    }
}

impl DrawingBackend for Drawing {
    type ErrorType = Error;

    fn get_size(&self) -> (u32, u32) {
        (WIDTH, self.height)
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, color: BackendColor) -> Drawn {
        let fill = Some((colour_of(color), 100));
        self.shape(Geometry::Rectangle(at, [1, 1]), Paint { fill, stroke: None });
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, s: &S) -> Drawn {
        self.draw_path([a, b], s)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (x0, y0): BackendCoord,
        (x1, y1): BackendCoord,
        style: &S,
        fill: bool,
    ) -> Drawn {
        let size = [x0.abs_diff(x1), y0.abs_diff(y1)];
        self.shape(Geometry::Rectangle((x0.min(x1), y0.min(y1)), size), paint(style, fill));
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        self.shape(Geometry::Polyline(path.into_iter().collect()), paint(style, false));
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        centre: BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Drawn {
        self.shape(Geometry::Circle(centre, radius), paint(style, fill));
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        vertices: I,
        style: &S,
    ) -> Drawn {
        self.shape(Geometry::Polygon(vertices.into_iter().collect()), paint(style, true));
        Ok(())
    }

    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, at: BackendCoord) -> Drawn {
        let anchor = style.anchor();
        let upwards = matches!(style.transform(), FontTransform::Rotate270);
        let look = (at, style.size().round() as i32, colour_of(style.color()));
        self.label(text, look, (anchor.h_pos, anchor.v_pos), upwards)
            .map_err(DrawingErrorKind::DrawingError)
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Error>> {
        let width = font::set(text).map_err(DrawingErrorKind::DrawingError)?.width;
        let size = style.size().round() as i32;
        let scaled = |length: i32| (length * size / font::EM).max(0) as u32;
        Ok((scaled(width), scaled(font::CAP_HEIGHT)))
    }
}

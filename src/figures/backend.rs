//! An own plotters backend that writes SVG.
//!
//! The grid is a hundredth of a millimetre at column width, so whole numbers are fine enough for
//! smooth curves; `viewBox` scales it. Labels become outlines (see [`super::font`]), the document
//! has a title, a description and a role, and nothing in it depends on the machine.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt::Write as _;

use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontTransform,
};

use super::style::{Colour, Stroke, WIDTH};
use super::{Error, font, markup};

/// Screen pixels of the drawing's own size, per hundred grid units.
const PIXELS_PER_HUNDRED: u32 = 8;

/// A drawing in the making.
#[derive(Debug)]
pub struct Svg {
    height: u32,
    body: String,
    glyphs: BTreeMap<String, String>,
    open: usize,
}

type Drawn = Result<(), DrawingErrorKind<Error>>;

fn fail(error: Error) -> DrawingErrorKind<Error> {
    DrawingErrorKind::DrawingError(error)
}

/// Text as it may stand inside an element or an attribute.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            other => out.push(other),
        }
    }
    out
}

fn colour_of(color: BackendColor) -> Colour {
    let (r, g, b) = color.rgb;
    Colour(r, g, b)
}

fn points<I: IntoIterator<Item = BackendCoord>>(path: I) -> String {
    let mut list = String::new();
    for (x, y) in path {
        let gap = if list.is_empty() { "" } else { " " };
        let _ = write!(list, "{gap}{x},{y}");
    }
    list
}

impl Svg {
    /// An empty drawing of column width.
    pub fn new(height: u32) -> Self {
        Svg { height, body: String::new(), glyphs: BTreeMap::new(), open: 0 }
    }

    fn push(&mut self, element: &str) {
        for _ in 0..=self.open {
            self.body.push(' ');
        }
        self.body.push_str(element);
        self.body.push('\n');
    }

    /// Opens a group with the given attributes.
    pub fn open(&mut self, attributes: &str) {
        self.push(&format!("<g {attributes}>"));
        self.open += 1;
    }

    /// Closes the last group.
    pub fn close(&mut self) {
        self.open = self.open.saturating_sub(1);
        self.push("</g>");
    }

    /// A line through points, with width, dash and colour.
    pub fn polyline<I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, stroke: &Stroke) {
        let list = points(path);
        let Stroke { colour, width, .. } = stroke;
        let dash = stroke.dash_array();
        self.push(&format!(
            "<polyline fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"{dash} \
             stroke-linejoin=\"round\" points=\"{list}\"/>"
        ));
    }

    /// A filled polygon, `opacity` in hundredths.
    pub fn polygon<I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        fill: Colour,
        opacity: u8,
    ) {
        let list = points(path);
        let opacity = opacity_attribute(opacity);
        self.push(&format!("<polygon fill=\"{fill}\"{opacity} points=\"{list}\"/>"));
    }

    /// A path that is stroked and, if `fill` is given, filled.
    pub fn path(&mut self, d: &str, stroke: &Stroke, fill: Option<Colour>) {
        let fill = fill.map_or("none".to_string(), |c| c.to_string());
        let Stroke { colour, width, .. } = stroke;
        let dash = stroke.dash_array();
        self.push(&format!(
            "<path fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"{width}\"{dash} d=\"{d}\"/>"
        ));
    }

    fn label(
        &mut self,
        text: &str,
        at: BackendCoord,
        size: i32,
        colour: Colour,
        (h, v): (HPos, VPos),
        upwards: bool,
    ) -> Result<(), Error> {
        let line = font::set(text)?;
        let dx = match h {
            HPos::Left => 0,
            HPos::Center => -line.width / 2,
            HPos::Right => -line.width,
        };
        let dy = match v {
            VPos::Top => -font::CAP_HEIGHT,
            VPos::Center => -font::CAP_HEIGHT / 2,
            VPos::Bottom => 0,
        };
        let scale = f64::from(size) / f64::from(font::EM);
        let turn = if upwards { " rotate(-90)" } else { "" };
        let name = escape(&markup::plain(text));
        let mut element = format!(
            "<g fill=\"{colour}\" aria-label=\"{name}\" \
             transform=\"translate({} {}){turn} scale({scale} -{scale})\">",
            at.0, at.1
        );
        for placed in &line.glyphs {
            let id = font::id(placed);
            let (x, y) = (placed.x + dx, placed.y + dy);
            let _ = if placed.small {
                let script = f64::from(font::SCRIPT) / f64::from(font::EM);
                write!(
                    element,
                    "<use href=\"#{id}\" transform=\"translate({x} {y}) scale({script})\"/>"
                )
            } else {
                write!(element, "<use href=\"#{id}\" x=\"{x}\" y=\"{y}\"/>")
            };
            if let Entry::Vacant(place) = self.glyphs.entry(id) {
                place.insert(font::outline(placed)?);
            }
        }
        element.push_str("</g>");
        self.push(&element);
        Ok(())
    }

    /// The document; `id` must be unique on a page that shows several drawings.
    pub fn document(&self, id: &str, title: &str, description: &str) -> String {
        let (title, description, height) = (escape(title), escape(description), self.height);
        let (w, h) = (WIDTH * PIXELS_PER_HUNDRED / 100, height * PIXELS_PER_HUNDRED / 100);
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" \
             viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" \
             aria-labelledby=\"{id}-title {id}-desc\">\n\
             <title id=\"{id}-title\">{title}</title>\n<desc id=\"{id}-desc\">{description}</desc>\n<defs>\n"
        );
        for (glyph, d) in &self.glyphs {
            let _ = writeln!(out, " <path id=\"{glyph}\" d=\"{d}\"/>");
        }
        let _ = write!(
            out,
            "</defs>\n<rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.body
        );
        out
    }
}

fn opacity_attribute(hundredths: u8) -> String {
    if hundredths >= 100 {
        String::new()
    } else {
        format!(" fill-opacity=\"{}\"", f64::from(hundredths) / 100.0)
    }
}

fn hundredths(alpha: f64) -> u8 {
    (alpha * 100.0).round() as u8
}

impl DrawingBackend for Svg {
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

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> Drawn {
        let fill = colour_of(color);
        self.push(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"1\" height=\"1\" fill=\"{fill}\"/>"));
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
        let colour = colour_of(style.color());
        let (x, y, w, h) = (x0.min(x1), y0.min(y1), x0.abs_diff(x1), y0.abs_diff(y1));
        let paint = if fill {
            format!("fill=\"{colour}\"{}", opacity_attribute(hundredths(style.color().alpha)))
        } else {
            format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{}\"", style.stroke_width())
        };
        self.push(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" {paint}/>"));
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        self.polyline(path, &Stroke::solid(colour_of(style.color()), style.stroke_width()));
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        (x, y): BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Drawn {
        let colour = colour_of(style.color());
        let paint = if fill {
            format!("fill=\"{colour}\"")
        } else {
            format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{}\"", style.stroke_width())
        };
        self.push(&format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" {paint}/>"));
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        vertices: I,
        style: &S,
    ) -> Drawn {
        let color = style.color();
        self.polygon(vertices, colour_of(color), hundredths(color.alpha));
        Ok(())
    }

    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, at: BackendCoord) -> Drawn {
        let anchor = style.anchor();
        let upwards = matches!(style.transform(), FontTransform::Rotate270);
        let size = style.size().round() as i32;
        let colour = colour_of(style.color());
        self.label(text, at, size, colour, (anchor.h_pos, anchor.v_pos), upwards).map_err(fail)
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Error>> {
        let width = font::set(text).map_err(fail)?.width;
        let size = style.size().round() as i32;
        let scaled = |length: i32| (length * size / font::EM).max(0) as u32;
        Ok((scaled(width), scaled(font::CAP_HEIGHT)))
    }
}

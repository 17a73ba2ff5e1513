//! Writes a drawing as SVG: as a file, or as an element of a page.
//!
//! Colours are classes: a file holds their rules, a page has them in its style sheet, for light and
//! dark. All drawings of a page share the outlines of glyphs.

use super::drawing::{Drawing, Element, Fill, Frame, Glyphs, Label};
use super::font;
use super::path::{Point, Step};
use super::style::{PALETTE, Stroke, WHITE, WIDTH};
use plotters::style::RGBColor;
use std::fmt::Write as _;

/// Screen pixels per hundred grid units, at the natural size of a drawing.
pub(super) const PIXELS_PER_HUNDRED: u32 = 8;

pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Writes the data of a path, each step relative to the end of the last one.
fn path_data(steps: &[Step]) -> String {
    let (mut d, mut at) = (String::new(), (0, 0));
    for step in steps {
        let by = |to: &Point| (to.0 - at.0, to.1 - at.1);
        let _ = match step {
            Step::Move((x, y)) => write!(d, "M{x} {y}"),
            Step::Line(to) => match by(to) {
                (x, 0) => write!(d, "h{x}"),
                (0, y) => write!(d, "v{y}"),
                (x, y) => write!(d, "l{x} {y}"),
            },
            Step::Curve(points) => {
                let [a, b, c] = points.each_ref().map(by);
                write!(d, "c{} {} {} {} {} {}", a.0, a.1, b.0, b.1, c.0, c.1)
            }
            Step::Close => write!(d, "z"),
        };
        if let Step::Move(to) | Step::Line(to) | Step::Curve([.., to]) = step {
            at = *to;
        }
    }
    d
}

pub fn outlines(glyphs: &Glyphs) -> String {
    let mut out = String::new();
    for (id, steps) in glyphs {
        let _ = writeln!(out, "<path id=\"glyph-{id}\" d=\"{}\"/>", path_data(steps));
    }
    out
}

/// Returns the class that paints a colour as the `fill` or the `stroke` of a shape.
fn class(paint: &str, colour: RGBColor) -> String {
    let named = PALETTE.iter().find(|named| named.1 == colour);
    format!("{paint}-{}", named.map_or("ink", |named| named.0))
}

fn shape(path: &[Step], fill: &Fill, stroke: &Option<Stroke>) -> String {
    let mut classes = Vec::new();
    let mut more = String::new();
    match *fill {
        None => more += " fill=\"none\" stroke-linejoin=\"round\"",
        Some((colour, opacity)) => {
            classes.push(class("fill", colour));
            if opacity < 100 {
                more += &format!(" fill-opacity=\"{}\"", f64::from(opacity) / 100.0);
            }
        }
    }
    if let Some(stroke) = stroke {
        classes.push(class("stroke", stroke.colour));
        more += &format!(" stroke-width=\"{}\"", stroke.width);
        let dashes: Vec<String> = stroke.dash.iter().map(u32::to_string).collect();
        if !dashes.is_empty() {
            more += &format!(" stroke-dasharray=\"{}\"", dashes.join(" "));
        }
    }
    format!("<path class=\"{}\"{more} d=\"{}\"/>", classes.join(" "), path_data(path))
}

fn label(label: &Label, on_page: bool) -> String {
    let scale = f64::from(label.size) / f64::from(font::EM);
    let (ink, (x, y)) = (class("fill", label.colour), label.at);
    let turn = if label.upwards { " rotate(-90)" } else { "" };
    let place = format!("transform=\"translate({x} {y}){turn} scale({scale} -{scale})\"");
    let mut glyphs = String::new();
    for placed in &label.glyphs {
        let (id, x, y) = (font::id(placed), placed.x, placed.y);
        let place = if placed.scale < font::EM {
            let script = f64::from(placed.scale) / f64::from(font::EM);
            format!("transform=\"translate({x} {y}) scale({script})\"")
        } else {
            format!("x=\"{x}\" y=\"{y}\"")
        };
        let _ = write!(glyphs, "<use href=\"#glyph-{id}\" {place}/>");
    }
    let mut out = String::new();
    if label.rim {
        let (page, width) = (class("stroke", WHITE), font::RIM);
        out = format!("<g class=\"{page}\" stroke-width=\"{width}\" {place}>{glyphs}</g>");
    }
    let words = escape(&label.words);
    if !on_page {
        return out + &format!("<g class=\"{ink}\" aria-label=\"{words}\" {place}>{glyphs}</g>");
    }
    // The words themselves lie over the outlines, unseen, for a search in the page.
    let (start, size) = (label.glyphs.first().map_or(0, |first| first.x), label.size);
    let start = (f64::from(start) * scale) as i32;
    out + &format!(
        "<g class=\"{ink}\" {place}>{glyphs}</g><text class=\"said\" x=\"{start}\" font-size=\"{size}\" \
         transform=\"translate({x} {y}){turn}\">{words}</text>"
    )
}

impl Drawing {
    /// Writes a file, or an element of a page, which holds the colours and outlines of glyphs.
    pub(crate) fn svg(&self, on_page: bool, id: &str, title: &str, description: &str) -> String {
        let (mut namespace, mut head) = ("", String::new());
        if !on_page {
            namespace = " xmlns=\"http://www.w3.org/2000/svg\"";
            let mut rules = String::new();
            for (name, RGBColor(r, g, b)) in PALETTE {
                let colour = format!("#{r:02x}{g:02x}{b:02x}");
                let _ = write!(rules, ".fill-{name}{{fill:{colour}}}");
                let _ = writeln!(rules, ".stroke-{name}{{stroke:{colour}}}");
            }
            let glyphs = outlines(&self.glyphs);
            head = format!("<style>\n{rules}</style>\n<defs>\n{glyphs}</defs>\n");
        }
        let [w, h] = [WIDTH, self.height].map(|side| side * PIXELS_PER_HUNDRED / 100);
        let (title, words, height) = (escape(title), escape(description), self.height);
        let mut out = format!(
            "<svg{namespace} width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" \
             aria-labelledby=\"{id}-title {id}-desc\">\n<title id=\"{id}-title\">{title}</title>\n\
             <desc id=\"{id}-desc\">{words}</desc>\n{head}\
             <rect width=\"{WIDTH}\" height=\"{height}\" class=\"{}\"/>\n",
            class("fill", WHITE)
        );
        for element in &self.elements {
            out += &match element {
                Element::Open(name, Frame { left, top, right, bottom }, axes) => {
                    let axes = if on_page { format!(" data-axes=\"{axes}\"") } else { "".into() };
                    format!(
                        "<g class=\"data\" data-name=\"{}\" data-frame=\"{left} {top} {right} {bottom}\"{axes}>",
                        escape(name)
                    )
                }
                Element::Close => "</g>".into(),
                Element::Shape(path, fill, stroke) => shape(path, fill, stroke),
                Element::Label(words) => label(words, on_page),
            };
            out.push('\n');
        }
        out + "</svg>"
    }
}

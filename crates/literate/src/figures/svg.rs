//! A drawing as SVG: a file, or an element of a page.
//!
//! `viewBox` scales the grid. The document has a title, a description and a role. Colours are classes, for which a
//! file has the rules itself, and a page in its style sheet, for light and dark; glyphs are shared by all drawings of a
//! page.

use super::drawing::{Drawing, Element, Fill, Glyphs, Label, Point, Step};
use super::style::{Colour, Stroke, WHITE, WIDTH};
use super::{font, palette};
use std::fmt::Write as _;

/// Screen pixels of the drawing's own size, per hundred grid units.
pub(super) const PIXELS_PER_HUNDRED: u32 = 8;

/// Text as it may stand inside an element or an attribute.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Path data, each step as seen from where the last one ended.
pub fn path_data(steps: &[Step]) -> String {
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

/// The outlines of glyphs, for use by their names.
pub fn outlines(glyphs: &Glyphs) -> String {
    let one = |(id, steps): (&String, &Vec<Step>)| {
        format!("<path id=\"glyph-{id}\" d=\"{}\"/>\n", path_data(steps))
    };
    glyphs.iter().map(one).collect()
}

/// The class of a colour inside or along the edge.
fn class(what: &str, colour: Colour) -> String {
    let name = super::style::PALETTE.iter().find(|(_, own)| *own == colour).map(|(name, _)| name);
    format!("{what}-{}", name.unwrap_or(&"ink"))
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
        let dashes: Vec<String> = stroke.dashes().iter().map(u32::to_string).collect();
        if !dashes.is_empty() {
            more += &format!(" stroke-dasharray=\"{}\"", dashes.join(" "));
        }
    }
    format!("<path class=\"{}\"{more} d=\"{}\"/>", classes.join(" "), path_data(path))
}

/// Words as glyphs; on a page, where groups have no role, without their text.
fn label(label: &Label, on_page: bool) -> String {
    let scale = f64::from(label.size) / f64::from(font::EM);
    let (ink, (x, y)) = (class("fill", label.colour), label.at);
    let turn = if label.upwards { " rotate(-90)" } else { "" };
    let place = format!("transform=\"translate({x} {y}){turn} scale({scale} -{scale})\"");
    let mut glyphs = String::new();
    for placed in &label.glyphs {
        let (id, x, y) = (font::id(placed), placed.x, placed.y);
        let place = match placed.small {
            true => {
                let script = f64::from(font::SCRIPT) / f64::from(font::EM);
                format!("transform=\"translate({x} {y}) scale({script})\"")
            }
            false => format!("x=\"{x}\" y=\"{y}\""),
        };
        let _ = write!(glyphs, "<use href=\"#glyph-{id}\" {place}/>");
    }
    let rim = class("stroke", WHITE);
    let rim = match label.rim {
        true => format!("<g class=\"{rim}\" stroke-width=\"{}\" {place}>{glyphs}</g>", font::RIM),
        false => String::new(),
    };
    let words = match on_page {
        true => String::new(),
        false => format!(" aria-label=\"{}\"", escape(&label.words)),
    };
    format!("{rim}<g class=\"{ink}\"{words} {place}>{glyphs}</g>")
}

impl Drawing {
    /// A file; `id` must be unique on a page that shows several drawings.
    pub fn svg(&self, id: &str, title: &str, description: &str) -> String {
        self.written(false, id, title, description) + "\n"
    }

    /// An element of a page, which holds the rules of the colours and the outlines of the glyphs.
    pub fn on_page(&self, id: &str, title: &str, description: &str) -> String {
        self.written(true, id, title, description.trim())
    }

    fn written(&self, on_page: bool, id: &str, title: &str, description: &str) -> String {
        let rule = |(name, colour): (&str, String)| {
            format!(".fill-{name}{{fill:{colour}}}.stroke-{name}{{stroke:{colour}}}\n")
        };
        let (mut space, mut within) = ("", String::new());
        if !on_page {
            space = " xmlns=\"http://www.w3.org/2000/svg\"";
            let (rules, glyphs) = (palette().map(rule).collect::<String>(), outlines(&self.glyphs));
            within = format!("<style>\n{rules}</style>\n<defs>\n{glyphs}</defs>\n");
        }
        let [w, h] = [WIDTH, self.height].map(|side| side * PIXELS_PER_HUNDRED / 100);
        let (title, words, height) = (escape(title), escape(description), self.height);
        let mut out = format!(
            "<svg{space} width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" \
             aria-labelledby=\"{id}-title {id}-desc\">\n<title id=\"{id}-title\">{title}</title>\n\
             <desc id=\"{id}-desc\">{words}</desc>\n{within}\
             <rect width=\"{WIDTH}\" height=\"{height}\" class=\"{}\"/>\n",
            class("fill", WHITE)
        );
        for element in &self.elements {
            out += &match element {
                Element::Open(name, frame) => format!(
                    "<g class=\"data\" data-name=\"{}\" data-frame=\"{} {} {} {}\">",
                    escape(name),
                    frame.left,
                    frame.top,
                    frame.right,
                    frame.bottom
                ),
                Element::Close => "</g>".into(),
                Element::Shape(path, fill, stroke) => shape(path, fill, stroke),
                Element::Label(own) => label(own, on_page),
            };
            out.push('\n');
        }
        out + "</svg>"
    }
}

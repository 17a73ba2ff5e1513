//! A drawing as SVG: a file of its own, or an element of a page.
//!
//! `viewBox` scales the grid. The document has a title, a description and a role. On a page colours are classes,
//! so that the style sheet can give them for light and dark, and glyphs are shared by all drawings.

use std::fmt::Write as _;

use super::drawing::{Drawing, Element, Geometry, Label, Paint, Step};
use super::style::{WHITE, WIDTH};
use super::{font, palette};

/// Screen pixels of the drawing's own size, per hundred grid units.
pub(super) const PIXELS_PER_HUNDRED: u32 = 8;

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

/// Path data, with what stands between the numbers of a pair.
pub fn path_data(steps: &[Step], between: char) -> String {
    let mut d = String::new();
    for step in steps {
        let _ = match step {
            Step::Begin((x, y)) => write!(d, "M{x}{between}{y}"),
            Step::BeginBy((x, y)) => write!(d, "m{x}{between}{y}"),
            Step::Line((x, y)) => write!(d, "L{x}{between}{y}"),
            Step::LineBy((x, y)) => write!(d, "l{x}{between}{y}"),
            Step::Side(x) => write!(d, "h{x}"),
            Step::Down(y) => write!(d, "v{y}"),
            Step::Curve([a, b, c]) => {
                write!(d, "C{} {} {} {} {} {}", a.0, a.1, b.0, b.1, c.0, c.1)
            }
            Step::HalfCircle(x) => {
                let r = x.abs() / 2;
                write!(d, "a{r},{r} 0 1 0 {x},0")
            }
            Step::Close => write!(d, "{}", if between == ' ' { 'Z' } else { 'z' }),
        };
    }
    d
}

/// Attributes in their order.
type Attributes = Vec<(&'static str, String)>;

/// Writes elements.
struct Writer {
    out: String,
    /// Whether it is for a page with others.
    page: bool,
}

impl Writer {
    /// `<name …`: on a page colours become classes, behind what else there is.
    fn start(&mut self, name: &str, attributes: Attributes) {
        let _ = write!(self.out, "<{name}");
        let mut classes = Vec::new();
        for (key, value) in attributes {
            match key {
                "class" if self.page => classes.insert(0, value),
                "fill" | "stroke"
                    if self.page
                        && let Some(name) = named(&value) =>
                {
                    classes.push(format!("{key}-{name}"));
                }
                // The picture is one image to readers of a screen: its description says what is seen.
                "aria-label" if self.page => {}
                _ => {
                    let _ = write!(self.out, " {key}=\"{}\"", escape(&value));
                }
            }
        }
        if !classes.is_empty() {
            let _ = write!(self.out, " class=\"{}\"", classes.join(" "));
        }
    }

    fn empty(&mut self, name: &str, attributes: Attributes) {
        self.start(name, attributes);
        self.out.push_str("/>");
    }

    /// A line of the file begins, so far inside.
    fn indent(&mut self, depth: usize) {
        if !self.page {
            self.out.extend(std::iter::repeat_n(' ', depth));
        }
    }

    fn line(&mut self) {
        if !self.page {
            self.out.push('\n');
        }
    }

    fn elements(&mut self, elements: &[Element]) {
        let mut depth = 1;
        for element in elements {
            if *element == Element::Close {
                depth -= 1;
            }
            self.indent(depth);
            match element {
                Element::Open(name, frame) => {
                    let frame =
                        format!("{} {} {} {}", frame.left, frame.top, frame.right, frame.bottom);
                    let attributes = [
                        ("class", "data".into()),
                        ("data-name", name.clone()),
                        ("data-frame", frame),
                    ];
                    self.start("g", attributes.into());
                    self.out.push('>');
                    depth += 1;
                }
                Element::Close => self.out.push_str("</g>"),
                Element::Shape(geometry, paint) => self.shape(geometry, paint),
                Element::Label(label) => self.label(label),
            }
            self.line();
        }
    }

    fn shape(&mut self, geometry: &Geometry, paint: &Paint) {
        let points = |points: &[(i32, i32)]| {
            let pairs: Vec<String> = points.iter().map(|(x, y)| format!("{x},{y}")).collect();
            vec![("points", pairs.join(" "))]
        };
        let place = |names: [&'static str; 2], (x, y): (i32, i32)| {
            names.into_iter().zip([x.to_string(), y.to_string()]).collect::<Attributes>()
        };
        let ink = inks(paint);
        let (name, attributes) = match geometry {
            Geometry::Polyline(path) => {
                let join = vec![("stroke-linejoin", "round".to_string())];
                ("polyline", [ink, join, points(path)])
            }
            Geometry::Polygon(path) => ("polygon", [ink, points(path), vec![]]),
            Geometry::Path(steps) => ("path", [ink, vec![("d", path_data(steps, ','))], vec![]]),
            Geometry::Rectangle(at, [w, h]) => {
                let size = vec![("width", w.to_string()), ("height", h.to_string())];
                ("rect", [place(["x", "y"], *at), size, ink])
            }
            Geometry::Circle(centre, r) => {
                ("circle", [place(["cx", "cy"], *centre), vec![("r", r.to_string())], ink])
            }
        };
        self.empty(name, attributes.concat());
    }

    fn label(&mut self, label: &Label) {
        let scale = f64::from(label.size) / f64::from(font::EM);
        let (x, y) = label.at;
        let turn = if label.upwards { " rotate(-90)" } else { "" };
        let transform = format!("translate({x} {y}){turn} scale({scale} -{scale})");
        let attributes = [
            ("fill", label.colour.to_string()),
            ("aria-label", label.words.clone()),
            ("transform", transform),
        ];
        self.start("g", attributes.into());
        self.out.push('>');
        for placed in &label.glyphs {
            let shared = if self.page { "glyph-" } else { "" };
            let mut attributes = vec![("href", format!("#{shared}{}", font::id(placed)))];
            let (x, y) = (placed.x, placed.y);
            if placed.small {
                let script = f64::from(font::SCRIPT) / f64::from(font::EM);
                attributes.push(("transform", format!("translate({x} {y}) scale({script})")));
            } else {
                attributes.extend([("x", x.to_string()), ("y", y.to_string())]);
            }
            self.empty("use", attributes);
        }
        self.out.push_str("</g>");
    }
}

fn inks(paint: &Paint) -> Attributes {
    let fill = paint.fill.map_or("none".into(), |(colour, _)| colour.to_string());
    let mut out = vec![("fill", fill)];
    if let Some((_, opacity @ ..100)) = paint.fill {
        out.push(("fill-opacity", (f64::from(opacity) / 100.0).to_string()));
    }
    if let Some(stroke) = paint.stroke {
        out.push(("stroke", stroke.colour.to_string()));
        out.push(("stroke-width", stroke.width.to_string()));
        let dashes: Vec<String> = stroke.dashes().iter().map(u32::to_string).collect();
        out.extend((!dashes.is_empty()).then(|| ("stroke-dasharray", dashes.join(" "))));
    }
    out
}

/// The name of a colour as the style sheet knows it.
fn named(code: &str) -> Option<&'static str> {
    palette().find(|(_, colour)| colour == code).map(|(name, _)| name)
}

impl Drawing {
    /// A file; `id` must be unique on a page that shows several drawings.
    pub fn svg(&self, id: &str, title: &str, description: &str) -> String {
        self.written(id, title, description, false)
    }

    /// An element of a page, which holds the outlines of its glyphs under `glyph-` and their ids.
    pub fn on_page(&self, id: &str, title: &str, description: &str) -> String {
        self.written(id, title, description.trim(), true)
    }

    fn written(&self, id: &str, title: &str, words: &str, page: bool) -> String {
        let mut writer = Writer { out: String::new(), page };
        let [w, h] = [WIDTH, self.height].map(|side| side * PIXELS_PER_HUNDRED / 100);
        let mut attributes = vec![
            ("width", w.to_string()),
            ("height", h.to_string()),
            ("viewBox", format!("0 0 {WIDTH} {}", self.height)),
            ("role", "img".into()),
            ("aria-labelledby", format!("{id}-title {id}-desc")),
        ];
        if !page {
            attributes.insert(0, ("xmlns", "http://www.w3.org/2000/svg".into()));
        }
        writer.start("svg", attributes);
        writer.out.push('>');
        writer.line();
        for (name, part, text) in [("title", "title", title), ("desc", "desc", words)] {
            let _ = write!(writer.out, "<{name} id=\"{id}-{part}\">{}</{name}>", escape(text));
            writer.line();
        }
        if !page {
            writer.out.push_str("<defs>\n");
            for (glyph, steps) in &self.glyphs {
                let d = path_data(steps, ' ');
                let _ = writeln!(writer.out, " <path id=\"{glyph}\" d=\"{d}\"/>");
            }
            writer.out.push_str("</defs>\n");
        }
        let size = [("width", WIDTH.to_string()), ("height", self.height.to_string())];
        let ground = [("fill", WHITE.to_string())];
        writer.empty("rect", size.into_iter().chain(ground).collect());
        writer.line();
        writer.elements(&self.elements);
        writer.out.push_str("</svg>");
        writer.line();
        writer.out
    }
}

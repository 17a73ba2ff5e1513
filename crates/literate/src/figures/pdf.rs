//! A drawing as a one-page PDF, for LaTeX: the same bytes everywhere.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::drawing::{Drawing, Element, Geometry, Label, Paint, Point, Step};
use super::font;
use super::style::{Colour, WHITE, WIDTH};
use super::svg::PIXELS_PER_HUNDRED;

/// Distance of a control point from its end, for a quarter of a circle with radius 1.
const QUARTER: f64 = 0.552_284_749_831;

impl Drawing {
    /// A file.
    pub fn pdf(&self, title: &str) -> Vec<u8> {
        // A pixel is 3/4 of a point.
        let width = 0.75 * f64::from(WIDTH * PIXELS_PER_HUNDRED / 100);
        let scale = width / f64::from(WIDTH);
        let height = scale * f64::from(self.height);
        let mut page = Page { drawing: self, content: String::new(), opacities: BTreeSet::new() };
        page.line(&format!("{} 0 0 {} 0 {} cm", n(scale), n(-scale), n(height)));
        let ground = Geometry::Rectangle((0, 0), [WIDTH, self.height]);
        page.shape(&ground, &Paint { fill: Some((WHITE, 100)), stroke: None });
        for element in &self.elements {
            match element {
                Element::Open(..) => page.line("q"),
                Element::Close => page.line("Q"),
                Element::Shape(geometry, paint) => page.shape(geometry, paint),
                Element::Label(label) => page.label(label),
            }
        }
        file(&page, width, height, title)
    }
}

struct Page<'a> {
    drawing: &'a Drawing,
    content: String,
    /// Opacities in use, in hundredths.
    opacities: BTreeSet<u8>,
}

impl Page<'_> {
    fn line(&mut self, operators: &str) {
        self.content.push_str(operators);
        self.content.push('\n');
    }

    /// Fills and strokes a shape.
    fn shape(&mut self, geometry: &Geometry, paint: &Paint) {
        self.line("q");
        let path = match geometry {
            Geometry::Polyline(points) | Geometry::Polygon(points) if points.is_empty() => {
                return self.line("Q");
            }
            Geometry::Polyline(points) => joined(points),
            Geometry::Polygon(points) => joined(points) + "h\n",
            Geometry::Path(steps) => operators(steps),
            Geometry::Rectangle((x, y), [w, h]) => format!("{x} {y} {w} {h} re\n"),
            Geometry::Circle(centre, radius) => circle(*centre, f64::from(*radius)),
        };
        self.ink(&path, paint, matches!(geometry, Geometry::Polyline(_)));
        self.line("Q");
    }

    fn ink(&mut self, path: &str, paint: &Paint, round: bool) {
        let operator = match (paint.fill, paint.stroke) {
            (None, None) => return,
            (Some(_), None) => "f",
            (None, Some(_)) => "S",
            (Some(_), Some(_)) => "B",
        };
        if let Some((colour, opacity)) = paint.fill {
            if opacity < 100 {
                self.opacities.insert(opacity);
                self.line(&format!("/o{opacity} gs"));
            }
            self.line(&format!("{} rg", shares(colour)));
        }
        if let Some(stroke) = paint.stroke {
            self.line(&format!("{} RG\n{} w", shares(stroke.colour), stroke.width));
            if round {
                self.line("1 j");
            }
            let dashes: Vec<String> = stroke.dashes().iter().map(u32::to_string).collect();
            if !dashes.is_empty() {
                self.line(&format!("[{}] 0 d", dashes.join(" ")));
            }
        }
        self.content.push_str(path);
        self.line(operator);
    }

    fn label(&mut self, label: &Label) {
        let scale = f64::from(label.size) / f64::from(font::EM);
        self.line(&format!("q\n1 0 0 1 {} {} cm", label.at.0, label.at.1));
        if label.upwards {
            self.line("0 -1 1 0 0 0 cm");
        }
        self.line(&format!("{} 0 0 {} 0 0 cm", n(scale), n(-scale)));
        let drawing = self.drawing;
        for placed in &label.glyphs {
            self.line(&format!("q\n1 0 0 1 {} {} cm", placed.x, placed.y));
            if placed.small {
                let script = n(f64::from(font::SCRIPT) / f64::from(font::EM));
                self.line(&format!("{script} 0 0 {script} 0 0 cm\n1 0 0 1 0 0 cm"));
            }
            let outline = drawing.glyphs.get(&font::id(placed)).map(|steps| operators(steps));
            let paint = Paint { fill: Some((label.colour, 100)), stroke: None };
            self.ink(&outline.unwrap_or_default(), &paint, false);
            self.line("Q");
        }
        self.line("Q");
    }
}

/// Red, green and blue.
fn shares(Colour(r, g, b): Colour) -> String {
    [r, g, b].map(|part| n(f64::from(part) / 255.0)).join(" ")
}

/// Operators of a line through points.
fn joined(points: &[Point]) -> String {
    let mut out = String::new();
    for (i, (x, y)) in points.iter().enumerate() {
        let _ = writeln!(out, "{x} {y} {}", if i == 0 { "m" } else { "l" });
    }
    out
}

/// Operators of a path.
fn operators(steps: &[Step]) -> String {
    let mut out = String::new();
    let ((mut x, mut y), mut begin) = ((0, 0), (0, 0));
    for step in steps {
        let from = (x, y);
        (x, y) = match *step {
            Step::Begin(to) | Step::Line(to) | Step::Curve([_, _, to]) => to,
            Step::BeginBy((dx, dy)) | Step::LineBy((dx, dy)) => (x + dx, y + dy),
            Step::Side(dx) | Step::HalfCircle(dx) => (x + dx, y),
            Step::Down(dy) => (x, y + dy),
            Step::Close => begin,
        };
        let _ = match *step {
            Step::Begin(_) | Step::BeginBy(_) => {
                begin = (x, y);
                writeln!(out, "{x} {y} m")
            }
            Step::Curve([a, b, _]) => {
                writeln!(out, "{} {} {} {} {x} {y} c", a.0, a.1, b.0, b.1)
            }
            Step::HalfCircle(across) => write!(out, "{}", half_circle(from, across)),
            Step::Close => writeln!(out, "h"),
            Step::Line(_) | Step::LineBy(_) | Step::Side(_) | Step::Down(_) => {
                writeln!(out, "{x} {y} l")
            }
        };
    }
    out
}

/// Quarters of a circle, each between two places, from its centre.
fn quarters((cx, cy): (f64, f64), places: &[(f64, f64)]) -> String {
    let mut out = String::new();
    for ends in places.windows(2) {
        let [(ax, ay), (bx, by)] = [ends[0], ends[1]];
        let k = QUARTER;
        for (x, y) in [(ax + k * bx, ay + k * by), (bx + k * ax, by + k * ay), (bx, by)] {
            let _ = write!(out, "{} {} ", n(cx + x), n(cy + y));
        }
        out.push_str("c\n");
    }
    out
}

/// Half a circle counter-clockwise, as two cubic curves.
fn half_circle((x, y): Point, across: i32) -> String {
    let r = f64::from(across) / 2.0;
    quarters((f64::from(x) + r, f64::from(y)), &[(-r, 0.0), (0.0, r), (r, 0.0)])
}

/// A circle as four cubic curves (off by 0.03 % of its radius at most).
fn circle((x, y): Point, r: f64) -> String {
    let (cx, cy) = (f64::from(x), f64::from(y));
    let places = [(r, 0.0), (0.0, r), (-r, 0.0), (0.0, -r), (r, 0.0)];
    format!("{} {} m\n{}h\n", n(cx + r), n(cy), quarters((cx, cy), &places))
}

/// A number for PDF: no exponent, four decimals at most.
fn n(x: f64) -> String {
    // Rounded before, so that no zero has a sign.
    let rounded = (x * 1e4).round() / 1e4 + 0.0;
    rounded.to_string()
}

/// The PDF file: catalogue, one page, its content, and a title.
fn file(page: &Page<'_>, width: f64, height: f64, title: &str) -> Vec<u8> {
    let mut states = String::new();
    for hundredths in &page.opacities {
        let _ = write!(states, "/o{hundredths} << /ca {} >> ", n(f64::from(*hundredths) / 100.0));
    }
    // UTF-16 with its mark, in hexadecimal: every character is allowed.
    let title: String = title.encode_utf16().map(|unit| format!("{unit:04X}")).collect();
    let objects = [
        "<< /Type /Catalog /Pages 2 0 R >>".to_string(),
        "<< /Type /Pages /Kids [3 0 R] /Count 1 >>".to_string(),
        format!(
            "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {} {}] /Contents 4 0 R \
             /Resources << /ExtGState << {states}>> >> >>",
            n(width),
            n(height)
        ),
        format!("<< /Length {} >>\nstream\n{}endstream", page.content.len(), page.content),
        format!("<< /Title <FEFF{title}> >>"),
    ];
    let mut out = String::from("%PDF-1.5\n");
    let mut offsets = Vec::new();
    for (i, object) in objects.iter().enumerate() {
        offsets.push(out.len());
        let _ = write!(out, "{} 0 obj\n{object}\nendobj\n", i + 1);
    }
    let start = out.len();
    let _ = write!(out, "xref\n0 {}\n0000000000 65535 f \n", objects.len() + 1);
    for offset in offsets {
        let _ = writeln!(out, "{offset:010} 00000 n ");
    }
    let _ = write!(
        out,
        "trailer\n<< /Size {} /Root 1 0 R /Info 5 0 R >>\nstartxref\n{start}\n%%EOF\n",
        objects.len() + 1
    );
    out.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::style::{Dash, INK, Stroke};

    #[test]
    fn shapes_become_operators() {
        let mut drawing = Drawing::new(500);
        let stroke = Stroke::dashed(Colour(0, 0, 255), 4, Dash::Long);
        drawing.polyline(vec![(1, 2), (3, 4)], stroke);
        let steps = vec![
            Step::Begin((1, 2)),
            Step::Side(3),
            Step::Down(4),
            Step::LineBy((-1, -1)),
            Step::Close,
        ];
        let filled = |opacity| Paint { fill: Some((INK, opacity)), stroke: None };
        drawing.shape(Geometry::Path(steps), filled(100));
        let disc = [Step::Begin((2, 0)), Step::HalfCircle(-4), Step::HalfCircle(4), Step::Close];
        drawing.shape(Geometry::Path(disc.into()), filled(25));
        let text = String::from_utf8(drawing.pdf("σ")).unwrap();
        for part in [
            "/MediaBox [0 0 504 30]",
            "0.06 0 0 -0.06 0 30 cm",
            "0 0 1 RG\n4 w\n1 j\n[150 75] 0 d\n1 2 m\n3 4 l\nS\n",
            "1 2 m\n4 2 l\n4 6 l\n3 5 l\nh\nf\n",
            "2 0 m\n2 -1.1046 1.1046 -2 0 -2 c\n-1.1046 -2 -2 -1.1046 -2 0 c\n",
            "/o25 gs",
            "/o25 << /ca 0.25 >>",
            "<FEFF03C3>",
        ] {
            assert!(text.contains(part), "{part:?} is not in\n{text}");
        }
        let table = text.split("0000000000 65535 f \n").nth(1).unwrap();
        for (i, line) in table.lines().take(5).enumerate() {
            let offset: usize = line[..10].parse().unwrap();
            assert!(text[offset..].starts_with(&format!("{} 0 obj", i + 1)));
        }
    }

    #[test]
    fn numbers_have_four_decimals_at_most() {
        let written = [0.0, -0.00004, 1.5, -12.0625, 2.99996, 0.05, -0.3].map(n);
        assert_eq!(written, ["0", "0", "1.5", "-12.0625", "3", "0.05", "-0.3"]);
    }
}

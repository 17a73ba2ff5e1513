//! A figure's SVG as a one-page PDF, for LaTeX.
//!
//! Our figures use a small part of SVG (groups, paths, polylines, circles, and glyphs as paths), so
//! a small translator is enough, always in the build, and writes the same bytes everywhere. What it
//! does not know is an error, never a silently different picture.

mod path;

use super::Error;
use path::{circle, n, number, numbers, operators};
use roxmltree::{Document, Node};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Translates one SVG.
///
/// # Errors
/// An element or attribute that is not translated.
pub fn from_svg(svg: &str) -> Result<Vec<u8>, Error> {
    let document = Document::parse(svg).map_err(|e| fail(format!("not XML: {e}")))?;
    let root = document.root_element();
    let boxed = numbers(root.attribute("viewBox").unwrap_or_default())?;
    let &[_, _, w, h] = boxed.as_slice() else {
        return Err(fail("an SVG without viewBox".into()));
    };
    // CSS pixels are 3/4 of a point.
    let width = 0.75 * length(&root, "width")?;
    let scale = width / w;
    let height = scale * h;
    let mut page = Page { document: &document, content: String::new(), opacities: BTreeSet::new() };
    page.line(&format!("{} 0 0 {} 0 {} cm", n(scale), n(-scale), n(height)));
    for child in root.children().filter(Node::is_element) {
        page.element(&child, "#000000")?;
    }
    let title = root.children().find(|c| c.has_tag_name("title")).and_then(|c| c.text());
    Ok(file(&page, width, height, title.unwrap_or_default()))
}

fn fail(what: String) -> Error {
    Error::Picture(what)
}

struct Page<'a> {
    document: &'a Document<'a>,
    content: String,
    /// Opacities in use, in hundredths.
    opacities: BTreeSet<u32>,
}

impl Page<'_> {
    fn line(&mut self, operators: &str) {
        self.content.push_str(operators);
        self.content.push('\n');
    }

    fn element(&mut self, node: &Node<'_, '_>, fill: &str) -> Result<(), Error> {
        let name = node.tag_name().name();
        if matches!(name, "title" | "desc" | "defs" | "metadata") {
            return Ok(());
        }
        known_attributes(node)?;
        let filled = node.attribute("fill").unwrap_or(fill);
        let turned = transforms(node.attribute("transform").unwrap_or_default())?;
        self.line("q");
        turned.iter().for_each(|matrix| self.line(matrix));
        match name {
            "g" => {
                for child in node.children().filter(Node::is_element) {
                    self.element(&child, filled)?;
                }
            }
            "use" => {
                let id = node.attribute("href").unwrap_or_default().trim_start_matches('#');
                let glyph =
                    self.document.descendants().find(|other| other.attribute("id") == Some(id));
                let glyph = glyph.ok_or_else(|| fail(format!("no element has the id {id}")))?;
                let path = operators(glyph.attribute("d").unwrap_or_default())?;
                let (x, y) = (length(node, "x")?, length(node, "y")?);
                self.line(&format!("1 0 0 1 {} {} cm", n(x), n(y)));
                self.paint(node, filled, &path, true)?;
            }
            "path" => {
                let path = operators(node.attribute("d").unwrap_or_default())?;
                self.paint(node, filled, &path, true)?;
            }
            "polyline" | "polygon" => {
                let points = numbers(node.attribute("points").unwrap_or_default())?;
                let mut path = String::new();
                for (i, point) in points.chunks_exact(2).enumerate() {
                    let operator = if i == 0 { "m" } else { "l" };
                    let _ = writeln!(path, "{} {} {operator}", n(point[0]), n(point[1]));
                }
                if name == "polygon" {
                    path.push_str("h\n");
                }
                self.paint(node, filled, &path, !points.is_empty())?;
            }
            "rect" => {
                let side = |name| length(node, name);
                let path = format!(
                    "{} {} {} {} re\n",
                    n(side("x")?),
                    n(side("y")?),
                    n(side("width")?),
                    n(side("height")?)
                );
                self.paint(node, filled, &path, true)?;
            }
            "circle" => {
                let path = circle(length(node, "cx")?, length(node, "cy")?, length(node, "r")?);
                self.paint(node, filled, &path, true)?;
            }
            other => return Err(fail(format!("no translation for the SVG element {other}"))),
        }
        self.line("Q");
        Ok(())
    }

    /// Fills and strokes a path as the attributes of its element say.
    fn paint(
        &mut self,
        node: &Node<'_, '_>,
        fill: &str,
        path: &str,
        any: bool,
    ) -> Result<(), Error> {
        let stroke = node.attribute("stroke").unwrap_or("none");
        let operator = match (fill, stroke) {
            _ if !any => return Ok(()),
            ("none", "none") => return Ok(()),
            (_, "none") => "f",
            ("none", _) => "S",
            _ => "B",
        };
        if let Some(opacity) = node.attribute("fill-opacity") {
            let opacity: f64 = opacity.parse().map_err(|_| fail(format!("opacity {opacity}")))?;
            let hundredths = (opacity * 100.0).round() as u32;
            self.opacities.insert(hundredths);
            self.line(&format!("/o{hundredths} gs"));
        }
        if fill != "none" {
            let [r, g, b] = colour(fill)?;
            self.line(&format!("{} {} {} rg", n(r), n(g), n(b)));
        }
        if stroke != "none" {
            let [r, g, b] = colour(stroke)?;
            self.line(&format!("{} {} {} RG", n(r), n(g), n(b)));
            let width = node.attribute("stroke-width").map_or(Ok(1.0), number)?;
            self.line(&format!("{} w", n(width)));
            if node.attribute("stroke-linejoin") == Some("round") {
                self.line("1 j");
            }
            if node.attribute("stroke-linecap") == Some("round") {
                self.line("1 J");
            }
            if let Some(dashes) = node.attribute("stroke-dasharray") {
                let dashes: Vec<String> = numbers(dashes)?.into_iter().map(n).collect();
                self.line(&format!("[{}] 0 d", dashes.join(" ")));
            }
        }
        self.content.push_str(path);
        self.line(operator);
        Ok(())
    }
}

/// Refuses attributes that change a picture and are not translated.
fn known_attributes(node: &Node<'_, '_>) -> Result<(), Error> {
    const KNOWN: [&str; 24] = [
        "id",
        "class",
        "href",
        "points",
        "d",
        "x",
        "y",
        "width",
        "height",
        "cx",
        "cy",
        "r",
        "fill",
        "fill-opacity",
        "stroke",
        "stroke-width",
        "stroke-linejoin",
        "stroke-linecap",
        "stroke-dasharray",
        "transform",
        "role",
        "shape-rendering",
        "tabindex",
        "lang",
    ];
    let unknown = node.attributes().map(|a| a.name()).find(|name| {
        !KNOWN.contains(name) && !name.starts_with("aria-") && !name.starts_with("data-")
    });
    match unknown {
        Some(name) => Err(fail(format!("no translation for the SVG attribute {name}"))),
        None => Ok(()),
    }
}

/// `translate(1 2) rotate(-90) scale(3)` → one matrix operator each, in that order.
fn transforms(text: &str) -> Result<Vec<String>, Error> {
    let mut out = Vec::new();
    for part in text.split(')').map(str::trim).filter(|part| !part.is_empty()) {
        let unknown = || fail(format!("no translation for the transform {part}"));
        let (name, inner) = part.split_once('(').ok_or_else(unknown)?;
        let values = numbers(inner)?;
        let [a, b, c, d, e, f] = match (name.trim(), values.as_slice()) {
            ("translate", &[x]) => [1.0, 0.0, 0.0, 1.0, x, 0.0],
            ("translate", &[x, y]) => [1.0, 0.0, 0.0, 1.0, x, y],
            ("scale", &[s]) => [s, 0.0, 0.0, s, 0.0, 0.0],
            ("scale", &[x, y]) => [x, 0.0, 0.0, y, 0.0, 0.0],
            ("rotate", &[degrees]) => {
                let (s, c) = match degrees {
                    90.0 => (1.0, 0.0),
                    -90.0 => (-1.0, 0.0),
                    _ => {
                        let angle = degrees * std::f64::consts::PI / 180.0;
                        (pxfm::f_sin(angle), pxfm::f_cos(angle))
                    }
                };
                [c, s, -s, c, 0.0, 0.0]
            }
            _ => return Err(unknown()),
        };
        out.push(format!("{} {} {} {} {} {} cm", n(a), n(b), n(c), n(d), n(e), n(f)));
    }
    Ok(out)
}

fn colour(text: &str) -> Result<[f64; 3], Error> {
    let text = match text {
        "black" => "#000000",
        "white" => "#ffffff",
        other => other,
    };
    let hex = text.strip_prefix('#').and_then(|hex| u32::from_str_radix(hex, 16).ok());
    let hex = hex.filter(|_| text.len() == 7).ok_or_else(|| fail(format!("the colour {text}")))?;
    Ok([hex >> 16, hex >> 8 & 255, hex & 255].map(|part| f64::from(part) / 255.0))
}

/// A length; 0 where the attribute is missing.
fn length(node: &Node<'_, '_>, name: &str) -> Result<f64, Error> {
    node.attribute(name).map_or(Ok(0.0), number)
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

    fn svg(body: &str) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50\" viewBox=\"0 0 1000 500\"><title>σ</title>{body}</svg>"
        )
    }

    fn translated(body: &str) -> String {
        String::from_utf8(from_svg(&svg(body)).unwrap()).unwrap()
    }

    #[test]
    fn what_is_known_is_translated() {
        let text = translated(
            "<defs><path id=\"r1\" d=\"M0 0L10 0Q5 5 0 0Z\"/></defs>\
             <g fill=\"#ff0000\" transform=\"translate(5 6) rotate(-90) scale(2 -2)\"><use href=\"#r1\" x=\"3\" y=\"4\"/></g>\
             <polyline fill=\"none\" stroke=\"#0000ff\" stroke-width=\"4\" stroke-dasharray=\"7 5\" points=\"1,2 3,4\"/>\
             <path fill=\"none\" stroke=\"#000000\" d=\"M1,2h3v4l-1,-1z\"/>\
             <path fill=\"#000000\" d=\"M2,0a2,2 0 1 1 -4,0z\"/>\
             <circle cx=\"5\" cy=\"5\" r=\"2\" fill=\"#000000\" fill-opacity=\"0.25\"/>",
        );
        for part in [
            "/MediaBox [0 0 75 37.5]",
            "0.075 0 0 -0.075 0 37.5 cm",
            "q\n1 0 0 1 5 6 cm\n0 -1 1 0 0 0 cm\n2 0 0 -2 0 0 cm\nq\n1 0 0 1 3 4 cm\n1 0 0 rg\n0 0 m\n10 0 l\n6.6667 3.3333 3.3333 3.3333 0 0 c\nh\nf\n",
            "0 0 1 RG\n4 w\n[7 5] 0 d\n1 2 m\n3 4 l\nS\n",
            "1 2 m\n4 2 l\n4 6 l\n3 5 l\nh\nS\n",
            "2 0 m\n2 1.1046 1.1046 2 0 2 c\n-1.1046 2 -2 1.1046 -2 0 c\nh\nf\n",
            "/o25 gs",
            "/o25 << /ca 0.25 >>",
            "<FEFF03C3>",
        ] {
            assert!(text.contains(part), "{part:?} is not in\n{text}");
        }
    }

    #[test]
    fn what_is_not_known_is_an_error() {
        for body in [
            "<text>x</text>",
            "<rect width=\"1\" height=\"1\" filter=\"url(#a)\"/>",
            "<path d=\"M0 0A9 9 0 0 0 1 1\"/>",
            "<path d=\"M0\"/>",
            "<g transform=\"skewX(3)\"/>",
            "<use href=\"#none\"/>",
            "<rect fill=\"tomato\" width=\"1\" height=\"1\"/>",
            "<circle cx=\"NaN\" r=\"1\"/>",
        ] {
            assert!(matches!(from_svg(&svg(body)), Err(Error::Picture(_))), "{body}");
        }
    }

    #[test]
    fn offsets_point_at_their_objects() {
        let text = translated("");
        let table = text.split("0000000000 65535 f \n").nth(1).unwrap();
        for (i, line) in table.lines().take(5).enumerate() {
            let offset: usize = line[..10].parse().unwrap();
            assert!(text[offset..].starts_with(&format!("{} 0 obj", i + 1)));
        }
    }
}

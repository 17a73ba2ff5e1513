//! A figure's SVG → an element of the page.
//!
//! Colours become classes, so that the style sheet can give them for light and dark; glyphs are
//! shared by all figures of the page. Titles and descriptions stay.

use super::escape;
use crate::figures::palette;
use crate::report::Error;
use roxmltree::{Document, Node};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Outlines of glyphs by their id.
pub type Glyphs = BTreeMap<String, String>;

/// The element; outlines that it uses are added to `glyphs`.
///
/// # Errors
/// What is not one of our own drawings: XML that does not read, a colour without a name.
pub fn inline(svg: &str, glyphs: &mut Glyphs) -> Result<String, Error> {
    let document = Document::parse(svg).map_err(|e| Error::Picture(e.to_string()))?;
    let mut out = String::with_capacity(svg.len());
    write(document.root_element(), glyphs, &mut out)?;
    Ok(out)
}

/// The hidden element that holds the outlines.
pub fn shared(glyphs: &Glyphs) -> String {
    let mut out = String::from("<svg class=\"glyphs\" aria-hidden=\"true\"><defs>\n");
    for (id, d) in glyphs {
        let _ = writeln!(out, "<path id=\"glyph-{id}\" d=\"{d}\"/>");
    }
    out + "</defs></svg>"
}

/// A rule for each class of a colour.
pub fn rules() -> String {
    let rule = |(name, _): (&str, _)| {
        format!(
            ".fill-{name} {{ fill: var(--{name}) }}\n.stroke-{name} {{ stroke: var(--{name}) }}\n"
        )
    };
    palette().map(rule).collect()
}

fn write(node: Node<'_, '_>, glyphs: &mut Glyphs, out: &mut String) -> Result<(), Error> {
    if node.is_text() {
        // Indentation of the file.
        let text = node.text().unwrap_or_default().trim();
        out.push_str(&escape::text(text));
        return Ok(());
    }
    if !node.is_element() {
        return Ok(());
    }
    let name = node.tag_name().name();
    if name == "defs" && node.children().filter(Node::is_element).all(is_glyph) {
        for glyph in node.children().filter(Node::is_element) {
            let [id, d] = ["id", "d"].map(|name| glyph.attribute(name).unwrap_or_default());
            glyphs.insert(id.into(), d.into());
        }
        return Ok(());
    }
    let _ = write!(out, "<{name}");
    let mut classes: Vec<String> = node.attribute("class").map(String::from).into_iter().collect();
    for attribute in node.attributes().filter(|attribute| attribute.name() != "class") {
        let (key, value) = (attribute.name(), attribute.value());
        match (key, value.strip_prefix('#')) {
            ("fill" | "stroke", Some(_)) => {
                classes.push(format!("{key}-{}", colour(value)?));
                continue;
            }
            // The picture is one image to readers of a screen: its description says what is seen.
            ("aria-label", _) => {}
            ("href", Some(glyph)) => {
                let _ = write!(out, " href=\"#glyph-{glyph}\"");
            }
            _ => {
                let _ = write!(out, " {key}=\"{}\"", escape::text(value));
            }
        }
    }
    if !classes.is_empty() {
        let _ = write!(out, " class=\"{}\"", classes.join(" "));
    }
    if !node.has_children() {
        out.push_str("/>");
        return Ok(());
    }
    out.push('>');
    for child in node.children() {
        write(child, glyphs, out)?;
    }
    let _ = write!(out, "</{name}>");
    Ok(())
}

fn is_glyph(node: Node<'_, '_>) -> bool {
    node.tag_name().name() == "path" && node.has_attribute("id")
}

/// The name of a colour as the style sheet knows it.
fn colour(code: &str) -> Result<&'static str, Error> {
    let named = palette().find(|(_, colour)| colour == code);
    named.map(|(name, _)| name).ok_or_else(|| {
        Error::Picture(format!("the colour {code} has no name; give it one in figures::style"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_become_classes_and_glyphs_are_shared() {
        let svg = |colour: &str| {
            format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\">\n<title id=\"a-title\">A &lt; B</title>\
                 <defs>\n<path id=\"r1\" d=\"M0 0Z\"/>\n</defs><g fill=\"{colour}\"><use href=\"#r1\" x=\"2\"/></g></svg>"
            )
        };
        let mut glyphs = Glyphs::new();
        assert_eq!(
            inline(&svg("#222222"), &mut glyphs).unwrap(),
            "<svg role=\"img\"><title id=\"a-title\">A &lt; B</title>\
             <g class=\"fill-ink\"><use href=\"#glyph-r1\" x=\"2\"/></g></svg>"
        );
        assert!(shared(&glyphs).contains("<path id=\"glyph-r1\" d=\"M0 0Z\"/>"));
        assert!(inline(&svg("#123456"), &mut glyphs).is_err());
    }
}

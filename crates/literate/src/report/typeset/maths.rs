//! TeX → MathML → the typesetter's mathematics.
//!
//! MathML is a small tree of known elements, so a walk over it is short and refuses what it does
//! not know; TeX itself would need a parser.

use crate::report::Error;
use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};
use roxmltree::{Document, Node};
use std::fmt::Write as _;

/// Mathematics in the typesetter's own form, to stand between two `$`.
pub fn write(tex: &str, block: bool) -> Result<String, Error> {
    let fail = |what: String| Error::Typeset(format!("{tex}: {what}"));
    let converter =
        LatexToMathML::new(MathCoreConfig::default()).map_err(|_| fail("no converter".into()))?;
    let display = if block { MathDisplay::Block } else { MathDisplay::Inline };
    let made = converter.convert_with_local_state(tex, display).map_err(|e| fail(e.to_string()))?;
    let document = Document::parse(&made.mathml).map_err(|e| fail(e.to_string()))?;
    let mut out = String::new();
    children(document.root_element(), &mut out).map_err(fail)?;
    Ok(out.trim().to_string())
}

fn children(node: Node, out: &mut String) -> Result<(), String> {
    node.children().filter(Node::is_element).try_for_each(|child| element(child, out))
}

/// The i-th child, as one argument.
fn part(node: Node, i: usize) -> Result<String, String> {
    let child = node.children().filter(Node::is_element).nth(i);
    let child = child.ok_or_else(|| format!("<{}> lacks a part", node.tag_name().name()))?;
    let mut out = String::new();
    element(child, &mut out)?;
    Ok(out.trim().to_string())
}

fn element(node: Node, out: &mut String) -> Result<(), String> {
    let name = node.tag_name().name();
    let scripts = |out: &mut String, base: String, parts: &[(&str, usize)]| {
        let _ = write!(out, "attach({base}");
        for (place, i) in parts {
            let _ = write!(out, ", {place}: {}", part(node, *i)?);
        }
        out.push_str(") ");
        Ok(())
    };
    let limits = |base: String| format!("limits({base})");
    match name {
        "mi" | "mn" | "mo" => token(name, node, out),
        "mtext" => {
            let _ = write!(out, "\"{}\" ", node.text().unwrap_or_default());
            Ok(())
        }
        "mspace" => space(node, out),
        "mrow" | "mstyle" | "mpadded" => {
            let (open, close) = if is_fenced(node) { ("lr(", ") ") } else { ("", "") };
            out.push_str(open);
            children(node, out)?;
            out.push_str(close);
            Ok(())
        }
        "msub" => scripts(out, part(node, 0)?, &[("b", 1)]),
        "msup" => scripts(out, part(node, 0)?, &[("t", 1)]),
        "msubsup" => scripts(out, part(node, 0)?, &[("b", 1), ("t", 2)]),
        "munder" => scripts(out, limits(part(node, 0)?), &[("b", 1)]),
        "munderover" => scripts(out, limits(part(node, 0)?), &[("b", 1), ("t", 2)]),
        "mover" if node.attribute("accent").is_some() => {
            let accent = part(node, 1)?;
            let accent = accent.trim_start_matches('\\');
            let _ = write!(out, "accent({}, \"{accent}\") ", part(node, 0)?);
            Ok(())
        }
        "mover" => scripts(out, limits(part(node, 0)?), &[("t", 1)]),
        "mfrac" if node.attribute("linethickness") == Some("0") => {
            let _ = write!(out, "mat(delim: #none, {}; {}) ", part(node, 0)?, part(node, 1)?);
            Ok(())
        }
        "mfrac" => {
            let _ = write!(out, "frac({}, {}) ", part(node, 0)?, part(node, 1)?);
            Ok(())
        }
        "msqrt" => {
            out.push_str("sqrt(");
            children(node, out)?;
            out.push_str(") ");
            Ok(())
        }
        // Aligned lines: cells meet at `&`.
        "mtable" => {
            for (i, row) in node.children().filter(Node::is_element).enumerate() {
                out.push_str(if i > 0 { "\\ " } else { "" });
                for (j, cell) in row.children().filter(Node::is_element).enumerate() {
                    out.push_str(if j > 0 { "& " } else { "" });
                    children(cell, out)?;
                }
            }
            Ok(())
        }
        _ => Err(format!("MathML <{name}> is not known here; teach it to report::typeset")),
    }
}

/// Whether a row stands between brackets that grow with it.
fn is_fenced(row: Node) -> bool {
    let grows = |node: Option<Node>, brackets: &str| {
        node.is_some_and(|node| {
            node.tag_name().name() == "mo"
                && node.attribute("stretchy") != Some("false")
                && node.text().is_some_and(|text| brackets.contains(text))
        })
    };
    let mut inner = row.children().filter(Node::is_element);
    let (first, last) = (inner.next(), inner.next_back());
    grows(first, "([{|⌊⌈") && grows(last, ")]}|⌋⌉")
}

fn token(name: &str, node: Node, out: &mut String) -> Result<(), String> {
    let text = node.text().unwrap_or_default();
    let mut characters = text.chars();
    let word = match (characters.next(), characters.next()) {
        // An invisible operator or an empty base.
        (None, _) => "\"\"".to_string(),
        (Some('\u{2061}'..='\u{2064}'), None) => return Ok(()),
        (Some(one), None) if node.attribute("mathvariant") == Some("normal") => {
            format!("upright({})", symbol(one))
        }
        (Some(one), None) => symbol(one),
        _ if name == "mn" => format!("\"{text}\""),
        _ => format!("op(\"{text}\")"),
    };
    let _ = write!(out, "{word} ");
    Ok(())
}

/// One character as itself, whatever it means to the typesetter's own syntax.
fn symbol(c: char) -> String {
    let means = c.is_ascii() && !c.is_ascii_alphanumeric() || matches!(c, '⟨' | '⟩');
    if means { format!("\\{c}") } else { c.to_string() }
}

fn space(node: Node, out: &mut String) -> Result<(), String> {
    let shift = node.attribute("style").and_then(|style| style.strip_prefix("margin-left:"));
    let width = node.attribute("width").or(shift.map(|shift| shift.trim_end_matches(';')));
    match width {
        None => Ok(()),
        Some(width) if width.ends_with("em") => {
            let _ = write!(out, "#h({width}) ");
            Ok(())
        }
        Some(width) => Err(format!("a space of {width}")),
    }
}

#[cfg(test)]
mod tests {
    use super::write;

    #[test]
    fn each_construction_has_its_form() {
        for (tex, typeset) in [
            (r"x_1^2", "attach(x, b: 1, t: 2)"),
            (r"\frac{a}{b}", "frac(a, b)"),
            (r"\sqrt{x+y}", "sqrt(x + y )".replace('+', r"\+").as_str()),
            (r"p(\sigma)", r"p \( σ \)"),
            (r"\sin\omega t", "op(\"sin\") ω t"),
            (r"0.12", "\"0.12\""),
            (r"\hat\sigma", "accent(σ, \"ˆ\")"),
            (r"a,b;c", r"a \, b \; c"),
            (r"\langle K \rangle^2", r"\⟨ K attach(\⟩, t: 2)"),
        ] {
            assert_eq!(write(tex, false).unwrap(), typeset, "{tex}");
        }
    }

    #[test]
    fn what_is_unknown_is_refused_with_its_tex() {
        let error = write(r"\nosuchcommand", false).unwrap_err().to_string();
        assert!(error.contains(r"\nosuchcommand"), "{error}");
    }
}

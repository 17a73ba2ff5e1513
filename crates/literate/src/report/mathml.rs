//! TeX → MathML Core.

use super::Error;
use super::html::Page;
use super::mark::{Piece, bare, pieces};
use crate::figures::escape;
use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};
use std::sync::LazyLock;

static CONVERTER: LazyLock<Option<LatexToMathML>> =
    LazyLock::new(|| LatexToMathML::new(MathCoreConfig::default()).ok());

/// Plain TeX without values.
fn convert(tex: &str, display: MathDisplay) -> Result<String, Error> {
    let fail = |what: String| Error::Maths { tex: bare(tex), what };
    let converter = CONVERTER.as_ref().ok_or_else(|| fail("no converter".into()))?;
    let made = converter.convert_with_local_state(tex, display);
    made.map(|made| made.mathml).map_err(|error| fail(error.to_string()))
}

/// Whether a browser can show this TeX.
pub fn reads(tex: &str) -> Result<(), Error> {
    convert(tex, MathDisplay::Block).map(drop)
}

/// A formula, cut at its values, which open their cards: readers of a screen take a formula as a whole and would
/// not reach a button inside it. A value in a script, a root or a fraction stays in the formula and opens nothing.
pub fn write(page: &Page<'_>, tex: &str, display: MathDisplay) -> Result<String, Error> {
    let (mut out, mut part, mut depth) = (String::new(), String::new(), 0);
    for piece in pieces(tex) {
        match piece {
            Piece::Text(text) => {
                depth += braces(text);
                part.push_str(text);
            }
            Piece::Value { shown, .. } if depth != 0 => part.push_str(shown),
            Piece::Value { id, shown } => {
                // A relation keeps its distance, a bracket has none.
                let close = part.trim().is_empty() || part.trim_end().ends_with(['(', '[']);
                if !part.trim().is_empty() {
                    // The empty group keeps the space of a relation at the cut.
                    out += &convert(&format!("{part}{{}}"), display)?;
                }
                out += if close { "" } else { "\u{202f}" };
                out += &page.value(&id, &digits(shown)?);
                part = String::from("{}");
            }
        }
    }
    if out.is_empty() {
        return convert(&part, display);
    }
    if !matches!(part.trim(), "" | "{}") {
        out += &convert(&part, display)?;
    }
    Ok(format!("<span class=\"keep\">{out}</span>"))
}

/// Opening braces less closing ones, `\left` and environments among them.
fn braces(tex: &str) -> i32 {
    let count = |text: &str| tex.matches(text).count() as i32;
    count("{") - count(r"\{") - count("}") + count(r"\}") + count(r"\left")
        - count(r"\right")
        - count(r"\leftarrow")
        + count(r"\rightarrow")
        + count(r"\begin")
        - count(r"\end")
}

/// Printed digits as text, powers raised.
pub fn digits(tex: &str) -> Result<String, Error> {
    let text = tex.strip_prefix(r"\text{").and_then(|rest| rest.strip_suffix('}')).unwrap_or(tex);
    let text = text.replace(r"\,", "\u{202f}").replace(r"\%", "%").replace('-', "−");
    let text = escape(&text.replace(r"\times", "\u{202f}×\u{202f}"));
    let text = match text.split_once("^{") {
        Some((base, rest)) => match rest.split_once('}') {
            Some((power, rest)) => format!("{base}<sup>{power}</sup>{rest}"),
            None => text,
        },
        None => text,
    };
    if text.contains(['\\', '^', '_', '{']) { convert(tex, MathDisplay::Inline) } else { Ok(text) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_text() {
        assert_eq!(digits("-3.2(2)").unwrap(), "−3.2(2)");
        assert_eq!(digits(r"8.87\times10^{-4}").unwrap(), "8.87\u{202f}×\u{202f}10<sup>−4</sup>");
        assert_eq!(digits(r"\text{none}").unwrap(), "none");
        assert!(digits(r"\sigma").unwrap().starts_with("<math"));
    }
}

//! Converts formulas from TeX to MathML Core.

use super::document::{Formula, Part};
use super::tex;
use crate::print::Shown;
use math_core::{LatexToMathML, MathDisplay};
use std::sync::LazyLock;

static CONVERTER: LazyLock<LatexToMathML> = LazyLock::new(LatexToMathML::default);

/// The converter is recursive, and so are readers of what it makes.
const DEEPEST: i32 = 40;

fn convert(tex: &str, display: MathDisplay) -> Result<String, String> {
    let (mut depth, mut macros) = (0, 0);
    for sign in tex::signs(tex).filter(|sign| !sign.trim().is_empty()) {
        depth += braces(sign);
        // Each may be the argument of the one before, as in `\hat\hat x`.
        macros = if sign.len() > 1 { macros + 1 } else { 0 };
        if depth + macros > DEEPEST {
            return Err(format!("it is nested more than {DEEPEST} deep"));
        }
    }
    let made = CONVERTER.convert_with_local_state(tex, display);
    made.map(|made| made.mathml).map_err(|error| error.to_string())
}

/// Writes a formula, cut at its values, which `value` writes: screen readers would not reach a
/// button inside it. A value in a script, a root or a fraction stays in the formula as digits.
pub fn write(
    formula: &Formula,
    display: MathDisplay,
    value: impl Fn(&str, &Shown) -> String,
) -> Result<String, String> {
    let (mut out, mut tex, mut depth) = (String::new(), String::new(), 0);
    for part in &formula.0 {
        match part {
            Part::Tex(text) => {
                depth += braces(text);
                tex.push_str(text);
            }
            Part::Value { shown, .. } if depth != 0 => tex.push_str(&shown.tex()),
            Part::Value { id, shown } => {
                // A relation keeps its distance, a bracket has none.
                let close = tex.trim().is_empty() || tex.trim_end().ends_with(['(', '[']);
                if !tex.trim().is_empty() {
                    // The empty group keeps the space of a relation at the cut.
                    out += &convert(&format!("{tex}{{}}"), display)?;
                }
                out += if close { "" } else { "\u{202f}" };
                out += &value(id, shown);
                tex = String::from("{}");
            }
        }
    }
    if out.is_empty() {
        return convert(&tex, display);
    }
    if !matches!(tex.trim(), "" | "{}") {
        out += &convert(&tex, display)?;
    }
    Ok(format!("<span class=\"keep\">{out}</span>"))
}

/// Opening braces less closing ones, `\left` and environments among them.
fn braces(tex: &str) -> i32 {
    let depth = |sign| match sign {
        "{" | r"\left" | r"\begin" => 1,
        "}" | r"\right" | r"\end" => -1,
        _ => 0,
    };
    tex::signs(tex).map(depth).sum()
}

//! Converts formulas from TeX to MathML Core.

use super::document::{Formula, Part};
use super::tex;
use crate::print::Printed;
use math_core::{LatexToMathML, MathDisplay};
use std::sync::LazyLock;

static CONVERTER: LazyLock<LatexToMathML> = LazyLock::new(LatexToMathML::default);

/// The converter is recursive, and so are readers of what it makes.
const DEEPEST: i32 = 40;

fn convert(tex: &str, display: MathDisplay) -> Result<String, String> {
    let (mut depth, mut macros) = (0, 0);
    for sign in tex::signs(tex).filter(|sign| !sign.trim().is_empty()) {
        depth += brace_balance(sign);
        // Each may be the argument of the one before, as in `\hat\hat x`.
        macros = if sign.len() > 1 { macros + 1 } else { 0 };
        if depth + macros > DEEPEST {
            return Err(format!("it is nested more than {DEEPEST} deep"));
        }
    }
    let converted = CONVERTER.convert_with_local_state(tex, display);
    converted.map(|converted| converted.mathml).map_err(|error| error.to_string())
}

/// Stands beside a value at which a formula is cut, so that a relation there keeps its space.
const CUT: &str = "{}";

/// Writes a formula, cut at its values, which `value` writes: screen readers would not reach a
/// button inside it. A value in a script, a root or a fraction stays in the formula as digits.
pub fn write(
    formula: &Formula,
    display: MathDisplay,
    value: impl Fn(&str, &Printed) -> String,
) -> Result<String, String> {
    let (mut html, mut tex, mut depth) = (String::new(), String::new(), 0);
    for part in &formula.0 {
        match part {
            Part::Tex(piece) => {
                depth += brace_balance(piece);
                tex.push_str(piece);
            }
            Part::Value { printed, .. } if depth != 0 => tex.push_str(&printed.to_tex()),
            Part::Value { id, printed } => {
                let begins = tex.trim().is_empty();
                let touches = begins || tex.trim_end().ends_with(['(', '[']);
                if !begins {
                    html += &convert(&(tex + CUT), display)?;
                }
                html += if touches { "" } else { "\u{202f}" };
                html += &value(id, printed);
                tex = CUT.into();
            }
        }
    }
    if html.is_empty() {
        return convert(&tex, display);
    }
    if tex.trim() != CUT {
        html += &convert(&tex, display)?;
    }
    Ok(format!("<span class=\"keep\">{html}</span>"))
}

/// Returns the number of opening braces, `\left` and `\begin` included, less that of closing ones.
fn brace_balance(tex: &str) -> i32 {
    let depth = |sign| match sign {
        "{" | r"\left" | r"\begin" => 1,
        "}" | r"\right" | r"\end" => -1,
        _ => 0,
    };
    tex::signs(tex).map(depth).sum()
}

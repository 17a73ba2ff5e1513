//! TeX → MathML Core.

use super::Page;
use super::escape;
use crate::report::Error;
use crate::report::valued::{Piece, bare, pieces};
use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};
use std::fmt::Write as _;
use std::sync::LazyLock;

static CONVERTER: LazyLock<Option<LatexToMathML>> =
    LazyLock::new(|| LatexToMathML::new(MathCoreConfig::default()).ok());

/// Plain TeX without values.
///
/// # Errors
/// TeX that math-core does not read.
fn convert(tex: &str, display: MathDisplay) -> Result<String, Error> {
    let fail = |what: String| Error::Maths { tex: bare(tex), what };
    let converter = CONVERTER.as_ref().ok_or_else(|| fail("no converter".into()))?;
    let made = converter.convert_with_local_state(tex, display);
    made.map(|made| made.mathml).map_err(|error| fail(error.to_string()))
}

/// Mathematics whose values are buttons.
///
/// # Errors
/// As [`convert`].
pub fn write(page: &Page<'_>, tex: &str, block: bool) -> Result<String, Error> {
    let display = if block { MathDisplay::Block } else { MathDisplay::Inline };
    let mut plain = String::with_capacity(tex.len());
    let mut buttons = Vec::new();
    for piece in pieces(tex) {
        match piece {
            Piece::Tex(text) => plain.push_str(text),
            Piece::Value { id, digits } => {
                // A text of its own, to be found again in the MathML.
                let _ = write!(plain, r"\text{{@{}@}}", buttons.len());
                buttons.push(page.button(id, &shown(digits)?));
            }
        }
    }
    let mut out = convert(&plain, display)?;
    for (i, button) in buttons.iter().enumerate() {
        let place = format!("@{i}@");
        if !out.contains(&place) {
            let what = "a value is lost in it".into();
            return Err(Error::Maths { tex: bare(tex), what });
        }
        out = out.replace(&place, button);
    }
    Ok(out)
}

/// Digits as text, or as mathematics of their own where there are powers.
fn shown(digits: &str) -> Result<String, Error> {
    let text = digits.replace(r"\,", "\u{202f}").replace(r"\%", "%").replace('-', "−");
    if text.contains(['\\', '^', '_']) {
        convert(digits, MathDisplay::Inline)
    } else {
        Ok(escape::text(&text))
    }
}

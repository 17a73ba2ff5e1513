//! TeX → MathML Core.

use super::{Page, escape, lines};
use crate::report::Error;
use crate::report::mark::{Piece, bare, pieces};
use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};
use std::panic::catch_unwind;
use std::sync::LazyLock;

static CONVERTER: LazyLock<Option<LatexToMathML>> =
    LazyLock::new(|| LatexToMathML::new(MathCoreConfig::default()).ok());

/// No formula is longer, in bytes: commands without brackets that follow each other nest as well.
pub const LONGEST: usize = 4000;

/// No formula has more brackets within each other: the converter calls itself for each.
const DEEPEST: usize = 50;

/// How deep the groups of a formula go.
fn deepest(tex: &str) -> usize {
    let (mut depth, mut most) = (0_usize, 0);
    for c in tex.chars() {
        match c {
            '{' | '[' | '(' => depth += 1,
            '}' | ']' | ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        most = most.max(depth);
    }
    most
}

/// Plain TeX without values.
fn convert(tex: &str, display: MathDisplay) -> Result<String, Error> {
    let fail = |what: String| Error::Maths { tex: bare(tex), what };
    let converter = CONVERTER.as_ref().ok_or_else(|| fail("no converter".into()))?;
    if tex.len() > LONGEST || deepest(tex) > DEEPEST {
        return Err(fail(format!("longer than {LONGEST} bytes, or {DEEPEST} brackets deep")));
    }
    // The converter asserts, in builds with assertions, that no column ends inside a script.
    let made = catch_unwind(|| converter.convert_with_local_state(tex, display));
    let made = made.map_err(|_| fail("a column ends inside a part of the formula".into()))?;
    made.map(|made| made.mathml).map_err(|error| fail(error.to_string()))
}

/// A piece of mathematics that was cut at its values.
enum Part {
    /// TeX between values.
    Tex(String),
    /// The button of a value.
    Button(String),
}

/// Cuts mathematics at its values, which are buttons between the parts: readers of a screen take a
/// formula as a whole and would not reach a button inside it. A value in a script, a root or a
/// fraction stays in the formula and opens nothing.
fn parts(page: &Page<'_>, tex: &str) -> Result<Vec<Part>, Error> {
    let mut out = Vec::new();
    let (mut part, mut depth) = (String::new(), 0);
    for piece in pieces(tex) {
        match piece {
            Piece::Text(text) => {
                depth += braces(text);
                part.push_str(text);
            }
            Piece::Value { shown, .. } if depth != 0 => part.push_str(shown),
            Piece::Value { id, shown } => {
                if !part.trim().is_empty() {
                    // The empty group keeps the space of a relation at the cut.
                    out.push(Part::Tex(format!("{part}{{}}")));
                }
                // A relation keeps its distance, a bracket has none.
                let close = part.trim().is_empty() || part.trim_end().ends_with(['(', '[']);
                let blank = if close { "" } else { "\u{2009}" };
                out.push(Part::Button(blank.to_string() + &page.button(&id, &digits(shown)?)));
                part = String::from("{}");
            }
        }
    }
    if !matches!(part.trim(), "" | "{}") {
        out.push(Part::Tex(part));
    }
    Ok(out)
}

/// Mathematics in the line.
pub fn write(page: &Page<'_>, tex: &str) -> Result<String, Error> {
    let one = |part| match part {
        Part::Tex(tex) => convert(&tex, MathDisplay::Inline),
        Part::Button(button) => Ok(button),
    };
    parts(page, tex)?.into_iter().map(one).collect()
}

/// A displayed equation, in the lines that [`lines`] lets it have.
pub fn display(page: &Page<'_>, tex: &str) -> Result<String, Error> {
    let mut rows: Vec<Vec<lines::Row>> = vec![vec![vec![Vec::new()]]];
    for part in parts(page, tex)? {
        let new = match part {
            Part::Button(button) => vec![vec![vec![vec![button]]]],
            Part::Tex(tex) => formulas(lines::rows(&displayed(&tex)?)?),
        };
        append(&mut rows, new);
    }
    let span = |inner: String| format!("<span>{inner}</span>");
    let cell = |row: &lines::Row| {
        let terms: String = row.iter().map(|term| span(term.concat())).collect();
        format!("<div class=\"terms\">{terms}</div>")
    };
    let lines = rows.iter().flatten().map(cell).collect::<String>();
    Ok(match rows.first().map_or(1, Vec::len) {
        1 => lines,
        2 => format!("<div class=\"aligned\">{lines}</div>"),
        _ => format!("<div class=\"aligned two\">{lines}</div>"),
    })
}

/// The MathML of a displayed equation.
pub(super) fn displayed(tex: &str) -> Result<String, Error> {
    convert(tex, MathDisplay::Block)
}

/// Each factor as a formula of its own.
fn formulas(rows: Vec<Vec<lines::Row>>) -> Vec<Vec<lines::Row>> {
    let formula = |factor: String| format!("<math display=\"block\">{factor}</math>");
    let term =
        |term: Vec<String>| term.into_iter().filter(|f| !f.is_empty()).map(formula).collect();
    let cell = |row: lines::Row| row.into_iter().map(term).collect();
    rows.into_iter().map(|row| row.into_iter().map(cell).collect()).collect()
}

/// Goes on with `new` where `rows` end: its first term is a part of their last one, unless it begins with
/// an operator.
fn append(rows: &mut Vec<Vec<lines::Row>>, mut new: Vec<Vec<lines::Row>>) {
    if let (Some(end), Some(start)) = (
        rows.last_mut().and_then(|row| row.last_mut()),
        new.first_mut().and_then(|row| row.first_mut()),
    ) {
        let mut terms = std::mem::take(start).into_iter();
        if let (Some(last), Some(first)) = (end.last_mut(), terms.next()) {
            last.extend(first);
        }
        end.extend(terms);
    }
    let mut new = new.into_iter();
    if let (Some(last), Some(first)) = (rows.last_mut(), new.next()) {
        last.extend(first.into_iter().skip(1));
    }
    rows.extend(new);
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
    let text = escape::text(&text.replace(r"\times", "\u{202f}×\u{202f}"));
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

    #[test]
    fn depth_is_counted() {
        for (tex, depth) in [(r"x_{", 1), (r"\left( x", 1), (r"\{a\}", 0), (r"\sqrt{2} =", 0)] {
            assert_eq!(braces(tex), depth, "{tex}");
        }
    }

    #[test]
    fn unknown_commands_are_errors() {
        let error = convert(r"\nosuch x", MathDisplay::Inline).unwrap_err().to_string();
        assert!(error.contains(r"$\nosuch x$"), "{error}");
    }
}

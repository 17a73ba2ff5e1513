//! Values inside mathematics: TeX that still knows which of its digits are which value.
//!
//! Private-use characters frame id and digits; formats without cards take [`bare`] TeX, the HTML
//! writer turns each piece into a button.

pub(super) const OPEN: char = '\u{e003}';
const NEXT: char = '\u{e004}';
const CLOSE: char = '\u{e005}';

/// The digits of a value, framed.
pub fn framed(id: &str, digits: &str) -> String {
    format!("{OPEN}{id}{NEXT}{digits}{CLOSE}")
}

/// A piece of TeX.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece<'a> {
    /// TeX between values.
    Tex(&'a str),
    /// A value.
    Value {
        /// Its id.
        id: &'a str,
        /// Its digits as TeX.
        digits: &'a str,
    },
}

/// Cuts TeX at its values.
pub fn pieces(tex: &str) -> Vec<Piece<'_>> {
    let mut out = Vec::new();
    let mut rest = tex;
    while let Some((before, after)) = rest.split_once(OPEN) {
        let Some((id, after)) = after.split_once(NEXT) else { break };
        let Some((digits, after)) = after.split_once(CLOSE) else { break };
        if !before.is_empty() {
            out.push(Piece::Tex(before));
        }
        out.push(Piece::Value { id, digits });
        rest = after;
    }
    if !rest.is_empty() {
        out.push(Piece::Tex(rest));
    }
    out
}

/// TeX with the digits alone.
pub fn bare(tex: &str) -> String {
    let text = |piece| match piece {
        Piece::Tex(text) | Piece::Value { digits: text, .. } => text,
    };
    pieces(tex).into_iter().map(text).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_come_off() {
        let tex = format!(r"\sigma = {}, k = {}", framed("half", "0.1165(4)"), framed("k", "3"));
        assert_eq!(bare(&tex), r"\sigma = 0.1165(4), k = 3");
        assert_eq!(pieces(&tex)[3], Piece::Value { id: "k", digits: "3" });
        assert_eq!(bare("x_1"), "x_1");
    }
}

//! Characters for pdflatex: what is special is escaped, what is not ASCII is named.

use super::Error;
use super::mark::{Piece, pieces};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Running text.
pub fn text(text: &str) -> Result<String, Error> {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' => out.push_str(r"\textbackslash{}"),
            '{' | '}' | '$' | '&' | '#' | '%' | '_' => out.extend(['\\', c]),
            '^' => out.push_str(r"\textasciicircum{}"),
            '~' => out.push_str(r"\textasciitilde{}"),
            '<' => out.push_str(r"\textless{}"),
            '>' => out.push_str(r"\textgreater{}"),
            '|' => out.push_str(r"\textbar{}"),
            '"' => out.push_str(r"\textquotedbl{}"),
            // Two of these become one sign.
            '-' | '\'' | ',' if out.ends_with(c) => out.extend(['{', '}', c]),
            c if c.is_ascii() => out.push(c),
            // Latin letters with accents are known to T1 fonts.
            '\u{c0}'..='\u{17f}' if c != '×' && c != '÷' => out.push(c),
            c => match (in_text(c), in_maths(c)) {
                (Some(tex), _) => out.push_str(tex),
                (None, Some(tex)) => out.push_str(&format!(r"\ensuremath{{{tex}}}")),
                (None, None) => return Err(Error::NoLatex(c)),
            },
        }
    }
    Ok(out)
}

/// Mathematics: TeX already, but for characters beyond ASCII, which are written so that they may stand in `\text{…}` too.
pub fn maths(tex: &str) -> Result<String, Error> {
    let piece = |piece| match piece {
        Piece::Text(tex) => tex.to_string(),
        Piece::Value { id, shown } => value(&id, shown),
    };
    let tex: String = pieces(tex).into_iter().map(piece).collect();
    let mut out = String::with_capacity(tex.len());
    for c in tex.chars() {
        match in_text(c) {
            _ if c.is_ascii() => out.push(c),
            Some(tex) => out.push_str(&format!(r"\text{{{tex}}}")),
            None => out.push_str(&text(c.encode_utf8(&mut [0; 4]))?),
        }
    }
    Ok(out)
}

/// A value that leads to its card: the template says how.
pub fn value(id: &str, shown: &str) -> String {
    let plain = |c: u8| c.is_ascii_alphanumeric() || b"._:=,-".contains(&c);
    let one = |c: u8| if plain(c) { char::from(c).into() } else { format!("\\%{c:02X}") };
    format!("\\origin{{{}}}{{{shown}}}", id.bytes().map(one).collect::<String>())
}

/// A block of code inside `alltt`, where only `\`, `{` and `}` are special.
pub fn code(code: &str) -> Result<String, Error> {
    let mut out = String::with_capacity(code.len());
    for c in code.chars() {
        match c {
            '\\' => out.push_str(r"\textbackslash{}"),
            '{' | '}' => out.extend(['\\', c]),
            c if c.is_ascii() => out.push(c),
            c => out.push_str(&text(&c.to_string())?),
        }
    }
    Ok(out)
}

fn in_text(c: char) -> Option<&'static str> {
    Some(match c {
        '\u{a0}' => "~",
        '\u{202f}' | '\u{2009}' => r"\,",
        '\u{2011}' => "-",
        '–' => "--",
        '—' => "---",
        '‘' => "`",
        '’' => "'",
        '“' => "``",
        '”' => "''",
        '…' => r"\ldots{}",
        '§' => r"\S{}",
        '©' => r"\textcopyright{}",
        '°' => r"\textdegree{}",
        '«' => r"\guillemotleft{}",
        '»' => r"\guillemotright{}",
        '€' => r"\texteuro{}",
        _ => return None,
    })
}

/// Characters of mathematics, each with its TeX.
const MATHS: &str = r"
    α \alpha  β \beta  γ \gamma  δ \delta  ε \varepsilon  ζ \zeta  η \eta  θ \theta  κ \kappa
    λ \lambda  μ \mu  µ \mu  ν \nu  ξ \xi  π \pi  ρ \rho  σ \sigma  τ \tau  φ \phi  χ \chi  ψ \psi
    ω \omega  Γ \Gamma  Δ \Delta  Θ \Theta  Λ \Lambda  Π \Pi  Σ \Sigma  Φ \Phi  Ψ \Psi  Ω \Omega
    ≤ \le  ≥ \ge  ≪ \ll  ≫ \gg  ≈ \approx  ≠ \ne  ≲ \lesssim  ≳ \gtrsim  ∼ \sim  ∝ \propto  ± \pm
    − -  × \times  ÷ \div  · \cdot  ∗ \ast  √ \surd  ∞ \infty  → \to  ← \leftarrow  ↦ \mapsto
    ⇒ \Rightarrow  ∈ \in  ∑ \sum  ∏ \prod  ∫ \int  ∂ \partial  ⌈ \lceil  ⌉ \rceil  ⌊ \lfloor
    ⌋ \rfloor  ′ '  ✓ \checkmark  ✗ \times  ⁰ ^0  ¹ ^1  ² ^2  ³ ^3  ⁴ ^4  ⁵ ^5  ⁶ ^6  ⁷ ^7  ⁸ ^8
    ⁹ ^9  ⁻ ^-  ₀ _0  ₁ _1  ₂ _2  ₃ _3  ₄ _4  ₅ _5  ₆ _6  ₇ _7  ₈ _8  ₉ _9  ₊ _+  ₋ _-  ½ \frac12
    ¼ \frac14";

/// The same as a map, by which [`super::spell`] finds characters too.
pub(super) static TEX: LazyLock<BTreeMap<&str, &str>> = LazyLock::new(|| {
    let words: Vec<&str> = MATHS.split_whitespace().collect();
    words.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
});

fn in_maths(c: char) -> Option<&'static str> {
    TEX.get(&*c.encode_utf8(&mut [0; 4])).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_stops_pdflatex_is_left() {
        assert_eq!(
            text("50 % of σ ≥ 1–2 «x_1»").unwrap(),
            r"50 \% of \ensuremath{\sigma} \ensuremath{\ge} 1--2 \guillemotleft{}x\_1\guillemotright{}"
        );
        assert_eq!(maths("σ+1 – x").unwrap(), r"\ensuremath{\sigma}+1 \text{--} x");
        let words = r"\text{größer → {é}}→";
        assert_eq!(maths(words).unwrap(), r"\text{größer \ensuremath{\to} {é}}\ensuremath{\to}");
        assert_eq!(code(r"a\{b_1}").unwrap(), r"a\textbackslash{}\{b_1\}");
        assert_eq!(text("é").unwrap(), "é");
    }
}

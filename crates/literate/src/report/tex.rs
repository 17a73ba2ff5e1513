//! Writes characters for pdflatex, knows the macros of every format, and spells formulas in words.
//!
//! GitHub renders mathematics by MathJax 3 without the packages that define macros, or add HTML,
//! actions and boxes. It refuses a formula that names one of a list of macros, `\operatorname`
//! among them, and shows the source of an unknown macro in red. So mathematics is checked against a
//! list of macros that are known there, to LaTeX with amsmath, and to math-core.

use crate::table::nearest;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

/// Escapes running text: special characters get a backslash, others beyond ASCII a name.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            'a'..='z' | 'A'..='Z' | '0'..='9' | ' ' => escaped.push(c),
            '\\' => escaped.push_str(r"\textbackslash{}"),
            '{' | '}' | '$' | '&' | '#' | '%' | '_' => escaped.extend(['\\', c]),
            '^' => escaped.push_str(r"\textasciicircum{}"),
            '~' => escaped.push_str(r"\textasciitilde{}"),
            '<' => escaped.push_str(r"\textless{}"),
            '>' => escaped.push_str(r"\textgreater{}"),
            '|' => escaped.push_str(r"\textbar{}"),
            '`' => escaped.push_str(r"\textasciigrave{}"),
            '"' => escaped.push_str(r"\textquotedbl{}"),
            // Two of these become one sign.
            '-' | '\'' | ',' if escaped.ends_with(c) => escaped.extend(['{', '}', c]),
            c => match (in_text(c), in_maths(c)) {
                (Some(tex), _) => escaped.push_str(tex),
                (None, Some(tex)) => escaped.push_str(&format!(r"\ensuremath{{{tex}}}")),
                (None, None) => escaped.push(c),
            },
        }
    }
    escaped
}

/// Returns the characters that pdflatex does not know; T1 fonts have most letters with accents.
pub fn unknown(tex: &str) -> BTreeSet<char> {
    let is_known = |c| ('\u{c0}'..='\u{17f}').contains(&c) && !"ĦħĸĿŀŉŦŧſ".contains(c);
    tex.chars().filter(|c| !c.is_ascii() && !is_known(*c)).collect()
}

/// Writes the characters of a formula beyond ASCII as macros, which may stand in `\text{…}` too.
pub fn escape_formula(tex: &str) -> String {
    let named = |c: char| match in_text(c) {
        _ if c.is_ascii() => c.to_string(),
        Some(tex) => format!(r"\text{{{tex}}}"),
        None => escape(&c.to_string()),
    };
    tex.chars().map(named).collect()
}

/// Writes a value that leads to its card by the macro `\origin` of the template.
pub fn origin_link(id: &str, printed: &str) -> String {
    let is_safe = |c: u8| c.is_ascii_alphanumeric() || b"._:=,-".contains(&c);
    let escaped = |c| if is_safe(c) { char::from(c).into() } else { format!("\\%{c:02X}") };
    let address: String = id.bytes().map(escaped).collect();
    format!("\\origin{{{address}}}{{{printed}}}")
}

/// Escapes a block of code inside `alltt`, where only `\`, `{` and `}` are special.
pub fn escape_code(code: &str) -> String {
    let is_plain = |c: char| c.is_ascii() && !['\\', '{', '}'].contains(&c);
    let escaped = |c: char| if is_plain(c) { c.to_string() } else { escape(&c.to_string()) };
    code.chars().map(escaped).collect()
}

fn in_text(c: char) -> Option<&'static str> {
    match c {
        '\u{a0}' => Some("~"),
        '\u{202f}' | '\u{2009}' => Some(r"\,"),
        c => NAMED[0].get(&*c.encode_utf8(&mut [0; 4])).copied(),
    }
}

pub fn pairs(list: &str) -> BTreeMap<&str, &str> {
    let words: Vec<&str> = list.split_whitespace().collect();
    words.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
}

/// Characters with their names in running text and in formulas, which spell formulas too.
static NAMED: LazyLock<[BTreeMap<&str, &str>; 2]> = LazyLock::new(|| {
    let (text, maths) = include_str!("characters.txt").split_once("\n\n").unwrap_or_default();
    [text, maths].map(pairs)
});

/// Returns the name of a letter: `sigma` for σ.
pub fn letter_name(c: char) -> Option<&'static str> {
    let name = in_maths(c)?.strip_prefix('\\')?;
    c.is_alphabetic().then_some(name)
}

fn in_maths(c: char) -> Option<&'static str> {
    NAMED[1].get(&*c.encode_utf8(&mut [0; 4])).copied()
}

/// The macros that the manual lists, and those of environments.
static ALLOWED: LazyLock<BTreeSet<&str>> = LazyLock::new(|| {
    let page = include_str!("../manual.md").split_once("The macros are these").unwrap_or_default();
    let listed = page.1.split_whitespace().filter_map(|word| word.strip_prefix('\\'));
    let is_name = |name: &&str| name.starts_with(|c: char| c.is_ascii_alphabetic());
    listed.filter(is_name).chain(["tag", "begin", "end"]).collect()
});

const ENVIRONMENTS: [&str; 5] = ["aligned", "cases", "matrix", "pmatrix", "bmatrix"];

/// The signs of a formula: a macro, as `\alpha`, a backslash with what it escapes, or a character.
pub fn signs(tex: &str) -> impl Iterator<Item = &str> {
    let mut rest = tex;
    std::iter::from_fn(move || {
        let first = rest.chars().next()?;
        let after = &rest[first.len_utf8()..];
        let length = match after.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(after.len()) {
            _ if first != '\\' => 0,
            0 => after.chars().next().map_or(0, char::len_utf8),
            letters => letters,
        };
        let (sign, after) = rest.split_at(first.len_utf8() + length);
        rest = after;
        Some(sign)
    })
}

/// Returns what is wrong with a formula: an environment, or its first macro, that not every format
/// supports, or a sign that must be escaped in LaTeX. (An environment needs its &.)
pub fn unsupported(tex: &str) -> Option<String> {
    let mut environments = tex.split(r"\begin{").skip(1).filter_map(|rest| rest.split('}').next());
    if !environments.all(|name| ENVIRONMENTS.contains(&name)) {
        return Some(format!("an environment must be one of {}", ENVIRONMENTS.join(", ")));
    }
    signs(tex).find_map(|sign| {
        Some(match sign {
            "%" | "#" | "$" => format!("{sign} must be escaped in LaTeX; write \\{sign}"),
            r"\\" if !tex.contains(r"\begin{") => {
                r"a line break \\ must stand in \begin{aligned}".into()
            }
            r"\operatorname" => r"\operatorname is not rendered by GitHub; write \mathrm{…}".into(),
            _ => {
                let name = sign.strip_prefix('\\').filter(|name| !ALLOWED.contains(name))?;
                name.starts_with(|c: char| c.is_ascii_alphabetic()).then_some(())?;
                let nearest = nearest(name, ALLOWED.iter().copied()).join(r", \");
                format!(r"{sign} is not supported by every format; nearest: \{nearest}")
            }
        })
    })
}

/// Spells a formula in characters: `p_{\mathrm{crit}}` as `p_crit`, `\sqrt{N+1}` as `√(N+1)`. An
/// unknown name stands without its backslash.
pub fn spell(tex: &str) -> String {
    let (mut spelt, mut signs) = (String::new(), signs(tex).peekable());
    while signs.peek().is_some() {
        spelt += &spell_group(&mut signs);
    }
    spelt
}

/// Spells signs up to the brace that ends their group, which is taken too.
fn spell_group<'a>(signs: &mut impl Iterator<Item = &'a str>) -> String {
    let mut spelt = String::new();
    while let Some(sign) = signs.next() {
        match sign {
            "}" => break,
            "{" => spelt += &spell_group(signs),
            r"\begin" | r"\end" => while signs.next().is_some_and(|sign| sign != "}") {},
            r"\sqrt" => spelt += &format!("√{}", spell_argument(signs)),
            r"\frac" | r"\dfrac" | r"\tfrac" => {
                spelt += &format!("{}/{}", spell_argument(signs), spell_argument(signs));
            }
            "&" => (),
            "~" => spelt.push(' '),
            sign => spelt.push_str(sign.strip_prefix('\\').map_or(sign, spell_macro)),
        }
    }
    spelt
}

/// Spells the argument of a macro, in brackets if it is a sum or a quotient.
fn spell_argument<'a>(signs: &mut impl Iterator<Item = &'a str>) -> String {
    let argument = match signs.find(|sign| *sign != " ") {
        Some("{") => spell_group(signs),
        sign => sign.map_or("", |sign| sign.strip_prefix('\\').map_or(sign, spell_macro)).into(),
    };
    let is_joined = argument.trim().contains(['+', '-', '−', '±', '/', ' ']);
    if is_joined { format!("({})", argument.trim()) } else { argument }
}

/// Macros that no character of a formula has for its name.
static SPELT: LazyLock<BTreeMap<&str, &str>> = LazyLock::new(|| {
    pairs("epsilon ε  varphi φ  leq ≤  geq ≥  lt <  gt >  vert |  sqrt √  dots …  ldots …")
});

fn spell_macro(name: &str) -> &str {
    match name {
        "mathrm" | "mathit" | "mathbf" | "mathbb" | "mathcal" | "mathsf" | "boldsymbol"
        | "text" | "left" | "right" | "operatorname" | "frac" | "dfrac" | "tfrac" | "bar"
        | "hat" | "tilde" | "vec" | "dot" | "ddot" | "overline" | "begin" | "end" | "!" => "",
        "," | ";" | ":" | " " | "quad" | "qquad" | "thinspace" | "\\" => " ",
        other => {
            let is_named = |tex: &str| tex.strip_prefix('\\') == Some(other);
            let character = NAMED[1].iter().find(|(_, tex)| is_named(tex));
            character.map(|(character, _)| character).or(SPELT.get(other)).unwrap_or(&other)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_spelt_in_characters() {
        for (tex, words) in [
            (r"p_{\mathrm{crit}} \ge \sigma^{-3}", "p_crit ≥ σ^-3"),
            (r"\frac{1}{2}\,\dot x \in \mathbb{R}", "1/2  x ∈ R"),
            (
                r"\left(\frac{1+\sqrt{N+1}}{N}\right)^2 = \frac12 \sqrt2",
                "((1+√(N+1))/N)^2 = 1/2 √2",
            ),
            (r"\begin{aligned} a &= b \\ c &= d \end{aligned}", " a = b   c = d "),
        ] {
            assert_eq!(spell(tex), words);
        }
    }

    #[test]
    fn nothing_that_stops_pdflatex_is_left() {
        assert_eq!(
            escape("50 % of σ ≥ 1–2 «x_1»"),
            r"50 \% of \ensuremath{\sigma} \ensuremath{\ge} 1--2 \guillemotleft{}x\_1\guillemotright{}"
        );
        assert_eq!(escape_formula("σ+1 – x"), r"\ensuremath{\sigma}+1 \text{--} x");
        let words = r"\text{größer → {é}}→";
        assert_eq!(escape_formula(words), r"\text{größer \ensuremath{\to} {é}}\ensuremath{\to}");
        assert_eq!(escape_code(r"a\{b_1}"), r"a\textbackslash{}\{b_1\}");
        assert_eq!(escape("é"), "é");
    }
}

//! Mathematics for terminals: the little TeX of titles, notes and values as characters.

use super::tex::TEX;

/// Text in which mathematics stands between dollars.
pub fn text(text: &str) -> String {
    let piece =
        |(i, piece): (usize, &str)| if i % 2 == 0 { piece.to_string() } else { maths(piece) };
    text.split('$').enumerate().map(piece).collect()
}

/// `p_{\mathrm{crit}}` as `p_crit`, `\sigma^{-3}` as `σ^-3`. A name that is not known stands without its backslash.
pub fn maths(tex: &str) -> String {
    let mut out = String::new();
    let mut rest = tex;
    while let Some(c) = rest.chars().next() {
        rest = &rest[c.len_utf8()..];
        match c {
            '\\' => {
                let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
                let end = if end > 0 { end } else { rest.chars().next().map_or(0, char::len_utf8) };
                let (name, after) = rest.split_at(end);
                rest = after;
                out.push_str(named(name));
            }
            '{' | '}' => (),
            '~' => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

fn named(name: &str) -> &str {
    match name {
        "epsilon" => "ε",
        "varphi" => "φ",
        "leq" => "≤",
        "geq" => "≥",
        "lt" => "<",
        "gt" => ">",
        "vert" => "|",
        "sqrt" => "√",
        "dots" | "ldots" => "…",
        "mathrm" | "mathit" | "mathbf" | "text" | "left" | "right" | "operatorname" | "!" => "",
        "," | ";" | ":" | " " | "quad" | "thinspace" => " ",
        other => {
            let is = |tex: &str| tex.strip_prefix('\\') == Some(other);
            TEX.iter().find(|(_, tex)| is(tex)).map_or(other, |(character, _)| character)
        }
    }
}

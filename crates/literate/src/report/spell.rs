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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tex_is_read_aloud() {
        for (tex, told) in [
            (r"p_{\mathrm{crit}}", "p_crit"),
            (r"f_{N,p}(k)", "f_N,p(k)"),
            (r"\mathrm{tol} = 10^{-3}", "tol = 10^-3"),
            (r"k_\pm", "k_±"),
            (r"\phi_N^1(k)", "φ_N^1(k)"),
            (r"\Delta_j(t)", "Δ_j(t)"),
            (r"8.87\times10^{-4}\,\%", "8.87×10^-4 %"),
            (r"a_{b", "a_b"),
            ("x^", "x^"),
            ("\\", ""),
        ] {
            assert_eq!(maths(tex), told);
        }
        assert_eq!(text(r"Runge–Kutta with $\sigma_i$, 3"), "Runge–Kutta with σ_i, 3");
    }
}

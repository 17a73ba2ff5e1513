//! The TeX that every format of the report shows.
//!
//! The largest host of Markdown draws mathematics by MathJax 3 with some packages taken away (those that
//! define macros, or bring HTML, actions and boxes) and refuses a formula that names one of a list of
//! macros, `\operatorname` among them; of a macro that is not known it shows the source in red. So
//! mathematics is held against a list of what is known there, to LaTeX with amsmath, and to math-core.

use super::mathml::LONGEST;
use crate::input::is_no_text;

/// Macros, by kind.
const ALLOWED: &str = "
    alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa lambda mu nu xi pi rho
    varrho sigma varsigma tau upsilon phi varphi chi psi omega
    Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega
    frac dfrac tfrac binom sqrt sum prod int iint oint partial nabla infty ell hbar prime
    le leq ge geq lt gt ne neq ll gg lesssim gtrsim approx sim simeq equiv propto in notin subset to mapsto
    rightarrow leftarrow Rightarrow Leftrightarrow longrightarrow iff implies land lor wedge vee neg forall exists
    cup cap bigcup bigcap setminus emptyset varnothing subseteq supset supseteq mid parallel perp top cong
    pm mp times div cdot cdots dots ldots vdots ddots ast star circ oplus otimes dagger colon leqslant geqslant
    left right bigl bigr Bigl Bigr biggl biggr big Big langle rangle lceil rceil lfloor rfloor
    lbrace rbrace lvert rvert lVert rVert vert Vert
    sin cos tan cot sinh cosh tanh coth arcsin arccos arctan exp ln log max min sup inf lim limsup liminf det dim deg Pr arg Re Im
    bmod pmod overset underset mathring mathfrak textbf
    bar hat tilde vec dot ddot overline underline widehat overbrace underbrace
    mathrm mathbf mathbb mathcal mathit mathsf boldsymbol text textrm
    quad qquad thinspace negthinspace limits nolimits displaystyle textstyle tag begin end";

/// Environments of displayed equations.
const ENVIRONMENTS: &str = "aligned cases matrix pmatrix bmatrix";

/// What is wrong with a formula: its first macro or environment that not every format shows.
pub fn refused(tex: &str) -> Option<String> {
    let known = |list: &str, name: &str| list.split_whitespace().any(|own| own == name);
    let mut rest = tex;
    while let Some((before, after)) = rest.split_once('\\') {
        if let Some(what) = bare(before) {
            return Some(what);
        }
        let name = &after[..after.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(after.len())];
        rest = &after[name.len()..];
        if name.is_empty() && after.starts_with('\\') && !tex.contains(r"\begin{") {
            return Some(r"a break \\ of lines stands in \begin{aligned}".into());
        } else if name.is_empty() {
            // `\,` and its like: one character, which may be a backslash.
            rest = after.get(after.chars().next().map_or(0, char::len_utf8)..).unwrap_or_default();
        } else if name == "operatorname" {
            return Some(r"\operatorname is refused by hosts; write \mathrm{…}".into());
        } else if !known(ALLOWED, name) {
            return Some(format!(
                r"\{name} is not among the macros that every format shows (report::macros lists them)"
            ));
        } else if name == "begin" {
            let inner = rest.strip_prefix('{').and_then(|rest| rest.split_once('}'));
            let environment = inner.map_or("", |(name, _)| name);
            if !known(ENVIRONMENTS, environment) {
                return Some(format!(
                    r"the environment {environment:?} is not one that every format shows; use {}",
                    ENVIRONMENTS.replace(' ', ", ")
                ));
            }
        }
    }
    bare(rest)
}

/// How many arguments a macro takes.
fn arguments(name: &str) -> usize {
    const ONE: &str = "pmod mathring mathfrak textbf sqrt bar hat tilde vec dot ddot overline underline widehat overbrace underbrace mathrm mathbf \
        mathbb mathcal mathit mathsf boldsymbol text textrm";
    let among = |list: &str| list.split_whitespace().any(|own| own == name);
    if among("frac dfrac tfrac binom overset underset") { 2 } else { usize::from(among(ONE)) }
}

/// The first macro with arguments of its own, or value, that stands, without brackets, where LaTeX takes one sign.
/// Values are framed (see [`super::mark`]).
pub fn ungrouped(tex: &str) -> Option<String> {
    // Longer formulas are refused as such.
    if tex.len() > LONGEST {
        return None;
    }
    let macro_of = |text: &str| -> Option<String> {
        let name = text.strip_prefix('\\')?;
        Some(name.chars().take_while(char::is_ascii_alphabetic).collect())
    };
    let wrong = |argument: &str| {
        if argument.trim_start().starts_with(is_no_text) {
            return Some("a value is an index or an argument here; put it into {…}".into());
        }
        let name = macro_of(argument.trim_start())?;
        let takes = arguments(&name) > 0 || name == "left" || name == "begin";
        takes.then(|| format!(r"\{name} is an argument here; put it into {{…}}"))
    };
    let mut at = 0;
    while let Some(offset) = tex[at..].find(['^', '_', '\\']) {
        at += offset;
        let Some(name) = macro_of(&tex[at..]) else {
            at += 1;
            if let Some(what) = wrong(&tex[at..]) {
                return Some(what);
            }
            continue;
        };
        // `\_` and its like are signs.
        at += 1 + name.len().max(tex[at + 1..].chars().next().map_or(0, char::len_utf8));
        let mut rest = &tex[at..];
        for _ in 0..arguments(&name) {
            if let Some(what) = wrong(rest) {
                return Some(what);
            }
            rest = behind(rest.trim_start());
        }
    }
    None
}

/// What is behind the first group or sign of a text.
fn behind(text: &str) -> &str {
    let mut depth = 0_i32;
    for (i, c) in text.char_indices() {
        depth += i32::from("{[".contains(c)) - i32::from("}]".contains(c));
        if depth <= 0 {
            return &text[i + c.len_utf8()..];
        }
    }
    ""
}

/// The first sign with a meaning of its own in LaTeX between macros. (Columns of an environment keep their &.)
fn bare(between: &str) -> Option<String> {
    let sign = between.chars().find(|c| matches!(c, '%' | '#' | '$'))?;
    Some(format!("a bare {sign} is no sign in LaTeX; write \\{sign}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_hosts_refuse_is_named() {
        for tex in [
            r"\frac{1}{2}\,\mathrm{erf}(x)",
            r"\begin{aligned} a \end{aligned}",
            r"\{x\}",
            r"50\,\% \& \# x",
            r"\_\sqrt{2} a^\ast \frac{\sqrt{2}}{\left( a \right)}\sqrt{x^{\frac12}} \sqrt[3]{a}",
            "x",
        ] {
            assert_eq!(refused(tex).or_else(|| ungrouped(tex)), None, "{tex}");
        }
        for (tex, name) in [
            (r"x + \operatorname{erf} x", "mathrm"),
            (r"\phantom{x}", r"\phantom "),
            (r"\newcommand{\a}{b}", r"\newcommand "),
            (r"\,\bbox{x}", r"\bbox "),
            ("50 % x", r"write \%"),
            (r"\alpha % x", r"write \%"),
            (r"n # \alpha", r"write \#"),
            (r"\,\sigmma", r"\sigmma "),
            (r"a \\ b", r"\begin{aligned}"),
            (r"\begin{align} a \end{align}", "\"align\""),
            (r"\frac{1}\sqrt{2}", r"\sqrt is an argument"),
            (r"\frac{1} \left[ a \right]", r"\left is an argument"),
            (r"x^\overline{a}", r"\overline is"),
            (r"\Phi_ \sqrt{a}", r"\sqrt is"),
            ("x^\u{e000}n\u{e001}12\u{e002}", "a value is"),
            ("\\frac{1}\u{e000}n\u{e001}12\u{e002}", "a value is"),
        ] {
            let told = refused(tex).or_else(|| ungrouped(tex)).unwrap_or_default();
            assert!(told.contains(name), "{tex}: {told}");
        }
    }

    /// Each macro is one that math-core reads too.
    #[test]
    fn what_is_allowed_is_read() {
        let with_brackets = |name: &str| match name {
            "frac" | "dfrac" | "tfrac" | "binom" | "overset" | "underset" => {
                format!(r"\{name}{{a}}{{b}}")
            }
            "left" | "right" => r"\left( a \right)".into(),
            "begin" | "end" => r"\begin{aligned} a &= b \\ c &= d \end{aligned}".into(),
            "tag" => "a".into(),
            name if name.starts_with(['b', 'B']) && name.to_lowercase().starts_with("big") => {
                format!(r"\{name}(")
            }
            "limits" | "nolimits" => format!(r"\int\{name}_a"),
            name => format!(r"\{name} {{a}}"),
        };
        for name in ALLOWED.split_whitespace() {
            let tex = with_brackets(name);
            assert!(
                super::super::mathml::reads(&tex).is_ok(),
                "{tex}: {:?}",
                super::super::mathml::reads(&tex)
            );
        }
    }
}

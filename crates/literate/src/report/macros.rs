//! The TeX that every format of the report shows.
//!
//! The largest host of Markdown draws mathematics by MathJax 3 with some packages taken away (those that
//! define macros, or bring HTML, actions and boxes) and refuses a formula that names one of a list of
//! macros, `\operatorname` among them; of a macro that is not known it shows the source in red. So
//! mathematics is held against a list of what is known there, to LaTeX with amsmath, and to math-core.

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
const ENVIRONMENTS: [&str; 5] = ["aligned", "cases", "matrix", "pmatrix", "bmatrix"];

/// What is wrong with a formula: its first macro or environment that not every format shows, or a value that stands
/// where TeX takes one sign.
pub fn refused(tex: &str) -> Option<String> {
    let mark = |sign: char| tex.split(sign).skip(1).any(|rest| rest.starts_with(is_no_text));
    if mark('^') || mark('_') {
        return Some("a value is an index here; put it into {…}".into());
    }
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
        } else if !ALLOWED.split_whitespace().any(|own| own == name) {
            return Some(format!(
                r"\{name} is not among the macros that every format shows (the manual lists them)"
            ));
        } else if name == "begin"
            && !ENVIRONMENTS.iter().any(|own| rest.starts_with(&format!("{{{own}}}")))
        {
            return Some(format!("an environment is {}", ENVIRONMENTS.join(", ")));
        }
    }
    bare(rest)
}

/// The first sign with a meaning of its own in LaTeX between macros. (Columns of an environment keep their &.)
fn bare(between: &str) -> Option<String> {
    let sign = between.chars().find(|c| matches!(c, '%' | '#' | '$'))?;
    Some(format!("a bare {sign} is no sign in LaTeX; write \\{sign}"))
}

//! The prose: numerals, Tera, Markdown, references, and all that is written of it.

use super::entries::written;
use super::mutants::{committed, is_one_line, survives};
use crate::quick::QUICK;
use impact_paper::report::claims::{Row, scorecard};
use impact_paper::report::filler::Filler;
use impact_paper::report::lint::{Declared, findings};
use impact_paper::report::{Error, PROGRAM, Registry, Templates};
use std::sync::LazyLock;

/// What the prose of the quick profile may name.
static NAMED: LazyLock<(Registry, Vec<Row>)> = LazyLock::new(|| {
    let mut values = QUICK.values.clone();
    values.extend(scorecard(&QUICK.claims)).unwrap();
    (values, QUICK.claims.iter().map(Row::of).collect())
});

/// Everything that prose can have, in little.
const SMALL: &str = r#"# A title

## Introduction {#sec:introduction}

Masses in a row ([@rice1945]; see [@fig:3], [@eq:18; @eq:25] and [@sec:protocol]). With
«sweep.rise.half_height» and $\sigma = «sweep.rise.half_height»$, the $n$-th mass of $f_{N,p}(k)$ and
$\Phi'_{N,p}\,(k) < 1$ moves *fast*, **very** fast, at 100 % of `a_b` [here](https://x.org).

$$
p_{\mathrm{crit}} = \left(\frac{1 + \sqrt{N+1}}{N}\right)^2 \tag{18}
$$

where $N$ is large, so
$$
\begin{aligned} a &= b \\ c &= \binom{n}{k} \sum_{k=1}^{N} d \end{aligned} \tag{25}
$$

![The rise, at «sweep.rise.half_height | significant(digits=3)» or $\sigma$ ≥ 0.12.](figures/fig03.svg)

### The protocol {#sec:protocol}

Table: What σ gives {#tab:sigma}

| Check | Statement | Ours |
|:--|---|--:|
<% for c in claims %><% if loop.index < 4 %>| [!claim:«c.id»] | «c.statement»: «c.ours» | «sweep.rise.half_height | percent | significant(digits=1)» |
<% endif %><% endfor %>
1. one
2. two

   more
- x
  - y

> An aside.

Scene: They move.

Listing: What $\delta v$ does. {#lst:kick}

«code(item="dynamics::flight::Motion::kick")»

## References {.unnumbered}

[@bibliography]
"#;

/// What the assembly makes of a text, but for pictures.
fn made(text: &str) -> Result<usize, Error> {
    let declared = Declared::read(&committed("templates/literals.toml"))?;
    findings("report.md", text, &declared);
    let templates = Templates::of([("report.md", text)]);
    let (values, claims) = &*NAMED;
    let mut filler = Filler::new(&templates, values, PROGRAM)?;
    filler.insert("claims", claims);
    for (name, rows) in &QUICK.rows {
        filler.insert(name, rows);
    }
    written(&filler.fill("report.md")?, values)
}

#[test]
fn prose_of_any_text() {
    let good = [SMALL.to_string()];
    LazyLock::force(&NAMED);
    survives("prose", &good, 600, "", |text| {
        let long = made(text).map_err(|error| error.to_string())?;
        assert!(long < 1 << 26, "{long} bytes");
        Ok(())
    });
}

/// Texts that once broke something, or that nest and repeat beyond what chance finds; the words
/// of the refusal, or `?` where it is enough that there is an answer.
#[test]
fn prose_that_is_made_to_hurt() {
    let nested = |open: &str, close: &str| {
        let (open, close) = (open.repeat(50_000), close.repeat(50_000));
        format!("# T\n\n{open}x{close}\n")
    };
    let maths = |open: &str, close: &str| {
        let times = 3900 / (open.len() + close.len());
        let (open, close) = (open.repeat(times), close.repeat(times));
        format!("# T\n\n$$\n{open}x{close}\n$$\n")
    };
    for (text, word) in [
        (nested("> ", ""), "levels"),
        (nested("- ", ""), "levels"),
        (nested("*a ", " a*"), "levels"),
        (nested("<% if true %>", "<% endif %>"), "too deep"),
        (nested("«(", ")»"), "?"),
        (maths("{", "}"), "brackets"),
        (maths("\\sqrt{", "}"), "brackets"),
        (maths("\\left(", "\\right)"), "brackets"),
        (maths("\\begin{cases}", "\\end{cases}"), "?"),
        (maths("\\sqrt", ""), "?"),
        (maths("x^", ""), "?"),
        (format!("# T\n\n$$\n{} x\n$$\n", "\\sqrt".repeat(9000)), "longer"),
        ("# T\n\n$$\n\\begin{aligned} a &^{N} d \\end{aligned}\n$$\n".into(), "?"),
        ("# T\n\n«sweep.rise.half_height | significant(digits=70000)»\n".into(), "digits"),
        ("# T\n\n«sweep.rise.half_height | significant(digits=99999999999)»\n".into(), "digits"),
        ("# T\n\n\u{e000}half_height\u{e002}significant99999999\u{e001}\n".into(), "?"),
        ("<% include \"report.md\" %>".into(), "no template has a tag"),
        (format!("«\"a\"{}»", "|replace(from=\"a\", to=\"aaaaaaaa\")".repeat(8)), "filter \"replace\""),
        ("<% for a in range(end=100000) %><% for b in range(end=100000) %>xxxxxxxxxxxxxxxx<% endfor %><% endfor %>".into(), "look for a loop"),
        ("# T\n\n".to_string() + &"<# $ ` {# [@ ".repeat(40_000), "?"),
    ] {
        let shown: String = text.chars().take(60).collect();
        let began = std::time::Instant::now();
        let made = std::thread::spawn(move || made(&text)).join();
        let made = made.unwrap_or_else(|_| panic!("{shown} panics"));
        let time = began.elapsed();
        // No text hangs, on a busy machine either.
        assert!(time.as_secs() < 60, "{shown} takes {time:?}");
        let line = made.err().map_or("?".to_string(), |error| error.to_string());
        assert!((word == "?" || line.contains(word)) && is_one_line(&line), "{shown}: {line}");
    }
}

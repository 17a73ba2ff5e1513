//! A report of one document that uses everything, and everything that can be wrong with it.

mod broken;
mod data;
mod documents;

use super::*;
use crate::claims::{Check, Kind};
use crate::figures::Figure;
use crate::figures::prelude::{HPos, INK, Sheet, VPos, words};
use crate::project::Project;
use crate::prose::Templates;
use crate::source::toy;
use crate::table::{DataFile, Table, Tables};
use impact_numerics::estimates::with_error;
use std::sync::Arc;

const BIB: &str = "@article{rice1945, author={Rice, S. O.}, title={Noise}, journal={B}, year=1945}";

const SAMPLE: &str = r#"# Impact\_dynamics & large % systems: R&D $\sigma_{1/2}$

## Introduction {#sec:introduction}

Masses in a row ([@rice1945]; see [@fig:3], [@eq:18; @eq:25] and [@sec:protocol]). With
«v.half_height» and $\sigma = «v.half_height»$, far below «v.tiny» or «v.least», the $n$-th mass of
$f_{N,p}(k)$ and $\Phi'_{N,p}\,(k) < 1$ moves *fast*, **very** fast, at «literal(text="100 %", why="all")» of `a_b`.

$$
p_{\mathrm{crit}} = \left(\frac{1 + \sqrt{N+1}}{N}\right)^2 \tag{18}
$$

where $N$ is large, so
$$
\begin{aligned} a &= b \\ c &= d \end{aligned} \tag{25}
$$

![The rise, at «v.half_height» or $\sigma$ ≥ «literal(text="0.12", why="toy")».](figures/fig03.svg){#fig:3}

Of [@eq:map],
$$
x \to f(x)
$$ {#eq:map}
follows $x^2$ («v.tiny»).

### The protocol {#sec:protocol}

Table: What σ gives {#tab:sigma}

| Check | Statement | Ours |
|:--|---|--:|
| [!claim:rise] | A threshold exists near «literal(text="0.12", why="toy")» | «v.half_height» |
| [!claim:jump] | a_b * c | «v.kept | percent» |

«v.count»
. and [@Claim:jump] of [@tab:sigma] and [@fig:3].

1. first
2. second

   more
- x
  - y

```rust
fn f() -> σ { 1 }
```

$a$–$b$ is \` and ``a `b` c``, \~\~c\~\~, \&lt; d.

\[x\]: yes

````
```
12
```
````

[DOI](https://doi.org/10.1/S0(98)00123-4)

| a | b |
|---|---|
| \[q\] | c |

- \[z\] a

![The set-up.](figures/photo.svg)

By [@lst:kick], in words.

Listing: What $\delta v$ does. {#lst:kick}

«code(item="toy::flight::Motion::kick")»

## References {.unnumbered}

[@bibliography]
"#;

/// Text in one line: `⏎` ends a line in it, and `·` is a blank that does not break.
fn unmarked(line: &str) -> String {
    line.replace('⏎', "\n").replace('·', "\u{a0}")
}

/// Asserts that the files of a report have these parts, one a line, each behind its file.
fn has(report: &Files, parts: &str) {
    for line in parts.lines().skip(1) {
        let (path, part) = line.split_once(" => ").unwrap();
        let (text, part) = (file(report, path), unmarked(part));
        assert!(text.contains(&part), "{part:?} is not in\n{text}");
    }
}

/// A title is plain text where no markup is read; signs that others read are escaped.
#[test]
fn each_format_shows_what_is_meant() {
    let [svg, pdf] = [&b"<svg/>"[..], b"%PDF-1.5"];
    let picture = Figure::picture(&[svg, pdf], "The set-up", crate::describe!("Balls on [rods]."));
    let picture = Figure { id: "photo".into(), ..picture.unwrap() };
    let (claims, figures) = (vec![claim("rise"), claim("jump")], vec![figure(), picture]);
    let report = Given { claims, figures, ..given(SAMPLE) }.made().unwrap();
    let parts = r##"
report.md => ## <a id="sec-introduction"></a>1 Introduction⏎
report.md => ([[Rice, 1945](#ref-rice1945)]; see [Fig.·3](#fig-3), Eqs.·[(18)](#eq-18) and
report.md => ⏎0.1165(4) and $\sigma = 0.1165(4)$, far below $-8.87\times10^{-4}$ or $10^{-9}$, the $n\text{-th}$
report.md => $\Phi'_{N,p}\thinspace(k) \lt 1$ moves *fast*, **very** fast
report.md => <a id="eq-18"></a>⏎⏎$$⏎p_{\mathrm{crit}} = \left(\frac{1 + \sqrt{N+1}}{N}\right)^2⏎\tag{18}⏎$$⏎
report.md => ⏎\begin{aligned} a &= b \cr c &= d \end{aligned}⏎
report.md => Of [Eq.·(1)](#eq-map),⏎⏎<a id="eq-map"></a>⏎⏎$$⏎x \to f(x)⏎\tag{1}⏎$$⏎⏎follows
report.md => <a id="fig-3"></a>⏎![It rises \[steeply\].](figures/fig03.svg)⏎⏎**Figure 3.** The rise, at 0.1165(4) or
report.md => <a id="tab-sigma"></a>**Table 1.** What σ gives⏎⏎| Check | Statement | Ours |⏎|---|---|--:|⏎
report.md => | <a id="claim-jump"></a>2 | a_b \* c | 94.5(8)·% |⏎
report.md => ⏎. and [Claim·2](#claim-jump) of [Table·1](#tab-sigma) and [Fig.·3](#fig-3).⏎
report.md => 1. first⏎2. second⏎⏎   more⏎
report.md => ```rust⏎fn f() -> σ { 1 }⏎```⏎
report.md => ⏎By [Listing·1](#lst-kick), in words.⏎
report.md => <a id="lst-kick"></a>**Listing 1.** What $\delta v$ does.⏎⏎<details>⏎<summary><code>toy::flight::Motion::kick</code></summary>⏎⏎```rust⏎/// 
report.md => ⏎    self.b += kick * p.cos;⏎}⏎```⏎⏎<sub>From [src/flight.rs](../src/flight.rs).</sub>⏎⏎</details>⏎
report.md => - <a id="ref-rice1945"></a>Rice, S. O. (1945). Noise. *B*.⏎
report.tex => \section{Introduction}\label{sec:introduction}⏎⏎Masses
report.tex => \origin{half_height}{0.1165(4)} and $\sigma = \origin{half_height}{0.1165(4)}$, far below
report.tex => see \hyperref[fig:3]{Fig.~3}, Eqs.~\hyperref[eq:18]{(18)} and
report.tex => at 100 \% of \texttt{a\_\allowbreak{}b}.⏎\begin{equation}⏎p_{
report.tex => \tag{18}\label{eq:18}⏎\end{equation}⏎where $N$ is large, so⏎\begin{equation}⏎
report.tex => \includegraphics[width=0.8\linewidth,height=0.62\textheight,keepaspectratio]{figures/fig03.pdf}
report.tex => \caption{The rise, at \origin{half_height}{0.1165(4)} or $\sigma$ \ensuremath{\ge} 0.12.}\label{fig:3}
report.tex => Of \hyperref[eq:map]{Eq.~(1)},⏎\begin{equation}⏎x \to f(x)⏎\tag{1}\label{eq:map}⏎\end{equation}⏎follows
report.tex => \begin{longtable}{llr}⏎\caption{What \ensuremath{\sigma} gives}\label{tab:sigma}\\⏎
report.tex => \phantomsection\label{claim:jump}2 & a\_b * c & \origin{kept}{94.5(8)~\%} \\⏎
report.tex => \phantomsection\section*{References}
report.tex => ⏎By \hyperref[lst:kick]{Listing~1}, in words.⏎
report.tex => \section*{Listings}
report.tex => \phantomsection\label{lst:kick}\textbf{Listing 1.} What $\delta v$ does. \texttt{toy::\allowbreak{}flight
report.tex => \begin{alltt}⏎/// A jump of the velocity by \ensuremath{\omega} `kick`
report.tex => (&mut self, kick: f64, p: &Phases<M>) \{⏎    self.a -= kick * p.sin;⏎
report.md => $a\text{–}b$ is \` and ``a `b` c``, \~\~c\~\~, \&lt; d.
report.md => ⏎\[x]: yes⏎
report.md => ⏎````⏎```⏎12⏎```⏎````⏎
report.md => (https://doi.org/10.1/S0(98)00123-4)
report.md => ![Balls on \[rods\].](figures/photo.svg)
report.tex => {figures/photo.pdf}
report.tex => ⏎{}[q] & c
report.tex => \item {}[z] a
report.tex => \title{Impact\_dynamics \& large \% systems: R\&D $\sigma_{1/2}$}
report.tex => pdftitle={Impact\_dynamics \& large \% systems: R\&D sigma\_1/2}
report.html => >−8.87 × 10<sup>−4</sup></span> or <span
report.html => >10<sup>−9</sup></span>, the
report.html => >94.5(8)·%</span></td>
report.html => <title>Impact_dynamics &amp; large·% systems: R&amp;D σ_1/2</title>
report.html => <img src="figures/photo.svg" alt="Balls on [rods]."/>
figures/photo.svg => <svg/>
figures/photo.pdf => %PDF-1.5
SHA256SUMS =>   figures/photo.svg⏎"##;
    has(&report, parts);
    let [markdown, tex] = ["report.md", "report.tex"].map(|path| file(&report, path));
    assert!(!markdown.contains("\n\n\n"), "{markdown}");
    assert_eq!(tex.matches("self.b +=").count(), 1, "{tex}");
}

fn figure() -> Figure {
    let sheet = Sheet::new(400);
    let style = words(200, INK, HPos::Left, VPos::Bottom);
    sheet.area.draw_text("(a)", &style, (0, 300)).unwrap();
    let words = |row: [&str; 2]| row.map(String::from).to_vec();
    let (name, rows) = ("fig03.csv".into(), vec![words(["0.1", "2"])]);
    let data = DataFile { name, header: words(["sigma", "mean"]), rows };
    let figure = sheet.finish("The rise", crate::describe!("It rises [steeply]."));
    Figure { id: "fig03".into(), data: vec![data], ..figure }
}

fn claim(id: &'static str) -> Check {
    let found = crate::text!("{}", with_error(0.11652, 0.0004));
    let check = Check::new(Kind::Statement, id, "A threshold | in [xx, {yy}^zz] @ exists", found);
    let mut judged = check.judged(true).within(crate::text!("{:1}", 0.005), "half a unit");
    (judged.place, judged.expected) = ("Sec. 2".into(), "σ ≈ 0.12".into());
    judged
}

struct Given {
    files: Vec<(&'static str, String)>,
    edition: Edition,
    lab: Option<&'static str>,
    figures: Vec<Figure>,
    claims: Vec<Check>,
    table: Option<Table>,
}

impl Given {
    fn made(self) -> Result<Files, Error> {
        let mut values = Registry::default();
        values.add(Value::integer("half_height", with_error(0.11652, 0.0004)))?;
        values.add(Value::real("tiny", -8.87e-4, 3))?;
        values.add(Value::real("least", 1e-9, 1))?;
        values.add(Value::integer("kept", with_error(0.945, 0.008)))?;
        values.add(Value::integer("count", 12345))?;
        let empty = Value::real("empty", 0.0, 1);
        values.add(Value { number: values::Number::None, ..empty })?;
        if let Some(table) = self.table {
            values.add_tables(&Tables::from([(table.name(), Arc::new(table))]))?;
        }
        let templates = self.files.iter().map(|(path, text)| (*path, text.as_str()));
        assemble(&Input {
            templates: &Templates::of(templates.chain([("references.bib", BIB)])),
            values: &values,
            rows: &Default::default(),
            claims: &self.claims,
            figures: &self.figures,
            lab: self.lab,
            top: Some("../"),
            edition: &self.edition,
            project: &Project::new(toy()),
            experiments: &[],
        })
    }
}

fn given(prose: &str) -> Given {
    let (what, home) = ("the jump".into(), "toy::flight".into());
    let (number, section, digits, step_towards) = (18, 7, None, None);
    let equation = ledger::EquationEntry { number, section, digits, what, home, step_towards };
    let authors = vec![("A. Uthor", "R & D"), ("B. Uthor", "")];
    let edition = Edition::new("toy");
    Given {
        files: vec![("report.md", prose.into())],
        edition: Edition { authors, date: "2026-11-24", equations: vec![equation], ..edition },
        lab: None,
        figures: vec![figure()],
        claims: vec![claim("rise")],
        table: None,
    }
}

fn assembled(prose: &str) -> Result<Files, Error> {
    given(prose).made()
}

fn file(report: &Files, path: &str) -> String {
    String::from_utf8(report[path].clone()).unwrap()
}

const PROSE: &str = "# Title\n\nAt «v.half_height», [@rice1945]. $$x = y \\tag{18}$$\n\n[@bibliography]\n\n\
    ![The rise.](figures/fig03.svg)\n\n| Id | Check |\n|---|---|\n\
    <% for c in claims %>| [!claim:«c.id»] | «c.statement»: «c.found», «c.verdict» |\n<% endfor %>";

#[test]
fn what_readers_run_is_offered_where_it_can_be_run() {
    let prose = PROSE.replace("[@bibliography]", "Lab toy: You run *them*.\n\n[@bibliography]");
    let mut without = assembled(&prose).unwrap();
    let mut with = Given { lab: Some("end();"), ..given(&prose) }.made().unwrap();
    let parts = r##"
report.html => <figure class="lab" id="lab-toy" data-lab="toy" hidden="">
report.html => You run <em>them</em>.
lab.js => end();"##;
    has(&with, parts);
    assert!(!file(&without, "report.html").contains("You run"));
    assert!(!without.contains_key(LAB));
    for report in [&mut with, &mut without] {
        report.retain(|path, _| !folder::is_generated(path));
    }
    assert!(with == without, "what is committed depends on the machine");
}

#[test]
fn a_report_is_all_its_files() {
    let report = assembled(PROSE).unwrap();
    let paths = report.keys().map(String::as_str).filter(|path| !path.starts_with("fonts/"));
    let expected = "SHA256SUMS SHA256SUMS.built cards.js data/fig03.csv data/index.html figures/fig03.pdf \
        figures/fig03.svg ledger.json points.js report.css report.html report.js report.md report.tex search.js values.json";
    assert_eq!(paths.collect::<Vec<_>>().join(" "), expected);
    assert_eq!(file(&report, "SHA256SUMS").lines().count(), 6);
    let parts = r##"
report.md => 1 | A threshold \| in [xx, {yy}^zz] @ exists: 0.1165(4), reproduced |
report.md => [fig03.csv](data/fig03.csv)
report.tex => At \origin{half_height}{0.1165(4)}, 
values.json => "score.reproduced"
SHA256SUMS => 5fbfa3bf9031ae769b4cb3a5cd6b9e1c235880438f409f9ec99217b60b1ecb17  data/fig03.csv⏎
data/index.html => <a href="fig03.csv">fig03.csv</a></td><td>"##;
    has(&report, parts);
    assert_eq!(assembled(PROSE).unwrap(), report);
}

#[test]
fn numerals_that_were_typed_outside_the_prose_are_refused() {
    for (text, fault) in [
        ("so at 12 s", "src/flight.rs:12: \"so at 12 s\": hard-coded number 12;"),
        ("7 of 0.35 m", "src/flight.rs:13: \"7 of 0.35 m\": hard-coded number 0.35;"),
        ("Eq. (25) at 98.98 s of Python 3.11", "src/flight.rs:14: \"Eq. (25) at 98.98 s of"),
        ("within ten of it", "src/flight.rs:14: \"within ten of it\": hard-coded number ten;"),
        ("Eq. (25) at 12, at 120 s, of Python 3.11, 14 s, 0.35", ""),
    ] {
        let claims = vec![claim("rise").note(text).within("", text)];
        let made = Given { claims, ..given(PROSE) }.made();
        let error = made.err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.starts_with(fault) && error.is_empty() == fault.is_empty(), "{error}");
    }
    let with_digit = || given(&PROSE.replace("x = y", "x = 2 y"));
    for (digits, fails) in [(None, false), (Some("2"), false), (Some("3"), true)] {
        let mut given = with_digit();
        given.edition.equations[0].digits = digits;
        let error = given.made().err().map(|error| error.to_string()).unwrap_or_default();
        assert_eq!(
            error.contains("equation (18) has the digits 2, in the list 3"),
            fails,
            "{error}"
        );
    }
}

#[test]
fn what_is_not_shown_is_refused() {
    for (from, to, says) in [
        ("![The rise.](figures/fig03.svg)", "", "figure fig03 is not shown"),
        ("\\tag{18}", "", "equation (18) is not shown"),
    ] {
        let error = assembled(&PROSE.replace(from, to)).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
}

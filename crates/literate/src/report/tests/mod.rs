//! A report of one document that uses everything, and everything that can be wrong with it.

mod broken;
mod data;
mod documents;

use super::*;
use crate::claims::{Check, Kind, decimals, with_error};
use crate::figures::prelude::{HPos, INK, Sheet, VPos, words};
use crate::figures::{DataFile, Figure};
use crate::project::Project;
use crate::prose::Templates;
use crate::source::toy;
use crate::table::Table;
use std::sync::Arc;

const BIB: &str = "@article{rice1945, author={Rice, S. O.}, title={Noise}, journal={B}, year=1945}";

const SAMPLE: &str = r#"# A title

## Introduction {#sec:introduction}

Masses in a row ([@rice1945]; see [@fig:3], [@eq:18; @eq:25] and [@sec:protocol]). With
«v.half_height» and $\sigma = «v.half_height»$, far below «v.tiny», the $n$-th mass of
$f_{N,p}(k)$ and $\Phi'_{N,p}\,(k) < 1$ moves *fast*, **very** fast, at 100 % of `a_b`.

$$
p_{\mathrm{crit}} = \left(\frac{1 + \sqrt{N+1}}{N}\right)^2 \tag{18}
$$

where $N$ is large, so
$$
\begin{aligned} a &= b \\ c &= d \end{aligned} \tag{25}
$$

![The rise, at «v.half_height» or $\sigma$ ≥ 0.12.](figures/fig03.svg){#fig:3}

Of [@eq:map],
$$
x \to f(x)
$$ {#eq:map}
follows $x^2$ («v.tiny»).

### The protocol {#sec:protocol}

Table: What σ gives {#tab:sigma}

| Check | Statement | Ours |
|:--|---|--:|
| [!claim:rise] | A threshold exists near 0.12 | «v.half_height» |
| [!claim:jump] | a_b * c | «v.kept | percent» |

«v.count»
. and [@Claim:jump] of [@tab:sigma] and [@fig:3].

1. one
2. two

   more
- x
  - y

> An aside.

Lab toy: You run *them*.

```rust
fn f() -> σ { 1 }
```

By [@lst:kick], in words.

Listing: What $\delta v$ does. {#lst:kick}

«code(item="toy::flight::Motion::kick")»

## References {.unnumbered}

[@bibliography]
"#;

fn values() -> Registry {
    let mut values = Registry::default();
    let half = Value::ensemble("half_height", 0.11652, 0.0004, 1000);
    let tiny = Value::real("tiny", 8.87e-4, 3);
    let kept = Value::ensemble("kept", 0.945, 0.008, 400);
    values.extend([half, tiny, kept, Value::integer("count", 12345)]).unwrap();
    values
}

fn tree(text: &str) -> Vec<document::Block> {
    let literals = "[[literal]]\nwhy = \"a test\"\nphrases = [\"100 %\", \"0.12\", \"two\"]";
    let templates = Templates::of([("report.md", text), ("literals.toml", literals)]);
    let filler = filler::Filler::new(&templates).unwrap().with(&values());
    let filled = filler.prose(&Document::REPORT).unwrap();
    let (values, sources) = (values(), toy());
    let parsed = parse::parse(&filled, &values, &filler.declared, &sources);
    let mut blocks = parsed.whole().unwrap().0;
    let library = bibliography::Library::read(BIB).unwrap();
    let mut labels = labels::Labels::default();
    labels.number_all(&mut blocks, Document::REPORT).unwrap();
    labels.resolve(&mut blocks, Document::REPORT, &library).unwrap();
    blocks
}

/// Text in one line: `⏎` ends a line in it, and `·` is a blank that does not break.
fn unmarked(line: &str) -> String {
    line.replace('⏎', "\n").replace('·', "\u{a0}")
}

/// Asserts that a document has these parts, one a line.
fn has(text: &str, parts: &str) {
    for part in parts.lines().map(unmarked) {
        assert!(text.contains(&part), "{part:?} is not in\n{text}");
    }
}

#[test]
fn markdown_for_a_host() {
    let text = markdown::write(&tree(SAMPLE));
    has(
        &text,
        r##"
## <a id="sec-introduction"></a>1 Introduction⏎
([[Rice, 1945](#ref-rice1945)]; see [Fig.·3](#fig-3), Eqs.·[(18)](#eq-18) and
⏎0.1165(4) and $\sigma = 0.1165(4)$, far below $8.87\times10^{-4}$, the $n\text{-th}$
$\Phi'_{N,p}\thinspace(k) \lt 1$ moves *fast*, **very** fast
<a id="eq-18"></a>⏎⏎$$⏎p_{\mathrm{crit}} = \left(\frac{1 + \sqrt{N+1}}{N}\right)^2⏎\tag{18}⏎$$⏎
⏎\begin{aligned} a &= b \cr c &= d \end{aligned}⏎
Of [Eq.·(1)](#eq-map),⏎⏎<a id="eq-map"></a>⏎⏎$$⏎x \to f(x)⏎\tag{1}⏎$$⏎⏎follows
<a id="fig-3"></a>⏎![](figures/fig03.svg)⏎⏎**Figure 3.** The rise, at 0.1165(4) or
<a id="tab-sigma"></a>**Table 1.** What σ gives⏎⏎| Check | Statement | Ours |⏎|---|---|--:|⏎
| <a id="claim-jump"></a>2 | a_b \* c | 94.5(8)·% |⏎
⏎. and [Claim·2](#claim-jump) of [Table·1](#tab-sigma) and [Fig.·3](#fig-3).⏎
1. one⏎2. two⏎⏎   more⏎
```rust⏎fn f() -> σ { 1 }⏎```⏎
⏎By [Listing·1](#lst-kick), in words.⏎
<a id="lst-kick"></a>**Listing 1.** What $\delta v$ does.⏎⏎<details>⏎<summary><code>toy::flight::Motion::kick</code></summary>⏎⏎```rust⏎/// 
⏎    self.b += kick * p.cos;⏎}⏎```⏎⏎<sub>From [src/flight.rs](../src/flight.rs).</sub>⏎⏎</details>⏎
- <a id="ref-rice1945"></a>Rice, S. O. (1945). Noise. *B*.⏎"##,
    );
    assert!(
        !text.contains("They move") && !text.contains("You run") && !text.contains("\n\n\n"),
        "{text}"
    );
}

#[test]
fn latex_for_pdflatex() {
    let parts = latex::write(&tree(SAMPLE), Document::REPORT).unwrap();
    let [text, appendix] = ["body", "listings"].map(|name| parts[name].as_str().unwrap());
    has(
        text,
        r##"
\section{Introduction}\label{sec:introduction}⏎⏎Masses
\origin{half_height}{0.1165(4)} and $\sigma = \origin{half_height}{0.1165(4)}$, far below
see \hyperref[fig:3]{Fig.~3}, Eqs.~\hyperref[eq:18]{(18)} and
at 100 \% of \texttt{a\_\allowbreak{}b}.⏎\begin{equation}⏎p_{
\tag{18}\label{eq:18}⏎\end{equation}⏎where $N$ is large, so⏎\begin{equation}⏎
\includegraphics[width=0.8\linewidth,height=0.62\textheight,keepaspectratio]{figures/fig03.pdf}
\caption{The rise, at \origin{half_height}{0.1165(4)} or $\sigma$ \ensuremath{\ge} 0.12.}\label{fig:3}
Of \hyperref[eq:map]{Eq.~(1)},⏎\begin{equation}⏎x \to f(x)⏎\tag{1}\label{eq:map}⏎\end{equation}⏎follows
\begin{longtable}{llr}⏎\caption{What \ensuremath{\sigma} gives}\label{tab:sigma}\\⏎
\phantomsection\label{claim:jump}2 & a\_b * c & \origin{kept}{94.5(8)~\%} \\⏎
\phantomsection\section*{References}
⏎By \hyperref[lst:kick]{Listing~1}, in words.⏎"##,
    );
    assert!(
        !text.contains("self.b +=") && !text.contains("They move") && !text.contains("You run"),
        "{text}"
    );
    has(
        appendix,
        r##"
\section*{Listings}
\phantomsection\label{lst:kick}\textbf{Listing 1.} What $\delta v$ does. \texttt{toy::\allowbreak{}flight
\begin{alltt}⏎/// A jump of the velocity by \ensuremath{\omega} `kick`
(&mut self, kick: f64, p: &Phases<M>) \{⏎    self.a -= kick * p.sin;⏎"##,
    );
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

fn claim() -> Check {
    let found =
        Check::new(Kind::Statement, "rise", "A threshold | exists", with_error(0.11652, 0.0004));
    let mut judged = found.judged(true).within(decimals(0.005, 3), "half a unit");
    (judged.place, judged.expected) = ("Sec. 2".into(), "σ ≈ 0.12".into());
    judged
}

/// Assembles a report with one figure, one claim and one value from this prose.
fn assembled(prose: &str) -> Result<Files, Error> {
    made_of(prose, None, figure(), claim())
}

fn made_of(prose: &str, lab: Option<&str>, figure: Figure, claim: Check) -> Result<Files, Error> {
    made(&[("report.md", prose), ("references.bib", BIB)], &with_equation(), lab, figure, claim)
}

fn with_equation() -> Edition {
    let (what, home) = ("the jump".into(), "toy::flight".into());
    let equation = ledger::EquationEntry { number: 18, section: 7, what, home, step_towards: None };
    Edition { equations: vec![equation], ..edition() }
}

fn edition() -> Edition {
    let authors = vec![("A. Uthor", "R & D"), ("B. Uthor", "")];
    Edition { authors, date: "2026-11-24", ..Edition::new("toy") }
}

fn made(
    files: &[(&str, &str)],
    edition: &Edition,
    lab: Option<&str>,
    figure: Figure,
    claim: Check,
) -> Result<Files, Error> {
    made_with(files, edition, lab, figure, claim, None)
}

fn made_with(
    files: &[(&str, &str)],
    edition: &Edition,
    lab: Option<&str>,
    figure: Figure,
    claim: Check,
    table: Option<Table>,
) -> Result<Files, Error> {
    let mut values = Registry::default();
    values.add(Value::ensemble("half_height", 0.11652, 0.0004, 1000))?;
    values.add(Value::integer("spare", 3).data_only())?;
    let empty = Value::real("empty", 0.0, 1).data_only();
    values.add(Value { number: values::Number::None, ..empty })?;
    if let Some(table) = table {
        values.add_table(Arc::new(table))?;
    }
    let (templates, rows) = (&Templates::of(files.iter().copied()), &Default::default());
    let (values, claims, figures, top) = (&values, &[claim], &[figure], Some("../"));
    let (project, experiments) = (&Project::new(toy()), &[][..]);
    let input =
        Input { templates, values, rows, claims, figures, lab, top, edition, project, experiments };
    assemble(&input)
}

const PROSE: &str = "# Title\n\nAt «v.half_height», [@rice1945]. $$x = y \\tag{18}$$\n\n[@bibliography]\n\n\
    ![The rise.](figures/fig03.svg)\n\n| Id | Check |\n|---|---|\n\
    <% for c in claims %>| [!claim:«c.id»] | «c.statement»: «c.found», «c.verdict» |\n<% endfor %>";

#[test]
fn what_readers_run_is_offered_where_it_can_be_run() {
    let prose = PROSE.replace("[@bibliography]", "Lab toy: You run *them*.\n\n[@bibliography]");
    let [mut without, mut with] =
        [None, Some("end();")].map(|lab| made_of(&prose, lab, figure(), claim()).unwrap());
    let page = |report: &Files| String::from_utf8(report["report.html"].clone()).unwrap();
    let figure = "<figure class=\"lab\" id=\"lab-toy\" data-lab=\"toy\" hidden=\"\">";
    assert!(page(&with).contains(figure) && page(&with).contains("You run <em>them</em>."));
    assert_eq!(with[LAB], b"end();");
    assert!(!page(&without).contains("You run") && !without.contains_key(LAB));
    for report in [&mut with, &mut without] {
        report.retain(|path, _| !folder::is_generated(path));
    }
    assert!(with == without, "what is committed depends on the machine");
}

#[test]
fn a_report_is_all_its_files() {
    let report = assembled(PROSE).unwrap();
    let paths = report.keys().map(String::as_str).filter(|path| !path.starts_with("fonts/"));
    let expected = [
        "SHA256SUMS",
        "SHA256SUMS.built",
        "cards.js",
        "data/fig03.csv",
        "data/index.html",
        "figures/fig03.pdf",
        "figures/fig03.svg",
        "ledger.json",
        "report.css",
        "report.html",
        "report.js",
        "report.md",
        "report.tex",
        "search.js",
        "values.json",
    ];
    assert_eq!(paths.collect::<Vec<_>>(), expected);
    let text = |path: &str| String::from_utf8(report[path].clone()).unwrap();
    let markdown = text("report.md");
    assert!(markdown.contains("![It rises \\[steeply\\].](figures/fig03.svg)"), "{markdown}");
    assert!(markdown.contains("1 | A threshold \\| exists: 0.1165(4), reproduced |"), "{markdown}");
    assert!(markdown.contains("[fig03.csv](data/fig03.csv)"), "{markdown}");
    assert!(text("report.tex").contains("\\title{Title}"));
    let latex = text("report.tex");
    assert!(latex.contains("At \\origin{half_height}{0.1165(4)}, "), "{latex}");
    assert!(text("values.json").contains("\"score.reproduced\""));
    assert_eq!(text("SHA256SUMS").lines().count(), 6);
    let sum = "5fbfa3bf9031ae769b4cb3a5cd6b9e1c235880438f409f9ec99217b60b1ecb17  data/fig03.csv\n";
    assert!(text("SHA256SUMS").contains(sum));
    let index = std::str::from_utf8(&report["data/index.html"]).unwrap();
    assert!(index.contains("<a href=\"fig03.csv\">fig03.csv</a></td><td>"), "{index}");
    assert_eq!(assembled(PROSE).unwrap(), report);
}

#[test]
fn a_picture_from_a_file_is_shown_in_all_formats() {
    let [svg, pdf] = [&b"<svg/>"[..], b"%PDF-1.5"];
    let description = crate::describe!("Balls on [rods].");
    let picture = Figure::picture(&[svg, pdf], "The set-up", description).unwrap();
    let prose = PROSE.replace("figures/fig03.svg", "figures/photo.svg");
    let report = made_of(&prose, None, Figure { id: "photo".into(), ..picture }, claim()).unwrap();
    assert_eq!(report["figures/photo.svg"], svg);
    assert_eq!(report["figures/photo.pdf"], pdf);
    for (file, part) in [
        (&report["report.md"], r"![Balls on \[rods\].](figures/photo.svg)"),
        (&report["report.tex"], "{figures/photo.pdf}"),
        (&report["SHA256SUMS"], "  figures/photo.svg\n"),
        (&report["report.html"], r#"<img src="figures/photo.svg" alt="Balls on [rods]."/>"#),
    ] {
        let text = String::from_utf8_lossy(file);
        assert!(text.contains(part), "{part} is not in {text}");
    }
}

/// A title is plain text where no markup is read, and markup of each format else.
#[test]
fn titles_are_clean() {
    let title = r"# Impact\_dynamics & large % systems: R&D $\sigma_{1/2}$";
    let report = assembled(&PROSE.replace("# Title", title)).unwrap();
    let page = String::from_utf8(report["report.html"].clone()).unwrap();
    let tex = String::from_utf8(report["report.tex"].clone()).unwrap();
    for (text, part) in [
        (&page, "<title>Impact_dynamics &amp; large % systems: R&amp;D σ_1/2</title>"),
        (&tex, r"\title{Impact\_dynamics \& large \% systems: R\&D $\sigma_{1/2}$}"),
        (&tex, r"pdftitle={Impact\_dynamics \& large \% systems: R\&D sigma\_1/2}"),
    ] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
}

#[test]
fn numerals_that_were_typed_outside_the_prose_are_refused() {
    let n = 12;
    let drawn = |description| Figure { description, ..figure() };
    let judged = |reason: &str| claim().within("", reason);
    let fine = made_of(PROSE, None, drawn(crate::describe!("{n} of {}, k = 1.", n + 1)), claim());
    fine.unwrap();
    for (made, words) in [
        (
            made_of(PROSE, None, drawn(crate::describe!("{n} of 12.")), claim()),
            "what fig03 shows: ",
        ),
        (made_of(PROSE, None, figure(), judged("within 12 of it")), "the reason of rise: "),
    ] {
        let error = made.unwrap_err().to_string();
        assert!(error.starts_with(words) && error.contains("12"), "{error}");
    }
}

#[test]
fn what_is_not_shown_is_refused() {
    let fails = |from: &str, to: &str| assembled(&PROSE.replace(from, to)).unwrap_err();
    assert!(matches!(fails("«v.half_height»", "half"), Error::Unused(id) if id == "half_height"));
    assert!(matches!(fails("![The rise.](figures/fig03.svg)", ""), Error::NotShown(_)));
    assert!(matches!(fails("\\tag{18}", ""), Error::NoEquation(number) if number == "18"));
}

/// Signs that another reader of Markdown, or TeX, would take for markup are escaped.
#[test]
fn each_format_shows_what_is_meant() {
    let text = "# T\n\n$a$–$b$ is \\` and ``a `b` c``, \\~\\~c\\~\\~, \\&lt; d.\n\n\\[x\\]: yes\n\n\
        ````\n```\n12\n````\n\n[DOI](https://doi.org/10.1/S0(98)00123-4)\n\n\
        | a | b |\n|---|---|\n| \\[q\\] | c |\n\n- \\[z\\] a\n";
    let (tree, tex) = (tree(text), latex::write(&tree(text), Document::REPORT).unwrap());
    let (markdown, tex) = (markdown::write(&tree), tex["body"].as_str().unwrap());
    for (text, kept) in [
        (&*markdown, r"$a\text{–}b$ is \` and ``a `b` c``, \~\~c\~\~, \&lt; d."),
        (&markdown, "\n\\[x]: yes\n"),
        (&markdown, "\n````\n```\n12\n````\n"),
        (&markdown, "(https://doi.org/10.1/S0(98)00123-4)"),
        (tex, "\n{}[q] & c"),
        (tex, "\\item {}[z] a"),
    ] {
        assert!(text.contains(kept), "{kept}: {text}");
    }
}

//! A report of one document that uses everything, and everything that can be wrong with it.

use super::*;
use crate::claims::{Basis, Check, Kind, Text, Verdict};
use crate::figures::{DataFile, Drawing, Figure};
use crate::source::{Program, TOY};

/// One document with everything that the prose may use.
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

![The rise, at «v.half_height» or $\sigma$ ≥ 0.12.](figures/fig03.svg)

### The protocol {#sec:protocol}

Table: What σ gives {#tab:sigma}

| Check | Statement | Ours |
|:--|---|--:|
| [!claim:rise] | A threshold exists near 0.12 | «v.half_height» |
| [!claim:jump] | a_b * c | «v.kept | percent» |

«v.count»
. and [@Claim:jump] of [@tab:sigma] and [@fig:3a].

1. one
2. two

   more
- x
  - y

> An aside.

Scene: They move.

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
    let mut values = Registry::new();
    let half = Value::ensemble("half_height", 0.11652, 0.0004, 1000);
    let tiny = Value::real("tiny", 8.87e-4, 3);
    let kept = Value::ensemble("kept", 0.945, 0.008, 400);
    values.extend([half, tiny, kept, Value::integer("count", 12345)]).unwrap();
    values
}

fn tree(text: &str) -> Vec<document::Block> {
    let templates = Templates::of([("report.md", text)]);
    let filled = filler::Filler::new(&templates, &values(), TOY).unwrap().prose(&Document::REPORT);
    let (mut blocks, _) = parse::parse(&filled.unwrap(), &values(), TOY).unwrap();
    let bib = "@article{rice1945, author={Rice, S. O.}, title={Noise}, journal={B}, year=1945}";
    let library = bibliography::Library::read(bib).unwrap();
    resolve(&mut blocks, &library).unwrap();
    blocks
}

/// Numbers and references of a document that is alone.
fn resolve(blocks: &mut [document::Block], library: &bibliography::Library) -> Result<(), Error> {
    let mut labels = labels::Labels::of(&[figure()]);
    labels.number_all(blocks, Document::REPORT)?;
    labels.resolve(blocks, Document::REPORT, library)
}

#[test]
fn markdown_for_a_host() {
    let text = markdown::write(&tree(SAMPLE));
    for part in [
        "## <a id=\"sec-introduction\"></a>1 Introduction\n",
        "([[Rice, 1945](#ref-rice1945)]; see [Fig.\u{a0}3](#fig-3), Eqs.\u{a0}[(18)](#eq-18) and",
        "\n0.1165(4) and $\\sigma = 0.1165(4)$, far below $8.87\\times10^{-4}$, the $n\\text{-th}$",
        "$\\Phi'_{N,p}\\thinspace(k) \\lt 1$ moves *fast*, **very** fast",
        "<a id=\"eq-18\"></a>\n\n$$\np_{\\mathrm{crit}} = \\left(\\frac{1 + \\sqrt{N+1}}{N}\\right)^2\n\\tag{18}\n$$\n",
        "\n\\begin{aligned} a &= b \\cr c &= d \\end{aligned}\n",
        "<a id=\"fig-3\"></a>\n![](figures/fig03.svg)\n\n**Figure 3.** The rise, at 0.1165(4) or",
        "<a id=\"tab-sigma\"></a>**Table 1.** What σ gives\n\n| Check | Statement | Ours |\n|---|---|--:|\n",
        "| <a id=\"claim-jump\"></a>2 | a_b \\* c | 94.5(8)\u{a0}% |\n",
        "\n. and [Claim\u{a0}2](#claim-jump) of [Table\u{a0}1](#tab-sigma) and [Fig.\u{a0}3(a)](#fig-3).\n",
        "1. one\n2. two\n\n   more\n",
        "```rust\nfn f() -> σ { 1 }\n```\n",
        "\nBy [Listing\u{a0}1](#lst-kick), in words.\n",
        "<a id=\"lst-kick\"></a>**Listing 1.** What $\\delta v$ does.\n\n<details>\n<summary><code>toy::flight::Motion::kick</code></summary>\n\n```rust\n/// ",
        "\n    self.b += kick * p.cos;\n}\n```\n\n<sub>From [src/flight.rs](../src/flight.rs).</sub>\n\n</details>\n",
        "- <a id=\"ref-rice1945\"></a>Rice, S. O. (1945). Noise. *B*.\n",
    ] {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
    assert!(
        !text.contains("They move") && !text.contains("You run") && !text.contains("\n\n\n"),
        "{text}"
    );
}

#[test]
fn latex_for_pdflatex() {
    let text = latex::write(&tree(SAMPLE)).unwrap();
    for part in [
        "\\section{Introduction}\\label{sec:introduction}\n\nMasses",
        "see \\hyperref[fig:3]{Fig.~3}, Eqs.~\\hyperref[eq:18]{(18)} and",
        "at 100 \\% of \\texttt{a\\_\\allowbreak{}b}.\n\\begin{equation}\np_{",
        "\\tag{18}\\label{eq:18}\n\\end{equation}\nwhere $N$ is large, so\n\\begin{equation}\n",
        "\\includegraphics[width=0.8\\linewidth,height=0.62\\textheight,keepaspectratio]{figures/fig03.pdf}",
        "\\caption{The rise, at 0.1165(4) or $\\sigma$ \\ensuremath{\\ge} 0.12.}\\label{fig:3}",
        "\\begin{longtable}{llr}\n\\caption{What \\ensuremath{\\sigma} gives}\\label{tab:sigma}\\\\\n",
        "\\phantomsection\\label{claim:jump}2 & a\\_b * c & 94.5(8)~\\% \\\\\n",
        "\\phantomsection\\section*{References}",
        "\nBy \\hyperref[lst:kick]{Listing~1}, in words.\n",
    ] {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
    assert!(
        !text.contains("self.b +=") && !text.contains("They move") && !text.contains("You run"),
        "{text}"
    );
    let appendix = latex::listings(&tree(SAMPLE)).unwrap();
    for part in [
        "\\section*{Listings}",
        "\\phantomsection\\label{lst:kick}\\textbf{Listing 1.} What $\\delta v$ does. \\texttt{toy::\\allowbreak{}flight",
        "\\begin{alltt}\n/// A jump of the velocity by \\ensuremath{\\omega} `kick`",
        "(&mut self, kick: f64, p: &Phases<M>) \\{\n    self.a -= kick * p.sin;\n",
    ] {
        assert!(appendix.contains(part), "{part:?} is not in\n{appendix}");
    }
}

/// The tree of Markdown that nothing was filled into.
fn parsed(text: &str) -> Result<Vec<document::Block>, Error> {
    let values = values();
    Ok(parse::parse(&origin::Filled::plain("report.md", text), &values, TOY)?.0)
}

fn figure() -> Figure {
    let drawing = Drawing::new(400);
    let words = |row: [&str; 2]| row.map(String::from).to_vec();
    let (name, rows) = ("fig03.csv".into(), vec![words(["0.1", "2"])]);
    let data = DataFile { name, header: words(["sigma", "mean"]), rows };
    Figure {
        id: "fig03".into(),
        title: "The rise".into(),
        description: "It rises [steeply].".into(),
        svg: drawing
            .svg("fig03", "The rise", "It rises [steeply].")
            .replace("</svg>", "<g aria-label=\"(a)\"/></svg>"),
        drawing,
        data: vec![data],
        source: String::new(),
        experiments: Vec::new(),
    }
}

fn claim() -> Check {
    Check {
        kind: Kind::Statement,
        id: "rise".into(),
        place: "Sec. 2".into(),
        statement: "A threshold | exists".into(),
        printed: "σ ≈ 0.12".into(),
        ours: Text::default().with_error(0.11652, 0.0004),
        tolerance: Text::default().decimals(0.005, 3),
        reason: "half a unit".into(),
        verdict: Verdict::Reproduced,
        basis: Basis::Statistics,
        note: Text::default(),
    }
}

/// Assembles a report with one figure, one claim and one value from this prose.
fn assembled(prose: &str) -> Result<Report, Error> {
    with_lab(prose, None)
}

fn with_lab(prose: &str, lab: Option<&str>) -> Result<Report, Error> {
    let bib = "@article{rice1945, author={Rice, S. O.}, title={Noise}, journal={B}, year=1945}";
    let tex = "\\title{«title»}«body»\\end{document}";
    let html = "<html><title>«page.title»</title><main id=\"text\">«page.body»</main>«page.cards»<script>«script»</script></html>";
    let files = [
        ("report.md", prose),
        ("references.bib", bib),
        ("report.tex", tex),
        ("report.html", html),
        ("report.css", ""),
        ("report.js", ""),
        ("lab.js", "function toy(bench) {}"),
        ("literals.toml", "literal = []"),
    ];
    let mut values = Registry::new();
    values.add(Value::ensemble("half_height", 0.11652, 0.0004, 1000))?;
    values.add(Value::integer("spare", 3).data_only())?;
    assemble(&Input {
        templates: &Templates::of(files),
        values: &values,
        rows: &Default::default(),
        claims: &[claim()],
        figures: &[figure()],
        equations: &[ledger::EquationEntry {
            number: 18,
            section: 7,
            what: "the jump".into(),
            home: "toy::flight".into(),
            step_towards: None,
        }],
        scene: None,
        lab,
        pdf: false,
        program: TOY,
    })
}

const PROSE: &str = "# Title\n\nAt «v.half_height», [@rice1945]. $$x = y \\tag{18}$$\n\n[@bibliography]\n\n\
    ![The rise.](figures/fig03.svg)\n\n| Id | Check |\n|---|---|\n\
    <% for c in claims %>| [!claim:«c.id»] | «c.statement»: «c.ours», «c.verdict» |\n<% endfor %>";

#[test]
fn what_readers_run_is_offered_where_it_can_be_run() {
    let prose = PROSE.replace("[@bibliography]", "Lab toy: You run *them*.\n\n[@bibliography]");
    let [without, with] = [None, Some("end();")].map(|lab| with_lab(&prose, lab).unwrap());
    let page = |report: &Report| String::from_utf8(report.beside["report.html"].clone()).unwrap();
    let figure = "<figure class=\"lab\" id=\"lab-toy\" data-lab=\"toy\" hidden=\"\">";
    assert!(page(&with).contains(figure) && page(&with).contains("You run <em>them</em>."));
    assert_eq!(with.beside[LAB], b"end();");
    assert!(!page(&without).contains("You run") && !without.beside.contains_key(LAB));
    assert!(with.committed == without.committed, "what is committed depends on the machine");
}

#[test]
fn a_value_that_a_filter_cuts_is_told_with_its_place() {
    for cut in ["«v.half_height[1:]»", "$«v.half_height[0:3]»$"] {
        let told = assembled(&format!("{PROSE}\n\nHalf {cut} of it.\n")).map(drop).unwrap_err();
        let told = told.to_string();
        assert!(told.starts_with("report.md:") && told.contains("cut a value"), "{told}");
    }
}

#[test]
fn what_readers_run_is_known() {
    let named = |lab: &str| {
        let prose =
            PROSE.replace("[@bibliography]", &format!("Lab {lab}: You run it.\n\n[@bibliography]"));
        assembled(&prose).map(drop)
    };
    named("toy").unwrap();
    for wrong in ["game", "toy "] {
        let told = named(wrong).unwrap_err().to_string();
        assert!(told.starts_with("report.md:") && told.contains("Lab "), "{told}");
    }
}

#[test]
fn a_report_is_all_its_files() {
    let report = assembled(PROSE).unwrap();
    let paths: Vec<&str> = report.committed.keys().map(String::as_str).collect();
    let expected = [
        "SHA256SUMS",
        "data/fig03.csv",
        "figures/fig03.svg",
        "ledger.json",
        "report.md",
        "report.tex",
        "values.json",
    ];
    assert_eq!(paths, expected);
    let text = |path: &str| String::from_utf8(report.committed[path].clone()).unwrap();
    let markdown = text("report.md");
    assert!(markdown.contains("![It rises \\[steeply\\].](figures/fig03.svg)"), "{markdown}");
    assert!(markdown.contains("1 | A threshold \\| exists: 0.1165(4), reproduced |"), "{markdown}");
    assert!(markdown.contains("[fig03.csv](data/fig03.csv)"), "{markdown}");
    assert!(text("report.tex").starts_with("\\title{Title}"));
    assert!(text("report.tex").contains("At 0.1165(4), "), "{}", text("report.tex"));
    assert!(text("values.json").contains("\"score.reproduced\""));
    assert_eq!(text("SHA256SUMS").lines().count(), paths.len() - 1);
    let sum = "5fbfa3bf9031ae769b4cb3a5cd6b9e1c235880438f409f9ec99217b60b1ecb17  data/fig03.csv\n";
    assert!(text("SHA256SUMS").contains(sum), "{}", text("SHA256SUMS"));
    assert_eq!(report.beside.keys().collect::<Vec<_>>(), ["figures/fig03.pdf", "report.html"]);
    assert_eq!(assembled(PROSE).unwrap(), report);
}

/// A front page shows a figure of the report again, and what is referred to is found in the document that has it.
#[test]
fn documents_refer_to_each_other() {
    const FRONT: Document = Document {
        prose: "front",
        name: "Front",
        markdown: "README.md",
        page: "index.html",
        print: None,
        repeats: true,
        ..Document::REPORT
    };
    const MORE: Document = Document {
        prose: "more",
        name: "More",
        letter: "S",
        markdown: "more.md",
        page: "more.html",
        print: Some("more"),
        repeats: false,
    };
    let program = Program { documents: &[FRONT, Document::REPORT, MORE], ..TOY };
    let files = [
        (
            "front.md",
            "# Front\n\n![Again.](figures/fig03.svg)\n\nSee [@sec:b], [@sign:rise] and [more](more.md).",
        ),
        ("report/2-second.md", "## Last {#sec:last}\n\nWords, [@row:rise] and [@sec:b.]"),
        (
            "report/1-first.md",
            "# Report\n\n## First {#sec:first}\n\n![The rise.](figures/fig03.svg)",
        ),
        (
            "more.md",
            "# More\n\n## A {#sec:a}\n\n### B {#sec:b}\n\n«v.half_height», [@fig:3], [@sec:last].\n\n\
          Table: T {#tab:t}\n\n| a |\n|---|\n| [!claim:rise] |",
        ),
        ("references.bib", ""),
        ("literals.toml", "literal = []"),
    ];
    let mut values = Registry::new();
    values.add(Value::ensemble("half_height", 0.11652, 0.0004, 1000)).unwrap();
    let made = |files: &[(&str, &str)]| {
        let (claims, figures) = ([claim()], [figure()]);
        assemble(&Input {
            templates: &Templates::of(files.iter().copied()),
            values: &values,
            rows: &Default::default(),
            claims: &claims,
            figures: &figures,
            equations: &[],
            scene: None,
            lab: None,
            pdf: false,
            program,
        })
    };
    // A mistake in the second file of a document has its place there.
    let error = made(&files).unwrap_err().to_string();
    assert!(error.starts_with("report/2-second.md:3:24: [@sec:b.]: nothing"), "{error}");
    let right = files.map(|(path, text)| (path, text.replace("[@sec:b.]", "[@sec:b]")));
    let right: Vec<_> = right.iter().map(|(path, text)| (*path, text.as_str())).collect();
    let report = made(&right).unwrap();
    let text = |path: &str| {
        let bytes = report.committed.get(path).or(report.beside.get(path)).unwrap();
        String::from_utf8(bytes.clone()).unwrap()
    };
    for (file, part) in [
        (
            "README.md",
            "See [Sec.\u{a0}S1.1](more.md#sec-b), [✓](more.md#claim-rise) and [more](more.md).",
        ),
        ("index.html", "<a href=\"more.html#sec-b\">Sec.\u{a0}S1.1</a>"),
        ("index.html", "title=\"reproduced\">✓</a> and <a href=\"more.html\">more</a>."),
        ("index.html", "<li><a href=\"index.html\" aria-current=\"page\">Front</a></li>"),
        ("report.md", "Words, <sup>[✓\u{a0}1](more.md#claim-rise)</sup> and"),
        ("report.tex", "Words, \\textsuperscript{\\ensuremath{\\checkmark}~1} and Sec.~S1.1"),
        ("more.md", "[Fig.\u{a0}3](report.md#fig-3), [Sec.\u{a0}2](report.md#sec-last)."),
        ("more.md", "**Table S1.** T"),
        ("more.tex", "\\renewcommand{\\thesection}{S\\arabic{section}}"),
    ] {
        assert!(text(file).contains(part), "{file}: {part:?} is not in\n{}", text(file));
    }
    assert!(text("report.md").find("First") < text("report.md").find("Last"));
    // Only a front page shows a figure again.
    let again =
        format!("{}\n\n![Again.](figures/fig03.svg)", files[3].1.replace("sec:b.]", "sec:b]"));
    let twice =
        right.iter().map(|(path, text)| (*path, if *path == "more.md" { &again } else { *text }));
    let error = made(&twice.collect::<Vec<_>>()).unwrap_err().to_string();
    assert!(error.contains("fig:3: two things"), "{error}");
}

#[test]
fn a_report_with_a_mistake_is_refused() {
    let fails = |from: &str, to: &str| match assembled(&PROSE.replace(from, to)).unwrap_err() {
        Error::At { error, .. } => *error,
        error => error,
    };
    assert!(matches!(fails("At", "At 0.12,"), Error::Lint(_)));
    assert!(matches!(fails("«v.half_height»", "half"), Error::Unused(id) if id == "half_height"));
    assert!(matches!(fails("v.half", "v.hulf"), Error::Template(_)));
    assert!(matches!(fails("rice1945", "mice1945"), Error::Reference(_)));
    assert!(matches!(fails("fig03.svg", "fig04.svg"), Error::NoFile(_)));
    assert!(matches!(fails("At", "[At](javascript://x)"), Error::NoFile(_)));
    assert!(matches!(fails("![The rise.](figures/fig03.svg)", ""), Error::NotShown(_)));
    assert!(matches!(fails("\\tag{18}", ""), Error::NoEquation(number) if number == "18"));
    assert!(matches!(fails("Title", "漢"), Error::NoLatex('漢')));
}

/// What another reader of Markdown would take for markup is kept from it.
#[test]
fn markdown_shows_what_is_meant() {
    let text = "# T\n\n$a$–$b$ is \\` and ``a `b` c``, \\~\\~c\\~\\~, \\&lt; d.\n\n\\[x\\]: yes\n\n\
        ````\n```\n12\n````\n\n[DOI](https://doi.org/10.1/S0(98)00123-4)\n";
    let text = markdown::write(&tree(text));
    for kept in [
        r"$a\text{–}b$ is \` and ``a `b` c``, \~\~c\~\~, \&lt; d.",
        "\n\\[x]: yes\n",
        "\n````\n```\n12\n````\n",
        "(https://doi.org/10.1/S0(98)00123-4)",
    ] {
        assert!(text.contains(kept), "{kept}: {text}");
    }
}

/// Behind a line's end TeX takes a bracket or a star for its own.
#[test]
fn tex_takes_no_bracket_for_its_own() {
    let text =
        "# T\n\n| a | b |\n|---|---|\n| \\[q\\] | c |\n\nwords\\\n\\[y\\] or\n\n- \\[z\\] a\n";
    let text = latex::write(&tree(text)).unwrap();
    for kept in ["\n{}[q] & c", "\\\\\n{}[y] or", "\\item {}[z] a"] {
        assert!(text.contains(kept), "{kept}: {text}");
    }
}

/// What Markdown would show raw, or not at all, is told with its place in the template.
#[test]
fn broken_prose_is_told_with_its_place() {
    let mut wrong = Vec::new();
    for (broken, place, words) in [
        (r"at $\frac{1}{2$ of", "14:4", "a formula without its end"),
        (r"at $\operatorname{erf} x$", "14:4", r"write \mathrm"),
        (r"at $\nosuch x$", "14:4", r"\nosuch"),
        ("| a | b |\n|---|\n| x | y |", "14:1", "a line of dashes"),
        (r"at $\left( x$", "14:4", "no MathML"),
        ("at «v.half_height»$x$", "14:19", "right behind a word or a number"),
        ("# Another title", "14:1", "a second title"),
        ("#### Deep", "14:1", "steps over a level"),
        ("##", "14:1", "a heading without words"),
        ("## A {#sec:a .unnumbred}", "14:1", ".unnumbered"),
        ("## A {#}", "14:1", "nothing else"),
        ("## A {#sec:a\"onclick=\"x}", "14:1", "write sec: and behind it"),
        ("## A {#fig:a}", "14:1", "write sec: and behind it"),
        ("Table: A. {#fig:a}\n\n| a |\n|---|\n| b |", "14:1", "write tab: and behind it"),
        ("[!fig:a]", "14:1", "no place of a claim"),
        ("$$ x \\tag{} $$", "14:1", "write eq: and behind it"),
        ("$$ x \\tag{a b} $$", "14:1", "write eq: and behind it"),
        ("## A {#sec:a}\n\n## B {#sec:a}", "16:1", "sec:a: two things"),
        ("$$a \\tag{1}$$\n\n$$b \\tag{1}$$", "16:1", "eq:1: two things"),
        ("## A {#sec:a}\n\nSee [@sec:a; @eq:1].", "16:5", "eq:1]: nothing"),
        ("see [@fig:9] or", "14:5", "[@fig:9]: nothing"),
        ("see [@fig:3; @rice1945]", "14:5", "nothing in the report"),
        ("[data](data/no.csv)", "14:1", "a link to data/no.csv"),
        ("[code](../src/no.rs)", "14:1", "a link to ../src/no.rs"),
        ("[place](#sec-no)", "14:1", "a link to #sec-no"),
        ("[](data)", "14:1", "a link without words"),
        ("[data]()", "14:1", "leads nowhere"),
        ("![Words.](figures/fig09.svg)", "14:1", "figures/fig09.svg"),
        ("words ![Words.](figures/fig03.svg)", "14:1", "a picture stands alone"),
        ("![](figures/fig03.svg)", "14:1", "without a caption"),
        ("- ![Words.](figures/fig03.svg)", "14:3", "stands in no list"),
        ("> ## Words", "14:3", "stands in no list"),
        ("- Table: Words {#tab:w}\n\n  | a |\n  |---|", "14:3", "stands in no list"),
        ("- Scene: Words.", "14:3", "stands in no list"),
        ("| a |\n|---|\n| ![A.](figures/fig03.svg) |", "16:3", "a picture stands alone"),
        ("[![Words.](figures/fig03.svg)](data)", "14:2", "a picture stands alone"),
        ("a *word", "14:3", "emphasis"),
        ("a word[^a]", "14:7", "footnotes"),
        ("a «v.half_height»» b", "14:18", "the end of a value"),
        ("<b>bold</b>", "14:1", "HTML"),
        ("<!-- a comment --> and words", "14:1", "hides text"),
        ("a *word with $x$*", "14:14", "inside emphasis"),
        ("---", "14:1", "shown nowhere"),
        ("[a]: https://x.org", "14:1", "a definition of a link"),
        ("~~~\ncode", "14:1", "~~~ is not closed"),
        ("Table: Words. {#tab:b}\n\nwords", "14:1", "a caption without its table"),
        ("words {#sec:b}", "14:7", "an id {#…}"),
        ("| a | b |\n|---|---|\n| c | d | «v.half_height» |", "16:1", "a row of 3 cells"),
        ("- item\n\n  - a *b", "16:7", "emphasis"),
        ("see 漢", "14:5", "'漢'"),
        ("at $50 % x$ of", "14:4", r"write \%"),
        ("<% if raw.half_heigth != 1 %>a<% endif %>", "14:1", "raw.half_heigth"),
        ("<% if rav.half_height %>a<% endif %>", "14:7", "`rav` is not defined"),
        ("<% if v.half_heigth %>a<% else %>b<% endif %>", "14:1", "v.half_heigth"),
        ("«v.half_heigth | default(value=1)»", "14:1", "no template has a filter"),
        ("a \u{8} b", "14:3", "U+0008"),
        ("[a][undefined]", "14:1", "[words](target)"),
        ("~~a~~", "14:1", "struck-out"),
        ("####### a", "14:1", "at most six"),
        ("- [ ] a", "14:3", "tasks"),
        ("see @sec:a", "14:5", "without its brackets"),
        ("see (@Fig:a)", "14:6", "without its brackets"),
        ("see [sec:a]", "14:5", "write [@…]"),
        ("##A", "14:1", "a blank behind"),
        ("&#x37; masses", "14:1", "write the character itself"),
        ("at «v.half_height and\n\n«v.half_height»", "14:4", "is not closed"),
        ("if <% if raw.x\n\n<% endif %>", "14:4", "is not closed"),
        ("$$\n\nx\n$$", "14:1", "is not closed in its paragraph"),
        ("<%- if raw.x > 0 > a <% endif %>", "14:1", "<% is not closed"),
        ("$a = v.half_height»$", "14:1", "the end of a value that does not begin"),
        ("\\begin{equation}\nN = n + 1\n\\end{equation}", "14:1", "a command of TeX"),
        ("With \\(n + 1\\) gaps", "14:7", "a formula of TeX"),
        ("<% if v.half_height == 0 %>a<% endif %>", "14:1", "a condition has raw.v.half_height"),
        ("at «raw.half_height»", "14:4", "a plain number"),
        ("at «\"3.14\"»", "14:4", "a text in quotes"),
        ("at «v»", "14:4", "a whole row"),
        ("$$ $$", "14:1", "a formula without anything"),
        ("[@bibliography]", "14:1", "a second [@bibliography]"),
        ("See [@bibliography].", "14:1", "stands alone"),
        ("Table: {#tab:x}\n\n| a |\n|---|", "14:1", "without its words"),
        ("| $$x$$ |\n|---|", "14:3", "stands in a paragraph"),
        ("Let $`x = y`$ be.", "14:5", "code within a formula"),
        ("```math\nx\n```", "14:1", "a formula stands between $$"),
        ("at $x^«v.half_height»$", "14:4", "a value is an index"),
        ("at $\\frac«v.half_height»2$", "14:4", "a value is an index"),
        ("at $a \\\\ b$", "14:4", "begin{aligned}"),
        ("at \\(x\\)", "14:5", "a formula of TeX"),
        ("\\[x\\]", "14:2", "an equation of TeX"),
        ("## A {-}", "14:1", "a heading has"),
        ("[!claim:rise2]", "14:1", "there is no claim of this id"),
        ("> [!NOTE]", "14:3", "no callouts"),
        ("<% if zero %>a<% endif %>", "14:1", "there is no name zero"),
        ("<% if raw.half_height == \"0\" %>a<% endif %>", "14:1", "a number in quotes"),
        ("{ref}`x`", "14:1", "braces are none in text"),
        (":math:`x`", "14:7", "code has no role"),
        ("[@fig:3](data)", "14:1", "a reference leads"),
        ("See [x](https://).", "14:5", "a link to https://"),
        ("«literal(text=\"\", why=\"x\")»", "14:", "needs a number"),
        ("* a\n\n+ b", "16:3", "two lists"),
        ("H~x~O", "14:2", "a tie or a lowered sign"),
        ("a^b^", "14:2", "a raised sign"),
        ("a ==b== c", "14:3", "of another tool"),
        ("::: note", "14:1", "of another tool"),
        ("a\n: b", "15:1", "of another tool"),
        ("a -- b", "14:3", "two hyphens"),
        ("! [A](data)", "14:1", "of another tool"),
        ("[a](http://b c)", "14:1", "a link that is not whole"),
        ("[fig(#tab:x).", "14:1", "a link that is not whole"),
        ("[@fig:3z]", "14:1", "nothing in the report"),
        ("## A {#sec:a}\n\n[a](#sec:a)", "16:1", "a link to #sec:a"),
        ("[a](<https://x.org/a b>)", "14:1", "a blank in the target"),
        ("    code", "14:", "four blanks"),
        ("[@eq:a, @eq:b]", "14:1", "several are"),
        ("Scene: A\n\nScene: B", "16:1", "a second scene"),
        ("## A [b](data)", "14:1", "a heading leads nowhere else"),
        ("## A [@fig:3]", "14:1", "a heading leads nowhere else"),
        ("<%- macro a() %>x<% endmacro %>", "14:1", "no template has a tag \"macro\""),
        ("Scen: A", "14:1", "a paragraph that begins with `Scen:`"),
        ("Lab theory What", "14:1", "a paragraph that begins with `Lab`"),
        ("See (it)[x] now", "14:9", "a link that is not whole"),
        ("See [it] (data) now", "14:5", "a link that is not whole"),
        ("An {{ x }} b", "14:4", "braces about a value"),
        ("An <<v.x>> b", "14:4", "signs about a value"),
        ("Seen [-@rice1945]", "14:6", "a link that is not whole"),
        ("Seen [rice1945]", "14:6", "a link that is not whole"),
        ("See \\ref{x}", "14:5", "a command of TeX outside of a formula"),
        ("See [@ eq:x]", "14:5", "a blank behind the sign of [@ eq:x]"),
        ("«1 > 0»", "14:1", "this is no name of a value"),
        ("at «»", "14:4", "a value without its name"),
        ("| a |\n|---|\n| |x| |", "16:1", "a bar in a cell"),
    ] {
        let made = assembled(&format!("{PROSE}\n\n{broken}\n"));
        let error = made.map_or_else(|error| error.to_string(), |_| "nothing is told".into());
        let told = error.starts_with(&format!("report.md:{place}"));
        if !told || !error.contains(words) || error.contains('\n') {
            wrong.push(format!("{broken}: {error}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let good = "Words \\*, \\_, \\$, me@x.org: C#, \\@sec:a, \\#, a * b, a_b, \\[a, b\\], a < b, \\^, \\~, \\--, <!-- a comment --> and\n\n<!-- another -->\n\n\
        [data](data), [code](../src/lib.rs), [out](https://x.org/a), <me@x.org>, [me](mailto:me@x.org), `*` and $a_b * c^*$.";
    assembled(&format!("{PROSE}\n\n{good}\n")).unwrap();
}

#[test]
fn what_cannot_be_resolved_is_an_error() {
    let code = "```rust toy::flight::Motion::kick\n```";
    assert!(parsed(&format!("Listing: A. {{#lst:a}}\n\n{code}")).is_ok());
    for text in [format!("Words.\n\n{code}"), format!("Listing: No id.\n\n{code}")] {
        let error = parsed(&text).unwrap_err().to_string();
        assert!(error.contains("Motion::kick") && error.contains("Listing: "), "{error}");
    }
}

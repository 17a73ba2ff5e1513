//! Breaks prose: each fault is named with its place.

use super::{Given, PROSE, Table, assembled, file, given, unmarked};

/// Broken prose, line and column of the error, and words of its message; or a heading.
const BROKEN: &str = r##"
A name that there is not.
a⏎«v.half_heigth» => 15:4 => v.half_heigth: there is no such name; nearest: half_height
<% if raw.half_heigth != 1 %>a<% endif %> => 14:7 => nearest: half_height
at «v.half_height now => 14:4 => this « has no » on its line
rises«holds(that=raw.half_height > 0.2)», so => 14:7 => the words before are no longer true: holds(that=raw.half_height > 0.2), where raw.half_height is 0.11652
rises«holds(that=raw.half_heigth > 0.2)» => 14:18 => nearest: half_height
at «raw.half_height» => 14:5 => a plain number is for conditions; write the value
at «nothing.at_all» => 14:5 => nothing
a <% if raw.half_height > 1 %>b => 1 => nexpected end
«v.half_height | nofilter» => 14: => nofilter
«literal(text="2007", why=" ")» => 14:2 => `literal` needs a number in `text` and its reason
at «v.empty» => 14: => empty has no number; say what stands there, by «… | otherwise(words=
at $x = «v.empty»$ => 14:4 => empty has no number
A hard-coded number.
at 0.12, so => 14:4 => hard-coded number 0.12;
a tenfold rise => 14:3 => hard-coded number tenfold;
at «"3.14"» => 14:4 => hard-coded number 3.14;
<% set b = 98.98 %>at «b» => 14:23 => hard-coded number 98.98;
<% for n in [13.5] %>at «n»<% endfor %> => 14:25 => hard-coded number 13.5;
<% set a = raw.half_height * 60 %>at «a» => 14:38 => hard-coded number 6.99
at «v.empty | otherwise(words="12") » => 14:4 => hard-coded number 12;
by $N = «6 + 1»$ => 14:4 => hard-coded number 7;
at «v.half_height» % => 14:4 => % follows «half_height», whose unit is
at «v.count»«v.half_height» => 14:4 => «count» reads as one number with what stands beside it
at «v.count».«v.count» => 14:4 => «count» reads as one number
at .«v.count» => 14:5 => «count» reads as one number
- a⏎  - b⏎    - c⏎      - d⏎        - e => 14:1 => lists stand at most four deep
at -$«v.half_height»$ => 14:6 => a minus before «half_height» changes its sign
at **«v.half_height»** % => 14:6 => % follows «half_height», whose unit is
at «v.count | significant(digits=30)» => 14: => needs 1 to 17: 
at −«v.half_height» => 14:5 => a minus before «half_height» changes its sign
$x = «v.half_height | percent»\,\%$ => 14:6 => % follows «half_height», whose unit is
at «v.half_height | significant(digits=17)» => 14:4 => a standard error, which `significant` drops
We find $\sigma_{1/2} = 0.1159$ here. => 14:9 => hard-coded number 0.1159;
by `0.1159` => 14:5 => hard-coded number 0.1159;
| a |⏎|---|⏎| 12 | => 16:3 => hard-coded number 12;
A reference to what there is not.
see [@fig:9] or => 14:5 => [@fig:9]: nothing in the report has this id; correct or remove the reference; nearest: fig:fig03
see [@fig:fig03; @rice1945] => 14:5 => different kinds
as @rise1945 showed => 14:4 => [@rise1945]: nothing in the report and no entry of references.bib has this id; nearest: rice1945
Seen [@eq:a, @eq:b] => 14:6 => ids alone
Seen [@rice1945, Sec. 3] => 14:6 => ids alone
[data](data/fig3.csv) => 14:1 => a link to data/fig3.csv: there is no such file or place; correct or remove it; nearest: data/fig03.csv
[x](https://x.org "y") => 14:1 => a link has no title
[place](#sec-no) => 14:1 => a link to #sec-no
## A {#sec:a.b}⏎⏎## B {#sec:a-b} => 16:1 => sec:a-b: links cannot tell it from sec:a.b;
[!claim:rise2] => 14:1 => there is no statement with this id; nearest: rise
[mice](javascript://x) => 14:1 => a link to javascript://x
Seen [@mice1945] => 14:6 => [@mice1945]: nothing
![Words.](figures/fig09.svg) => 14:1 => there is no figure figures/fig09.svg; use figures/NAME.svg of a figure of the paper; a file becomes one by Figure::picture; nearest: figures/fig03.svg
![Words.](figures/fig03.png){#fig:x} => 14:1 => there is no figure figures/fig03.png; 
![Words.](img/photo.png) => 14:1 => there is no figure img/photo.png; 
![Words.](figures/fig03.svg){#eq:a} => 14:1 => write fig: followed by
$$ x $$ {#fig:a} => 14:1 => write eq: followed by
## A {#sec:a}⏎⏎## B {#sec:a} => 16:1 => have this id
## A {#fig:a} => 14:1 => write sec: followed by
A table or a formula that is broken.
| a | b |⏎|---|⏎| x | y | => 14:1 => a line of dashes
| a | b |⏎|---|---|⏎| c | d | «v.half_height» | => 16:1 => a row has 3 cells
Table: A. {#tab:b}⏎⏎words => 14:1 => a caption must be followed by its table
Table: A. {#tab:&amp;}⏎⏎| a |⏎|---| => 14:1 => write tab: followed by
Words.⏎⏎«code(item="toy::flight::Motion::kick")» => 16:1 => needs a paragraph `Listing: 
Words.⏎⏎«code(item="toy::flight::kik")» => 16:1 => there is no listing `toy::flight::kik`; it needs the lines `// listing: kik`
at $\left( x$ => 14:4 => cannot be shown
$$ x \tag{a b} $$ => 14:1 => write eq: followed by
$$⏎a = b⏎+ c⏎$$ => 16:1 => an unclosed formula
| $$x$$ |⏎|---| => 14:3 => must stand in a paragraph
A macro that GitHub refuses, and what it renders differently.
at $\operatorname{erf} x$ => 14:4 => write \mathrm
at $\newcommand{\a}{b}$ => 14:4 => \newcommand is not
at $\,\sigmma$ => 14:4 => \sigmma is not supported by every format; nearest: \sigma
at $a \mod b$ => 14:4 => nearest: \bmod
at $\alpha % x$ => 14:4 => write \%
at $a \\ b$ => 14:4 => \begin{aligned}
at $\begin{align} a \end{align}$ => 14:4 => an environment must be one of aligned, 
at $x^«v.half_height»$ => 14:4 => a value used as an index
at «v.half_height»$x$ => 14:19 => right after a word or a number
a *word with $x$* => 14:14 => in emphasis
What is too deep or too long.
at $DEEP{xDEEP}$ => 14:4 => cannot be shown: it is nested more than 40 deep
at $HATSx$ => 14:4 => nested more than 40 deep
QUOTESa => 14: => nested too deeply
<% for a in range(end=30000) %><% for b in range(end=30000) %>QUOTES⏎<% endfor %><% endfor %> => 14:6 => this writes more than 64 MiB
at «IN1IN» => 14: => too complex
<% if false %>ELIFS<% endif %> => 14: => more than 200 `elif`
A delimiter that is not closed.
at $\frac{1}{2$ of => 14:4 => a dollar sign alone
a *word => 14:3 => unclosed markup
a «v.half_height»» b => 14:18 => unclosed markup
- item⏎⏎  - a *b => 16:7 => unclosed markup
See [it] (data) now => 14:5 => unclosed markup
words {#sec:b} => 14:7 => an id belongs right after
![The rise.](figures/fig03.svg){width=50%} => 14:32 => such as a width
at $5, with => 14:4 => a dollar sign alone
a @ b => 14:3 => a citation is @key
«v» => 14:1 => a group or a row
```⏎code => 14:1 => between two lines ```
```⏎code⏎⏎`x` is the last word => 14:1 => between two lines ```
````⏎code⏎``` => 14:1 => between two lines ```
~~~⏎code⏎``` => 14:1 => between two lines ```
> ## Words => 14:3 => cannot stand in a list
What not every format supports.
<b>bold</b> => 14:1 => not supported by every format
--- => 14:1 => not supported by every format
<!-- a comment --> => 14:1 => not supported by every format
a[^1] => 14:2 => footnotes are not supported
# Another title => 14:1 => one title
- ![Words.](figures/fig03.svg) => 14:3 => cannot stand in a list
words ![Words.](figures/fig03.svg) => 14:7 => a figure must stand alone
at «v.half_height[1:]» => 14:1 => name it whole
see 漢 => 14:5 => '漢'"##;

#[test]
fn faults_in_prose_are_reported_with_their_places() {
    let mut wrong = Vec::new();
    let deep = [("DEEP{", r"\sqrt{"), ("DEEP}", "}"), ("HATS", r"\hat "), ("QUOTES", "> ")];
    let deep = deep.into_iter().chain([("IN1IN", "("), ("ELIFS", "<% elif false %>a")]);
    let deep = |line: &str| {
        deep.clone()
            .fold(line.to_string(), |line, (name, sign)| line.replace(name, &sign.repeat(201)))
    };
    for line in BROKEN.lines().map(deep) {
        let parts: Vec<String> = line.split(" => ").map(unmarked).collect();
        let [broken, place, words] = parts.as_slice() else { continue };
        let made = assembled(&format!("{PROSE}\n\n{broken}\n"));
        let error = made.map_or_else(|error| error.to_string(), |_| "no error".into());
        let placed = error.starts_with(&format!("report.md:{place}"));
        if !placed || !error.contains(words.as_str()) || error.contains('\n') {
            wrong.push(format!("{broken}: {error}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn several_faults_have_their_places() {
    for (broken, expected) in [
        ("a *b\n\n12\n\n- at $\\nosuch x$", ["14:3:", "16:1:", "18:6:"].as_slice()),
        ("## A *b {#sec:b}\n\nSee [@sec:b], [@sec:c].", &["14:6:", "16:15"]),
        ("漢\n\nat é and $\\left( x$\n\nand 字", &["14:1:", "16:10", "18:5:"]),
    ] {
        let error = assembled(&format!("{PROSE}\n\n{broken}\n")).unwrap_err().to_string();
        let places = error.lines().filter_map(|line| line.strip_prefix("report.md:")?.get(..5));
        assert_eq!(places.collect::<Vec<_>>(), expected, "{error}");
    }
}

#[test]
fn good_prose_passes() {
    let good = "Words \\*, \\_, \\$, me@x.org: C#, \\@sec:a, \\#, a * b, a_b, \\[a, b\\], a < b, \\^, \\~, \\-- and\n\n\
        [data](data), [code](../src/lib.rs), [out](https://x.org/10), `*` and $a_b * c^*$.\n\n\
        «literal(text=\"2007\", why=\"the year\")», two-sided, `f64`, $k \\ge 3$, $x_{12} = «v.half_height»$\n\n```\n12\n```\n\n\
        ~~~~\n12\n```\n~~~~~  \n\n> ```\n> 12\n> ```\n\n\
        $$\n\\begin{aligned} a &= b \\\\\n&+ c \\end{aligned}\n$$\n\n«v.empty | otherwise(words=\"nothing\")», «v.count | otherwise(words=\"nothing\")»\n\n| a |\n|---|\n| «v.empty» |\n\n12) item and [linked][a].\n\n[a]: https://x.org\n\n<# 12 #><% if raw.half_height > 12 %>12<% endif %>\
        <% for row in keys.toy.none.rows %><% if raw.toy.none[row].x > 1 %>a<% endif %><% endfor %>";
    let none = Table::of("toy.none", &[0.5; 0], |_| 0).key("x", "1", |x| *x).done();
    let prose = format!("{PROSE}\n\n{good}\n");
    let report = Given { table: Some(none), ..given(&prose) }.made().unwrap();
    let text = file(&report, "report.md");
    assert!(text.contains("nothing, 12") && text.contains("| – |"), "{text}");
    let lists = assembled(&format!("{PROSE}\n\n1. a\n\n1) b\n")).unwrap();
    assert!(file(&lists, "report.md").contains("1. a\n\n<!-- -->\n\n1. b\n"));
}

//! No naked numerals: a digit in prose is a value, part of mathematics, a reference, or declared. And no
//! delimiter without its end, which would show numerals elsewhere as naked.
//!
//! The lint reads templates before they are filled. Exempt are tags and comments of Tera (so
//! `«v.id»` and `«literal(text="2007", why="…")»`), mathematics, code, `[@references]`,
//! `[!anchors]`, `{#ids}`, targets of links, markers of ordered lists, and names that begin with
//! a letter (`f64`). A number alone in mathematics, as `$0.12$`, is naked too: it is not a formula.
//!
//! Number words are numerals: *two*, *twice*, *twenty*, *hundred*, *dozens*. Not so words that are mostly
//! something else: *one* (a pronoun), *once*, *single*, *pair*, *both*, *half*, *quarter*, *zero*, and
//! ordinals (*first*, *a tenth of N* is a definition). A word inside a compound that names a kind,
//! as *two-sided*, passes. Whatever the model itself fixes (*two masses* meet in an impact) is declared
//! once, as a phrase with its reason, in `literals.toml`; a phrase that no prose has is refused.

pub use super::declared::Declared;
use super::tags::other_word;
use super::{Error, Templates};
use crate::input::is_no_text;
use crate::source::Program;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// A numeral that nobody computed, or a delimiter without its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Template file.
    pub path: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What it is.
    pub fault: Fault,
}

/// What the lint finds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A numeral.
    Numeral(String),
    /// A kind of `EXEMPT` that opens and does not close.
    Open((&'static str, &'static str, bool)),
    /// A character that is none of a text, by its number.
    Control(char),
    /// A tag or a filter that no template has: which of both, its word, and those that there are.
    Word(&'static str, String, &'static [&'static str]),
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Finding { path, line, column, fault } = self;
        let numeral = match fault {
            Fault::Numeral(numeral) => numeral,
            Fault::Control(c) => {
                let number = u32::from(*c);
                return write!(
                    f,
                    "{path}:{line}:{column}: the character U+{number:04X} is none of a text; remove it"
                );
            }
            Fault::Word(kind, word, all) => {
                let all = all.join(", ");
                return write!(
                    f,
                    "{path}:{line}:{column}: no template has a {kind} {word:?}, only {all}; remove it"
                );
            }
            Fault::Open((open, close, long)) => {
                let here = if *long { "" } else { " in its paragraph" };
                let close = if *close == "$" { "$, with no blank before it," } else { close };
                return write!(
                    f,
                    "{path}:{line}:{column}: {open} is not closed{here}; put {close} where it ends"
                );
            }
        };
        write!(f, "{path}:{line}:{column}: the naked numeral {numeral}; name a value «v.…», ")?;
        if numeral.contains(['\\', '^', '{']) {
            let doubled = numeral.replace('\\', "\\\\");
            write!(f, "or declare «literal(text=\"${doubled}$\", why=\"…\")»")
        } else if numeral.starts_with(char::is_alphabetic) {
            write!(f, "or declare the phrase around it, with its reason, in literals.toml")
        } else {
            write!(f, "or declare «literal(text=\"{numeral}\", why=\"…\")»")
        }
    }
}

/// Pairs of delimiters between which digits are exempt, in the order in which they are tried, and whether
/// what is between them may go over several paragraphs.
const EXEMPT: [(&str, &str, bool); 15] = [
    ("<#", "#>", true),
    ("<%", "%>", true),
    ("«", "»", true),
    ("<!--", "-->", true),
    ("````", "````", true),
    ("```", "```", true),
    ("~~~", "~~~", true),
    ("`", "`", false),
    ("$$", "$$", false),
    ("$", "$", false),
    ("[@", "]", false),
    ("[!", "]", false),
    ("{#", "}", false),
    ("](", ")", false),
    ("<http", ">", false),
];

/// Where what a delimiter opens ends: the length of what is between. A dollar that ends a formula has no
/// blank before it.
fn length(inner: &str, (open, close, long): (&str, &str, bool)) -> Option<usize> {
    let scope = if long { inner } else { inner.split("\n\n").next().unwrap_or(inner) };
    let mut ends = scope.match_indices(close).map(|(at, _)| at);
    if ["«", "<%"].contains(&open) {
        // Another begins before it ends.
        return ends.next().filter(|end| !scope[..*end].contains(open));
    }
    if open == "](" {
        // Brackets in the target come in pairs.
        let depth =
            |text: &str| text.matches('(').count() as i32 - text.matches(')').count() as i32;
        let whole = ends.find(|end| depth(&scope[..*end]) <= 0);
        // Behind a blank there is no target any more, but a title, or text.
        return whole.map(|end| scope[..end].find(char::is_whitespace).unwrap_or(end));
    }
    if ["[@", "[!"].contains(&open) && !scope.starts_with('[') {
        // What it names has neither brackets nor formulas.
        return ends.next().filter(|end| !scope[..*end].contains(['[', '(', ')', '$']));
    }
    if open != "$" {
        return ends.next();
    }
    let end = ends.find(|at| !scope[..*at].ends_with('\\'))?;
    (!scope[..end].is_empty() && !scope[..end].ends_with([' ', '\n'])).then_some(end)
}

/// Refuses characters that are none of a text, and tags and filters that no template has.
///
/// # Errors
/// All places where there are some.
pub fn form(templates: &Templates) -> Result<(), Error> {
    let odd = |(path, text)| odd(path, text).or_else(|| other_word(path, text));
    let odd: Vec<Finding> = templates.iter().filter_map(odd).collect();
    if odd.is_empty() { Ok(()) } else { Err(Error::Lint(odd)) }
}

/// Holds all prose against the lint. What it gives says which declared phrases the prose has.
///
/// # Errors
/// What is missing or empty, and all places with a fault.
pub fn check(templates: &Templates, program: Program) -> Result<Declared, Error> {
    for of in program.documents {
        let mut texts = of.files(templates).into_iter().map(|path| templates.text(path));
        if texts.all(|text| text.is_ok_and(|text| text.trim().is_empty())) {
            let what = "it is missing or empty; write the document";
            return Err(Error::Template(format!("{}.md: {what}", of.prose)));
        }
    }
    let empty = |(path, text): &(&str, &str)| path.ends_with(".md") && text.trim().is_empty();
    if let Some((path, _)) = templates.iter().find(empty) {
        let what = "it is empty; write what it had, or remove it";
        return Err(Error::Template(format!("{path}: {what}")));
    }
    form(templates)?;
    let prose = templates.iter().filter(|(path, _)| path.ends_with(".md"));
    let declared = Declared::read(templates.text("literals.toml")?)?;
    let found: Vec<Finding> =
        prose.flat_map(|(path, text)| findings(path, text, &declared)).collect();
    if !found.is_empty() {
        return Err(Error::Lint(found));
    }
    Ok(declared)
}

/// Words that are numbers and nothing else.
const WORDS: &str = "two three four five six seven eight nine ten eleven twelve thirteen fourteen \
    fifteen sixteen seventeen eighteen nineteen twenty thirty forty fifty sixty seventy eighty ninety \
    hundred thousand million billion dozen hundreds thousands millions dozens tens twice thrice";

/// The first character that is none of a text.
fn odd(path: &str, text: &str) -> Option<Finding> {
    let (at, c) = text.char_indices().find(|(_, c)| is_no_text(*c))?;
    let mut position = Position::default();
    position.past(text, at);
    Some(position.finding(path, Fault::Control(c)))
}

/// The first character that is none, the first delimiter without its end, or else all naked numerals.
pub fn findings(path: &str, text: &str, declared: &Declared) -> Vec<Finding> {
    if let Some(odd) = odd(path, text) {
        return vec![odd];
    }
    let mut findings = Vec::new();
    let mut position = Position::default();
    let mut rest = text;
    // The word that the position is in, and whether it began with a letter.
    let mut word: Option<bool> = None;
    while let Some(c) = rest.chars().next() {
        // A sign behind a backslash is meant as it stands.
        if rest
            .strip_prefix('\\')
            .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_punctuation()))
        {
            rest = position.past(rest, 2);
            word = None;
            continue;
        }
        let opens = |(open, ..): &&(&str, _, _)| rest.starts_with(open);
        // A dollar before a blank is a sign of money.
        let money = rest.strip_prefix('$').is_some_and(|rest| rest.starts_with([' ', '\n']));
        if let Some(&kind) = EXEMPT.iter().find(opens).filter(|_| !money) {
            let (open, close, _) = kind;
            let inner = &rest[open.len()..];
            let Some(length) = length(inner, kind) else {
                return vec![position.finding(path, Fault::Open(kind))];
            };
            if open == "$" && is_number(&inner[..length]) {
                findings.push(position.numeral(path, &inner[..length]));
            }
            rest = position.past(rest, open.len() + length + close.len());
            word = None;
            continue;
        }
        if position.column == 1 {
            let marker = list_marker(rest);
            if marker > 0 {
                rest = position.past(rest, marker);
                continue;
            }
        }
        if c.is_alphanumeric() || c == '_' {
            if word.is_none() && c.is_alphabetic() {
                let start = text.len() - rest.len();
                let whole: String = rest.chars().take_while(|c| c.is_alphanumeric()).collect();
                if is_number_word(&whole)
                    && !names_a_kind(text, start, &whole)
                    && !declared.allows(text, start, &whole)
                {
                    findings.push(position.numeral(path, &whole));
                }
            }
            let begins_with_letter = *word.get_or_insert(c.is_alphabetic() || c == '_');
            if c.is_numeric() && !begins_with_letter {
                let numeral: String = rest.chars().take_while(|c| in_numeral(*c)).collect();
                let numeral = numeral.trim_end_matches(['.', ',']).to_string();
                findings.push(position.numeral(path, &numeral));
                rest = position.past(rest, numeral.len());
                continue;
            }
        } else {
            word = None;
        }
        rest = position.past(rest, c.len_utf8());
    }
    findings
}

fn is_number_word(word: &str) -> bool {
    static KNOWN: LazyLock<BTreeSet<&str>> = LazyLock::new(|| WORDS.split_whitespace().collect());
    KNOWN.contains(word.to_lowercase().as_str())
}

/// Is the word tied by a hyphen to one that is no number: *two-sided*, not *twenty-five*?
fn names_a_kind(text: &str, start: usize, word: &str) -> bool {
    let after = text[start + word.len()..].strip_prefix('-').unwrap_or_default();
    let next: String = after.chars().take_while(|c| c.is_alphabetic()).collect();
    !next.is_empty() && !is_number_word(&next) && next.to_lowercase() != "one"
}

fn in_numeral(c: char) -> bool {
    c.is_numeric() || matches!(c, '.' | ',')
}

/// What may stand about a number without making a formula of it; of two that begin alike the longer first.
const AROUND: [&str; 22] = [
    r"\times",
    r"\cdot",
    r"\,",
    r"\;",
    r"\:",
    r"\!",
    r"\quad",
    r"\approx",
    r"\simeq",
    r"\sim",
    r"\leq",
    r"\le",
    r"\geq",
    r"\ge",
    r"\lesssim",
    r"\gtrsim",
    r"\ll",
    r"\gg",
    r"\pm",
    r"\mathbf",
    r"\mathit",
    r"\boldsymbol",
];

/// Nothing but one number? `0` and `1` pass: they are as much words as numbers.
fn is_number(maths: &str) -> bool {
    let mut text = maths.to_string();
    // Words and units in it are no letters of a formula.
    for open in [r"\text{", r"\textrm{", r"\mathrm{"] {
        while let Some((before, after)) = text.split_once(open) {
            let Some((word, rest)) = after.split_once('}') else { break };
            if is_number_word(word.trim()) {
                return true;
            }
            let word = if word.contains(|c: char| c.is_ascii_digit()) { word } else { "" };
            text = format!("{before}{word}{rest}");
        }
    }
    for sign in AROUND {
        text = text.replace(sign, "");
    }
    let text = text.trim_matches([' ', '=', '<', '>', '~', '≈', '±', '≤', '≥']);
    let digits = text.chars().any(|c| c.is_ascii_digit());
    digits
        && !matches!(text, "0" | "1")
        && text.chars().all(|c| c.is_ascii_digit() || " .,+-^{}%\\()".contains(c))
}

/// Length of "  12. " at the start of a line.
fn list_marker(line: &str) -> usize {
    let spaces = line.len() - line.trim_start_matches(' ').len();
    let digits = line[spaces..].chars().take_while(char::is_ascii_digit).count();
    let end = spaces + digits;
    if digits > 0 && (line[end..].starts_with(". ") || line[end..].starts_with(") ")) {
        end + 1
    } else {
        0
    }
}

pub(super) struct Position {
    line: usize,
    column: usize,
}

impl Default for Position {
    fn default() -> Self {
        Position { line: 1, column: 1 }
    }
}

impl Position {
    /// Moves over so many bytes of `rest`, and returns what is behind them.
    pub(super) fn past<'a>(&mut self, rest: &'a str, bytes: usize) -> &'a str {
        for c in rest[..bytes].chars() {
            if c == '\n' {
                (self.line, self.column) = (self.line + 1, 1);
            } else {
                self.column += 1;
            }
        }
        &rest[bytes..]
    }

    pub(super) fn finding(&self, path: &str, fault: Fault) -> Finding {
        Finding { path: path.to_string(), line: self.line, column: self.column, fault }
    }

    fn numeral(&self, path: &str, numeral: &str) -> Finding {
        self.finding(path, Fault::Numeral(numeral.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<(usize, usize, String)> {
        let place = |f: Finding| match f.fault {
            Fault::Numeral(numeral) => (f.line, f.column, numeral),
            Fault::Open((open, ..)) => (f.line, f.column, format!("open {open}")),
            Fault::Control(c) => (f.line, f.column, format!("control {}", u32::from(c))),
            Fault::Word(kind, word, _) => (f.line, f.column, format!("{kind} {word}")),
        };
        findings("x.md", text, &Declared::default()).into_iter().map(place).collect()
    }

    #[test]
    fn what_is_no_text_is_found_with_its_place() {
        assert_eq!(found("a\n«v.x and\n«v.y»"), [(2, 1, "open «".into())]);
        assert_eq!(found("a\nb\u{8}c 3"), [(2, 2, "control 8".into())]);
        assert_eq!(found("a\n\tb\0"), [(2, 3, "control 0".into())]);
        assert_eq!(found("a `\u{e000}v.x\u{e001}`"), [(1, 4, "control 57344".into())]);
    }

    #[test]
    fn digits_in_prose_are_found_with_their_place() {
        assert_eq!(
            found("a\nrises at 0.12, and 3."),
            [(2, 10, "0.12".into()), (2, 20, "3".into())]
        );
        assert_eq!(found("the 2nd of 1,000"), [(1, 5, "2".into()), (1, 12, "1,000".into())]);
        assert_eq!(
            found("Fig. 3, n=4, ½"),
            [(1, 6, "3".into()), (1, 11, "4".into()), (1, 14, "½".into())]
        );
        assert_eq!(found("$0.12$ and $10^{-9}$").len(), 2);
        for alone in [
            r"\approx 0.12",
            r"\text{0.12}",
            r"\mathbf{3}",
            "= 3",
            r"3~\text{gaps}",
            r"\mathrm{seven}",
        ] {
            assert_eq!(found(&format!("at ${alone}$")).len(), 1, "{alone}");
        }
        assert_eq!(
            found(r"$= 0$, $\approx 1$, $x_{12}$, $\sigma = 0.12$, $10^{n}$ and $2 \text{ of } n$")
                .len(),
            0
        );
        assert_eq!(found("a price of 5 $ only"), [(1, 12, "5".into())]);
    }

    #[test]
    fn number_words_are_numerals() {
        assert_eq!(
            found("Two rows,\nmore than a hundred"),
            [(1, 1, "Two".into()), (2, 13, "hundred".into())]
        );
        assert_eq!(found("twenty-five times, twice").len(), 3);
        assert_eq!(found("twenty-one times, two-sided").len(), 1);
        for text in ["one of them, once, a single pair, both halves", "two-sided", "often, weight"]
        {
            assert_eq!(found(text), [], "{text}");
        }
        let file =
            "[[literal]]\nwhy = \"an impact has them\"\nphrases = [\"two masses\", \"not there\"]";
        let declared = Declared::read(file).unwrap();
        assert_eq!(findings("x.md", "The two masses. Two masses; two", &declared).len(), 1);
        assert_eq!(declared.unmet(), ["not there"]);
        assert!(Declared::read("[[literal]]\nwhy = \" \"\nphrases = [\"two\"]").is_err());
    }

    #[test]
    fn what_is_not_closed_is_told_and_no_numeral_elsewhere() {
        for (text, at) in [
            ("a\n\nb «v.x of\n$k = 3$", (3, 3, "«")),
            ("with $k = 3 and $l = 4$\n\nthe $m = 5$", (1, 6, "$")),
            ("with `k = 3\n\nthe `m = 5`", (1, 6, "`")),
            ("$$\na = 3\n\nthe $m = 5$", (1, 1, "$$")),
            ("see [@fig:3\n\nor [@fig:4]", (1, 5, "[@")),
            ("<% if 3\nx", (1, 1, "<%")),
            ("x [data](a.csv\n\n3", (1, 8, "](")),
        ] {
            let (line, column, open) = at;
            assert_eq!(found(text), [(line, column, format!("open {open}"))], "{text}");
        }
    }

    #[test]
    fn what_is_declared_or_no_prose_passes() {
        for text in [
            "«v.p_15» and «literal(text=\"2007\", why=\"year\")» <% if raw.n > 3 %> <# 12 #>",
            "$k = 1$, $1$, $x_{12}$\n$$\n1 + 2 \\tag{18}\n$$",
            "[@fig:3] [@eq:18; @rice1945] [!claim:c1] {#sec:s2}",
            "`f64 = 3` and f64, k1, σ², H2O\n```\n12\n```",
            "1. one\n2. other\n   3) third",
            "[words](data/fig03.csv) ![caption](figures/fig03.svg) <https://x.org/10.1/2>",
            "<!-- 12 -->",
        ] {
            assert_eq!(found(text), [], "{text}");
        }
    }
}

//! No naked numerals: a digit in prose is a value, part of mathematics, a reference, or declared.
//!
//! The lint reads templates before they are filled. Exempt are tags and comments of Tera (so
//! `«v.id»` and `«literal(text="2007", why="…")»`), mathematics, code, `[@references]`,
//! `[!anchors]`, `{#ids}`, targets of links, markers of ordered lists, and names that begin with
//! a letter (`f64`). A number alone in mathematics, as `$0.12$`, is naked too: it is not a formula.

/// A numeral that nobody computed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Template file.
    pub path: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The numeral.
    pub numeral: String,
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Finding { path, line, column, numeral } = self;
        write!(
            f,
            "{path}:{line}:{column}: the naked numeral {numeral}; name a value «v.…», \
             or declare «literal(text=\"{numeral}\", why=\"…\")»"
        )
    }
}

/// Pairs of delimiters between which digits are exempt, in the order in which they are tried.
const EXEMPT: [(&str, &str); 13] = [
    ("<#", "#>"),
    ("<%", "%>"),
    ("«", "»"),
    ("<!--", "-->"),
    ("```", "```"),
    ("`", "`"),
    ("$$", "$$"),
    ("$", "$"),
    ("[@", "]"),
    ("[!", "]"),
    ("{#", "}"),
    ("](", ")"),
    ("<http", ">"),
];

/// All naked numerals of a text.
pub fn numerals(path: &str, text: &str) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut position = Position { line: 1, column: 1 };
    let mut rest = text;
    // The word that the position is in, and whether it began with a letter.
    let mut word: Option<bool> = None;
    while let Some(c) = rest.chars().next() {
        if rest.starts_with(r"\$") {
            rest = position.past(rest, 2);
            continue;
        }
        if let Some((open, close)) = EXEMPT.iter().find(|(open, _)| rest.starts_with(open)) {
            let inner = &rest[open.len()..];
            // Without its end a delimiter is a character like any other.
            if let Some(length) = inner.find(close) {
                if *open == "$" && is_number(&inner[..length]) {
                    findings.push(position.finding(path, &inner[..length]));
                }
                rest = position.past(rest, open.len() + length + close.len());
                word = None;
                continue;
            }
        }
        if position.column == 1 {
            let marker = list_marker(rest);
            if marker > 0 {
                rest = position.past(rest, marker);
                continue;
            }
        }
        if c.is_alphanumeric() || c == '_' {
            let begins_with_letter = *word.get_or_insert(c.is_alphabetic() || c == '_');
            if c.is_numeric() && !begins_with_letter {
                let numeral: String = rest.chars().take_while(|c| in_numeral(*c)).collect();
                let numeral = numeral.trim_end_matches(['.', ',']).to_string();
                findings.push(position.finding(path, &numeral));
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

fn in_numeral(c: char) -> bool {
    c.is_numeric() || matches!(c, '.' | ',')
}

/// Nothing but one number? `0` and `1` pass: they are as much words as numbers.
fn is_number(maths: &str) -> bool {
    let text = maths.replace(r"\times", "").replace(r"\cdot", "").replace(r"\,", "");
    let text = text.trim();
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

struct Position {
    line: usize,
    column: usize,
}

impl Position {
    /// Moves over so many bytes of `rest`, and returns what is behind them.
    fn past<'a>(&mut self, rest: &'a str, bytes: usize) -> &'a str {
        for c in rest[..bytes].chars() {
            if c == '\n' {
                (self.line, self.column) = (self.line + 1, 1);
            } else {
                self.column += 1;
            }
        }
        &rest[bytes..]
    }

    fn finding(&self, path: &str, numeral: &str) -> Finding {
        let numeral = numeral.to_string();
        Finding { path: path.to_string(), line: self.line, column: self.column, numeral }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<(usize, usize, String)> {
        let place = |f: Finding| (f.line, f.column, f.numeral);
        numerals("x.md", text).into_iter().map(place).collect()
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
        assert_eq!(found("a price of 5 $ only"), [(1, 12, "5".into())]);
    }

    #[test]
    fn what_is_declared_or_no_prose_passes() {
        for text in [
            "«v.p_15» and «literal(text=\"2007\", why=\"year\")» <% if raw.n > 3 %> <# 12 #>",
            "$k = 1$, $1$, $x_{12}$\n$$\n1 + 2 \\tag{18}\n$$",
            "[@fig:3] [@eq:18; @rice1945] [!claim:c1] {#sec:s2}",
            "`f64 = 3` and f64, k1, σ², H2O\n```\n12\n```",
            "1. one\n2. two\n   3) three",
            "[words](data/fig03.csv) ![caption](figures/fig03.svg) <https://x.org/10.1/2>",
            "<!-- 12 -->",
        ] {
            assert_eq!(found(text), [], "{text}");
        }
    }
}

//! A Markdown document as its sentences, and words in which all numbers are alike.

use super::super::spell;
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use std::mem::take;

/// A row of a table, an equation and a line of code are sentences too.
pub struct Sentence {
    /// The heading above.
    pub section: String,
    pub words: Vec<Word>,
}

#[derive(Clone, Default)]
pub struct Word {
    pub shown: String,
    /// What is compared: a placeholder stands for each number.
    pub key: String,
}

/// What ends with a point and no sentence.
const SHORT: [&str; 12] = [
    "Fig.", "Figs.", "Eq.", "Eqs.", "Sec.", "Secs.", "Ref.", "Refs.", "e.g.", "i.e.", "cf.", "al.",
];

/// What may stand between two digits of one number, here with its error and power of ten.
const JOINTS: [&str; 5] = [".", "\u{202f}", "(", "×10^", "×10^-"];

/// All sentences. Markup, targets of links and marks of verdicts are no words.
pub fn sentences(text: &str) -> Vec<Sentence> {
    let mut reader = Reader::default();
    let (mut code, mut mark) = (false, false);
    for event in Parser::new_ext(text, Options::ENABLE_MATH | Options::ENABLE_TABLES) {
        match event {
            Event::InlineHtml(html) if html.ends_with("sup>") => mark = !html.starts_with("</"),
            Event::Text(_) if mark => {}
            Event::Start(Tag::CodeBlock(_)) => code = true,
            Event::End(TagEnd::CodeBlock) => code = false,
            Event::Text(lines) if code => lines.lines().for_each(|line| {
                reader.push(line, str::to_string);
                reader.end(false);
            }),
            Event::Text(text) => reader.push(&text, |word| folded(word, false)),
            Event::Code(text) => reader.push(&text, str::to_string),
            Event::InlineMath(tex) => reader.push(&spell::maths(&tex), |word| folded(word, true)),
            Event::DisplayMath(tex) => {
                reader.end(true);
                // Its number moves with those above.
                let tex = tex.split(r"\tag").next().unwrap_or_default();
                reader.push(tex, |word| folded(word, true));
                reader.end(false);
            }
            Event::SoftBreak | Event::HardBreak => reader.push(" ", str::to_string),
            Event::Start(Tag::TableCell) if !reader.words.is_empty() => {
                reader.push(" | ", str::to_string);
            }
            Event::End(TagEnd::TableRow | TagEnd::TableHead) => reader.end(false),
            Event::End(TagEnd::Heading(_)) => {
                reader.section = shown(&reader.words);
                reader.end(false);
            }
            Event::Start(Tag::List(_)) | Event::End(TagEnd::Paragraph | TagEnd::Item) => {
                reader.end(true);
            }
            _ => {}
        }
    }
    reader.done
}

#[derive(Default)]
struct Reader {
    section: String,
    words: Vec<Word>,
    done: Vec<Sentence>,
}

impl Reader {
    /// The first word of the text goes on with the last that was read.
    fn push(&mut self, text: &str, key: impl Fn(&str) -> String) {
        for (i, piece) in text.split([' ', '\n']).enumerate() {
            if i > 0 || self.words.is_empty() {
                self.words.push(Word::default());
            }
            if let Some(word) = self.words.last_mut() {
                word.shown += piece;
                word.key += &key(piece);
            }
        }
    }

    /// A block ends.
    fn end(&mut self, split: bool) {
        let mut words = take(&mut self.words);
        words.retain(|word| !word.shown.is_empty());
        for words in words.chunk_by(|word, next| !split || !ends(&word.shown, &next.shown)) {
            self.done.push(Sentence { section: self.section.clone(), words: words.to_vec() });
        }
    }
}

/// Words as they stand.
pub fn shown(words: &[Word]) -> String {
    words.iter().map(|word| word.shown.as_str()).collect::<Vec<_>>().join(" ")
}

/// Whether a sentence ends between two words.
fn ends(word: &str, next: &str) -> bool {
    let word = word.trim_matches(['(', ')', '[', ']', '“', '”', '"']);
    word.ends_with(['.', '!', '?'])
        && !SHORT.contains(&word)
        && !next.starts_with(char::is_lowercase)
}

/// A word with `#` for each number, whatever its sign, error and power of ten. In a formula a bare integer belongs
/// to its form.
pub fn folded(word: &str, formula: bool) -> String {
    let (mut out, mut rest) = (String::new(), word);
    while let Some(c) = rest.chars().next() {
        let after = if c.is_ascii_digit() { after(rest) } else { &rest[c.len_utf8()..] };
        let piece = &rest[..rest.len() - after.len()];
        let bare = piece.bytes().all(|b| b.is_ascii_digit());
        if c.is_ascii_digit() && !(formula && bare) {
            out.truncate(out.trim_end_matches(['-', '−']).len());
            out.push('#');
        } else {
            out += piece;
        }
        rest = after;
    }
    out
}

/// What comes after the number that a text begins with.
fn after(text: &str) -> &str {
    let (mut rest, mut open) = (text, false);
    loop {
        rest = rest.trim_start_matches(|c: char| c.is_ascii_digit());
        if let Some(after) = rest.strip_prefix(')').filter(|_| open) {
            (rest, open) = (after, false);
        }
        let joins = |joint: &&str| {
            let next = rest.strip_prefix(joint).and_then(|rest| rest.chars().next());
            next.is_some_and(|c| c.is_ascii_digit())
        };
        let Some(joint) = JOINTS.iter().copied().find(joins) else { return rest };
        open |= joint == "(";
        rest = &rest[joint.len()..];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> Vec<String> {
        sentences(text).iter().map(|sentence| shown(&sentence.words)).collect()
    }

    #[test]
    fn sentences_end_where_readers_end_them() {
        let text = "# The *rise*\nSee Fig. 3, Eq. (25), [Sec. 2](#sec-2) and Homer et al. [a](b). \
                    It is so,<sup>[✓ 1](l.md)</sup> e.g. here (at last.) Why? With $p_{\\mathrm{c}}$ = 0.5.\n";
        let expected = [
            "The rise",
            "See Fig. 3, Eq. (25), Sec. 2 and Homer et al. a.",
            "It is so, e.g. here (at last.)",
            "Why?",
            "With p_c = 0.5.",
        ];
        assert_eq!(told(text), expected);
        assert!(sentences(text)[1..].iter().all(|sentence| sentence.section == "The rise"));
    }

    #[test]
    fn rows_equations_and_lines_of_code_are_sentences() {
        let text = "Here\n\n$$\nx^2 = 1\n\\tag{3}\n$$\n\nfollows. All\n- one\n- two\n\n| a | b. C |\n|---|---|\n\
                    | 1 | 2 |\n\n```rust\nlet x = 1;\n\nlet y. Z;\n```\n";
        let expected = [
            "Here",
            "x^2 = 1",
            "follows.",
            "All",
            "one",
            "two",
            "a | b. C",
            "1 | 2",
            "let x = 1;",
            "let y. Z;",
        ];
        assert_eq!(told(text), expected);
    }

    #[test]
    fn numbers_are_folded_whole() {
        for (word, key) in [
            ("−0.1159(4),", "#,"),
            ("-6(3)×10^-4", "#"),
            ("(25).", "(#)."),
            ("100\u{202f}000\u{a0}%", "#\u{a0}%"),
            ("N=101", "N=#"),
            ("0.1–0.3", "#–#"),
            ("1(2", "#"),
            ("f(x)…", "f(x)…"),
        ] {
            assert_eq!(folded(word, false), key, "{word}");
        }
        assert_eq!(folded("2σ^2/0.12", true), "2σ^2/#");
    }
}

//! Prepares text for messages: one short line without control characters, in plain words.

use std::panic::Location;

/// Returns a message in one line of at most `most` characters; a longer one keeps its beginning
/// and its end. Parsers repeat their input, which may be of any length.
pub fn one_line(text: &str, most: usize) -> String {
    let line = text.replace(is_control, " ");
    let line = line.trim();
    let length = line.chars().count();
    if length <= most {
        return line.into();
    }
    let (head, tail) = (most * 2 / 3, most - most * 2 / 3 - 1);
    let head = line.chars().take(head);
    head.chain(['…']).chain(line.chars().skip(length - tail)).collect()
}

/// Writes a place in the source: `src/main.rs:12`.
pub(crate) fn place(at: &Location<'_>) -> String {
    format!("{}:{}", at.file(), at.line())
}

/// Counts things in words: `3 numbers`, `1 number`, `no number`.
pub fn count(number: usize, noun: &str) -> String {
    match number {
        0 => format!("no {noun}"),
        1 => format!("1 {noun}"),
        _ if noun.ends_with('s') => format!("{number} {noun}es"),
        _ => format!("{number} {noun}s"),
    }
}

const NUMBER: &str = "not a number; write one such as 0.12";
const WHOLE: &str = "not a whole number of 0 or more; write one such as 1000";

/// Words of parsers, and those that users read instead.
const PLAIN: [(&str, &str); 11] = [
    (" as i128", ""),
    ("`usize`", "a whole number"),
    ("expected f64", "expected a number"),
    ("expected u64", "expected a whole number"),
    ("expected usize", "expected a whole number"),
    ("an array of length 2", "a pair [a, b]"),
    ("expected value", "unexpected value"),
    ("invalid float literal", NUMBER),
    ("cannot parse float from empty string", NUMBER),
    ("invalid digit found in string", WHOLE),
    ("cannot parse integer from empty string", WHOLE),
];

/// Replaces the types of Rust in a message of a parser by plain words.
pub fn plain(message: &str) -> String {
    PLAIN
        .iter()
        .fold(message.into(), |line: String, (technical, plain)| line.replace(technical, plain))
}

/// Returns whether a terminal or an editor treats a character as a command, or hides it.
pub fn is_control(c: char) -> bool {
    let invisible = [
        '\u{200b}'..='\u{200f}',
        '\u{2028}'..='\u{202e}',
        '\u{2060}'..='\u{206f}',
        '\u{fff9}'..='\u{fffb}',
        '\u{1d173}'..='\u{1d17a}',
        '\u{e0000}'..='\u{e007f}',
    ];
    c.is_control()
        || matches!(c, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{feff}')
        || invisible.iter().any(|range| range.contains(&c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_and_broken_lines_are_one_short_line() {
        assert_eq!(one_line("a\nb\u{2028}c\0d\u{61c}e\u{202e}f\u{e0041}g\n", 20), "a b c d e f g");
        let long = format!("begin{}end", "σ".repeat(1000));
        let line = one_line(&long, 30);
        assert_eq!(line.chars().count(), 30);
        assert!(
            line.starts_with("begin") && line.ends_with("σend") && line.contains('…'),
            "{line}"
        );
        assert_eq!(one_line("abc", 3), "abc");
    }
}

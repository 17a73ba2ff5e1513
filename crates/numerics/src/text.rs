//! Text that others wrote, for messages.

/// A message in one line of at most `most` characters: parsers repeat what they were given. Of a
/// longer one the beginning and the end are kept, for both tell something.
pub fn one_line(text: &str, most: usize) -> String {
    let visible = |c: char| if breaks(c) { ' ' } else { c };
    let line: String = text.chars().map(visible).collect();
    let line = line.trim();
    let length = line.chars().count();
    if length <= most {
        return line.into();
    }
    let (head, tail) = (most * 2 / 3, most - most * 2 / 3 - 1);
    let head = line.chars().take(head);
    head.chain(['…']).chain(line.chars().skip(length - tail)).collect()
}

/// Does a terminal or an editor take the character for more than a sign?
fn breaks(c: char) -> bool {
    c.is_control() || matches!(c, '\u{2028}' | '\u{2029}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_and_broken_lines_are_one_short_line() {
        assert_eq!(one_line("a\nb\u{2028}c\0\n", 10), "a b c");
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

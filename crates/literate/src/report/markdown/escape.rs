//! Writes words, code and addresses so that readers of Markdown show them as they are.

use super::super::document::address;

/// What words stand in: the text of a link, a cell of a table, or what may have no tags.
#[derive(Clone, Copy, Default)]
pub struct Within {
    pub link: bool,
    pub cell: bool,
    pub plain: bool,
}

/// Returns a fence of at least this many grave accents, longer than any in the code.
pub fn fence(code: &str, least: usize) -> String {
    let longest = code.split(|c| c != '`').map(str::len).max().unwrap_or_default();
    "`".repeat(least.max(longest + 1))
}

/// Writes code within a line. In a cell a backslash before a bar is always taken away.
pub fn push_code(code: &str, within: Within, markdown: &mut String) {
    if within.cell && code.contains(r"\|") {
        markdown.push_str("<code>");
        push_words(code, within, markdown);
        return markdown.push_str("</code>");
    }
    if code.is_empty() {
        return;
    }
    let fence = fence(code, 1);
    let both = code.starts_with(' ') && code.ends_with(' ') && !code.trim().is_empty();
    let blank = if both || code.starts_with('`') || code.ends_with('`') { " " } else { "" };
    let code = if within.cell { code.replace('|', r"\|") } else { code.into() };
    markdown.push_str(&format!("{fence}{blank}{code}{blank}{fence}"));
}

pub fn push_link(words: &str, to: &str, markdown: &mut String) {
    // With it, this would be a picture.
    if markdown.ends_with('!') {
        markdown.insert(markdown.len() - 1, '\\');
    }
    let to = address(to).replace('&', if to.contains(';') { "&amp;" } else { "&" });
    markdown.push_str(&format!("[{words}]({to})"));
}

pub fn push_words(words: &str, within: Within, markdown: &mut String) {
    let starts_line = markdown.is_empty() || markdown.ends_with('\n');
    // After a displayed equation the line starts anew.
    let words = if markdown.ends_with('\n') { words.trim_start() } else { words };
    let chars: Vec<char> = words.chars().collect();
    let marker = if starts_line { marker(&chars) } else { None };
    let is_word = |c: Option<&char>| c.is_some_and(|c| c.is_alphanumeric());
    // GitHub makes a picture of a name between colons, with backslashes too: `1:100:1000`.
    let is_picture = |i: usize| {
        let is_name = |c: &&char| c.is_alphanumeric() || "_+-".contains(**c);
        let length = chars[i + 1..].iter().take_while(is_name).count();
        !within.plain && length > 0 && chars.get(i + 1 + length) == Some(&':')
    };
    let is_read = |i: usize| {
        let (before, after) = (i.checked_sub(1).map(|i| &chars[i]), &chars[i + 1..]);
        match chars[i] {
            '\\' | '*' | '`' | '<' | '$' | '~' | '|' => true,
            // What names a character.
            '&' => after.iter().find(|c| !c.is_alphanumeric() && **c != '#') == Some(&';'),
            '[' | ']' if within.link => true,
            '_' => !(is_word(before) && is_word(after.first())),
            '(' => before == Some(&']'),
            ':' if is_picture(i) => true,
            _ => marker == Some(i),
        }
    };
    // An address, of which GitHub makes a link, takes backslashes and markup behind it as its own.
    let is_address = |i: usize| {
        let begins = chars[i..].starts_with(&[':', '/']) || chars[..i].ends_with(&['w', 'w', 'w']);
        let mut rest = (i..chars.len()).take_while(|j| !chars[*j].is_whitespace());
        let has_end = chars[i..].iter().any(|c| c.is_whitespace());
        begins && !within.link && (!has_end || rest.any(is_read))
    };
    for (i, &c) in chars.iter().enumerate() {
        markdown.extend((is_read(i) || ":.".contains(c) && is_address(i)).then_some('\\'));
        markdown.push(c);
        markdown.push_str(if c == ':' && is_picture(i) { "<wbr>" } else { "" });
    }
}

/// Returns where a backslash stops words at the start of a line from becoming a list, a heading, a
/// quote, a rule, the head of a table, a box, or what defines a link.
fn marker(chars: &[char]) -> Option<usize> {
    let blanks = chars.iter().take_while(|c| **c == ' ').count();
    let digits = chars[blanks..].iter().take_while(|c| c.is_ascii_digit()).count();
    let rest = &chars[blanks + digits..];
    let next = rest.get(1).copied().unwrap_or(' ');
    let defines = rest.windows(2).any(|pair| pair == [']', ':']);
    let is_marker = match rest.first()? {
        '.' | ')' => digits > 0 && next == ' ',
        _ if digits > 0 => false,
        '-' | '+' => " -:".contains(next),
        ':' => next == '-',
        '#' | '>' | '=' => true,
        '[' => rest.get(2) == Some(&']') || "!^".contains(next) || defines,
        _ => false,
    };
    is_marker.then_some(blanks + digits)
}

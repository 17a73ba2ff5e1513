//! Markup that Markdown took for text, since its other end is missing or it is none here.

use super::labels::names;

/// Signs of markup, and what is wrong where one is left over in text.
const SIGNS: [(&str, &str); 30] = [
    ("$", "a formula without its end, or with brackets that do not match; write \\$ for the sign"),
    ("`", "code without its end, or code() within a line; write \\` for the sign"),
    ("*", "emphasis without its other end; write \\* for the sign"),
    ("_", "emphasis without its other end; write \\_ for the sign"),
    ("«", "a value without its end"),
    ("»", "the end of a value that does not begin"),
    ("<%", "a tag without its end"),
    ("%>", "the end of a tag that does not begin"),
    ("<#", "a comment without its end"),
    ("#>", "the end of a comment that does not begin"),
    ("<!--", "a comment without its end"),
    ("-->", "the end of a comment that does not begin"),
    ("](", "a link that is not whole"),
    ("] (", "a link with a blank in it; write [words](target)"),
    (")[", "a link with its brackets changed; write [words](target)"),
    ("{{", "braces about a value; write «…»"),
    ("{%", "braces about a tag; write <% … %>"),
    ("<<", "signs about a value that are two each; write «…»"),
    ("\\", "a command of TeX outside of a formula; write $…$, or [@…] for a reference"),
    ("[@", "a reference without its end"),
    ("[!", "a place without its end"),
    ("[^", "footnotes are no part of the report"),
    ("][", "a link by reference; write [words](target)"),
    ("~~", "struck-out text is no part of the report"),
    ("#######", "a heading has at most six signs"),
    ("[ ]", "lists of tasks are no part of the report"),
    ("[x]", "lists of tasks are no part of the report"),
    ("@", "a reference without its brackets; write [@…]"),
    ("[", "a reference without its sign; write [@…]"),
    ("#", "a heading has a blank behind its signs; write \\# for the sign"),
];

/// The first leftover in a piece of text that stands at `start` of the source: its offset, and what is
/// wrong. The first sign of an `escaped` piece is meant as it stands.
pub fn find(
    source: &str,
    start: usize,
    text: &str,
    escaped: bool,
) -> Option<(usize, &'static str)> {
    let skip = usize::from(escaped);
    // Brackets come in pieces of their own: a sign may go on behind this one.
    let rest = source.get(start..).filter(|rest| rest.starts_with(text)).unwrap_or(text);
    let beyond: usize = rest[text.len()..].chars().take(3).map(char::len_utf8).sum();
    let window = &rest[..text.len() + beyond];
    let of = |(sign, what): &(&str, &'static str)| {
        let mut found = window.match_indices(sign).map(|(i, _)| i);
        let i =
            found.find(|i| (skip..text.len()).contains(i) && is_markup(source, start + i, sign))?;
        Some((start + i, *what))
    };
    SIGNS.iter().filter_map(of).min_by_key(|(offset, _)| *offset)
}

/// Would the sign, where it stands, begin or end something? A star between blanks would not, nor a low
/// line inside a word, nor what names nothing that can be referred to, nor a number sign in a line.
fn is_markup(source: &str, at: usize, sign: &str) -> bool {
    let Some((before, after)) = source.split_at_checked(at) else { return false };
    let word = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    match sign {
        "*" | "_" => {}
        "@" | "[" => {
            let id = after[1..].split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default();
            let named =
                names(&id.to_lowercase()).is_some() && after[1 + id.len()..].starts_with(':');
            let cites = match sign {
                // Within a word it is an address of mail.
                "@" => !word(before.chars().next_back()) && id.starts_with(char::is_alphabetic),
                _ => {
                    id.starts_with(char::is_alphabetic)
                        && id.ends_with(|c: char| c.is_ascii_digit())
                }
            };
            // Within [@one; @two] it has its brackets.
            let last = before.rfind(['[', ']']).map_or("", |bracket| &source[bracket..]);
            return !last.starts_with("[@") && (named || cites);
        }
        "\\" => return after[1..].starts_with(|c: char| c.is_ascii_alphabetic()),
        "<<" => {
            return after[2..].trim_start().starts_with(char::is_alphabetic)
                && after.contains(">>");
        }
        ")[" => return !after[2..].starts_with(['@', '!']),
        "] (" => {
            let target = after[3..].split(')').next().unwrap_or_default();
            return !target.contains(char::is_whitespace) && target.contains(['.', '#', '/']);
        }
        "#" => return before.rsplit('\n').next().is_some_and(|line| line.trim().is_empty()),
        _ => return true,
    }
    let blank = |c: Option<char>| c.is_none_or(char::is_whitespace);
    let own = |c: char| matches!(c, '*' | '_');
    let before = before.trim_end_matches(own).chars().next_back();
    let after = after.trim_start_matches(own).chars().next();
    match sign {
        "*" => !(blank(before) && blank(after)),
        _ => word(before) != word(after),
    }
}

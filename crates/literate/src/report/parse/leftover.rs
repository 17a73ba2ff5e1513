//! Markup that Markdown took for text: its other end is missing, it is that of another tool, or it is none.
//! What is meant as it stands has a backslash before it.

/// Signs of markup, and what is wrong where one is left over in text: of two at one place the first.
const SIGNS: [(&str, &str); 35] = [
    ("«", "a value without its end"),
    ("»", "the end of a value that does not begin"),
    ("<%", "a tag without its end"),
    ("%>", "the end of a tag that does not begin"),
    ("<#", "a comment without its end"),
    ("#>", "the end of a comment that does not begin"),
    ("<!--", "a comment without its end"),
    ("-->", "the end of a comment that does not begin"),
    ("<<", "signs about a value that are two each; write «…»"),
    ("[@", "a reference without its end"),
    ("[!", "a place without its end"),
    ("[^", "footnotes are no part of the report"),
    ("[ ]", "lists of tasks are no part of the report"),
    ("[x]", "lists of tasks are no part of the report"),
    ("](", "a link that is not whole, or with a blank in its target"),
    (
        "[",
        "a link that is not whole, write [words](target); or a reference, write [@…]; or write \\[ for the sign",
    ),
    ("]", "the end of a link that does not begin; write \\] for the sign"),
    ("~~", "struck-out text is no part of the report"),
    (
        "~",
        "a tie or a lowered sign is none in text; write a blank or a formula, or \\~ for the sign",
    ),
    ("^", "a raised sign is none in text; write a formula, or \\^ for the sign"),
    ("#######", "a heading has at most six signs"),
    ("#", "a heading has a blank behind its signs, an id stands in {#…}; write \\# for the sign"),
    ("{", "braces are none in text; an id stands in {#…}; write \\{ for the sign"),
    ("}", "the end of braces that do not begin; write \\} for the sign"),
    ("<", "a bracket of HTML, or a sign of a formula; write $…$, or \\< for the sign"),
    (">", "a bracket of HTML, or a sign of a formula; write $…$, or \\> for the sign"),
    ("@", "a reference without its brackets; write [@…], or \\@ for the sign"),
    (
        "$",
        "a formula without its end, with a blank behind its first $ or before its last, or with brackets that do not match; write \\$ for the sign",
    ),
    ("`", "code without its end, or code() within a line; write \\` for the sign"),
    ("*", "emphasis without its other end; write \\* for the sign"),
    ("_", "emphasis without its other end; write \\_ for the sign"),
    ("\\", "a command of TeX outside of a formula; write $…$, or [@…] for a reference"),
    ("--", "two hyphens; write – or —"),
    ("''", "two quotation marks; write ”"),
    (",,", "two commas; write „, or one"),
];

/// Signs of other tools, which this project has not, at the beginning of a line or anywhere.
const OTHERS: [(&str, bool); 8] = [
    (":::", false),
    ("==", false),
    ("++", false),
    ("%%", false),
    ("% ", true),
    (": ", true),
    ("! [", true),
    ("(@)", true),
];

/// What is wrong with them.
const OTHER: &str = "markup of another tool; write it otherwise, or \\ before its first sign";

/// The first leftover in a piece of text that stands at `start` of the source: its offset, and what is
/// wrong. The first sign of an `escaped` piece is meant as it stands.
pub fn find(
    source: &str,
    start: usize,
    text: &str,
    escaped: bool,
) -> Option<(usize, &'static str)> {
    if escaped && text.starts_with('(') {
        return Some((start, "a formula of TeX; write $…$"));
    }
    let paragraph = source[start..].split("\n\n").next().unwrap_or_default().trim_end();
    if escaped && text.starts_with('[') && begins(source, start - 1) && paragraph.ends_with("\\]") {
        return Some((start, "an equation of TeX; write $$…$$"));
    }
    if let Some(what) = of_tex(source, start, text).filter(|_| escaped) {
        return Some((start, what));
    }
    let skip = usize::from(escaped);
    // Brackets come in pieces of their own: a sign may go on behind this one.
    let rest = source.get(start..).filter(|rest| rest.starts_with(text)).unwrap_or(text);
    let beyond: usize = rest[text.len()..].chars().take(3).map(char::len_utf8).sum();
    let window = &rest[..text.len() + beyond];
    let first = |sign: &str, is: &dyn Fn(usize) -> bool| {
        let mut found = window.match_indices(sign).map(|(i, _)| i);
        found.find(|i| (skip..text.len()).contains(i) && is(start + i)).map(|i| start + i)
    };
    let signs = SIGNS.iter().filter_map(|(sign, what)| {
        first(sign, &|at| is_markup(source, at, sign)).map(|at| (at, *what))
    });
    let others = OTHERS.iter().filter_map(|(sign, line)| {
        first(sign, &|at| !line || begins(source, at)).map(|at| (at, OTHER))
    });
    others.chain(signs).min_by_key(|(offset, _)| *offset)
}

/// What a sign behind a backslash is to TeX, which nobody means as it stands: an accent between letters, a space.
fn of_tex(source: &str, start: usize, text: &str) -> Option<&'static str> {
    let before = source.get(..start.checked_sub(1)?)?.chars().next_back();
    let (sign, after) = (text.chars().next()?, source[start..].chars().nth(1));
    let letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
    match sign {
        '\'' | '"' | '^' | '~' | '`' | '='
            if letter(before) && (letter(after) || after == Some('{')) =>
        {
            Some("an accent of TeX; write the letter itself, such as é")
        }
        ',' | ';' | '/' => Some("a space of TeX; write a blank"),
        '!' if !matches!(after, Some('[' | '\\')) => Some("a space of TeX; write a blank"),
        _ => None,
    }
}

/// Does a line begin there?
fn begins(source: &str, at: usize) -> bool {
    source[..at].rsplit('\n').next().is_some_and(|line| line.trim().is_empty())
}

/// Would the sign, where it stands, begin or end something? A star between blanks would not, nor
/// *less than* there, nor a low line or an @ inside a word, nor braces about an id.
fn is_markup(source: &str, at: usize, sign: &str) -> bool {
    let Some((before, after)) = source.split_at_checked(at) else { return false };
    let word = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    let blank = |c: Option<char>| c.is_none_or(char::is_whitespace);
    match sign {
        "*" | "_" => {}
        "<" | ">" => {
            return !blank(before.chars().next_back()) || !blank(after[1..].chars().next());
        }
        // Within [@one; @two] it has its brackets.
        "@" => {
            let within = before.rfind(['[', ']']).is_some_and(|at| source[at..].starts_with("[@"));
            let address = word(before.chars().next_back()) && word(after[1..].chars().next());
            return !within && !address;
        }
        "\\" => return after[1..].starts_with(|c: char| c.is_ascii_alphabetic() || c == ' '),
        "{" => return !after.starts_with("{#"),
        "#" => return !before.ends_with('{') && !word(before.chars().next_back()),
        "}" => return !before.rfind('{').is_some_and(|open| source[open..].starts_with("{#")),
        "[ ]" | "[x]" => {
            let line = before.rsplit('\n').next().unwrap_or_default();
            return line.trim_matches([' ', '-', '*', '+']).is_empty();
        }
        _ => return true,
    }
    let own = |c: char| matches!(c, '*' | '_');
    let before = before.trim_end_matches(own).chars().next_back();
    let after = after.trim_start_matches(own).chars().next();
    match sign {
        "*" => !(blank(before) && blank(after)),
        _ => word(before) != word(after),
    }
}

//! Markup that Markdown took for text, since its other end is missing. What is meant as it stands has a backslash
//! before it.

/// Signs that begin or end markup.
const SIGNS: [char; 17] =
    ['«', '»', '[', ']', '~', '^', '#', '{', '}', '<', '>', '@', '$', '`', '*', '_', '\\'];

/// What is wrong where one of them is left over in text.
pub const WHAT: &str = "markup without its other end, or none of this project; complete it, or write a backslash \
                        before the sign";

/// The place in the source of the first sign of markup that is left over in a piece of text, which stands at `start`. The
/// first sign of an `escaped` piece is meant as it stands.
pub fn find(source: &str, start: usize, text: &str, escaped: bool) -> Option<usize> {
    let signs = text.char_indices().skip(usize::from(escaped));
    let mut signs = signs.filter(|(_, c)| SIGNS.contains(c)).map(|(i, c)| (start + i, c));
    signs.find(|(at, sign)| is_markup(source, *at, *sign)).map(|(at, _)| at)
}

/// Would the sign, where it stands, begin or end something? A star between blanks would not, nor *less than* there, nor
/// a low line or an @ inside a word, nor braces about an id.
fn is_markup(source: &str, at: usize, sign: char) -> bool {
    let Some((before, after)) = source.split_at_checked(at) else { return false };
    let word = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    let blank = |c: Option<char>| c.is_none_or(char::is_whitespace);
    let (last, next) = (before.chars().next_back(), after.chars().nth(1));
    match sign {
        '<' | '>' => !blank(last) || !blank(next),
        // Within [@one; @two] it has its brackets.
        '@' => {
            let within = before.rfind(['[', ']']).is_some_and(|at| source[at..].starts_with("[@"));
            !(within || word(last) && word(next))
        }
        '\\' => next.is_some_and(|c| c.is_ascii_alphabetic() || c == ' '),
        '{' => !after.starts_with("{#"),
        '}' => !before.rfind('{').is_some_and(|open| source[open..].starts_with("{#")),
        '#' => !before.ends_with('{') && !word(last),
        '*' | '_' => {
            let own = |c: char| matches!(c, '*' | '_');
            let last = before.trim_end_matches(own).chars().next_back();
            let next = after.trim_start_matches(own).chars().next();
            if sign == '*' { !(blank(last) && blank(next)) } else { word(last) != word(next) }
        }
        _ => true,
    }
}

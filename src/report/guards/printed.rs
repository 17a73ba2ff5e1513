//! What was printed.

use super::{Guard, Look, unless};
use crate::claims::rows;

pub const GUARDS: &[Guard] =
    &[Guard { name: "printed_as_it_reads", ids: &["printed.*"], find: as_it_reads }];

/// Numbers in a text, as they are written; not those that a formula adds to a letter.
fn numbers(text: &str) -> impl Iterator<Item = &str> {
    let digit = |c: char| c.is_ascii_digit() || c == '.';
    let starts = text.char_indices().filter(move |&(at, c)| {
        c.is_ascii_digit() && !text[..at].ends_with(digit) && {
            let before = text[..at].trim_end();
            !before.ends_with(['+', '−'])
        }
    });
    starts.map(move |(at, _)| {
        let rest = &text[at..];
        let end = rest.find(|c| !digit(c)).unwrap_or(rest.len());
        rest[..end].trim_end_matches('.')
    })
}

/// Claims that compare all that is printed with what they find.
const HELD: [&str; 4] = ["sec2_parameters", "sec5_fig5", "sec5_fig6", "sec9_fig6_repeats"];

/// `published.toml` has what can be read in the paper and the number that is judged, each typed for
/// itself: where numbers can be read, they are the one that is judged, to its last digit; and where none is judged,
/// none can be read. Claims that judge more of what is printed hold it themselves.
fn as_it_reads(look: Look<'_>) -> Option<String> {
    look.published.statements.iter().find_map(|statement| {
        let read = || numbers(&statement.printed);
        let held = HELD.contains(&statement.id.as_str());
        let Some(value) = statement.value else {
            let named = || rows().any(|row| row.id == statement.id && row.reads.is_some());
            return unless(held || read().next().is_none() || named(), || {
                format!("{} reads {:?}, and no number is judged", statement.id, statement.printed)
            });
        };
        let number = format!("{value:.*}", usize::from(statement.decimals));
        let exact = number.parse() == Ok(value) || read().next().is_none();
        let named = held || (exact && read().all(|own| own == number));
        unless(named, || {
            format!("{} reads {:?}, and is judged by {number}", statement.id, statement.printed)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::numbers;

    #[test]
    fn numbers_are_read() {
        let all = |text| numbers(text).collect::<Vec<_>>();
        assert_eq!(all("σ ≈ 0.12, L-1 and 16."), ["0.12", "1", "16"]);
        assert_eq!(all("N − 1, k + 1, k > 3"), ["3"]);
    }
}

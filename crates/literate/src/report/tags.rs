//! Words of tags: which tags and filters templates may have.

use super::lint::{Fault, Finding, Position};
use super::origin::next_tag;

/// Tags that templates may have. Variables could double until the memory is full; what is included, imported or put
/// into a block would stand at no line of its own.
const TAGS: [&str; 6] = ["if", "elif", "else", "endif", "for", "endfor"];

/// Filters that templates may have. Others would change the name of a value, or its digits.
const FILTERS: [&str; 5] = ["percent", "no_error", "significant", "split", "last"];

/// The first tag or filter of another kind, in what is filled.
pub(super) fn other_word(path: &str, text: &str) -> Option<Finding> {
    let (mut position, mut at) = (Position::default(), 0);
    let filled = [".md", ".tex", ".html"].iter().any(|end| path.ends_with(end));
    let word = |text: &str| -> String {
        let text = text.trim_start_matches(['-', ' ', '\n', '\t']);
        text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    while let Some((start, end)) = next_tag(text, at).filter(|_| filled) {
        let tag = &text[start..end];
        if ["<%", "«"].iter().any(|open| tag[2..].contains(open)) && !tag.starts_with("<#") {
            // It has lost its end, which is told when all delimiters are held against each other.
            at = start + 2;
            continue;
        }
        let own = tag.strip_prefix("<%").map(word).filter(|word| !TAGS.contains(&word.as_str()));
        // What is quoted is no filter.
        let bare: String = tag.split('"').step_by(2).filter(|_| !tag.starts_with("<#")).collect();
        let mut filters = bare.split('|').skip(1).map(word);
        let filter = filters.find(|word| !FILTERS.contains(&word.as_str()));
        let fault = own.map(|word| Fault::Word("tag", word, &TAGS));
        let fault = fault.or(filter.map(|word| Fault::Word("filter", word, &FILTERS)));
        if let Some(fault) = fault {
            position.past(text, start);
            return Some(position.finding(path, fault));
        }
        at = end;
    }
    None
}

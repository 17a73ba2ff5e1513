//! What is read off the source itself, as it is written, where the reader of Markdown says nothing of it.

use super::super::Error;
use super::super::document::Inline;
use super::super::labels::of_kind;

/// An error of the markup.
pub(super) fn markup(what: impl Into<String>) -> Error {
    Error::Markup(what.into())
}

/// Comments are for writers; other HTML has no place in four formats.
pub(super) fn comment(html: &str) -> Result<(), Error> {
    match (html.starts_with("<!--"), html.ends_with("-->") && html.len() >= 7) {
        (true, true) => Ok(()),
        (true, false) => {
            Err(markup("a comment <!-- without --> at the end of its last line hides text"))
        }
        (false, _) => Err(markup(format!("HTML has no place in four formats: {html}"))),
    }
}

/// What stands in the `{…}` at the end of a heading.
pub(super) fn attributes<'a>(heading: &'a str) -> Vec<&'a str> {
    let inner = heading.trim_end().strip_suffix('}').and_then(|text| text.rsplit_once('{'));
    let inner = inner.map(|(_, inner)| inner).filter(|inner| !inner.ends_with('\\'));
    // Markdown takes away what is in there, and empty braces too.
    let words = |inner: &'a str| match inner.trim() {
        "" => vec!["{}"],
        inner => inner.split_whitespace().collect(),
    };
    inner.map(words).unwrap_or_default()
}

/// Cells of a row of a table, by its bars.
pub(super) fn cells_of(row: &str) -> usize {
    let row = row.trim();
    let row = row.strip_prefix('|').unwrap_or(row);
    let row = row.strip_suffix('|').filter(|rest| !rest.ends_with('\\')).unwrap_or(row);
    row.matches('|').count() - row.matches(r"\|").count() + 1
}

/// `@fig:2; @fig:3` or `!claim:rise`.
pub(super) fn own_link(reference: &str) -> Result<Inline, Error> {
    if let Some(id) = reference.strip_prefix('!') {
        if !id.starts_with("claim:") {
            return Err(markup(format!(
                "[!{id}] is no place of a claim, [!claim:id], and there are no callouts; remove it"
            )));
        }
        of_kind("claim", id)?;
        return Ok(Inline::Anchor { id: id.to_string(), number: String::new() });
    }
    let one = |id: &str| {
        let id = id.trim().strip_prefix('@').map(str::to_string);
        let id =
            id.ok_or_else(|| Error::Reference(reference.trim_start_matches('@').to_string()))?;
        match id.starts_with(char::is_whitespace) {
            true => Err(markup(format!("a blank behind the sign of [@{id}]; remove it"))),
            false => Ok(id),
        }
    };
    reference.split(';').map(one).collect::<Result<_, _>>().map(Inline::Unresolved)
}

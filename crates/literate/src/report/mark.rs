//! Places of values in filled text.

use super::print::{Asked, Style};

/// The place of a value in filled text. Private-use characters frame it, so that neither Tera nor
/// Markdown reads anything into it, and no prose can contain one by accident.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark {
    /// Id of the value.
    pub id: String,
    /// What the filters asked for.
    pub style: Style,
}

const OPEN: char = '\u{e000}';
const CLOSE: char = '\u{e001}';
const NEXT: char = '\u{e002}';

/// Brackets of an address, into which Markdown would read a link.
const BRACKETS: [(&str, &str); 2] = [("[", "\u{e008}"), ("]", "\u{e009}")];

/// Does a mark end with this character?
pub fn ends(c: char) -> bool {
    c == CLOSE
}

impl Mark {
    /// The mark as text.
    pub fn write(&self) -> String {
        let id = BRACKETS.iter().fold(self.id.clone(), |id, (own, kept)| id.replace(own, kept));
        let mut out = format!("{OPEN}{id}");
        let mut flag = |text: String| {
            out.push(NEXT);
            out.push_str(&text);
        };
        if self.style.percent {
            flag("percent".into());
        }
        match self.style.digits {
            Some(Asked::Full) => flag("full".into()),
            Some(Asked::Fixed(n)) => flag(format!("fixed{n}")),
            Some(Asked::Significant(n)) => flag(format!("significant{n}")),
            None => {}
        }
        if self.style.no_error {
            flag("noerror".into());
        }
        if self.style.with_unit {
            flag("unit".into());
        }
        out.push(CLOSE);
        out
    }

    /// Reads what [`Mark::write`] wrote; None for anything else.
    pub fn read(text: &str) -> Option<Mark> {
        let inner = text.strip_prefix(OPEN)?.strip_suffix(CLOSE)?;
        let mut parts = inner.split(NEXT);
        let id = parts.next()?.to_string();
        let id = BRACKETS.iter().fold(id, |id, (own, kept)| id.replace(kept, own));
        let mut style = Style::default();
        for flag in parts {
            let number = |prefix: &str| flag.strip_prefix(prefix)?.parse().ok();
            match flag {
                "percent" => style.percent = true,
                "full" => style.digits = Some(Asked::Full),
                "noerror" => style.no_error = true,
                "unit" => style.with_unit = true,
                _ => {
                    let fixed = number("fixed").map(Asked::Fixed);
                    style.digits = Some(fixed.or(number("significant").map(Asked::Significant))?);
                }
            }
        }
        (!id.contains(OPEN)).then_some(Mark { id, style })
    }

    /// Cuts text at its marks: Ok is a mark, Err is text between marks.
    pub fn split(text: &str) -> Vec<Result<Mark, &str>> {
        let mut pieces = Vec::new();
        let mut rest = text;
        while let Some(start) = rest.find(OPEN) {
            let Some(length) = rest[start..].find(CLOSE) else { break };
            let end = start + length + CLOSE.len_utf8();
            if start > 0 {
                pieces.push(Err(&rest[..start]));
            }
            pieces.push(Mark::read(&rest[start..end]).ok_or(&rest[start..end]));
            rest = &rest[end..];
        }
        if !rest.is_empty() {
            pieces.push(Err(rest));
        }
        pieces
    }
}

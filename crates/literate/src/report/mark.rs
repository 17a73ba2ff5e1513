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

/// Is there a part of a mark in what is none?
pub fn is_cut(text: &str) -> bool {
    text.contains([OPEN, CLOSE])
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
        if let Some(Asked::Significant(n)) = self.style.digits {
            flag(format!("significant{n}"));
        }
        if self.style.no_error {
            flag("noerror".into());
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
            match flag {
                "percent" => style.percent = true,
                "noerror" => style.no_error = true,
                _ => {
                    let digits = flag.strip_prefix("significant")?.parse().ok()?;
                    style.digits = Some(Asked::Significant(digits));
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

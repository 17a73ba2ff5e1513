//! The table of contents.

use super::{Page, escape};
use crate::report::Error;
use crate::report::document::Block;
use std::fmt::Write as _;

impl Page<'_> {
    /// Sections that have an id, as a list of links; subsections are left to the text.
    pub(super) fn contents(&self, blocks: &[Block]) -> Result<String, Error> {
        let mut out = String::from("<ol>\n");
        for block in blocks {
            if let Block::Heading { level: 2, number, id: Some(id), text } = block {
                let number = number.as_ref().map(|n| format!("<span>{n}</span> "));
                let _ = writeln!(
                    out,
                    "<li><a href=\"#{}\">{}{}</a></li>",
                    escape::id(id),
                    number.unwrap_or_default(),
                    self.inlines(text)?
                );
            }
        }
        Ok(out + "</ol>")
    }
}

//! What readers run by themselves.

use super::{Page, escape};
use crate::report::Error;
use crate::report::document::Inline;

impl Page<'_> {
    /// What readers run: a button that a script shows, and nothing where there is nothing to run.
    pub(super) fn lab(&self, lab: &str, caption: &[Inline]) -> Result<String, Error> {
        let caption = self.inlines(caption)?;
        let figure = format!(
            "<figure class=\"lab\" id=\"lab-{lab}\" data-lab=\"{lab}\" hidden=\"\">\
             <div class=\"controls\"><button type=\"button\">Run it here</button>\
             <span role=\"status\"></span></div>\
             <figcaption><strong>Live.</strong> {caption}</figcaption></figure>\n",
            lab = escape::id(lab),
        );
        Ok(if self.site.lab { figure } else { String::new() })
    }
}

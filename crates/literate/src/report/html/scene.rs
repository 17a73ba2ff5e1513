//! A picture that a script moves: it is complete by itself, and controls, numbers and script move it.

use super::{Page, escape};
use crate::report::Error;
use crate::report::document::Inline;

/// What moves on a page.
#[derive(Clone, Debug, PartialEq)]
pub struct Moving {
    /// What it is, for those who do not see it.
    pub name: String,
    /// Its beginning, as an SVG element.
    pub picture: String,
    /// Its first and its last time.
    pub times: [f64; 2],
    /// The numbers that the script reads, as JSON.
    pub data: String,
    /// Where it comes from: what, and path from the report.
    pub origins: Vec<(&'static str, String)>,
}

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

    pub(super) fn scene(&self, caption: &[Inline]) -> Result<String, Error> {
        let missing = || Error::Markup("`Scene: …`, but the results have no scene".into());
        let (moving, script) = self.site.moving.ok_or_else(missing)?;
        let Moving { name, picture, times: [from, until], data, origins } = moving;
        let link = |(what, to): &(&str, String)| {
            let name = to.rsplit('/').next().unwrap_or(to);
            format!("{what}: <a href=\"{}\">{}</a>.", escape::text(to), escape::text(name))
        };
        Ok(format!(
            "<figure id=\"scene\"><div class=\"scroll\" tabindex=\"0\" role=\"group\" \
             aria-label=\"{}\">{picture}</div>\n\
             <div class=\"controls\" hidden=\"\"><button type=\"button\">Play</button>\
             <input type=\"range\" aria-label=\"Time of the scene\" min=\"{from}\" max=\"{until}\" \
             step=\"0.1\" value=\"{from}\"/><span aria-hidden=\"true\"></span></div>\n\
             <figcaption><strong>Scene.</strong> {} <span class=\"origin\">{}</span></figcaption>\n\
             <script type=\"application/json\">{data}</script>\n\
             <script>//<![CDATA[\n{script}//]]></script></figure>\n",
            escape::text(name),
            self.inlines(caption)?,
            origins.iter().map(link).collect::<Vec<_>>().join(" "),
        ))
    }
}

//! Running text → HTML.

use super::{Page, escape, keep, maths};
use crate::claims::Verdict;
use crate::report::Error;
use crate::report::document::Inline;

impl Page<'_> {
    /// Running text.
    pub(super) fn inlines(&self, list: &[Inline]) -> Result<String, Error> {
        let mut out = String::new();
        for group in keep::together(list) {
            let text: String = group.iter().map(|p| self.inline(p)).collect::<Result<_, _>>()?;
            match group.len() {
                1 => out.push_str(&text),
                _ => out.push_str(&format!("<span class=\"keep\">{text}</span>")),
            }
        }
        Ok(out)
    }

    fn inline(&self, inline: &Inline) -> Result<String, Error> {
        Ok(match inline {
            Inline::Text(text) => escape::text(text),
            Inline::Soft => "\n".into(),
            Inline::Break => "<br/>".into(),
            // Long paths may break at their joints.
            Inline::Code(code) => {
                let code = escape::text(code).replace('/', "/\u{200b}").replace("::", "::\u{200b}");
                let code = code.replace(',', ",\u{200b}").replace('[', "\u{200b}[");
                format!("<code>{}</code>", code.replace('\u{200b}', "<wbr/>"))
            }
            Inline::Emphasis(inner) => format!("<em>{}</em>", self.inlines(inner)?),
            Inline::Raised(inner) => format!("<sup>{}</sup>", self.inlines(inner)?),
            Inline::Strong(inner) => format!("<strong>{}</strong>", self.inlines(inner)?),
            Inline::Maths(tex) => maths::write(self, tex)?,
            Inline::Display { tex, tag } => self.display(tex, tag.as_deref())?,
            Inline::Value { id, shown } => {
                let part = |inline: &Inline| match inline {
                    Inline::Maths(tex) => maths::digits(tex),
                    other => self.inline(other),
                };
                self.button(id, &shown.iter().map(part).collect::<Result<String, Error>>()?)
            }
            Inline::Link { to, shown } => {
                // A document is another file here.
                let of = self.program.documents.iter().find(|of| of.markdown == to);
                let to = of.map_or(to.as_str(), |of| of.page);
                format!("<a href=\"{}\">{}</a>", escape::text(to), self.inlines(shown)?)
            }
            Inline::Reference { to, within, shown } => {
                let file = within.map_or("", |document| document.page);
                let sign = shown.chars().next();
                let verdict = Verdict::ALL.iter().find(|verdict| Some(verdict.sign()) == sign);
                // A sign alone has its word for those who do not see it.
                let class = verdict.map_or(String::new(), |verdict| {
                    let words = verdict.words();
                    let name = words.replace(' ', "-");
                    format!(" class=\"verdict {name}\" title=\"{words}\"")
                });
                format!("<a href=\"{file}#{}\"{class}>{}</a>", escape::id(to), escape::text(shown))
            }
            Inline::Anchor { id, number } => {
                format!("<span id=\"{}\">{number}</span>", escape::id(id))
            }
            Inline::Unresolved(ids) => return Err(Error::Reference(ids.join("; "))),
        })
    }

    /// An equation, which goes on in the next line or scrolls by itself where it is too wide, and its number.
    fn display(&self, tex: &str, tag: Option<&str>) -> Result<String, Error> {
        let formula = maths::display(self, tex)?;
        Ok(match tag {
            Some(tag) => format!(
                "<div class=\"equation\" id=\"eq-{tag}\"><div class=\"scroll\" tabindex=\"0\" \
                 role=\"group\" aria-label=\"Equation {tag}\">{formula}</div>\
                 <a class=\"number\" href=\"#eq-{tag}\">({tag})</a></div>\n"
            ),
            None => format!(
                "<div class=\"equation\"><div class=\"scroll\" tabindex=\"0\" role=\"group\" \
                 aria-label=\"Equation without number\">{formula}</div></div>\n"
            ),
        })
    }
}

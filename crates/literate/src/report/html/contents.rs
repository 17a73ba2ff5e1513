//! The table of contents, and the way to the other documents.

use super::{Page, escape};
use crate::figures::Figure;
use crate::report::Error;
use crate::report::document::{Block, Inline, plain};
use crate::report::documents::Document;
use std::fmt::Write as _;

impl Page<'_> {
    /// What the head says of the document, as elements.
    pub(super) fn about(&self) -> String {
        let one = |(name, content): &(&str, &str)| {
            format!("<meta name=\"{name}\" content=\"{}\"/>\n", escape::text(content))
        };
        self.program.about.iter().map(one).collect()
    }

    /// Version, date and licence, and links to the data and to the text for hosts.
    pub(super) fn imprint(&self) -> String {
        let of = |name| self.program.about.iter().find(|about| about.0 == name);
        let of = ["version", "citation_publication_date", "license"].map(of);
        let [Some((_, version)), Some((_, date)), Some((_, licence))] = of else {
            return String::new();
        };
        let text = self.site.here.markdown;
        format!(
            "Version {version}, {date}, {licence}. <a href=\"values.json\">Values</a>, \
             <a href=\"data\">data of the figures</a>, <a href=\"{text}\">this text as Markdown</a>."
        )
    }

    /// How to cite the document, as BibTeX; nothing if the program does not say who wrote it, and when.
    pub(super) fn cite(&self, title: &str) -> String {
        let of =
            |name| self.program.about.iter().find(|about| about.0 == name).map(|about| about.1);
        let of =
            ["citation_author", "citation_publication_date", "version", "citation_title"].map(of);
        let [Some(author), Some(date), Some(version), Some(program)] = of else {
            return String::new();
        };
        let key = self.site.here.page.trim_end_matches(".html");
        let year = date.split('-').next().unwrap_or_default();
        escape::text(&format!(
            "@misc{{{program}-{key},\n  author = {{{{{author}}}}},\n  title  = {{{title}}},\n  year   = {{{year}}},\n  \
             note   = {{{program} {version}, {date}}},\n}}"
        ))
    }

    /// Links to all documents, as items of a list; nothing if there is one only.
    pub(super) fn documents(&self) -> String {
        let all = self.program.documents;
        let one = |of: &Document| {
            let here = if *of == self.site.here { " aria-current=\"page\"" } else { "" };
            format!("<li><a href=\"{}\"{here}>{}</a></li>\n", of.page, escape::text(of.name))
        };
        if all.len() > 1 { all.iter().map(one).collect() } else { String::new() }
    }

    /// Sections and figures as lists of links; subsections are left to the text.
    pub(super) fn contents(&self, blocks: &[Block]) -> Result<String, Error> {
        let [mut sections, mut figures] = [const { String::new() }; 2];
        for block in blocks {
            match block {
                Block::Heading { level: 2, number, id, text } => {
                    let id = self.id_of(id.as_deref(), text);
                    let number = number.as_ref().map(|n| format!("<span>{n}</span> "));
                    let (number, text) = (number.unwrap_or_default(), self.inlines(text)?);
                    let _ = writeln!(sections, "<li><a href=\"#{id}\">{number}{text}</a></li>");
                }
                Block::Figure { id, number, path, .. } => {
                    let own = |f: &&Figure| *path == format!("figures/{}.svg", f.id);
                    let title = self.figures.iter().find(own).map_or("", |f| f.title.as_str());
                    let (id, title) = (escape::id(id), escape::text(title));
                    let _ = writeln!(
                        figures,
                        "<li><a href=\"#{id}\"><span>{number}</span> {title}</a></li>"
                    );
                }
                _ => (),
            }
        }
        let figures = match figures.lines().count() {
            0 | 1 => String::new(),
            _ => format!("<details><summary>Figures</summary>\n<ol>\n{figures}</ol></details>"),
        };
        Ok(format!("<ol>\n{sections}</ol>{figures}"))
    }

    /// The id of a section on the page: its own, or its words, as `#references`.
    pub(super) fn id_of(&self, id: Option<&str>, text: &[Inline]) -> String {
        match id {
            Some(id) => escape::id(id),
            None => {
                let words = plain(text).to_lowercase();
                let words = words.split(|c: char| !c.is_ascii_alphanumeric());
                words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
            }
        }
    }
}

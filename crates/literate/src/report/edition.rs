//! Says what an edition is: its title, its authors, its documents and the equations that they show.

use super::ledger::EquationEntry;
use crate::prose::Templates;

/// What an edition says of itself.
#[derive(Clone, Debug)]
pub struct Edition {
    /// Title of the paper.
    pub title: &'static str,
    /// Names and affiliations, which may be empty.
    pub authors: Vec<(&'static str, &'static str)>,
    /// Address of the repository, at the foot of each page, and DOI; may be empty.
    pub address: &'static str,
    /// DOI; may be empty.
    pub doi: &'static str,
    /// Day of this version, YYYY-MM-DD; may be empty.
    pub date: &'static str,
    /// Licence of text and figures; may be empty.
    pub license: &'static str,
    /// Names and addresses of what the foot of each page leads to, seen from the report.
    pub links: Vec<(&'static str, &'static str)>,
    /// The figure that links to a page show; a README has its form for dark pages too.
    pub cover: Option<&'static str>,
    /// The documents, in the order in which readers are offered them.
    pub documents: Vec<Document>,
    /// The numbered equations that the prose must show.
    pub equations: Vec<EquationEntry>,
    /// Returns the path of the item that judges the statement with this id, for its card.
    pub judged_by: fn(&str) -> String,
}

impl Edition {
    /// Makes an edition with this title and one document, [`Document::REPORT`].
    pub(crate) fn new(title: &'static str) -> Self {
        Edition {
            title,
            authors: Vec::new(),
            address: "",
            doi: "",
            date: "",
            license: "",
            links: Vec::new(),
            cover: None,
            documents: vec![Document::REPORT],
            equations: Vec::new(),
            judged_by: |_| String::new(),
        }
    }

    /// Returns what stands below the title of a document that is printed: authors and date.
    pub(super) fn byline(&self, document: Document) -> String {
        let author = |author: &(&str, &str)| match author {
            (name, "") => name.to_string(),
            (name, affiliation) => format!("{name} ({affiliation})"),
        };
        let date = Some(self.date.to_string()).filter(|date| !date.is_empty());
        let parts = self.authors.iter().map(author).chain(date).collect::<Vec<_>>().join(", ");
        if document.print.is_some() { parts } else { String::new() }
    }

    /// Writes the authors for BibTeX. A name that ends in a word without a capital, as that of a
    /// group, stands in braces: its last word is no family.
    pub(super) fn bibtex_authors(&self) -> String {
        let author = |(name, _): &(&str, _)| match name.rsplit(char::is_whitespace).next() {
            Some(last) if last.starts_with(char::is_lowercase) => format!("{{{name}}}"),
            _ => name.to_string(),
        };
        self.authors.iter().map(author).collect::<Vec<_>>().join(" and ")
    }
}

/// A document: its prose, and the files that it is written to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Document {
    /// Its prose: `PROSE.md`, or the files of the folder `PROSE` in the order of their names.
    pub prose: &'static str,
    /// What links to it say.
    pub name: &'static str,
    /// What the numbers of its sections, tables and listings begin with; nothing in the first.
    pub letter: &'static str,
    /// Name of the file in Markdown.
    pub markdown: &'static str,
    /// Name of the file in HTML.
    pub page: &'static str,
    /// Its file for LaTeX, without its ending `.tex`, if it is printed.
    pub print: Option<&'static str>,
    /// Whether it shows figures that have their place in another: a front page does.
    pub repeats: bool,
}

impl Document {
    /// The only document of a small paper, `report`.
    pub const REPORT: Document = Document {
        prose: "report",
        name: "Report",
        letter: "",
        markdown: "report.md",
        page: "report.html",
        print: Some("report"),
        repeats: false,
    };

    /// Returns the paths of its prose in the templates, in their order, if any.
    pub fn files<'a>(&self, templates: &'a Templates) -> Vec<&'a str> {
        let (one, folder) = (format!("{}.md", self.prose), format!("{}/", self.prose));
        let is_prose =
            |path: &&str| *path == one || path.starts_with(&folder) && path.ends_with(".md");
        templates.iter().map(|(path, _)| path).filter(is_prose).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Edition;

    #[test]
    fn a_group_keeps_its_last_word_from_being_a_family() {
        let authors = vec![("The impact-paper authors", ""), ("Ada Example", "Somewhere")];
        let edition = Edition { authors, ..Edition::new("A title") };
        assert_eq!(edition.bibtex_authors(), "{The impact-paper authors} and Ada Example");
    }
}

//! `references.bib` → labels and entries of the list of references, in a style of the Citation Style
//! Language.

use super::document::{Entry, Inline, plain};
use super::{Error, entries};
use crate::input::line_and_column;
use hayagriva::archive::{ArchivedStyle, locales};
use hayagriva::citationberg::{FontStyle, FontWeight, IndependentStyle, Style};
use hayagriva::io::{BibLaTeXError, from_biblatex_str};
use hayagriva::{
    BibliographyDriver, BibliographyRequest, CitationItem, CitationRequest, ElemChild,
    ElemChildren, Formatted,
};

/// Authors and year in the text; author, year, title in the list.
const STYLE: ArchivedStyle = ArchivedStyle::AmericanPsychologicalAssociation;

/// All entries of a .bib file, in the order in which a list shows them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library(Vec<Entry>);

impl Library {
    /// Reads BibTeX.
    pub fn read(text: &str) -> Result<Self, Error> {
        entries::sound(text)?;
        let read = from_biblatex_str(text).map_err(|errors| {
            let told: Vec<String> = errors.iter().map(|error| explained(error, text)).collect();
            Error::Template(format!("{}; mend it, or restore the file", told.join("; ")))
        })?;
        let style = style()?;
        let locales = locales();
        let mut driver = BibliographyDriver::new();
        for entry in &read {
            let items = vec![CitationItem::with_entry(entry)];
            driver.citation(CitationRequest::from_items(items, &style, &locales));
        }
        let rendered = driver.finish(BibliographyRequest::new(&style, None, &locales));
        let labels: Vec<(&str, String)> = read
            .iter()
            .zip(&rendered.citations)
            .map(|(entry, label)| (entry.key(), plain(&inlines(&label.citation))))
            .collect();
        let items = rendered.bibliography.map(|list| list.items).unwrap_or_default();
        let one = |item: &hayagriva::BibliographyItem| {
            let label = labels.iter().find(|(key, _)| *key == item.key)?.1.clone();
            Some(Entry { key: item.key.clone(), label, text: inlines(&item.content) })
        };
        Ok(Library(items.iter().filter_map(one).collect()))
    }

    fn entry(&self, key: &str) -> Result<&Entry, Error> {
        let unknown = || Error::Reference(key.to_string());
        self.0.iter().find(|entry| entry.key == key).ok_or_else(unknown)
    }

    /// The label of a citation: "Rice, 1945", "Homer & Hogan, 2007", "Kowalczyk et al., 2006".
    pub fn label(&self, key: &str) -> Result<String, Error> {
        Ok(self.entry(key)?.label.clone())
    }

    /// The entries with these keys, as a list shows them.
    pub fn entries(&self, keys: &[String]) -> Result<Vec<Entry>, Error> {
        keys.iter().try_for_each(|key| self.entry(key).map(drop))?;
        Ok(self.0.iter().filter(|entry| keys.contains(&entry.key)).cloned().collect())
    }

    /// All keys.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|entry| entry.key.as_str())
    }
}

/// The style, without brackets around a citation: the report sets its own.
fn style() -> Result<IndependentStyle, Error> {
    let Style::Independent(mut style) = STYLE.get() else {
        return Err(Error::Template("references: the style depends on another".into()));
    };
    (style.citation.layout.prefix, style.citation.layout.suffix) = (None, None);
    Ok(style)
}

/// A fault of the file with its line and column.
fn explained(error: &BibLaTeXError, text: &str) -> String {
    let (what, span) = match error {
        BibLaTeXError::Parse(error) => (error.kind.to_string(), &error.span),
        BibLaTeXError::Type(error) => (error.kind.to_string(), &error.span),
    };
    format!("references.bib:{}: {what}", line_and_column(text, span.start))
}

/// Formatted text as pieces of running text.
fn inlines(children: &ElemChildren) -> Vec<Inline> {
    children.0.iter().flat_map(child).collect()
}

fn child(child: &ElemChild) -> Vec<Inline> {
    match child {
        ElemChild::Text(text) => vec![formatted(text)],
        ElemChild::Elem(element) => inlines(&element.children),
        ElemChild::Markup(text) => vec![Inline::Text(text.clone())],
        ElemChild::Link { text, url } => {
            vec![Inline::Link { to: url.clone(), shown: vec![formatted(text)] }]
        }
        ElemChild::Transparent { .. } => Vec::new(),
    }
}

fn formatted(piece: &Formatted) -> Inline {
    let words = Inline::Text(piece.text.clone());
    if piece.formatting.font_style == FontStyle::Italic {
        Inline::Emphasis(vec![words])
    } else if piece.formatting.font_weight == FontWeight::Bold {
        Inline::Strong(vec![words])
    } else {
        words
    }
}

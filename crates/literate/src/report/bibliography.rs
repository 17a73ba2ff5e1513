//! `references.bib` → labels and entries of the list of references, in a style of the Citation Style
//! Language.

use super::Error;
use super::document::{Entry, Inline, plain};
use super::entries::Entries;
use crate::input::line_and_column;
use hayagriva::archive::{ArchivedStyle, locales};
use hayagriva::citationberg::{FontStyle, FontWeight, IndependentStyle, Locale, Style};
use hayagriva::io::{BibLaTeXError, from_biblatex_str};
use hayagriva::types::MaybeTyped;
use hayagriva::{
    BibliographyDriver, BibliographyItem, BibliographyRequest, CitationItem, CitationRequest,
    ElemChild, ElemChildren, Formatted,
};

/// Authors and year in the text; author, year, title in the list.
const STYLE: ArchivedStyle = ArchivedStyle::AmericanPsychologicalAssociation;

/// All entries of a .bib file, in the order in which a list shows them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library(Vec<Entry>);

impl Library {
    /// Reads BibTeX.
    pub fn read(text: &str) -> Result<Self, Error> {
        let faults = |errors: Vec<BibLaTeXError>, text: &str| {
            let told: Vec<String> = errors.iter().map(|error| explained(error, text)).collect();
            Error::Template(format!("{}; mend it, or restore the file", told.join("; ")))
        };
        let form = |error| faults(vec![BibLaTeXError::Parse(error)], text);
        let written = Entries::read(text).map_err(form)?;
        written.sound()?;
        let understood = written.understood();
        let read = from_biblatex_str(&understood).map_err(|errors| faults(errors, &understood))?;
        let look = (style()?, locales());
        let (all, _) = rendered(&read.iter().collect::<Vec<_>>(), &look);
        let mut entries = Vec::new();
        for key in all.iter().map(|item| &item.key) {
            let Some(entry) = read.get(key) else { continue };
            let entry = &with_numbers(entry, &written);
            // Alone: beside others of its name the style takes initials away.
            let (list, labels) = rendered(&[entry], &look);
            let mut text = list.first().map(|item| inlines(&item.content)).unwrap_or_default();
            if let Some(chapter) = written.field(key, "chapter") {
                as_chapter(&mut text, &chapter);
            }
            let link = |part: &&Inline| matches!(part, Inline::Link { .. });
            let words: Vec<Inline> = text.iter().filter(|part| !link(part)).cloned().collect();
            written.shows(key, &plain(&words))?;
            let label = labels.first().map(|label| plain(label)).unwrap_or_default();
            entries.push(Entry { key: key.clone(), label, text });
        }
        tell_apart(&mut entries);
        Ok(Library(entries))
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

/// A hyphen that the style takes for no range of numbers.
const TIED: &str = "\u{2011}";

/// The entry with its numbers as they are written.
fn with_numbers(entry: &hayagriva::Entry, written: &Entries<'_>) -> hayagriva::Entry {
    let mut own = entry.clone();
    if let Some(pages) = written.pages(entry.key()) {
        own.set_page_range(MaybeTyped::String(pages));
    }
    let serial = entry.keyed_serial_number("serial").is_some();
    if let Some(number) = written.field(entry.key(), "number").filter(|_| serial) {
        own.set_keyed_serial_number("serial", number.replace('-', TIED));
    }
    if let Some(volume) = written.volume(entry.key()).map(MaybeTyped::String) {
        let mut parents = own.parents().to_vec();
        match parents.iter_mut().find(|parent| parent.volume().is_some()) {
            Some(parent) => parent.set_volume(volume),
            None => own.set_volume(volume),
        }
        own.set_parents(parents);
    }
    own
}

/// Entries as the style shows them, in its order, and labels of citations, in theirs.
fn rendered(
    entries: &[&hayagriva::Entry],
    (style, locales): &(IndependentStyle, Vec<Locale>),
) -> (Vec<BibliographyItem>, Vec<Vec<Inline>>) {
    let mut driver = BibliographyDriver::new();
    for entry in entries {
        let items = vec![CitationItem::with_entry(*entry)];
        driver.citation(CitationRequest::from_items(items, style, locales));
    }
    let made = driver.finish(BibliographyRequest::new(style, None, locales));
    let labels = made.citations.iter().map(|label| inlines(&label.citation)).collect();
    (made.bibliography.map(|list| list.items).unwrap_or_default(), labels)
}

/// Gives those with one label letters behind their year, in the order of the list.
fn tell_apart(entries: &mut [Entry]) {
    let labels: Vec<String> = entries.iter().map(|entry| entry.label.clone()).collect();
    for (i, entry) in entries.iter_mut().enumerate() {
        let alike = |range: &[String]| range.iter().filter(|label| **label == labels[i]).count();
        let (before, all) = (alike(&labels[..i]), alike(&labels));
        let Some(letter) = ('a'..='z').nth(before).filter(|_| all > 1) else { continue };
        let year = labels[i].rsplit(' ').next().unwrap_or_default();
        let lettered = format!("{year}{letter}");
        entry.label = labels[i].replace(year, &lettered);
        for part in &mut entry.text {
            if let Inline::Text(words) = part
                && words.contains(year)
            {
                *words = words.replacen(year, &lettered, 1);
                break;
            }
        }
    }
}

/// A chapter, which the style takes for a number of its book, and may show again.
fn as_chapter(text: &mut [Inline], chapter: &str) {
    let (number, own) = (format!("No. {chapter}"), format!("Chapter {chapter}"));
    for part in text {
        if let Inline::Text(words) = part {
            *words = words.replace(&format!("{number}; {own}"), &own).replace(&number, &own);
        }
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
    // Where the reader sees that a brace is missing is behind it.
    let brace =
        if what.contains("expected") { "; is a brace or a comma missing before?" } else { "" };
    format!("references.bib:{}: {what}{brace}", line_and_column(text, span.start))
}

/// Formatted text as pieces of running text, words side by side in one.
fn inlines(children: &ElemChildren) -> Vec<Inline> {
    let mut out: Vec<Inline> = Vec::new();
    for piece in children.0.iter().flat_map(child) {
        match (out.last_mut(), piece) {
            (Some(Inline::Text(before)), Inline::Text(words)) => before.push_str(&words),
            (Some(Inline::Emphasis(before)), Inline::Emphasis(words)) => before.extend(words),
            (_, piece) => out.push(piece),
        }
    }
    for piece in &mut out {
        // Beside its editors the style names a collection twice.
        if let Inline::Emphasis(inner) = piece
            && let words = plain(inner)
            && let Some((title, rest)) = words.split_once(": ")
            && let Some(rest) = rest.strip_suffix(title)
        {
            let rest = rest.trim_end_matches(". ");
            let words = if rest.is_empty() { title.into() } else { format!("{title}: {rest}") };
            *inner = vec![Inline::Text(words)];
        }
        if let Inline::Text(words) = piece {
            // A year without a day leaves its comma; of *and others* the style makes a name.
            *words = words
                .replace(",)", ")")
                .replace("& others", "et al.")
                .replace("et al..", "et al.")
                .replace(TIED, "-");
        }
    }
    out
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

//! Reads `references.bib` into the list of references and the labels of citations.
//!
//! Articles, books, doctoral theses and software; entries of other kinds are refused.

mod people;

use super::document::{Inline, Reference, plain};
use super::error::Error;
use crate::input::line_and_column;
use biblatex::{Bibliography, Chunk, Entry, EntryType, Person};
use people::{family, listed, names};
use std::collections::BTreeSet;
use unicode_normalization::{UnicodeNormalization, char::is_combining_mark};

/// All entries of a .bib file, in the order in which a list shows them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library(Vec<Work>);

/// An entry as a list shows it: authors, year in brackets, and the rest.
#[derive(Clone, Debug, PartialEq)]
struct Work {
    key: String,
    /// Who a citation names: "Homer & Hogan", "van der Berg et al.".
    names: String,
    year: String,
    authors: String,
    rest: Vec<Inline>,
}

impl Library {
    /// Reads BibTeX. All entries that cannot be shown are reported at once.
    pub fn read(text: &str) -> Result<Self, Error> {
        let fault = |what: String| Error::Template(format!("references.bib:{what}"));
        let read = Bibliography::parse(text).map_err(|error| {
            let place = line_and_column(text, error.span.start);
            fault(format!("{place}: {}; is a brace or a comma missing before?", error.kind))
        })?;
        let (mut works, mut errors) = (Vec::new(), Vec::new());
        for entry in read.iter() {
            match work(entry) {
                Ok(work) => works.push(work),
                Err(what) => errors.push(fault(format!(" {} {what}", entry.key))),
            }
        }
        Error::all(errors)?;
        works.sort_by_cached_key(|work| {
            collated(&format!("{} {} {}", work.authors, work.year, plain(&work.rest)))
        });
        Ok(Library(works))
    }

    /// The keys of all entries.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|work| work.key.as_str())
    }

    /// Returns the list of the entries with these keys. Those that citations would not tell apart
    /// have a letter behind the year: 1954a, 1954b.
    pub fn list(&self, keys: &BTreeSet<String>) -> Vec<Reference> {
        let cited: Vec<&Work> = self.0.iter().filter(|work| keys.contains(&work.key)).collect();
        let mut list = Vec::new();
        for (at, work) in cited.iter().enumerate() {
            let is_like = |other: &&&Work| (&other.names, &other.year) == (&work.names, &work.year);
            let mut year = work.year.clone();
            if cited.iter().filter(is_like).count() > 1 {
                let before = cited[..at].iter().filter(is_like).count();
                let letter = char::from(b'a' + (before % 26) as u8);
                year.extend(std::iter::repeat_n(letter, before / 26 + 1));
            }
            let mut text = vec![Inline::Text(format!("{} ({year}). ", work.authors))];
            text.extend(work.rest.iter().cloned());
            let (key, names) = (work.key.clone(), work.names.clone());
            list.push(Reference { key, names, year, text });
        }
        list
    }
}

/// Reads an entry; the error is a message that follows its key.
fn work(entry: &Entry) -> Result<Work, String> {
    let field = |name: &str| field(entry, name);
    let either = |names: [&str; 2]| {
        for name in names {
            let found = field(name)?;
            if !found.is_empty() {
                return Ok(found);
            }
        }
        Err(format!("lacks its {}; give it", names.join(" or ")))
    };
    let people = |name: &str| entry.get_as::<Vec<Person>>(name).unwrap_or_default();
    let mut people = [people("author"), people("editor")].into_iter();
    let is_named = |all: &Vec<Person>| all.iter().any(|person| !family(person).is_empty());
    let people = people.find(is_named).ok_or("lacks its author or editor; give it")?;
    let title = either(["title", "booktitle"])?;
    let mut rest = Sentences::default();
    match entry.entry_type {
        EntryType::Article => {
            rest.add(title);
            rest.end();
            rest.add(slanted(either(["journal", "journaltitle"])?));
            let (volume, number, pages) = (field("volume")?, field("number")?, field("pages")?);
            rest.add_between(", ", slanted(volume), "");
            rest.add_between("(", number, ")");
            rest.add_between(", ", pages, "");
        }
        EntryType::Book => {
            rest.add(slanted(title));
            let edition = ordinal(&plain(&field("edition")?));
            rest.add_between(" (", edition, " ed.)");
            rest.end();
            rest.add(field("publisher")?);
        }
        EntryType::PhdThesis => {
            rest.add(slanted(title));
            rest.words(" [Doctoral dissertation].");
            rest.end();
            rest.add(either(["school", "institution"])?);
        }
        EntryType::Software => {
            rest.add(slanted(title));
            rest.words(" [Computer software].");
        }
        ref other => {
            let kinds = "@article, @book, @phdthesis or @software";
            return Err(format!("has the type @{other}, which is not supported; use {kinds}"));
        }
    }
    rest.end();
    if let Some(to) = address(entry)? {
        rest.add(vec![Inline::Link { to: to.clone(), shown: vec![Inline::Text(to)] }]);
    }
    let year = year(&plain(&either(["year", "date"])?));
    let authors = listed(&people);
    Ok(Work { key: entry.key.clone(), names: names(&people), year, authors, rest: rest.finish() })
}

/// Sentences of an entry that are being written.
#[derive(Default)]
struct Sentences(Vec<Inline>);

impl Sentences {
    fn add(&mut self, more: Vec<Inline>) {
        for piece in more {
            match (self.0.last_mut(), piece) {
                (Some(Inline::Text(before)), Inline::Text(words)) => before.push_str(&words),
                (_, piece) => self.0.push(piece),
            }
        }
    }

    fn words(&mut self, words: &str) {
        self.add(vec![Inline::Text(words.into())]);
    }

    /// Adds something between two marks, unless it is empty.
    fn add_between(&mut self, before: &str, more: Vec<Inline>, after: &str) {
        if !more.is_empty() {
            self.words(before);
            self.add(more);
            self.words(after);
        }
    }

    /// Ends a sentence, by a full stop if it has no mark at its end.
    fn end(&mut self) {
        let text = plain(&self.0);
        match text.trim_end() {
            end if end.len() < text.len() || end.is_empty() => (),
            end if end.ends_with(['.', '?', '!']) => self.words(" "),
            _ => self.words(". "),
        }
    }

    /// Returns all, without the blank after the last sentence.
    fn finish(mut self) -> Vec<Inline> {
        if let Some(Inline::Text(last)) = self.0.last_mut() {
            last.truncate(last.trim_end().len());
        }
        self.0
    }
}

/// Reads a field into text; empty if the entry has none.
fn field(entry: &Entry, name: &str) -> Result<Vec<Inline>, String> {
    let mut out = Sentences::default();
    for chunk in entry.get(name).unwrap_or_default() {
        out.add(match &chunk.v {
            Chunk::Math(tex) => vec![Inline::Maths(tex.as_str().into())],
            Chunk::Normal(text) | Chunk::Verbatim(text) => {
                macros(text).map_err(|what| format!("has {what} in its {name}; {REMEDY}"))?
            }
        });
    }
    if let Some(Inline::Text(first)) = out.0.first_mut() {
        *first = first.trim_start().into();
    }
    let mut all = out.finish();
    all.retain(|piece| !matches!(piece, Inline::Text(words) if words.is_empty()));
    Ok(all)
}

const REMEDY: &str = "which not every format can show; write it in plain words";

/// Reads text in which macros stand that the reader of BibTeX does not know.
fn macros(text: &str) -> Result<Vec<Inline>, String> {
    let words = |text: &str| Inline::Text(text.replace('~', "\u{a0}"));
    let Some((before, after)) = text.split_once('\\') else { return Ok(vec![words(text)]) };
    let name = &after[..after.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(after.len())];
    let inside = after[name.len()..].strip_prefix('{').and_then(|rest| rest.split_once('}'));
    let Some((inside, behind)) = inside.filter(|(inside, _)| !inside.contains('{')) else {
        return Err(format!("\\{name}"));
    };
    let shown = macros(inside)?;
    let mut out = vec![words(before)];
    match name {
        "emph" | "textit" | "textsl" => out.push(Inline::Emphasis(shown)),
        "textbf" => out.push(Inline::Strong(shown)),
        "textsuperscript" => out.push(Inline::Raised(shown)),
        "textrm" | "textsc" | "textup" | "text" | "mbox" => out.extend(shown),
        "url" => out.push(Inline::Link { to: inside.into(), shown }),
        _ => return Err(format!("\\{name}")),
    }
    out.extend(macros(behind)?);
    Ok(out)
}

/// Emphasises text. What is emphasised within stands upright, and a formula is not in emphasis, in
/// which GitHub renders none.
fn slanted(text: Vec<Inline>) -> Vec<Inline> {
    let mut out = Vec::new();
    for piece in text {
        match piece {
            Inline::Text(words) => {
                let inner = words.trim();
                let (begin, end) = words.split_once(inner).unwrap_or(("", ""));
                out.push(Inline::Text(begin.into()));
                if !inner.is_empty() {
                    out.push(Inline::Emphasis(vec![Inline::Text(inner.into())]));
                }
                out.push(Inline::Text(end.into()));
            }
            Inline::Emphasis(inner) => out.extend(inner),
            other => out.push(other),
        }
    }
    out.retain(|piece| !matches!(piece, Inline::Text(words) if words.is_empty()));
    out
}

/// The year of a date, `2025-03-01` or `2025/2026`; of `-0300` it is 300 BC.
fn year(date: &str) -> String {
    let (date, era) = match date.strip_prefix(['-', '−', '–']) {
        Some(before) => (before.trim_start_matches('0'), " BC"),
        None => (date, ""),
    };
    format!("{}{era}", date.split(['-', '/']).next().unwrap_or_default())
}

/// An edition as a list shows it before "ed.": `11th` for 11, and words as they are.
fn ordinal(edition: &str) -> Vec<Inline> {
    let words = edition.trim_end_matches("edition").trim_end_matches("ed.").trim();
    let end = match words.parse::<u32>() {
        Err(_) => "",
        Ok(n) if (11..=13).contains(&(n % 100)) => "th",
        Ok(n) => ["th", "st", "nd", "rd"].get(n as usize % 10).unwrap_or(&"th"),
    };
    if words.is_empty() { Vec::new() } else { vec![Inline::Text(format!("{words}{end}"))] }
}

/// Where the work can be read: its DOI in any spelling as an address, or its URL.
fn address(entry: &Entry) -> Result<Option<String>, String> {
    // These fields keep their backslashes.
    let bare = |name| -> String {
        let chunks = entry.get(name).unwrap_or_default();
        let text: String = chunks.iter().map(|chunk| chunk.v.get()).collect();
        text.trim()
            .replace(['\\', '{', '}'], "")
            .replace(' ', "%20")
            .replace('<', "%3C")
            .replace('>', "%3E")
    };
    let doi = bare("doi");
    if doi.is_empty() {
        return Ok(Some(bare("url")).filter(|url| !url.is_empty()));
    }
    match doi.find("10.").map(|at| (doi[..at].to_lowercase(), &doi[at..])) {
        Some((before, number)) if before.is_empty() || before.contains("doi") => {
            Ok(Some(format!("https://doi.org/{number}")))
        }
        _ => Err(format!("has the doi {doi:?}; a DOI begins with 10.")),
    }
}

/// What a text is sorted by: small letters without accents, and no signs.
fn collated(text: &str) -> String {
    let bare = text.nfd().filter(|c| !is_combining_mark(*c)).flat_map(char::to_lowercase);
    let words: String = bare.map(|c| if c.is_alphanumeric() { c } else { ' ' }).collect();
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The list of all entries, each after what a citation shows, with emphasis between stars; or
    /// the fault.
    fn list(text: &str) -> Result<Vec<String>, String> {
        let library = Library::read(text).map_err(|error| error.to_string())?;
        let keys = library.keys().map(String::from).collect();
        let piece = |part: &Inline| match part {
            Inline::Emphasis(inner) => format!("*{}*", plain(inner)),
            Inline::Link { to, .. } => format!("<{to}>"),
            Inline::Maths(tex) => format!("${}$", tex.digits()),
            other => plain(std::slice::from_ref(other)),
        };
        let entry = |entry: &Reference| {
            let text: String = entry.text.iter().map(piece).collect();
            format!("{}, {}: {text}", entry.names, entry.year)
        };
        Ok(library.list(&keys).iter().map(entry).collect())
    }

    #[test]
    fn each_kind_is_shown() {
        let text = r"@article{a, author={Šidák, Zbyněk}, title={Rectangles}, journal={J. {S}tat.}, year={1967}, volume={62},
              number={3--4}, pages={626--633}, doi={10.1/x(2)}}
            @book{b, author={Rice, Stephen O. and {di Bernardo}, Mario}, title={Noise \& $x_1$}, edition={2},
              publisher={Dover, New York}, year={1954}}
            @book{c, author={Rice, S.O. and A, Jean-Marc and others}, title={Whole}, year={1955}, publisher={P}}
            @phdthesis{d, author={Rice, Stephen O. and {di Bernardo}, Mario}, title={T}, school={U of B}, year={1954}}
            @book{f, author={Rice, Stephen O.}, title={Alone}, year={1960}}
            @software{e, author={{A Group}}, title={Code}, date={2025-03-01}, url={https://x.org/}}";
        let expected = [
            "A Group, 2025: A Group. (2025). *Code* [Computer software]. <https://x.org/>",
            "Rice, 1960: Rice, S. O. (1960). *Alone*.",
            "Rice et al., 1955: Rice, S. O., A, J.-M., et al. (1955). *Whole*. P.",
            "Rice & di Bernardo, 1954a: Rice, S. O., & di Bernardo, M. (1954a). *Noise &* $x_1$ (2nd ed.). Dover, New York.",
            "Rice & di Bernardo, 1954b: Rice, S. O., & di Bernardo, M. (1954b). *T* [Doctoral dissertation]. U of B.",
            "Šidák, 1967: Šidák, Z. (1967). Rectangles. *J. Stat.*, *62*(3–4), 626–633. <https://doi.org/10.1/x(2)>",
        ];
        // Who stands alone comes first, and accents are sorted as letters.
        assert_eq!(list(text).unwrap(), expected);
    }

    /// An entry, and what the list shows of it; `·` is a blank that does not break.
    const MEANT: &str = r"
@article{k, author={van der Berg, Jan}, title={T}, journal={J}, year={1}} => van der Berg, 1: van der Berg, J. (1). T. *J*.
@article{k, author={Jan van der Berg}, title={T}, journal={J}, year={1}} => van der Berg, 1: van der Berg, J. (1). T. *J*.
@article{k, author={Knuth, III, Donald E.}, title={T}, journal={J}, year={1}} => Knuth, 1: Knuth, D. E., III. (1). T. *J*.
@article{k, author={A}, title={Why?}, journal={Phys. Lett.}, year={-300}} => A, 300 BC: A. (300 BC). Why? *Phys. Lett.*
@book{k, author={A}, title={Why?}, edition={11}, year=1} => A, 1: A. (1). *Why?* (11th ed.).
@book{k, author={A}, title={O!}, publisher={P.}, edition={Revised ed.}, year=1} => A, 1: A. (1). *O!* (Revised ed.). P.
@book{k, author={A}, title={On \emph{E. coli} and \$5, 50\%}, year=1} => A, 1: A. (1). *On* E. coli *and $5, 50%*.
@book{k, author={A}, title={T}, doi={https://dx.doi.org/10.1/a\_b}, url={https://doi.org/10.1/a}, year=1} => A, 1: A. (1). *T*. <https://doi.org/10.1/a_b>
@book{k, author={A}, title={T~U}, doi={DOI: 10.1/a}, year=1} => A, 1: A. (1). *T·U*. <https://doi.org/10.1/a>";

    #[test]
    fn names_titles_dates_and_addresses_are_shown_as_they_are_meant() {
        for line in MEANT.lines().skip(1) {
            let (text, shown) = line.split_once(" => ").unwrap();
            assert_eq!(list(text).unwrap(), [shown.replace('·', "\u{a0}")], "{text}");
        }
    }

    #[test]
    fn an_entry_that_cannot_be_shown_is_named_by_its_key() {
        for (text, message) in [
            (
                "@misc{a, author={B}, title={c}, year={1999}}",
                "references.bib: a has the type @misc",
            ),
            ("@book{a, author={B}, title={c}}", "references.bib: a lacks its year or date"),
            ("@book{a, author={}, title={c}, year={1}}", "references.bib: a lacks its author"),
            ("@article{a, author={B}, title={c}, year={1}}", "a lacks its journal or journaltitle"),
            (r"@book{a, author={B}, title={c \foo{d}}, year={1}}", r"a has \foo in its title"),
            ("@book{a, author={B}, title={c}, year={1}, doi={x}}", "a has the doi"),
            ("@book{a, author={B}, title={c, year={1}}", "references.bib:1:"),
        ] {
            let found = list(text).unwrap_err();
            assert!(found.contains(message) && !found.contains('\n'), "{found}");
        }
    }
}

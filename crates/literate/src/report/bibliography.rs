//! Reads `references.bib` into the list of references and the labels of citations.

use super::document::{Inline, Reference, plain, words_and_maths};
use super::error::Error;
use crate::input::line_and_column;
use biblatex::{Bibliography, ChunksExt, Entry, EntryType, Person};
use std::collections::BTreeSet;
use unicode_normalization::{UnicodeNormalization, char::is_combining_mark};

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library(Vec<Reference>);

impl Library {
    /// Reads BibTeX. All entries that cannot be shown are reported at once.
    pub fn read(text: &str) -> Result<Self, Error> {
        let fault = |what: String| Error::Template(format!("references.bib:{what}"));
        let read = Bibliography::parse(text).map_err(|error| {
            let place = line_and_column(text, error.span.start);
            fault(format!("{place}: {}; is a brace or a comma missing before?", error.kind))
        })?;
        let (mut list, mut errors) = (Vec::new(), Vec::new());
        for entry in read.iter() {
            match reference(entry) {
                Ok(reference) => list.push(reference),
                Err(what) => errors.push(fault(format!(" {} {what}", entry.key))),
            }
        }
        Error::all(errors)?;
        list.sort_by_cached_key(|reference| collated(&plain(&reference.text())));
        Ok(Library(list))
    }

    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|reference| reference.key.as_str())
    }

    /// Returns the list of these entries; like labels get a letter after the year: 1954a.
    pub fn list(&self, keys: &BTreeSet<String>) -> Vec<Reference> {
        let cited = self.0.iter().filter(|reference| keys.contains(&reference.key));
        let mut list: Vec<Reference> = cited.cloned().collect();
        let labels: Vec<_> = list.iter().map(|one| (one.names.clone(), one.year.clone())).collect();
        for (at, reference) in list.iter_mut().enumerate() {
            let is_like = |label: &&(String, String)| **label == labels[at];
            if labels.iter().filter(is_like).count() > 1 {
                let before = labels[..at].iter().filter(is_like).count();
                reference.year.extend(('a'..='z').nth(before));
            }
        }
        list
    }
}

/// Reads an entry; the error is a message that follows its key.
fn reference(entry: &Entry) -> Result<Reference, String> {
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
    let sentences = match entry.entry_type {
        EntryType::Article => {
            let journal = [
                slanted(either(["journal", "journaltitle"])?),
                between(", ", slanted(field("volume")?), ""),
                between("(", field("number")?, ")"),
                between(", ", field("pages")?, ""),
            ];
            [title, journal.concat()]
        }
        EntryType::Book => {
            let edition = between(" (", ordinal(field("edition")?), " ed.)");
            [[slanted(title), edition].concat(), field("publisher")?]
        }
        EntryType::PhdThesis => {
            let title = between("", slanted(title), " [Doctoral dissertation]");
            [title, either(["school", "institution"])?]
        }
        EntryType::Software => [between("", slanted(title), " [Computer software]"), Vec::new()],
        ref other => {
            let kinds = "@article, @book, @phdthesis or @software";
            return Err(format!("has the type @{other}, which is not supported; use {kinds}"));
        }
    };
    let mut rest = Vec::new();
    for sentence in sentences.into_iter().filter(|sentence| !sentence.is_empty()) {
        let ends = plain(&sentence).ends_with(['.', '?', '!']);
        rest.extend(between(" ", sentence, if ends { "" } else { "." }));
    }
    if let Some(to) = address(entry)? {
        let link = Inline::Link { to: to.clone(), shown: vec![Inline::Text(to)] };
        rest.extend(between(" ", vec![link], ""));
    }
    let year = plain(&either(["year", "date"])?);
    let first = year.split('-').next().filter(|first| !first.is_empty());
    let year = first.unwrap_or(&year).to_string();
    Ok(Reference {
        key: entry.key.clone(),
        names: names(&people),
        year,
        authors: listed(&people),
        rest,
    })
}

fn between(before: &str, inner: Vec<Inline>, after: &str) -> Vec<Inline> {
    if inner.is_empty() {
        return inner;
    }
    let mut all = vec![Inline::Text(before.into())];
    all.extend(inner);
    all.push(Inline::Text(after.into()));
    all
}

/// Reads a field into words and formulas, none if absent; macros other than accents are refused.
fn field(entry: &Entry, name: &str) -> Result<Vec<Inline>, String> {
    let text = entry.get(name).unwrap_or_default().format_verbatim();
    let mut shown = words_and_maths(text.trim());
    for piece in &mut shown {
        let Inline::Text(words) = piece else { continue };
        if let Some((_, found)) = words.split_once('\\') {
            let what = "which not every format can show; write it in plain words";
            return Err(format!("has \\{found} in its {name}, {what}"));
        }
        *words = words.replace('~', "\u{a0}");
    }
    Ok(shown)
}

/// Emphasises words. A title with a formula stands upright: GitHub renders none in emphasis.
fn slanted(text: Vec<Inline>) -> Vec<Inline> {
    match text[..] {
        [Inline::Text(_)] => vec![Inline::Emphasis(text)],
        _ => text,
    }
}

/// An edition as a list shows it before "ed.": `11th` for 11, and words as they are.
fn ordinal(edition: Vec<Inline>) -> Vec<Inline> {
    let ending = match plain(&edition).parse::<u32>() {
        Err(_) => return edition,
        Ok(n) if (11..=13).contains(&(n % 100)) => "th",
        Ok(n) => ["th", "st", "nd", "rd"].get(n as usize % 10).unwrap_or(&"th"),
    };
    between("", edition, ending)
}

/// Where the work can be read: its DOI in any spelling as an address, or its URL.
fn address(entry: &Entry) -> Result<Option<String>, String> {
    // These fields keep their backslashes.
    let bare = |name| {
        let text = entry.get(name).unwrap_or_default().format_verbatim();
        let text = text.trim().replace(['\\', '{', '}'], "").replace(' ', "%20");
        text.replace('<', "%3C").replace('>', "%3E")
    };
    let [doi, url] = ["doi", "url"].map(bare);
    match doi.find("10.") {
        Some(at) => Ok(Some(format!("https://doi.org/{}", &doi[at..]))),
        None if doi.is_empty() => Ok(Some(url).filter(|url| !url.is_empty())),
        None => Err(format!("has the doi {doi:?}; a DOI begins with 10.")),
    }
}

/// What a text is sorted by: small letters without accents, and no signs.
fn collated(text: &str) -> String {
    let bare = text.nfd().filter(|c| !is_combining_mark(*c)).flat_map(char::to_lowercase);
    let words: String = bare.map(|c| if c.is_alphanumeric() { c } else { ' ' }).collect();
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Family name with its particle: `van der Berg`.
fn family(person: &Person) -> String {
    format!("{} {}", person.prefix, person.name).trim().to_string()
}

/// The names of a citation: "Rice", "Homer & Hogan", "Kowalczyk et al.".
fn names(people: &[Person]) -> String {
    let names: Vec<String> = people.iter().map(family).collect();
    match names.as_slice() {
        [one, two] if two != "others" => format!("{one} & {two}"),
        [one, _, ..] => format!("{one} et al."),
        one => one.concat(),
    }
}

/// All authors as `Rice, S. O.` and `Knuth, D. E., III`, with a full stop at the end.
fn listed(people: &[Person]) -> String {
    let initial = |word: &str| word.chars().next().map(|c| format!("{c}."));
    let tied = |word: &str| word.split('-').filter_map(initial).collect::<Vec<_>>().join("-");
    let mut names = Vec::new();
    for person in people {
        let given = person.given_name.replace('.', ". ");
        let given = given.split_whitespace().map(tied).collect::<Vec<_>>().join(" ");
        let mut parts = vec![family(person), given, person.suffix.clone()];
        parts.retain(|part| !part.is_empty());
        names.push(parts.join(", "));
    }
    let list = match names.as_slice() {
        [first @ .., last] if last == "others" => format!("{}, et al", first.join(", ")),
        [first @ .., last] if !first.is_empty() => format!("{}, & {last}", first.join(", ")),
        one => one.concat(),
    };
    list.trim_end_matches('.').to_string() + "."
}

#[cfg(test)]
mod tests {
    use super::super::markdown;
    use super::*;

    /// The list of all entries in Markdown, each after what a citation shows; or the fault.
    fn list(text: &str) -> Result<Vec<String>, String> {
        let library = Library::read(text).map_err(|error| error.to_string())?;
        let keys = library.keys().map(String::from).collect();
        let shown = |entry: &Reference| markdown::inlines(&entry.text());
        let entry = |one: &Reference| format!("{}, {}: {}", one.names, one.year, shown(one));
        Ok(library.list(&keys).iter().map(entry).collect())
    }

    /// Entries, and what the list shows of them, with a bar between, or the fault; `·` is a blank
    /// that does not break. A single author comes first, and accents are sorted as letters.
    const ENTRIES: &str = r"
@article{a, author={Šidák, Zbyněk}, title={T}, journal={J. {S}tat.}, year={1967}, volume={62}, number={3--4}, pages={6--7}, doi={10.1/x(2)}} @book{c, author={Ti, S.O. and A, Jean-Marc and others}, title={W}, year={1955}, publisher={P}} @software{e, author={{A Group}}, title={Code}, date={2025-03-01}, url={https://x.org/}} => A Group, 2025: A Group. (2025). *Code* [Computer software]. [https://x.org/](https://x.org/) | Šidák, 1967: Šidák, Z. (1967). T. *J. Stat.*, *62*(3–4), 6–7. [https://doi.org/10.1/x(2)](https://doi.org/10.1/x(2)) | Ti et al., 1955: Ti, S. O., A, J.-M., et al. (1955). *W*. P.
@book{b, author={Rice, Stephen O. and {di Bernardo}, Mario}, title={Noise \& $x_1$}, edition={2}, publisher={Dover}, year=1954} @phdthesis{d, author={Rice, Stephen O. and {di Bernardo}, Mario}, title={T}, school={U of B}, year=1954} @book{f, author={Rice, Stephen O.}, title={U}, year=1960} => Rice, 1960: Rice, S. O. (1960). *U*. | Rice & di Bernardo, 1954a: Rice, S. O., & di Bernardo, M. (1954a). Noise & $x_1$ (2nd ed.). Dover. | Rice & di Bernardo, 1954b: Rice, S. O., & di Bernardo, M. (1954b). *T* [Doctoral dissertation]. U of B.
@article{k, author={van der Berg, Jan}, title={T}, journal={J}, year={1}} => van der Berg, 1: van der Berg, J. (1). T. *J*.
@article{k, author={Jan van der Berg}, title={T}, journal={J}, year={1}} => van der Berg, 1: van der Berg, J. (1). T. *J*.
@article{k, author={Knuth, III, Donald E.}, title={T}, journal={J}, year={1}} => Knuth, 1: Knuth, D. E., III. (1). T. *J*.
@article{k, author={A}, title={Why?}, journal={Phys. Lett.}, year={-300}} => A, -300: A. (-300). Why? *Phys. Lett.*
@book{k, author={A}, title={Why?}, edition={11}, year=1} => A, 1: A. (1). *Why?* (11th ed.).
@book{k, author={A}, title={O!}, publisher={P.}, edition={Revised}, year=1} => A, 1: A. (1). *O!* (Revised ed.). P.
@book{k, author={A}, title={On \$5, 50\%}, year=1} => A, 1: A. (1). *On \$5, 50%*.
@book{k, author={A}, title={T}, doi={https://dx.doi.org/10.1/a\_b}, url={https://doi.org/10.1/a}, year=1} => A, 1: A. (1). *T*. [https://doi.org/10.1/a_b](https://doi.org/10.1/a_b)
@book{k, author={A}, title={T~U}, doi={DOI: 10.1/a}, year=1} => A, 1: A. (1). *T·U*. [https://doi.org/10.1/a](https://doi.org/10.1/a)
@misc{a, author={B}, title={c}, year={1999}} => references.bib: a has the type @misc
@book{a, author={B}, title={c}} => references.bib: a lacks its year or date
@book{a, author={}, title={c}, year={1}} => references.bib: a lacks its author
@article{a, author={B}, title={c}, year={1}} => references.bib: a lacks its journal or journaltitle
@book{a, author={B}, title={c \foo{d}}, year={1}} => references.bib: a has \foo{d} in its title
@book{a, author={B}, title={c}, year={1}, doi={x}} => references.bib: a has the doi
@book{a, author={B}, title={c, year={1}} => references.bib:1:";

    #[test]
    fn each_entry_is_shown_as_it_is_meant_or_refused_by_its_key() {
        for line in ENTRIES.lines().skip(1) {
            let (text, shown) = line.split_once(" => ").unwrap();
            match list(text) {
                Ok(found) => assert_eq!(found.join(" | "), shown.replace('·', "\u{a0}"), "{text}"),
                Err(fault) => assert!(fault.starts_with(shown) && !fault.contains('\n'), "{fault}"),
            }
        }
    }
}

//! `references.bib` → labels and entries of the list of references: authors and year, title, where it was published.
//!
//! Articles, books, parts of collections, theses and software; entries of other kinds are refused.

use super::document::{Entry, Inline, plain};
use super::{Error, tex};
use crate::input::{line, line_and_column};
use biblatex::{Bibliography, ChunksExt, EntryType, Person, RawBibliography};

/// Of more authors than this the list shows the first and the last.
const MOST: usize = 20;

/// All entries of a .bib file, in the order in which a list shows them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library(Vec<Entry>);

impl Library {
    /// Reads BibTeX.
    ///
    /// # Errors
    /// The line, the key, and what is wrong: the form, a kind that is not shown, a field that is missing.
    pub fn read(text: &str) -> Result<Self, Error> {
        let form = |error: biblatex::ParseError| {
            let place = line_and_column(text, error.span.start);
            let remedy = "is a brace or a comma missing before?";
            Error::Template(format!("references.bib:{place}: {}; {remedy}", error.kind))
        };
        let raw = RawBibliography::parse(text).map_err(form)?;
        // The reader follows these without end where they lead back.
        let borrowed = |pair: &&biblatex::Pair<'_>| {
            ["crossref", "xdata", "xref"].contains(&pair.key.v.to_lowercase().as_str())
        };
        for entry in &raw.entries {
            if let Some(pair) = entry.v.fields.iter().find(borrowed) {
                let what = format!("{} has `{}`; write its fields out", entry.v.key.v, pair.key.v);
                return Err(fault(text, pair.key.span.start, &what));
            }
        }
        let places: Vec<usize> = raw.entries.iter().map(|entry| entry.span.start).collect();
        let read = Bibliography::from_raw(raw).map_err(form)?;
        let shown = |(entry, &at): (&biblatex::Entry, &usize)| {
            shown(entry).map_err(|what| fault(text, at, &format!("{} {what}", entry.key)))
        };
        let mut entries = read.iter().zip(&places).map(shown).collect::<Result<Vec<_>, _>>()?;
        entries.sort_by_cached_key(|entry| collated(&plain(&entry.text)));
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

fn fault(text: &str, at: usize, what: &str) -> Error {
    Error::Template(format!("references.bib:{}: {what}", line(text.get(..at).unwrap_or(text))))
}

/// An entry as the list shows it; what is said behind its key if it cannot be shown.
fn shown(entry: &biblatex::Entry) -> Result<Entry, String> {
    let field = |names: &[&str]| {
        let found = names.iter().find_map(|name| entry.get(name)).map(|chunks| {
            let words = chunks.format_verbatim().replace("---", "—").replace("--", "–");
            words.split_whitespace().collect::<Vec<_>>().join(" ")
        });
        found.filter(|words| !words.is_empty())
    };
    let needed = |names: &[&str]| {
        field(names).ok_or_else(|| format!("lacks its {}; give it", names.join(" or ")))
    };
    let people = |name: &str| {
        let people = entry.get_as::<Vec<Person>>(name).unwrap_or_default();
        if people.is_empty() { Err(format!("lacks its {name}; give it")) } else { Ok(people) }
    };
    let authors = people("author").or_else(|what| people("editor").map_err(|_| what))?;
    let (title, date) = (needed(&["title"])?, needed(&["year", "date"])?);
    let year = date.split('-').next().unwrap_or_default();
    let family: Vec<&str> = authors.iter().map(|person| person.name.as_str()).collect();
    let label = match family.as_slice() {
        [one] => format!("{one}, {year}"),
        [one, two] if *two != "others" => format!("{one} & {two}, {year}"),
        [one, ..] => format!("{one} et al., {year}"),
        [] => year.to_string(),
    };
    let mut text = vec![Inline::Text(format!("{} ({year}). ", listed(&authors)))];
    let words = |text: &mut Vec<Inline>, more: &str| text.push(Inline::Text(more.into()));
    let slanted = |text: &mut Vec<Inline>, words: &str| {
        text.push(Inline::Emphasis(vec![Inline::Text(words.into())]));
    };
    let ending = |publisher: Option<String>| match publisher {
        Some(publisher) => format!(". {}.", publisher.trim_end_matches('.')),
        None => ".".into(),
    };
    let pages = field(&["pages", "eid"]);
    match entry.entry_type {
        EntryType::Article => {
            words(&mut text, &format!("{}. ", title.trim_end_matches('.')));
            slanted(&mut text, &needed(&["journal", "journaltitle"])?);
            if let Some(volume) = field(&["volume"]) {
                words(&mut text, ", ");
                slanted(&mut text, &volume);
            }
            let number = field(&["number", "issue"]).map(|number| format!("({number})"));
            let pages = pages.map(|pages| format!(", {pages}")).unwrap_or_default();
            words(&mut text, &format!("{}{pages}.", number.unwrap_or_default()));
        }
        EntryType::Book => {
            slanted(&mut text, &title);
            let edition =
                field(&["edition"]).map(|edition| format!(" ({} ed.)", ordinal(&edition)));
            words(&mut text, &(edition.unwrap_or_default() + &ending(field(&["publisher"]))));
        }
        EntryType::InCollection | EntryType::InProceedings => {
            words(&mut text, &format!("{}. In ", title.trim_end_matches('.')));
            slanted(&mut text, &needed(&["booktitle"])?);
            let pages = pages.map(|pages| format!(" (pp. {pages})")).unwrap_or_default();
            words(&mut text, &(pages + &ending(field(&["publisher"]))));
        }
        EntryType::PhdThesis | EntryType::MastersThesis | EntryType::Thesis => {
            slanted(&mut text, &title);
            let master = entry.entry_type == EntryType::MastersThesis;
            let kind = if master { "Master’s thesis" } else { "Doctoral dissertation" };
            let school = needed(&["school", "institution"])?;
            words(&mut text, &format!(" [{kind}]{}", ending(Some(school))));
        }
        EntryType::Software => {
            slanted(&mut text, &title);
            words(&mut text, " [Computer software].");
        }
        ref other => {
            let kinds = "@article, @book, @incollection, @phdthesis or @software";
            return Err(format!("has the type @{other}, which is not shown; write {kinds}"));
        }
    }
    tex::text(&plain(&text)).map_err(|error| format!("cannot be shown: {error}"))?;
    let address = field(&["doi"]).map(|doi| format!("https://doi.org/{doi}"));
    if let Some(to) = address.or_else(|| field(&["url"])) {
        words(&mut text, " ");
        text.push(Inline::Link { to: to.clone(), shown: vec![Inline::Text(to)] });
    }
    Ok(Entry { key: entry.key.clone(), label, text })
}

/// `Rice, S. O.`, or the name of a group.
fn inverted(person: &Person) -> String {
    let initial = |word: &str| word.chars().next().map(|c| format!("{c}."));
    let tied = |word: &str| word.split('-').filter_map(initial).collect::<Vec<_>>().join("-");
    let given = person.given_name.replace('.', ". ");
    let initials: Vec<String> = given.split_whitespace().map(tied).collect();
    let suffix = Some(&person.suffix).filter(|suffix| !suffix.is_empty());
    let family = [person.prefix.as_str(), person.name.as_str()].join(" ");
    let parts = [Some(family.trim().into()), Some(initials.join(" ")), suffix.cloned()];
    let parts: Vec<String> = parts.into_iter().flatten().filter(|part| !part.is_empty()).collect();
    parts.join(", ")
}

/// All authors, with a full stop at the end.
fn listed(people: &[Person]) -> String {
    let names: Vec<String> = people.iter().map(inverted).collect();
    let list = match names.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] if last == "others" => format!("{}, et al.", first.join(", ")),
        [first @ .., last] if names.len() <= MOST => format!("{}, & {last}", first.join(", ")),
        [.., last] => format!("{}, … {last}", names[..MOST - 1].join(", ")),
    };
    if list.ends_with('.') { list } else { list + "." }
}

/// `2` as `2nd`; words stay.
fn ordinal(edition: &str) -> String {
    let end = match edition {
        "1" => "st",
        "2" => "nd",
        "3" => "rd",
        _ if edition.bytes().all(|c| c.is_ascii_digit()) => "th",
        _ => "",
    };
    format!("{edition}{end}")
}

/// What a text is sorted by: small letters without accents, and no signs.
fn collated(text: &str) -> String {
    const ACCENTS: [(&str, char); 13] = [
        ("áàâäãåāă", 'a'),
        ("çćč", 'c'),
        ("ďđ", 'd'),
        ("éèêëēěę", 'e'),
        ("ğ", 'g'),
        ("íìîïīı", 'i'),
        ("ł", 'l'),
        ("ñńň", 'n'),
        ("óòôöõøō", 'o'),
        ("řŕ", 'r'),
        ("śšş", 's'),
        ("úùûüūů", 'u'),
        ("žźż", 'z'),
    ];
    let bare =
        |c: char| ACCENTS.iter().find(|(all, _)| all.contains(c)).map_or(c, |(_, bare)| *bare);
    let signs = |c: char| if c.is_alphanumeric() { c } else { ' ' };
    let words: String = text.chars().map(signs).flat_map(char::to_lowercase).map(bare).collect();
    words.split_whitespace().collect::<Vec<_>>().join(" ")
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
        if let Some(Inline::Text(words)) = entry.text.first_mut() {
            *words = words.replacen(year, &lettered, 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The list, with emphasis between stars; or the fault.
    fn list(text: &str) -> Result<Vec<String>, String> {
        let library = Library::read(text).map_err(|error| error.to_string())?;
        let piece = |part: &Inline| match part {
            Inline::Emphasis(inner) => format!("*{}*", plain(inner)),
            Inline::Link { to, .. } => format!("<{to}>"),
            other => plain(std::slice::from_ref(other)),
        };
        let entry = |entry: &Entry| {
            format!("{}: {}", entry.label, entry.text.iter().map(piece).collect::<String>())
        };
        Ok(library.0.iter().map(entry).collect())
    }

    #[test]
    fn each_kind_is_shown() {
        let text = "@article{a, author={Šidák, Zbyněk}, title={Rectangles}, journal={J. {S}tat.}, year={1967}, volume={62},
              number={3--4}, pages={626--633}, doi={10.1/x(2)}}
            @book{b, author={Rice, Stephen O. and {di Bernardo}, Mario}, title={Noise \\& more}, edition={2},
              publisher={Dover, New York}, year={1954}}
            @incollection{c, author={Rice, S.O. and A, Jean-Marc and others}, title={Part}, booktitle={Whole}, year={1955},
              pages={1--2}, publisher={P}}
            @phdthesis{d, author={Rice, Stephen O. and {di Bernardo}, Mario}, title={T}, school={U of B}, year={1954}}
            @book{f, author={Rice, Stephen O.}, title={Alone}, year={1960}}
            @software{e, author={{A Group}}, title={Code}, date={2025-03-01}, url={https://x.org/}}";
        let expected = [
            "A Group, 2025: A Group. (2025). *Code* [Computer software]. <https://x.org/>",
            "Rice, 1960: Rice, S. O. (1960). *Alone*.",
            "Rice et al., 1955: Rice, S. O., A, J.-M., et al. (1955). Part. In *Whole* (pp. 1–2). P.",
            "Rice & di Bernardo, 1954a: Rice, S. O., & di Bernardo, M. (1954a). *Noise & more* (2nd ed.). Dover, New York.",
            "Rice & di Bernardo, 1954b: Rice, S. O., & di Bernardo, M. (1954b). *T* [Doctoral dissertation]. U of B.",
            "Šidák, 1967: Šidák, Z. (1967). Rectangles. *J. Stat.*, *62*(3–4), 626–633. <https://doi.org/10.1/x(2)>",
        ];
        // Who stands alone comes first, and accents are sorted as letters.
        assert_eq!(list(text).unwrap(), expected);
    }

    #[test]
    fn what_cannot_be_shown_is_told_with_its_line() {
        for (text, told) in [
            (
                "\n@misc{a, author={B}, title={c}, year={1999}}",
                "references.bib:2: a has the type @misc",
            ),
            ("@book{a, author={B}, title={c}}", "references.bib:1: a lacks its year or date"),
            ("@book{a, title={c}, year={1}}", "references.bib:1: a lacks its author"),
            ("@article{a, author={B}, title={c}, year={1}}", "a lacks its journal or journaltitle"),
            ("@book{a, author={B}, title={Ж}, year={1}}", "a cannot be shown"),
            ("@book{a,\ncrossref={a}}", "references.bib:2: a has `crossref`"),
            ("@book{a, author={B}, title={c, year={1}}", "references.bib:1:"),
        ] {
            let found = list(text).unwrap_err();
            assert!(found.contains(told) && !found.contains('\n'), "{found}");
        }
    }
}

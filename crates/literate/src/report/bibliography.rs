//! Reads `references.bib` into labels and entries of the list of references.
//!
//! Articles, books, doctoral theses and software; entries of other kinds are refused.

use super::document::{Inline, Reference, plain, words_and_maths};
use super::error::Error;
use crate::input::line_and_column;
use biblatex::{Bibliography, ChunksExt, EntryType, Person};
use unicode_normalization::{UnicodeNormalization, char::is_combining_mark};

/// All entries of a .bib file, in the order in which a list shows them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library(Vec<Reference>);

impl Library {
    /// Reads BibTeX.
    pub fn read(text: &str) -> Result<Self, Error> {
        let fault = |what: String| Error::Template(format!("references.bib:{what}"));
        let form = |error: biblatex::ParseError| {
            let place = line_and_column(text, error.span.start);
            fault(format!("{place}: {}; is a brace or a comma missing before?", error.kind))
        };
        let read = Bibliography::parse(text).map_err(form)?;
        let shown = |entry| shown(entry).map_err(|what| fault(format!(" {} {what}", entry.key)));
        let mut entries = read.iter().map(shown).collect::<Result<Vec<_>, _>>()?;
        entries.sort_by_cached_key(|entry| collated(&plain(&entry.text)));
        Ok(Library(entries))
    }

    fn entry(&self, key: &str) -> Result<&Reference, Error> {
        let unknown = || Error::Reference(key.to_string());
        self.0.iter().find(|entry| entry.key == key).ok_or_else(unknown)
    }

    /// The label of a citation: "Rice, 1945", "Homer & Hogan, 2007", "Kowalczyk et al., 2006".
    pub fn label(&self, key: &str) -> Result<String, Error> {
        Ok(self.entry(key)?.label.clone())
    }

    /// The entries with these keys, as a list shows them.
    pub fn entries(&self, keys: &[String]) -> Result<Vec<Reference>, Error> {
        keys.iter().try_for_each(|key| self.entry(key).map(drop))?;
        Ok(self.0.iter().filter(|entry| keys.contains(&entry.key)).cloned().collect())
    }
}

/// Formats an entry for the list; the error is a message that follows its key.
fn shown(entry: &biblatex::Entry) -> Result<Reference, String> {
    let field = |name: &str| {
        let words = entry.get(name)?.format_verbatim().replace("---", "—").replace("--", "–");
        let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
        (!words.is_empty()).then_some(words)
    };
    let either = |names: [&str; 2]| {
        let found = names.into_iter().find_map(field);
        found.ok_or_else(|| format!("lacks its {}; give it", names.join(" or ")))
    };
    let people = |name: &str| entry.get_as::<Vec<Person>>(name).ok().filter(|all| !all.is_empty());
    let authors = people("author").or_else(|| people("editor"));
    let authors = authors.ok_or("lacks its author or editor; give it")?;
    let (title, date) = (either(["title", "booktitle"])?, either(["year", "date"])?);
    let year = date.split('-').next().unwrap_or_default();
    let names: Vec<&str> = authors.iter().map(|author| author.name.as_str()).collect();
    let label = match names.as_slice() {
        [one, two] if *two != "others" => format!("{one} & {two}, {year}"),
        [one, _, ..] => format!("{one} et al., {year}"),
        one => format!("{}, {year}", one.concat()),
    };
    let words = |words: String| Inline::Text(words);
    let slanted = |words: String| Inline::Emphasis(vec![Inline::Text(words)]);
    let ending = |words: String| format!("{}.", words.trim_end_matches('.'));
    let and = |before: &str, name: &str, after: &str| {
        field(name).map_or(String::new(), |words| format!("{before}{words}{after}"))
    };
    let mut text = vec![words(format!("{} ({year}). ", listed(&authors)))];
    text.extend(match entry.entry_type {
        EntryType::Article => vec![
            words(ending(title) + " "),
            slanted(either(["journal", "journaltitle"])?),
            words(field("volume").map_or(String::new(), |_| ", ".into())),
            slanted(field("volume").unwrap_or_default()),
            words(and("(", "number", ")") + &and(", ", "pages", "") + "."),
        ],
        EntryType::Book => {
            let edition =
                and(" (", "edition", " ed.)").replace("(2 ", "(2nd ").replace("(3 ", "(3rd ");
            vec![slanted(title), words(ending(edition + &and(". ", "publisher", "")))]
        }
        EntryType::PhdThesis => {
            let school = ending(either(["school", "institution"])?);
            vec![slanted(title), words(format!(" [Doctoral dissertation]. {school}"))]
        }
        EntryType::Software => vec![slanted(title), words(" [Computer software].".into())],
        ref other => {
            let kinds = "@article, @book, @phdthesis or @software";
            return Err(format!("has the type @{other}, which is not supported; use {kinds}"));
        }
    });
    text.retain(|piece| !plain(std::slice::from_ref(piece)).is_empty());
    let formulas = |piece: Inline| match piece {
        Inline::Text(words) => words_and_maths(&words),
        Inline::Emphasis(inner) => vec![Inline::Emphasis(words_and_maths(&plain(&inner)))],
        other => vec![other],
    };
    text = text.into_iter().flat_map(formulas).collect();
    let doi = field("doi").map(|doi| format!("https://doi.org/{doi}"));
    if let Some(to) = doi.or_else(|| field("url")) {
        text.extend([words(" ".into()), Inline::Link { to: to.clone(), shown: vec![words(to)] }]);
    }
    Ok(Reference { key: entry.key.clone(), label, text })
}

/// All authors as `Rice, S. O.`, with a full stop at the end.
fn listed(people: &[Person]) -> String {
    let initial = |word: &str| word.chars().next().map(|c| format!("{c}."));
    let tied = |word: &str| word.split('-').filter_map(initial).collect::<Vec<_>>().join("-");
    let inverted = |person: &Person| {
        let given = person.given_name.replace('.', ". ");
        let given = given.split_whitespace().map(tied).collect::<Vec<_>>().join(" ");
        let family = format!("{} {}", person.prefix, person.name);
        format!("{}, {given}", family.trim()).trim_end_matches(", ").to_string()
    };
    let names: Vec<String> = people.iter().map(inverted).collect();
    let list = match names.as_slice() {
        [first @ .., last] if last == "others" => format!("{}, et al", first.join(", ")),
        [first @ .., last] if !first.is_empty() => format!("{}, & {last}", first.join(", ")),
        one => one.concat(),
    };
    list.trim_end_matches('.').to_string() + "."
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

    /// The list, with emphasis between stars; or the fault.
    fn list(text: &str) -> Result<Vec<String>, String> {
        let library = Library::read(text).map_err(|error| error.to_string())?;
        let piece = |part: &Inline| match part {
            Inline::Emphasis(inner) => format!("*{}*", plain(inner)),
            Inline::Link { to, .. } => format!("<{to}>"),
            other => plain(std::slice::from_ref(other)),
        };
        let entry = |entry: &Reference| {
            format!("{}: {}", entry.label, entry.text.iter().map(piece).collect::<String>())
        };
        Ok(library.0.iter().map(entry).collect())
    }

    #[test]
    fn each_kind_is_shown() {
        let text = "@article{a, author={Šidák, Zbyněk}, title={Rectangles}, journal={J. {S}tat.}, year={1967}, volume={62},
              number={3--4}, pages={626--633}, doi={10.1/x(2)}}
            @book{b, author={Rice, Stephen O. and {di Bernardo}, Mario}, title={Noise \\& $x_1$}, edition={2},
              publisher={Dover, New York}, year={1954}}
            @book{c, author={Rice, S.O. and A, Jean-Marc and others}, title={Whole}, year={1955}, publisher={P}}
            @phdthesis{d, author={Rice, Stephen O. and {di Bernardo}, Mario}, title={T}, school={U of B}, year={1954}}
            @book{f, author={Rice, Stephen O.}, title={Alone}, year={1960}}
            @software{e, author={{A Group}}, title={Code}, date={2025-03-01}, url={https://x.org/}}";
        let expected = [
            "A Group, 2025: A Group. (2025). *Code* [Computer software]. <https://x.org/>",
            "Rice, 1960: Rice, S. O. (1960). *Alone*.",
            "Rice et al., 1955: Rice, S. O., A, J.-M., et al. (1955). *Whole*. P.",
            "Rice & di Bernardo, 1954: Rice, S. O., & di Bernardo, M. (1954). *Noise & x_1* (2nd ed.). Dover, New York.",
            "Rice & di Bernardo, 1954: Rice, S. O., & di Bernardo, M. (1954). *T* [Doctoral dissertation]. U of B.",
            "Šidák, 1967: Šidák, Z. (1967). Rectangles. *J. Stat.*, *62*(3–4), 626–633. <https://doi.org/10.1/x(2)>",
        ];
        // Who stands alone comes first, and accents are sorted as letters.
        assert_eq!(list(text).unwrap(), expected);
    }

    #[test]
    fn an_entry_that_cannot_be_shown_is_named_by_its_key() {
        for (text, message) in [
            (
                "@misc{a, author={B}, title={c}, year={1999}}",
                "references.bib: a has the type @misc",
            ),
            ("@book{a, author={B}, title={c}}", "references.bib: a lacks its year or date"),
            ("@book{a, title={c}, year={1}}", "references.bib: a lacks its author"),
            ("@article{a, author={B}, title={c}, year={1}}", "a lacks its journal or journaltitle"),
            ("@book{a, author={B}, title={c, year={1}}", "references.bib:1:"),
        ] {
            let found = list(text).unwrap_err();
            assert!(found.contains(message) && !found.contains('\n'), "{found}");
        }
    }
}

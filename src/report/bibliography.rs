//! `references.bib` → labels and entries of the list of references.
//!
//! A small reader of BibTeX: entries with braced or quoted fields, no macros. Titles are Unicode.

use super::Error;
use super::document::{Entry, Inline};
use std::collections::BTreeMap;

/// All entries of a .bib file, by key.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library(BTreeMap<String, Fields>);

type Fields = BTreeMap<String, String>;

impl Library {
    /// Reads BibTeX.
    ///
    /// # Errors
    /// An entry that does not end, or two with one key, with the line where it begins.
    pub fn read(text: &str) -> Result<Self, Error> {
        let mut entries = BTreeMap::new();
        let mut rest = text;
        while let Some(at) = rest.find('@') {
            let line = text[..text.len() - rest.len() + at].matches('\n').count() + 1;
            let fail = |what: &str| Error::Template(format!("references.bib:{line}: {what}"));
            let open = rest[at..].find('{').ok_or_else(|| fail("an entry without braces"))? + at;
            let end = closing(&rest[open..]).ok_or_else(|| fail("an entry that does not end"))?;
            let body = &rest[open + 1..open + end];
            let (key, fields) =
                body.split_once(',').ok_or_else(|| fail("an entry without fields"))?;
            let mut fields = read_fields(fields);
            fields.insert("kind".into(), rest[at + 1..open].trim().to_lowercase());
            if entries.insert(key.trim().to_string(), fields).is_some() {
                return Err(fail("this key is taken"));
            }
            rest = &rest[open + end + 1..];
        }
        Ok(Library(entries))
    }

    fn fields(&self, key: &str) -> Result<&Fields, Error> {
        let unknown = || Error::Reference(format!("@{key} (not in references.bib)"));
        self.0.get(key).ok_or_else(unknown)
    }

    /// The label of a citation: "Rice, 1945", "Homer & Hogan, 2007", "Kowalczyk et al., 2006".
    ///
    /// # Errors
    /// A key that the file lacks, or an entry without author or year.
    pub fn label(&self, key: &str) -> Result<String, Error> {
        let fields = self.fields(key)?;
        let names = authors(fields);
        let year = fields.get("year").map(String::as_str);
        let (Some((first, _)), Some(year)) = (names.first(), year) else {
            return Err(Error::Template(format!("references.bib: {key} lacks author or year")));
        };
        Ok(match names.len() {
            1 => format!("{first}, {year}"),
            2 => format!("{first} & {}, {year}", names[1].0),
            _ => format!("{first} et al., {year}"),
        })
    }

    /// The entries with these keys, ordered by label.
    ///
    /// # Errors
    /// As [`Library::label`].
    pub fn entries(&self, keys: &[String]) -> Result<Vec<Entry>, Error> {
        let one = |key: &String| {
            let text = entry(self.fields(key)?);
            Ok(Entry { key: key.clone(), label: self.label(key)?, text })
        };
        let mut entries: Vec<Entry> = keys.iter().map(one).collect::<Result<_, Error>>()?;
        entries.sort_by_key(|entry| entry.label.to_lowercase());
        Ok(entries)
    }

    /// All keys.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }
}

/// Index of the brace that closes the one at the start.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0;
    for (i, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(i);
        }
    }
    None
}

fn read_fields(mut text: &str) -> Fields {
    let mut fields = Fields::new();
    while let Some((name, after)) = text.split_once('=') {
        let after = after.trim_start();
        let end = match after.chars().next() {
            Some('{') => closing(after),
            Some('"') => after[1..].find('"').map(|i| i + 1),
            _ => Some(after.find([',', '\n']).unwrap_or(after.len()).saturating_sub(1)),
        };
        let Some(end) = end else { break };
        let end = end + after[end..].chars().next().map_or(0, char::len_utf8);
        let value = after[..end].trim().replace(['{', '}', '"'], "").replace("--", "–");
        let value = value.replace(r"\&", "&");
        let value = value.split_whitespace().collect::<Vec<_>>().join(" ");
        fields.insert(name.trim().trim_start_matches(',').trim().to_lowercase(), value);
        text = &after[end..];
    }
    fields
}

/// (family name, initials) of each author; both "Rice, S. O." and "S. O. Rice" are read.
fn authors(fields: &Fields) -> Vec<(String, String)> {
    let Some(names) = fields.get("author").or_else(|| fields.get("editor")) else {
        return Vec::new();
    };
    let one = |name: &str| {
        let (family, given) = match name.split_once(',') {
            Some((family, given)) => (family.trim(), given.trim()),
            None => match name.trim().rsplit_once(' ') {
                Some((given, family)) => (family, given),
                None => (name.trim(), ""),
            },
        };
        let initial = |part: &str| part.chars().next().map(|c| format!("{c}.")).unwrap_or_default();
        let initials = given.split([' ', '.']).filter(|p| !p.is_empty()).map(initial);
        (family.to_string(), initials.collect::<Vec<_>>().join("\u{a0}"))
    };
    names.split(" and ").map(one).collect()
}

/// Authors (year). Title. *Journal* **volume**(number), pages. Publisher. DOI or address.
fn entry(fields: &Fields) -> Vec<Inline> {
    let get = |name: &str| fields.get(name).map(String::as_str).unwrap_or_default();
    let names: Vec<String> = authors(fields)
        .into_iter()
        .map(
            |(family, initials)| {
                if initials.is_empty() { family } else { format!("{family},\u{a0}{initials}") }
            },
        )
        .collect();
    let names = match names.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [before @ .., last] => format!("{} & {last}", before.join(", ")),
    };
    let title = get("title").trim_end_matches('.');
    let words = |text: String| Inline::Text(text);
    let emphasis = |text: &str| Inline::Emphasis(vec![Inline::Text(text.to_string())]);
    let mut out = vec![words(format!("{names} ({}). ", get("year")))];
    let whole = matches!(get("kind"), "book" | "phdthesis" | "mastersthesis");
    out.push(if whole { emphasis(title) } else { words(title.to_string()) });
    out.push(words(".".into()));
    let inside = [get("journal"), get("booktitle")].into_iter().find(|text| !text.is_empty());
    if let Some(inside) = inside {
        out.extend([words(" ".into()), emphasis(inside)]);
        let mut tail = String::new();
        if !get("volume").is_empty() {
            tail.push_str(&format!(" {}", get("volume")));
        }
        if !get("number").is_empty() {
            tail.push_str(&format!("({})", get("number")));
        }
        if !get("pages").is_empty() {
            tail.push_str(&format!(", {}", get("pages")));
        }
        out.push(words(format!("{tail}.")));
    }
    let edition = match get("edition") {
        "" => String::new(),
        "1" => "1st edition".into(),
        "2" => "2nd edition".into(),
        "3" => "3rd edition".into(),
        other => format!("{other} edition"),
    };
    let mut house = vec![edition.as_str()];
    house.extend(["school", "institution", "publisher", "address", "note"].iter().map(|n| get(n)));
    house.retain(|text| !text.is_empty());
    if !house.is_empty() {
        out.push(words(format!(" {}.", house.join(", "))));
    }
    let address = match (get("doi"), get("url")) {
        ("", "") => None,
        ("", url) => Some((url.to_string(), url.to_string())),
        (doi, _) => Some((format!("https://doi.org/{doi}"), format!("doi:{doi}"))),
    };
    if let Some((to, shown)) = address {
        out.extend([words(" ".into()), Inline::Link { to, shown: vec![words(shown)] }]);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::document::plain;
    use super::*;

    const BIB: &str = r#"
@article{rice1945,
  author = {Rice, S. O.},
  title = "Mathematical analysis of {R}andom noise",
  journal = {Bell System Technical Journal},
  volume = 24,
  pages = {46--156},
  year = {1945},
  doi = {10.1002/x}
}
@book{stauffer1985, author = {Dietrich Stauffer}, title = {Introduction to Percolation Theory},
  publisher = {Taylor \& Francis}, edition = 2, year = 1985}
@inproceedings{three2006, author = {A. One and Two, B. and C. D. Three}, title = {T}, year = {2006}}
"#;

    #[test]
    fn labels_and_entries() {
        let library = Library::read(BIB).unwrap();
        assert_eq!(library.label("rice1945").unwrap(), "Rice, 1945");
        assert_eq!(library.label("three2006").unwrap(), "One et al., 2006");
        let keys = ["stauffer1985".to_string(), "rice1945".to_string()];
        let entries = library.entries(&keys).unwrap();
        assert_eq!(
            plain(&entries[0].text),
            "Rice,\u{a0}S.\u{a0}O. (1945). Mathematical analysis of Random noise. \
             Bell System Technical Journal 24, 46–156. doi:10.1002/x"
        );
        assert_eq!(
            plain(&entries[1].text),
            "Stauffer,\u{a0}D. (1985). Introduction to Percolation Theory. 2nd edition, Taylor & Francis."
        );
    }

    #[test]
    fn mistakes_have_their_line() {
        let error = Library::read("\n\n@book{a, year = {1").unwrap_err().to_string();
        assert!(error.contains("references.bib:3"), "{error}");
        assert!(Library::read("@book{a, year={1}}@book{a, year={2}}").is_err());
        assert!(Library::read("").unwrap().label("none").is_err());
    }
}

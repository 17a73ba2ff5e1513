//! Reads `references.bib` into the list of references and the labels of citations.

use super::bibtex::{self, citation_names, list_authors, list_editors, parse_people};
use super::document::{Inline, Reference, push, to_plain_text, words_and_maths};
use super::error::Error;
use super::latex;
use super::tex;
use crate::input::{Place, one_line};
use biblatex::{ChunksExt, Entry, EntryType, ParseErrorKind};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use unicode_normalization::{UnicodeNormalization, char::is_combining_mark};

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library {
    references: Vec<Reference>,
    /// What is wrong with entries that nobody may cite, by their keys, and where they stand.
    faults: BTreeMap<String, (Place, String)>,
}

impl Library {
    /// Reads a file. Fails if it is not BibTeX; an entry that cannot be shown has a fault.
    pub fn read(path: &str, bibtex: &str) -> Result<Self, Error> {
        let place = |offset: usize| Place::in_text(path.into(), bibtex, offset);
        let (entries, starts) = bibtex::parse_entries(bibtex).map_err(|error| {
            let remedy = match error.kind {
                ParseErrorKind::UnknownAbbreviation(_) => "give it above",
                ParseErrorKind::DuplicateKey(_) => "rename or remove one",
                _ => "is a brace or a comma missing before?",
            };
            let problem = format!("{}; {remedy}", error.kind);
            Error::Message(problem).with_place(place(error.span.start))
        })?;
        let (mut references, mut faults) = (Vec::new(), BTreeMap::new());
        let parents = bibtex::parents(&entries);
        for entry in entries.iter() {
            let completed = bibtex::completed(entry, &entries, &[]);
            let is_parent = completed.is_ok() && parents.contains(&entry.key);
            match completed.and_then(|completed| reference(&completed, entry)) {
                Ok(reference) => references.push(reference),
                Err(_) if is_parent || entry.entry_type == EntryType::XData => (),
                Err(problem) => {
                    faults.insert(entry.key.clone(), (place(starts[&entry.key]), problem));
                }
            }
        }
        references
            .sort_by_cached_key(|reference| sort_key(&to_plain_text(&reference.to_inlines())));
        Ok(Library { references, faults })
    }

    /// Returns what is wrong with the entry that has a key, or `None` if there is no such fault.
    pub fn fault(&self, key: &str) -> Option<Error> {
        let (place, problem) = self.faults.get(key)?;
        Some(Error::Message(format!("{key} {problem}")).with_place(place.clone()))
    }

    /// Returns a line for each entry that is wrong, for reports that cite none of them.
    pub fn warnings(&self) -> impl Iterator<Item = String> {
        let line = |key, place, problem| format!("{place}: {key}, which nobody cites, {problem}");
        self.faults.iter().map(move |(key, (place, it))| one_line(&line(key, place, it), 1000))
    }

    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.references.iter().map(|reference| reference.key.as_str())
    }

    /// Returns the list of these entries; like labels get letters after the year: 1954a.
    pub fn list(&self, keys: &BTreeSet<String>) -> Vec<Reference> {
        let cited = self.references.iter().filter(|reference| keys.contains(&reference.key));
        let mut list: Vec<Reference> = cited.cloned().collect();
        let labels: Vec<_> = list.iter().map(|one| (one.names.clone(), one.year.clone())).collect();
        for (index, reference) in list.iter_mut().enumerate() {
            let is_like = |label: &&(String, String)| **label == labels[index];
            if labels.iter().filter(is_like).count() > 1 {
                let before = labels[..index].iter().filter(is_like).count();
                let (name, year) = &labels[index];
                let lettered = (0..).map(|number| (name.clone(), year.clone() + &letters(number)));
                let mut free = lettered.filter(|label| !labels.contains(label));
                reference.year = free.nth(before).unwrap_or_default().1;
            }
        }
        list
    }
}

/// Returns the letters that tell several works of one name and year apart: a to z, then aa, ab.
fn letters(number: usize) -> String {
    let last = char::from(b'a' + (number % 26) as u8);
    let before = number / 26;
    if before > 0 { letters(before - 1) + last.encode_utf8(&mut [0]) } else { last.into() }
}

/// Reads an entry, completed from its parents; the error is a message that follows its key.
fn reference(entry: &Entry, own: &Entry) -> Result<Reference, String> {
    let read_fields = RefCell::new(BTreeSet::new());
    let field = |name: &str| {
        read_fields.borrow_mut().insert(name.to_string());
        read_field(entry, name)
    };
    let first_of = |names: &[&str]| {
        let texts = names.iter().map(|name| field(name)).find(|texts| *texts != Ok(Vec::new()));
        texts.unwrap_or(Ok(Vec::new()))
    };
    let required = |names: &[&str]| match first_of(names)? {
        none if none.is_empty() => Err(format!("lacks its {}; give it", names.join(" or "))),
        texts => Ok(texts),
    };
    let (authors, editors) = (parse_people(entry, "author")?, parse_people(entry, "editor")?);
    let people = [&authors, &editors].into_iter().find(|group| !group.is_empty());
    let people = people.ok_or("lacks its author or editor; give it")?;
    let subtitle = enclosed(": ", field("subtitle")?, "");
    let mut title = required(&["title", "booktitle"])?;
    // A title with a subtitle is emphasised as a whole.
    for inline in subtitle.into_iter().chain(enclosed(" ", field("titleaddon")?, "")) {
        push(&mut title, inline);
    }
    let kind = |name: &str, words: &str| {
        let kind = to_plain_text(&field("type")?);
        Ok::<_, String>(if kind.is_empty() || kind == name { words.into() } else { kind })
    };
    let publisher = || first_of(&["publisher", "organization", "howpublished"]);
    let sentences = match entry.entry_type {
        EntryType::Article => {
            let journal = [
                emphasised(required(&["journal", "journaltitle"])?),
                enclosed(", ", emphasised(field("volume")?), ""),
                enclosed("(", field("number")?, ")"),
                enclosed(", ", field("pages")?, ""),
            ];
            vec![title, journal.concat()]
        }
        EntryType::Book | EntryType::Collection | EntryType::Proceedings => {
            let edition = enclosed(" (", ordinal(field("edition")?), " ed.)");
            vec![[emphasised(title), edition].concat(), field("publisher")?]
        }
        EntryType::InProceedings | EntryType::InCollection | EntryType::InBook => {
            field("editor")?;
            let editors = if authors.is_empty() { "" } else { &list_editors(&editors) };
            let volume = enclosed("Vol. ", field("volume")?, "");
            let pages = field("pages")?;
            let several = to_plain_text(&pages).contains(['–', '-', ',']);
            let pages = enclosed(if several { "pp. " } else { "p. " }, pages, "");
            let parts = [volume, pages].map(|part| enclosed(", ", part, "")).concat();
            let parts = enclosed(" (", parts.into_iter().skip(1).collect(), ")");
            let within = [emphasised(required(&["booktitle"])?), parts].concat();
            vec![title, enclosed(&format!("In {editors}"), within, ""), publisher()?]
        }
        EntryType::TechReport | EntryType::Report => {
            let kind = kind("techreport", "Report")?;
            let number = enclosed(&format!(" ({kind} No. "), field("number")?, ")");
            vec![[emphasised(title), number].concat(), required(&["institution", "publisher"])?]
        }
        EntryType::PhdThesis => {
            let kind = kind("phdthesis", "Doctoral dissertation")?;
            let title = enclosed("", emphasised(title), &format!(" [{kind}]"));
            vec![title, required(&["school", "institution"])?]
        }
        EntryType::Software => vec![enclosed("", emphasised(title), " [Computer software]")],
        EntryType::Misc | EntryType::Online => vec![emphasised(title), publisher()?],
        ref other => {
            let kinds = "@article, @book, @inproceedings, @incollection, @techreport, @phdthesis, \
                         @software, @online or @misc";
            return Err(format!("has the type @{other}, which is not supported; use {kinds}"));
        }
    };
    let mut rest = Vec::new();
    let sentences = [sentences, vec![field("note")?]].concat();
    for sentence in sentences.into_iter().filter(|sentence| !sentence.is_empty()) {
        let ends = to_plain_text(&sentence).ends_with(['.', '?', '!']);
        rest.extend(enclosed(" ", sentence, if ends { "" } else { "." }));
    }
    if let Some(to) = address(entry)? {
        let link = Inline::Link { to: to.clone(), words: vec![Inline::Text(to)] };
        rest.extend(enclosed(" ", vec![link], ""));
    }
    let mut listed = list_authors(people);
    if authors.is_empty() {
        field("editor")?;
        listed += if people.len() > 1 { " (Eds.)." } else { " (Ed.)." };
    }
    bibtex::refuse_left_out(own, &read_fields.borrow())?;
    let [year, date] = [field("year")?, field("date")?].map(|inlines| to_plain_text(&inlines));
    let reference = Reference {
        key: entry.key.clone(),
        names: citation_names(people),
        year: bibtex::parse_year(&year, &date)?,
        authors: listed,
        rest,
    };
    let unknown = tex::unknown(&latex::inlines(&reference.to_inlines())).pop_first();
    let problem = "is not known in LaTeX; write it in Latin letters";
    unknown.map_or(Ok(reference), |c| Err(format!("has the character {c:?}, which {problem}")))
}

fn enclosed(before: &str, inner: Vec<Inline>, after: &str) -> Vec<Inline> {
    let inlines = |words: &str| vec![Inline::Text(words.into())];
    if inner.is_empty() { inner } else { [inlines(before), inner, inlines(after)].concat() }
}

/// Reads a field, which may be absent; macros other than accents are refused.
fn read_field(entry: &Entry, name: &str) -> Result<Vec<Inline>, String> {
    let verbatim = entry.get(name).unwrap_or_default().format_verbatim();
    let mut inlines = words_and_maths(verbatim.trim());
    let mut open = [false; 2];
    for piece in &mut inlines {
        let Inline::Text(words) = piece else { continue };
        if let Some((_, name_of_macro)) = words.split_once('\\') {
            let problem = "which not every format can show; write it in plain words";
            return Err(format!("has \\{name_of_macro} in its {name}, {problem}"));
        }
        *words = with_quotes(&words.replace('~', "\u{a0}"), &mut open);
    }
    Ok(inlines)
}

/// Sets the quotation marks typed as ``…'', `…' or "…"; those of either kind may be open before.
fn with_quotes(words: &str, open: &mut [bool; 2]) -> String {
    let words = words.replace("``", "“").replace("''", "”");
    let ends = |offset: usize| !words[offset + 1..].starts_with(char::is_alphanumeric);
    let set = |(offset, sign): (usize, char)| match sign {
        '`' => {
            open[0] = true;
            '‘'
        }
        '\'' if open[0] && ends(offset) => {
            open[0] = false;
            '’'
        }
        '"' if open[1] || !ends(offset) => {
            open[1] = !open[1];
            if open[1] { '“' } else { '”' }
        }
        _ => sign,
    };
    words.char_indices().map(set).collect()
}

/// Emphasises words. A title with a formula stands upright: GitHub renders none in emphasis.
fn emphasised(text: Vec<Inline>) -> Vec<Inline> {
    match text[..] {
        [Inline::Text(_)] => vec![Inline::Emphasis(text)],
        _ => text,
    }
}

/// Writes an edition as a list shows it before "ed.": `11th` for 11, and words as they are.
fn ordinal(edition: Vec<Inline>) -> Vec<Inline> {
    let ending = match to_plain_text(&edition).parse::<u32>() {
        Err(_) => return edition,
        Ok(n) if (11..=13).contains(&(n % 100)) => "th",
        Ok(n) => ["th", "st", "nd", "rd"].get(n as usize % 10).unwrap_or(&"th"),
    };
    enclosed("", edition, ending)
}

/// Returns where the work can be read: its DOI in any spelling, its URL, or its place in arXiv.
fn address(entry: &Entry) -> Result<Option<String>, String> {
    // These fields keep their backslashes.
    let verbatim_field = |name| {
        let verbatim = entry.get(name).unwrap_or_default().format_verbatim();
        let verbatim = verbatim.trim().replace(['\\', '{', '}'], "").replace(' ', "%20");
        verbatim.replace('<', "%3C").replace('>', "%3E")
    };
    let [doi, url, eprint] = ["doi", "url", "eprint"].map(verbatim_field);
    if !doi.is_empty() {
        let (before, number) = doi.split_at(doi.find("10.").unwrap_or(doi.len()));
        let before = before.to_lowercase().replace("%20", "");
        let is_doi = ["", "doi:", "doi"].contains(&&*before) || before.ends_with("doi.org/");
        return if is_doi && number.contains('/') {
            Ok(Some(format!("https://doi.org/{number}")))
        } else {
            let remedy = "a DOI begins with 10. and has a slash; a number of arXiv is an eprint";
            Err(format!("has the doi {doi:?}; {remedy}"))
        };
    }
    let archive = verbatim_field("archiveprefix") + &verbatim_field("eprinttype");
    if url.is_empty() && !eprint.is_empty() && archive.eq_ignore_ascii_case("arxiv") {
        return Ok(Some(format!("https://arxiv.org/abs/{eprint}")));
    }
    Ok(Some(url).filter(|url| !url.is_empty()))
}

/// Returns the key by which a text is sorted: its letters in lower case, without accents and signs.
fn sort_key(text: &str) -> String {
    let bare = text.nfd().filter(|c| !is_combining_mark(*c)).flat_map(char::to_lowercase);
    let words: String = bare.map(|c| if c.is_alphanumeric() { c } else { ' ' }).collect();
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::super::markdown;
    use super::*;

    /// The list of all entries in Markdown, each after what a citation shows; or the fault.
    fn list(text: &str) -> Result<Vec<String>, String> {
        let library = Library::read("references.bib", text).map_err(|error| error.to_string())?;
        if let Some(key) = library.faults.keys().next() {
            return Err(library.fault(key).unwrap().to_string());
        }
        let keys = library.keys().map(String::from).collect();
        let markdown_of = |entry: &Reference| markdown::inlines(&entry.to_inlines());
        let entry = |one: &Reference| format!("{}, {}: {}", one.names, one.year, markdown_of(one));
        Ok(library.list(&keys).iter().map(entry).collect())
    }

    #[test]
    fn each_entry_is_shown_as_it_is_meant_or_refused_by_its_key() {
        let mut wrong = Vec::new();
        // A single author comes first, and accents are sorted as letters.
        for line in include_str!("tests/entries.txt").lines() {
            let (bibtex, expected) = line.split_once(" => ").unwrap();
            wrong.extend(match list(bibtex).map(|references| references.join(" | ")) {
                Ok(references) => {
                    (references != expected.replace('·', "\u{a0}")).then_some(references)
                }
                Err(fault) => (!fault.starts_with(expected)).then_some(fault),
            });
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
    }

    #[test]
    fn labels_go_on_after_z_and_never_repeat() {
        let entry = |i| format!("@book{{k{i}, author={{A}}, title={{{i:02}}}, year={{1}}}}\n");
        let mut bibtex: String = (0..60).map(entry).collect();
        bibtex += "@book{own, author={A}, title={T}, year={1ab}}";
        let library = Library::read("references.bib", &bibtex).unwrap();
        let list = library.list(&library.keys().map(String::from).collect());
        let years: Vec<&str> = list.iter().map(|one| one.year.as_str()).collect();
        assert_eq!(years[24..28], ["1y", "1z", "1aa", "1ac"], "1ab is taken");
        assert_eq!(years.iter().collect::<BTreeSet<_>>().len(), 61);
    }
}

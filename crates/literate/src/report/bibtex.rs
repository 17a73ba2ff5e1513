//! Reads BibTeX by the rules of BibTeX and biblatex: entries with the fields of their parents, and
//! the names of people, as citations and the list show them.

use biblatex::EntryType::*;
use biblatex::{Bibliography, Chunk, ChunksExt, Entry, ParseError, ParseErrorKind};
use biblatex::{Person, RawBibliography, RawChunk};
use std::collections::{BTreeMap, BTreeSet};

/// Groups of fields: an entry that has one of a group inherits none of it.
const ALIKE: [&[&str]; 4] = [
    &["date", "month", "year"],
    &["doi", "eprint", "url"],
    &["journal", "journaltitle"],
    &["institution", "school"],
];

/// How `xdata` and `crossref` are kept, so that the crate does not follow them in a circle.
const PARENTS: [&str; 2] = [" xdata", " crossref"];

/// Reads the entries, and where each begins. An abbreviation may be made of those above it.
pub fn parse_entries(bibtex: &str) -> Result<(Bibliography, BTreeMap<String, usize>), ParseError> {
    let bibtex = with_braced_values(bibtex);
    let mut raw = RawBibliography::parse(&bibtex)?;
    for (place, pair) in raw.abbreviations.iter().enumerate() {
        for part in &pair.value.v {
            let RawChunk::Abbreviation(name) = part.v else { continue };
            if raw.abbreviations[place..].iter().any(|later| later.key.v == name) {
                let kind = ParseErrorKind::UnknownAbbreviation(name.into());
                return Err(ParseError { span: part.span.clone(), kind });
            }
        }
    }
    for entry in &raw.entries {
        let name = |place: usize| entry.v.fields[place].key.v.to_lowercase();
        let is_repeated = |place: &usize| (0..*place).any(|before| name(before) == name(*place));
        if let Some(place) = (0..entry.v.fields.len()).find(is_repeated) {
            let span = entry.v.fields[place].key.span.clone();
            return Err(ParseError { span, kind: ParseErrorKind::DuplicateKey(name(place)) });
        }
    }
    for field in raw.entries.iter_mut().flat_map(|entry| &mut entry.v.fields) {
        let is_it = |name: &&&str| name.trim().eq_ignore_ascii_case(field.key.v);
        field.key.v = PARENTS.iter().find(is_it).unwrap_or(&field.key.v);
    }
    let starts = raw.entries.iter().map(|entry| (entry.v.key.v.to_string(), entry.span.start));
    let starts = starts.collect();
    Ok((Bibliography::from_raw(raw)?, starts))
}

/// Writes quoted values in braces, since they may have quotes in braces, and `\'\i` as `\' i`,
/// without moving any place of the text.
fn with_braced_values(bibtex: &str) -> String {
    let mut bibtex = bibtex.to_string();
    for accent in "`'\"^~=.uvHcdbrk".chars() {
        // The blank after a macro is none.
        for macros in [r"\i ", r"\j ", r"\i", r"\j"] {
            let letter = format!("{:>1$}", macros[1..].trim(), macros.len());
            bibtex = bibtex.replace(&format!(r"\{accent}{macros}"), &format!(r"\{accent}{letter}"));
        }
    }
    let (mut depth, mut before) = (0, ' ');
    let [mut is_entry, mut is_comment, mut is_quoted, mut is_literal] = [false; 4];
    let sign = |sign: char| {
        let mut written = sign;
        match sign {
            '\n' => is_comment = false,
            _ if is_comment || is_literal => (),
            '%' if depth < 2 && !is_quoted => is_comment = true,
            '@' if depth == 0 => is_entry = true,
            '{' if is_entry => depth += 1,
            '}' if depth > 0 => {
                depth -= 1;
                is_entry = depth > 0;
            }
            '"' if depth == 1 && (is_quoted || ['=', '#'].contains(&before)) => {
                written = if is_quoted { '}' } else { '{' };
                is_quoted = !is_quoted;
            }
            _ => (),
        }
        is_literal = sign == '\\' && !is_literal;
        before = if is_comment || sign.is_whitespace() { before } else { sign };
        written
    };
    bibtex.chars().map(sign).collect()
}

fn parent_keys(entry: &Entry, field: &str) -> Vec<String> {
    let list = entry.get(field).unwrap_or_default().format_verbatim();
    list.split(',').map(|key| key.trim().into()).filter(|key: &String| !key.is_empty()).collect()
}

/// Returns the keys of all that are parents of others; they need not be complete.
pub fn parents(entries: &Bibliography) -> Vec<String> {
    let keys = |entry| PARENTS.iter().flat_map(move |field| parent_keys(entry, field));
    entries.iter().flat_map(keys).collect()
}

/// Returns an entry with the fields that it inherits, or a message that follows its key. The keys
/// of the entries that inherit from it stand in `below`, by which a circle is found.
pub fn completed(entry: &Entry, entries: &Bibliography, below: &[&str]) -> Result<Entry, String> {
    let (mut complete, keys_below) = (entry.clone(), [below, &[&entry.key]].concat());
    for field in PARENTS {
        for key in parent_keys(entry, field) {
            let link = format!("has the {} {key}", field.trim());
            let no_such_entry = || format!("{link}, which no entry has as its key; correct it");
            let parent = entries.get(&key).ok_or_else(no_such_entry)?;
            if keys_below.contains(&parent.key.as_str()) || keys_below.len() > 8 {
                let circle = format!("{} → {key}", keys_below.join(" → "));
                return Err(format!("{link}, which makes a circle, {circle}; end it"));
            }
            let own: Vec<String> = complete.fields.keys().cloned().collect();
            for (mut name, value) in completed(parent, entries, &keys_below)?.fields {
                // The title of a book is the booktitle of a chapter.
                let before = match (&entry.entry_type, &parent.entry_type) {
                    (InBook | InCollection | InProceedings, Book | Collection | Proceedings) => {
                        "book"
                    }
                    (Article, Periodical) => "journal",
                    _ => "",
                };
                if ["title", "subtitle"].contains(&name.as_str()) && field == " crossref" {
                    name.insert_str(0, before);
                }
                let alike = ALIKE.into_iter().find(|names| names.contains(&name.as_str()));
                let is_own = |one: &&str| own.iter().any(|own| own == one);
                if !alike.unwrap_or(&[&name]).iter().any(is_own) {
                    complete.fields.entry(name).or_insert(value);
                }
            }
        }
        complete.remove(field);
    }
    Ok(complete)
}

/// Fields that no list of references shows, besides those of an address on the web.
const NOT_SHOWN: &str = "abstract address addendum annotation annote archiveprefix copyright day \
                         eprintclass eprinttype file groups isbn issn issue_date key keywords langid language \
                         location month numpages primaryclass shortauthor timestamp urldate urn doi url eprint \
                         author date year";

/// Refuses a field of an entry's own that its reference leaves out without a word.
pub fn refuse_left_out(entry: &Entry, read_fields: &BTreeSet<String>) -> Result<(), String> {
    let is_known = |name: &str| {
        read_fields.contains(name)
            || NOT_SHOWN.split_whitespace().any(|known| known == name)
            || PARENTS.contains(&name)
    };
    let Some(name) = entry.fields.keys().find(|name| !is_known(name)) else { return Ok(()) };
    let kind = &entry.entry_type;
    Err(format!("has the field {name}, which a @{kind} does not show; put it in its note"))
}

/// Returns the year, or that of a date: `2011`, `2011-03`, `2011-03-01`, or a range with `/`.
pub fn parse_year(year: &str, date: &str) -> Result<String, String> {
    let is_number =
        |part: &str, most: u32| part.parse().is_ok_and(|n: u32| (1..=most).contains(&n));
    let is_date = |date: &str| {
        let parts: Vec<&str> = date.trim_start_matches('-').splitn(3, '-').collect();
        parts.iter().zip([9999, 12, 31]).all(|(part, most)| is_number(part, most))
    };
    if !date.split('/').filter(|part| !["", ".."].contains(part)).all(is_date) {
        return Err(format!("has the date {date:?}; write it as 2011-03-01, or give a year"));
    }
    let first = date.split('/').next().unwrap_or_default();
    let digits = first.trim_start_matches('-');
    let end = first.len() - digits.len() + digits.find('-').unwrap_or(digits.len());
    match (year, &first[..end]) {
        ("", "") => Err("lacks its year or date; give it".into()),
        (year, "") => Ok(year.into()),
        ("", first) => Ok(first.into()),
        (year, first) if year == first => Ok(year.into()),
        _ => Err(format!("has the year {year} and the date {date}; keep one")),
    }
}

/// Reads the people of a field, who are none if it is empty. An empty name is refused.
pub fn parse_people(entry: &Entry, field: &str) -> Result<Vec<Person>, String> {
    let mut chunks = entry.get(field).unwrap_or_default().to_vec();
    let mut names_and = "and ".to_string();
    for chunk in &mut chunks {
        if let Chunk::Normal(text) = &mut chunk.v {
            *text = text.replace('~', " ").replace(" AND ", " and ");
        }
        let is_normal = matches!(chunk.v, Chunk::Normal(_));
        names_and +=
            &if is_normal { chunk.v.get().into() } else { chunk.v.get().replace([' ', ','], "_") };
    }
    let words: Vec<&str> = names_and.split_whitespace().chain(["and"]).collect();
    if let Some((_, macro_name)) = names_and.split_once('\\') {
        Err(format!("has \\{macro_name} in its {field}; write it in plain letters"))
    } else if words.len() == 2 {
        Ok(Vec::new())
    } else if words.windows(2).any(|pair| pair == ["and"; 2]) {
        Err(format!("has {:?} as its {field}, and so an empty name; correct it", &names_and[4..]))
    } else if let Some(name) =
        names_and[4..].split(" and ").find(|name| name.matches(',').count() > 2)
    {
        Err(format!("has {name:?} in its {field}; write `and` between names"))
    } else {
        Ok(chunks.parse().unwrap_or_default())
    }
}

/// Returns the family name with its particle: `van der Berg`.
fn family(person: &Person) -> String {
    format!("{} {}", person.prefix, person.name).trim().to_string()
}

/// Returns the names of a citation: "Rice", "Homer & Hogan", "Kowalczyk et al.".
pub fn citation_names(people: &[Person]) -> String {
    let names: Vec<String> = people.iter().map(family).collect();
    match names.as_slice() {
        [one, two] if two != "others" => format!("{one} & {two}"),
        [one, _, ..] => format!("{one} et al."),
        one => one.concat(),
    }
}

/// Returns the initials of given names: `S. O.`, `J.-M.`.
fn initials(person: &Person) -> String {
    let initial = |word: &str| word.chars().next().map(|c| format!("{c}."));
    let tied = |word: &str| word.split('-').filter_map(initial).collect::<Vec<_>>().join("-");
    let given = person.given_name.replace('.', ". ");
    given.split_whitespace().map(tied).collect::<Vec<_>>().join(" ")
}

/// Lists all authors as `Rice, S. O.` and `Knuth, D. E., III`, with a full stop at the end.
pub fn list_authors(people: &[Person]) -> String {
    let name = |person: &Person| {
        let mut parts = vec![family(person), initials(person), person.suffix.clone()];
        parts.retain(|part| !part.is_empty());
        parts.join(", ")
    };
    let list = joined(people.iter().map(name).collect(), ", & ");
    list.trim_end_matches('.').to_string() + "."
}

/// Lists editors as `M. di Bernardo & E. Itor (Eds.), `, or returns no words if there are none.
pub fn list_editors(people: &[Person]) -> String {
    let name = |one: &Person| format!("{} {}", initials(one), family(one)).trim().to_string();
    match people.len() {
        0 => String::new(),
        1 => format!("{} (Ed.), ", name(&people[0])),
        _ => joined(people.iter().map(name).collect(), " & ") + " (Eds.), ",
    }
}

fn joined(names: Vec<String>, between_two: &str) -> String {
    match names.as_slice() {
        [first @ .., last] if last == "others" => format!("{}, et al.", first.join(", ")),
        [one, two] => format!("{one}{between_two}{two}"),
        [first @ .., last] if !first.is_empty() => format!("{}, & {last}", first.join(", ")),
        one => one.concat(),
    }
}

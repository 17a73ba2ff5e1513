//! Entries of `references.bib` as they are written: what a reader of BibTeX passes over in silence would be
//! missing, or wrong, in the list of references.

use super::{Error, tex};
use crate::input::line;
use biblatex::{EntryType, Pair, ParseError, RawBibliography, RawChunk, RawEntry};

/// Fields that the list of references shows. Managers of references write many others beside them.
const FIELDS: &str = "author booktitle chapter date doi edition editor eid institution issue journal \
    journaltitle number pages publisher school title translator url volume year";

/// Of each of these an entry has one, with something in it; of the last, if it is of that type.
const NEEDED: [(&str, &[&str]); 6] = [
    ("", &["author", "editor"]),
    ("", &["year", "date"]),
    ("", &["title"]),
    ("article", &["journal", "journaltitle"]),
    ("inproceedings", &["booktitle"]),
    ("incollection", &["booktitle"]),
];

/// Fields of BibLaTeX that are spelt nearly as these.
const NEAR: [&str; 4] = ["editora", "editorb", "editorc", "volumes"];

/// Fields that are names and not sentences: their capitals stay.
const NAMES: [&str; 6] =
    ["journal", "journaltitle", "booktitle", "publisher", "school", "institution"];

/// Kinds of entries that the style shows as another: proceedings without their pages and publisher, and programs and
/// data each as the other.
const KINDS: [(&str, &str); 4] = [
    ("inproceedings", "incollection"),
    ("conference", "incollection"),
    ("software", "dataset"),
    ("dataset", "misc"),
];

/// What a thesis is, by the words that BibLaTeX has for it.
const THESES: [(&str, &str); 2] =
    [("phdthesis", "Doctoral dissertation"), ("mathesis", "Master’s thesis")];

/// What an edition in words is, which the style shows as it is written.
const EDITIONS: [&str; 10] =
    ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth"];

/// Words of groups, whose last word would be taken for a family name.
const GROUPS: [&str; 4] = ["Collaboration", "Consortium", "Association", "Committee"];

/// Signs that are markup where they would be shown.
const SIGNS: [&str; 14] =
    ["\\", "`", "''", "$", "~", "^", "_", "{", "}", "<", ">", "*", "«", "&amp;"];

/// The entries of a file.
pub struct Entries<'a> {
    text: &'a str,
    read: RawBibliography<'a>,
}

impl<'a> Entries<'a> {
    /// Reads them.
    ///
    /// # Errors
    /// What is wrong with the form of the file.
    pub fn read(text: &'a str) -> Result<Self, ParseError> {
        Ok(Entries { text, read: RawBibliography::parse(text)? })
    }

    /// Refuses what no list of references could show as it was meant.
    ///
    /// # Errors
    /// The line, the key, and what to write.
    pub fn sound(&self) -> Result<(), Error> {
        if let Some(pair) = self.read.abbreviations.first() {
            let what = "@string takes fields from elsewhere; write them out";
            return Err(self.fault(pair.key.span.start, what));
        }
        let ends = self.read.entries.iter().map(|entry| (entry.span.end, entry.v.key.v));
        let starts = self.read.entries.iter().map(|entry| entry.span.start);
        let gaps = std::iter::once((0, "")).chain(ends).zip(starts.chain([self.text.len()]));
        for ((from, key), to) in gaps {
            if let Some(offset) = stray(&self.text[from..to]) {
                let what = match key {
                    "" => "text before the first entry; is an @ missing?".into(),
                    key => format!(
                        "{key} ends before what stands here; is a brace too many, or an @ missing?"
                    ),
                };
                return Err(self.fault(from + offset, &what));
            }
        }
        for entry in &self.read.entries {
            if let Some((offset, what)) = wrong(&entry.v) {
                return Err(self.fault(offset, &format!("{} {what}", entry.v.key.v)));
            }
        }
        Ok(())
    }

    /// The field of an entry, if it has something in it.
    pub fn field(&self, key: &str, wanted: &str) -> Option<String> {
        let entry = self.read.entries.iter().find(|entry| entry.v.key.v == key)?;
        let own = entry.v.fields.iter().find(|pair| name(pair) == wanted)?;
        Some(value(own)).filter(|value| !value.is_empty())
    }

    /// The volume of an entry, if it begins with a zero, which a number would lose.
    pub fn volume(&self, key: &str) -> Option<String> {
        self.field(key, "volume").filter(|volume| volume.starts_with('0'))
    }

    /// The pages of an entry, or the number of its article, where they are more than one number or two: zeros before a number
    /// are part of it, and commas part several.
    pub fn pages(&self, key: &str) -> Option<String> {
        let pages = self.field(key, "pages").or_else(|| self.field(key, "eid"))?;
        let range = |part: &str| {
            let ends = part.split(['-', '–']).map(str::trim).filter(|end| !end.is_empty());
            ends.collect::<Vec<_>>().join("–")
        };
        let parts: Vec<String> = pages.split(',').map(range).collect();
        let is_number = |end: &str| {
            !end.starts_with('0') && !end.is_empty() && end.bytes().all(|c| c.is_ascii_digit())
        };
        let plain = parts.len() == 1 && parts[0].split('–').all(is_number);
        (!plain && !pages.contains(['\\', '{', '$'])).then(|| parts.join(", "))
    }

    /// Refuses what would be shown of an entry, if a sign of markup is in it, or a character without LaTeX.
    ///
    /// # Errors
    /// The line of the entry, and the sign.
    pub fn shows(&self, key: &str, words: &str) -> Result<(), Error> {
        let what = if let Some(sign) = SIGNS.into_iter().find(|sign| words.contains(sign)) {
            format!(
                "{key} would show {sign} as it stands; write the word or character that is meant"
            )
        } else if let Err(error) = tex::text(words) {
            format!("{key}: {error}")
        } else {
            return Ok(());
        };
        let own = self.read.entries.iter().find(|entry| entry.v.key.v == key);
        let offset = own.map_or(0, |entry| entry.span.start);
        Err(self.fault(offset, &what))
    }

    /// The file as the reader of entries understands it: names of journals keep their capitals, initials
    /// stand apart, and who published a thesis or a report is its publisher.
    pub fn understood(&self) -> String {
        let (mut out, mut at) = (String::new(), 0);
        let mut put = |span: &std::ops::Range<usize>, words: &str| {
            out.push_str(&self.text[at..span.start]);
            out.push_str(words);
            at = span.end;
        };
        for entry in self.read.entries.iter().map(|entry| &entry.v) {
            let has = |wanted| entry.fields.iter().any(|pair| name(pair) == wanted);
            let (published, paged) = (has("publisher"), has("pages"));
            let kinds = KINDS.iter().find(|(kind, _)| kind.eq_ignore_ascii_case(entry.kind.v));
            if let Some((_, shown)) = kinds {
                put(&entry.kind.span, shown);
            }
            for pair in &entry.fields {
                let own = name(pair);
                match own.as_str() {
                    "school" | "institution" | "organization" if !published => {
                        put(&pair.key.span, "publisher")
                    }
                    "eid" if !paged => put(&pair.key.span, "pages"),
                    // Beside a volume the style makes a part and a chapter of it.
                    "series" => put(&pair.key.span, "the-series"),
                    // It would leave its comma.
                    _ if value(pair).is_empty() => put(&pair.key.span, &format!("no-{own}")),
                    _ => {}
                }
                let [words] = pair.value.v.as_slice() else { continue };
                let RawChunk::Normal(text) = words.v else { continue };
                let thesis = THESES.iter().find(|(kind, _)| own == "type" && *kind == text.trim());
                if let Some((_, words_of)) = thesis {
                    put(&words.span, words_of);
                    continue;
                }
                let edition = text.trim().split(' ').next().unwrap_or_default().to_lowercase();
                let edition = EDITIONS.iter().position(|word| own == "edition" && *word == edition);
                if let Some(before) = edition {
                    put(&words.span, &(before + 1).to_string());
                } else if NAMES.contains(&own.as_str()) {
                    put(&words.span, &format!("{{{text}}}"));
                } else if ["author", "editor"].contains(&own.as_str()) {
                    put(&words.span, &apart(text));
                }
            }
        }
        out + &self.text[at..]
    }

    fn fault(&self, offset: usize, what: &str) -> Error {
        let line = line(self.text.get(..offset).unwrap_or(self.text));
        Error::Template(format!("references.bib:{line}: {what}"))
    }
}

/// Where in what stands between entries, which a reader takes for a comment, there are words that are none.
fn stray(between: &str) -> Option<usize> {
    let end = between.find('@').unwrap_or(between.len());
    let mut at = 0;
    for line in between[..end].split_inclusive('\n') {
        let words = line.trim_start_matches([' ', '\t', '}', ')', ',']).trim();
        if !words.is_empty() && !words.starts_with('%') {
            return Some(at + line.find(words).unwrap_or_default());
        }
        at += line.len();
    }
    None
}

/// The first fault of an entry: its offset, and what is said behind the key.
fn wrong(entry: &RawEntry<'_>) -> Option<(usize, String)> {
    let (head, kind) = (entry.key.span.start, entry.kind.v);
    if matches!(EntryType::new(kind), EntryType::Unknown(_)) {
        let what = "which there is not; write @article, @book, @phdthesis or the like";
        return Some((head, format!("has the type @{kind}, {what}")));
    }
    if entry.key.v.contains(':') {
        return Some((
            head,
            "has a colon in its key, which references take for their kind; change it".into(),
        ));
    }
    let one = |(i, pair): (usize, &Pair<'_>)| {
        let before = entry.fields[..i].iter().map(name);
        Some((pair.key.span.start, format!("has `{}`, which {}", pair.key.v, fault(pair, before)?)))
    };
    if let Some(found) = entry.fields.iter().enumerate().find_map(one) {
        return Some(found);
    }
    let has = |names: &[&str]| {
        let full = |pair: &&Pair<'_>| value(pair).contains(char::is_alphanumeric);
        entry.fields.iter().filter(full).any(|pair| names.contains(&name(pair).as_str()))
    };
    let subtitle = entry.fields.iter().find(|pair| name(pair) == "subtitle");
    if let Some(pair) = subtitle {
        let what = "which is not shown; write it into the title, behind a colon";
        return Some((pair.key.span.start, format!("has `{}`, {what}", pair.key.v)));
    }
    let lost = |pair: &&Pair<'_>| ["eprint", "howpublished"].contains(&name(pair).as_str());
    if let Some(pair) = entry.fields.iter().find(lost).filter(|_| !has(&["doi", "url"])) {
        let what = "which is not shown; give the address that it leads to as `url`";
        return Some((pair.key.span.start, format!("has `{}`, {what}", pair.key.v)));
    }
    let needs = |of: &str| of.is_empty() || of == kind.to_lowercase();
    let (_, lacks) = NEEDED.into_iter().find(|(of, names)| needs(of) && !has(names))?;
    Some((head, format!("lacks its {}; give it", lacks.join(" or "))))
}

/// What is wrong with a field; the names of those before it.
fn fault(pair: &Pair<'_>, mut before: impl Iterator<Item = String>) -> Option<String> {
    let (own, value) = (name(pair), value(pair));
    let shown = |name: &str| FIELDS.split(' ').any(|field| field == name);
    let meant = FIELDS.split(' ').find(|field| strsim::osa_distance(field, &own) == 1);
    let what = match own.as_str() {
        // The reader follows them without end where they lead back.
        "crossref" | "xdata" | "xref" => "takes fields from elsewhere; write them out",
        _ if shown(&own) && before.any(|name| name == own) => "stands twice; keep one",
        "year" if value.len() != 4 || !value.bytes().all(|c| c.is_ascii_digit()) => {
            "is no year of four digits; correct it"
        }
        "date" if !is_date(&value) => "is no date as 2007-05-31; correct it",
        "url"
            if !["http://", "https://", "ftp://"]
                .iter()
                .any(|scheme| value.starts_with(scheme)) =>
        {
            "is no address with https:// at its beginning; correct it"
        }
        _ if shown(&own) && value.replace(r"\$", "").matches('$').count() % 2 == 1 => {
            "has a $ without its other end"
        }
        "doi" if !value.is_empty() && !value.contains("://") && !value.starts_with("10.") => {
            "does not begin with 10. as each DOI; write what follows doi.org/"
        }
        "doi" if value.contains("://") => "is an address; write what follows doi.org/",
        "doi" | "url" if value.contains('\\') => {
            "has a backslash in it; write the address as a browser shows it"
        }
        "doi" | "url" if value.contains(char::is_whitespace) => "has a blank in it; remove it",
        "author" | "editor" if outside(&written(pair)).contains("et al") => {
            "has et al.; write `and others`"
        }
        "author" | "editor"
            if GROUPS.iter().any(|group| outside(&written(pair)).contains(group)) =>
        {
            "has a group, which is no person; put its name into braces of its own: {{…}}"
        }
        "author" | "editor" if outside(&written(pair)).split_whitespace().any(is_particle) => {
            "has a name with a small letter at its beginning; put the family name into braces: {van der Pol}, B."
        }
        "author" | "editor" if !value.is_empty() && !are_names(written(pair).trim()) => {
            "is no list of names; write `Family, Given and Family, Given`"
        }
        _ => {
            let meant = meant.filter(|_| !shown(&own) && !NEAR.contains(&own.as_str()))?;
            return Some(format!("is no field; is `{meant}` meant?"));
        }
    };
    Some(what.into())
}

/// Does a name begin small, as *van* and *de* do?
fn is_particle(word: &str) -> bool {
    word.starts_with(char::is_lowercase) && !["and", "others"].contains(&word)
}

/// A text without what stands in braces, of which the last is left.
fn outside(text: &str) -> String {
    let mut depth = 0_i32;
    let outside = |c: &char| {
        depth += i32::from(*c == '{') - i32::from(*c == '}');
        depth == 0
    };
    text.chars().filter(outside).collect()
}

/// Are these names, joined by *and*? What stands in braces is one name.
fn are_names(value: &str) -> bool {
    let bare = outside(value);
    let words: Vec<&str> = bare.split_whitespace().collect();
    let one = |name: &[&str]| {
        let name = name.join(" ");
        let parts: Vec<&str> = name.split(',').map(str::trim).collect();
        let junior = |part: &str| part.len() <= 4 && part.starts_with(['J', 'S', 'I', 'V']);
        let fits = match parts.as_slice() {
            [family, middle, _] => !family.is_empty() && junior(middle),
            // What was in braces has left nothing.
            parts => {
                parts.len() < 3
                    && parts[1..].iter().all(|part| !part.is_empty() || value.contains('{'))
            }
        };
        // Without its comma a family name would be taken for a given one, and initials for a family.
        let (alone, family) = match parts.as_slice() {
            [_] => (true, name.split(' ').skip(1).last().unwrap_or_default()),
            _ => (false, parts[0]),
        };
        let initial = |word: &str| {
            let bare = word.replace(['.', '-'], "");
            let short = bare.chars().all(char::is_uppercase) && (1..=3).contains(&bare.len());
            short && (alone || word.ends_with('.'))
        };
        fits && !name.contains([';', '&', '/']) && !family.split(' ').any(initial)
    };
    let empty = |name: &[&str]| name.is_empty() && !value.contains('{');
    let mut names = words.split(|word| *word == "and");
    !words.iter().any(|word| ["AND", "And"].contains(word))
        && names.all(|name| one(name) && !empty(name))
}

/// A year, month or day, or two of them with a stroke between.
fn is_date(text: &str) -> bool {
    let number = |part: &str, least: u32, most: u32| {
        part.bytes().all(|c| c.is_ascii_digit())
            && part.parse::<u32>().is_ok_and(|number| (least..=most).contains(&number))
    };
    let one = |date: &str| {
        let parts: Vec<&str> = date.split('-').collect();
        let fits = |i: usize, long: usize, least, most| {
            parts.get(i).is_none_or(|part| part.len() == long && number(part, least, most))
        };
        parts.len() <= 3 && fits(0, 4, 1, 9999) && fits(1, 2, 1, 12) && fits(2, 2, 1, 31)
    };
    let ends: Vec<&str> = text.split('/').collect();
    ends.len() <= 2 && ends.into_iter().all(one)
}

/// `P.J. Holmes` with a blank between the initials.
fn apart(names: &str) -> String {
    let mut out = String::new();
    for c in names.chars() {
        if c.is_uppercase() && out.ends_with('.') {
            out.push(' ');
        }
        out.push(c);
    }
    out
}

fn name(pair: &Pair<'_>) -> String {
    pair.key.v.to_lowercase()
}

/// The value of a field.
fn written(pair: &Pair<'_>) -> String {
    let words = pair.value.v.iter().map(|chunk| match chunk.v {
        RawChunk::Normal(words) | RawChunk::Abbreviation(words) => words,
    });
    words.collect()
}

/// The value of a field without braces and blanks about it.
fn value(pair: &Pair<'_>) -> String {
    let words = written(pair);
    words.trim_matches(|c: char| c.is_whitespace() || matches!(c, '{' | '}')).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_joined_by_and() {
        for right in [
            "Homer, Martin and Hogan, S. John",
            "Martin Homer",
            "{di Bernardo}, Mario and\n  {van der Walt}, Stéfan J.",
            "{SciPy 1.0 Contributors} and A, B",
            "King, Jr., Martin and Doe, J. and others",
        ] {
            assert!(are_names(right), "{right}");
        }
        for wrong in [
            "Doe, Jane & Roe, Richard",
            "Doe, Jane; Roe, Richard",
            "Doe, Jane AND Roe, Richard",
            "Doe, Jane und Roe, Richard",
            "Doe, Jane, Roe, Richard",
            "Doe, Jane and",
            "Doe, Jane and and Roe, Richard",
            "Goyder H. G. D. and Teh C. E.",
            "H. G. D. Goyder, C. E. Teh",
            "Goyder HGD",
            ",",
        ] {
            assert!(!are_names(wrong), "{wrong}");
        }
    }

    #[test]
    fn dates_are_known() {
        for right in ["2007", "2007-05", "2007-05-31", "2007/2008", "1999-12-31/2000-01-02"] {
            assert!(is_date(right), "{right}");
        }
        for wrong in [
            "",
            "MCM",
            "soon",
            "2000-13-45",
            "99",
            "2000-1",
            "2000/2001/2002",
            "2000-01-01-01",
            "+200",
        ] {
            assert!(!is_date(wrong), "{wrong}");
        }
    }

    #[test]
    fn entries_are_understood() {
        let text = "@phdthesis{a, author={P.J. Holmes}, school={U of B}}\n@book{b, series={S}, publisher = \"P Q\"}\n\
            @inproceedings{c, eid={012}, organization={O}, edition={Second}}";
        let read = Entries::read(text).unwrap();
        let understood = "@phdthesis{a, author={P. J. Holmes}, publisher={{U of B}}}\n\
            @book{b, the-series={S}, publisher = \"{P Q}\"}\n\
            @incollection{c, pages={012}, publisher={O}, edition={2}}";
        assert_eq!(read.understood(), understood);
        assert!(read.shows("b", "T & P").is_ok());
        let told = read.shows("b", "\\foo{T}").unwrap_err().to_string();
        assert!(told.starts_with("references.bib:2: b would show"), "{told}");
    }

    #[test]
    fn words_between_entries_are_none() {
        let entry = "@misc{a, author={B}, title={C}, year={1999}}";
        let sound = |text: &str| Entries::read(text).unwrap().sound().map_err(|e| e.to_string());
        assert_eq!(sound(&format!("% d\n\n{entry},\n% e\n@comment{{x, y}}\n{entry}\n")), Ok(()));
        for (text, place) in [
            (format!("\nmisc{{b}}\n{entry}"), ":2: text before"),
            (format!("{entry}\n\n  d = 1}}\n"), ":3: a ends"),
        ] {
            let told = sound(&text).unwrap_err();
            assert!(told.contains(place), "{told}");
        }
    }

    #[test]
    fn numbers_of_pages_stay_as_they_are_written() {
        for (written, shown) in [
            ("12--19", None),
            ("7", None),
            ("032205", Some("032205")),
            ("002--031", Some("002–031")),
            ("1, 5 -- 9", Some("1, 5–9")),
            ("1--9,12--15", Some("1–9, 12–15")),
            ("S12--S19", Some("S12–S19")),
        ] {
            let text = format!("@article{{a, pages={{{written}}}, volume={{05}}}}");
            let read = Entries::read(&text).unwrap();
            assert_eq!(read.pages("a").as_deref(), shown, "{written}");
            assert_eq!(read.volume("a").as_deref(), Some("05"));
        }
    }
}

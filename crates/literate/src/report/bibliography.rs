//! Reads `references.bib` into the list of references and the labels of citations.

use super::bibtex;
use super::document::{Inline, Reference, plain, words_and_maths};
use super::error::Error;
use super::people::{listed, listed_editors, names, people};
use crate::input::line_and_column;
use biblatex::{ChunksExt, Entry, EntryType, ParseErrorKind};
use std::cell::RefCell;
use std::collections::BTreeSet;
use unicode_normalization::{UnicodeNormalization, char::is_combining_mark};

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library(Vec<Reference>);

impl Library {
    /// Reads BibTeX. All entries that cannot be shown are reported at once.
    pub fn read(text: &str) -> Result<Self, Error> {
        let fault = |what: String| Error::Template(format!("references.bib:{what}"));
        let read = bibtex::entries(text).map_err(|error| {
            let place = line_and_column(text, error.span.start);
            let remedy = match error.kind {
                ParseErrorKind::UnknownAbbreviation(_) => "give it above",
                ParseErrorKind::DuplicateKey(_) => "rename or remove one",
                _ => "is a brace or a comma missing before?",
            };
            fault(format!("{place}: {}; {remedy}", error.kind))
        })?;
        let (mut list, mut errors) = (Vec::new(), Vec::new());
        let parents = bibtex::parents(&read);
        for entry in read.iter() {
            let completed = bibtex::completed(entry, &read, &[]);
            let is_parent = completed.is_ok() && parents.contains(&entry.key);
            match completed.and_then(|completed| reference(&completed, entry)) {
                Ok(reference) => list.push(reference),
                Err(_) if is_parent || entry.entry_type == EntryType::XData => (),
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

    /// Returns the list of these entries; like labels get letters after the year: 1954a.
    pub fn list(&self, keys: &BTreeSet<String>) -> Vec<Reference> {
        let cited = self.0.iter().filter(|reference| keys.contains(&reference.key));
        let mut list: Vec<Reference> = cited.cloned().collect();
        let labels: Vec<_> = list.iter().map(|one| (one.names.clone(), one.year.clone())).collect();
        for (at, reference) in list.iter_mut().enumerate() {
            let is_like = |label: &&(String, String)| **label == labels[at];
            if labels.iter().filter(is_like).count() > 1 {
                let before = labels[..at].iter().filter(is_like).count();
                let (name, year) = &labels[at];
                let all = (0..).map(|number| (name.clone(), year.clone() + &letters(number)));
                let mut free = all.filter(|label| !labels.contains(label));
                reference.year = free.nth(before).unwrap_or_default().1;
            }
        }
        list
    }
}

/// The letters of one of several labels: a to z, then aa, ab.
fn letters(number: usize) -> String {
    let last = char::from(b'a' + (number % 26) as u8);
    let before = number / 26;
    if before > 0 { letters(before - 1) + last.encode_utf8(&mut [0]) } else { last.into() }
}

/// Reads an entry, completed from its parents; the error is a message that follows its key.
fn reference(entry: &Entry, own: &Entry) -> Result<Reference, String> {
    let shown = RefCell::new(BTreeSet::new());
    let field = |name: &str| {
        shown.borrow_mut().insert(name.to_string());
        field(entry, name)
    };
    let any = |names: &[&str]| {
        let found = names.iter().map(|name| field(name)).find(|found| *found != Ok(Vec::new()));
        found.unwrap_or(Ok(Vec::new()))
    };
    let either = |names: &[&str]| match any(names)? {
        none if none.is_empty() => Err(format!("lacks its {}; give it", names.join(" or "))),
        found => Ok(found),
    };
    let (authors, editors) = (people(entry, "author")?, people(entry, "editor")?);
    let people = [&authors, &editors].into_iter().find(|all| !all.is_empty());
    let people = people.ok_or("lacks its author or editor; give it")?;
    let title = [
        either(&["title", "booktitle"])?,
        between(": ", field("subtitle")?, ""),
        between(" ", field("titleaddon")?, ""),
    ];
    let title = joined(title.concat());
    let publisher = || any(&["publisher", "organization", "howpublished"]);
    let sentences = match entry.entry_type {
        EntryType::Article => {
            let journal = [
                slanted(either(&["journal", "journaltitle"])?),
                between(", ", slanted(field("volume")?), ""),
                between("(", field("number")?, ")"),
                between(", ", field("pages")?, ""),
            ];
            vec![title, journal.concat()]
        }
        EntryType::Book | EntryType::Collection | EntryType::Proceedings => {
            let edition = between(" (", ordinal(field("edition")?), " ed.)");
            vec![[slanted(title), edition].concat(), field("publisher")?]
        }
        EntryType::InProceedings | EntryType::InCollection | EntryType::InBook => {
            let editors = if authors.is_empty() { "" } else { &listed_editors(&editors) };
            let volume = between("Vol. ", field("volume")?, "");
            let pages = field("pages")?;
            let several = plain(&pages).contains(['–', '-', ',']);
            let pages = between(if several { "pp. " } else { "p. " }, pages, "");
            let parts = [volume, pages].map(|part| between(", ", part, "")).concat();
            let parts = between(" (", parts.into_iter().skip(1).collect(), ")");
            let within = [slanted(either(&["booktitle"])?), parts].concat();
            vec![title, between(&format!("In {editors}"), within, ""), publisher()?]
        }
        EntryType::TechReport | EntryType::Report => {
            let kind = plain(&field("type")?);
            let kind = if ["", "techreport"].contains(&&*kind) { "Report" } else { &kind };
            let number = between(&format!(" ({kind} No. "), field("number")?, ")");
            vec![[slanted(title), number].concat(), either(&["institution", "publisher"])?]
        }
        EntryType::PhdThesis => {
            let kind = plain(&field("type")?);
            let kind =
                if ["", "phdthesis"].contains(&&*kind) { "Doctoral dissertation" } else { &kind };
            let title = between("", slanted(title), &format!(" [{kind}]"));
            vec![title, either(&["school", "institution"])?]
        }
        EntryType::Software => vec![between("", slanted(title), " [Computer software]")],
        EntryType::Misc | EntryType::Online => vec![slanted(title), publisher()?],
        ref other => {
            let kinds = "@article, @book, @inproceedings, @incollection, @techreport, @phdthesis, \
                         @software, @online or @misc";
            return Err(format!("has the type @{other}, which is not supported; use {kinds}"));
        }
    };
    let mut rest = Vec::new();
    let sentences = [sentences, vec![field("note")?]].concat();
    for sentence in sentences.into_iter().filter(|sentence| !sentence.is_empty()) {
        let ends = plain(&sentence).ends_with(['.', '?', '!']);
        rest.extend(between(" ", sentence, if ends { "" } else { "." }));
    }
    if let Some(to) = address(entry)? {
        let link = Inline::Link { to: to.clone(), shown: vec![Inline::Text(to)] };
        rest.extend(between(" ", vec![link], ""));
    }
    let has_editors_in = matches!(
        entry.entry_type,
        EntryType::InProceedings | EntryType::InCollection | EntryType::InBook
    );
    if authors.is_empty() || has_editors_in {
        shown.borrow_mut().insert("editor".into());
    }
    bibtex::refuse_left_out(own, &shown.borrow())?;
    let [year, date] = [field("year")?, field("date")?].map(|text| plain(&text));
    Ok(Reference {
        key: entry.key.clone(),
        names: names(people),
        year: bibtex::year(&year, &date)?,
        authors: if authors.is_empty() { edited(people) } else { listed(people) },
        rest,
    })
}

/// Joins neighbouring words, so that a title with a subtitle is emphasised as a whole.
fn joined(text: Vec<Inline>) -> Vec<Inline> {
    let mut out: Vec<Inline> = Vec::new();
    for piece in text {
        match (out.last_mut(), piece) {
            (Some(Inline::Text(before)), Inline::Text(words)) => before.push_str(&words),
            (_, piece) => out.push(piece),
        }
    }
    out
}

/// All editors of a work without authors.
fn edited(people: &[biblatex::Person]) -> String {
    let kind = if people.len() > 1 { "Eds." } else { "Ed." };
    format!("{} ({kind}).", listed(people))
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
    let mut open = [false; 2];
    for piece in &mut shown {
        let Inline::Text(words) = piece else { continue };
        if let Some((_, found)) = words.split_once('\\') {
            let what = "which not every format can show; write it in plain words";
            return Err(format!("has \\{found} in its {name}, {what}"));
        }
        *words = with_quotes(&words.replace('~', "\u{a0}"), &mut open);
    }
    Ok(shown)
}

/// Sets the quotation marks that a text types as ``…'', `…' or "…"; single and double ones may be
/// open from before.
fn with_quotes(text: &str, open: &mut [bool; 2]) -> String {
    let text = text.replace("``", "“").replace("''", "”");
    let ends = |at: usize| !text[at + 1..].starts_with(char::is_alphanumeric);
    let set = |(at, sign): (usize, char)| match sign {
        '`' => {
            open[0] = true;
            '‘'
        }
        '\'' if open[0] && ends(at) => {
            open[0] = false;
            '’'
        }
        '"' if open[1] || !ends(at) => {
            open[1] = !open[1];
            if open[1] { '“' } else { '”' }
        }
        _ => sign,
    };
    text.char_indices().map(set).collect()
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

/// Where the work can be read: its DOI in any spelling as an address, its URL, or its place in
/// arXiv.
fn address(entry: &Entry) -> Result<Option<String>, String> {
    // These fields keep their backslashes.
    let bare = |name| {
        let text = entry.get(name).unwrap_or_default().format_verbatim();
        let text = text.trim().replace(['\\', '{', '}'], "").replace(' ', "%20");
        text.replace('<', "%3C").replace('>', "%3E")
    };
    let [doi, url, eprint] = ["doi", "url", "eprint"].map(bare);
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
    let archive = bare("archiveprefix") + &bare("eprinttype");
    if url.is_empty() && !eprint.is_empty() && archive.eq_ignore_ascii_case("arxiv") {
        return Ok(Some(format!("https://arxiv.org/abs/{eprint}")));
    }
    Ok(Some(url).filter(|url| !url.is_empty()))
}

/// What a text is sorted by: small letters without accents, and no signs.
fn collated(text: &str) -> String {
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
        let library = Library::read(text).map_err(|error| error.to_string())?;
        let keys = library.keys().map(String::from).collect();
        let shown = |entry: &Reference| markdown::inlines(&entry.text());
        let entry = |one: &Reference| format!("{}, {}: {}", one.names, one.year, shown(one));
        Ok(library.list(&keys).iter().map(entry).collect())
    }

    /// Entries, and what the list shows of them, with a bar between, or the fault; `·` is a blank
    /// that does not break. A single author comes first, and accents are sorted as letters.
    const ENTRIES: &str = r#"
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
@patent{a, author={B}, title={c}, year={1999}} => references.bib: a has the type @patent
@book{foo, author={Mayer, M}, title={Lorem}, publisher={P}, year=2005, crossref={ref}} @book{ref, editor={Itor, Ed}, title={Whole}, date={2001-02}, publisher={Q}} => Itor, 2001: Itor, E. (Ed.). (2001). *Whole*. Q. | Mayer, 2005: Mayer, M. (2005). *Lorem*. P.
@proceedings{ref, title={Whole}, year=2001, doi={10.1/w}, publisher={Q}, pages={1--900}} @inproceedings{foo, author={M}, title={L}, date={2005}, pages={7}, url={https://x.org}, crossref={ref}} => M, 2005: M. (2005). L. In *Whole* (p. 7). Q. [https://x.org](https://x.org)
@article{foo, author={M}, title={L}, journaltitle={Own}, crossref={ref}} @article{ref, author={R}, journal={Not}, title={T}, year=2001, volume=3} => M, 2001: M. (2001). L. *Own*, *3*. | R, 2001: R. (2001). T. *Not*, *3*.
@xdata{x, publisher={P}, year=3, xdata={y}} @xdata{y, year=4, edition=2} @book{a, author={A}, title={T}, xdata={x}} => A, 3: A. (3). *T* (2nd ed.). P.
@incollection{a, author={A}, title={T}, booktitle={B}, editor={Itor, Ed and van der Berg, J.}, pages={1--2}, volume=3, publisher={P}, year=1} => A, 1: A. (1). T. In E. Itor & J. van der Berg (Eds.), *B* (Vol. 3, pp. 1–2). P.
@techreport{a, author={A}, title={T}, number={12}, institution={I}, year=1} => A, 1: A. (1). *T* (Report No. 12). I.
@report{a, author={A}, title={T}, type={Note}, number={12}, institution={I}, year=1} => A, 1: A. (1). *T* (Note No. 12). I.
@misc{a, author={A}, title={T}, eprint={2010.12345}, archivePrefix={arXiv}, year=1} => A, 1: A. (1). *T*. [https://arxiv.org/abs/2010.12345](https://arxiv.org/abs/2010.12345)
@online{a, author={A}, title={T}, organization={O}, url={https://x.org}, year=1} => A, 1: A. (1). *T*. O. [https://x.org](https://x.org)
@book{a, author={A}, year=1, title="The {"}x{"} y", publisher={Kept}} => A, 1: A. (1). *The “x” y*. Kept.
free { "text @comment{a "b} @book{a, author="M{\"u}ller, J AND D'Arcy, \'Ulf", year=1, title="On {"}Q{"}: \"Uber"} => Müller & D'Arcy, 1: Müller, J., & D'Arcy, Ú. (1). *On “Q”: Über*.
@book{b, author={B}, year=1, title={``q'' and `r' of Royen's}} => B, 1: B. (1). *“q” and ‘r’ of Royen's*.
@book{e, author={Garc{\'\i}a, J and D\'\i az, Jos\'e and Ho\v{c}\"{\i}~A. B.}, year=1, title={Na{\"\i}ve "\`\i"}} => García et al., 1: García, J., Díaz, J., & B., H. A. (1). *Naïve “ì”*.
@string{x = "a"} @string{y = x # "b"} @book{a, author={A}, title=y # "c", year=1} => A, 1: A. (1). *abc*.
@book{a, author={\foo{A}}, title={T}, year=1} => references.bib: a has \foo{A} in its author
@book{a, author={A. and and B}, title={T}, year=1} => references.bib: a has "A. and and B" as its author
@book{a, author={A}, title={T}, doi={arXiv:2010.12345}, year=1} => references.bib: a has the doi "arXiv:2010.12345"
@book{a, author={A}, title={T}, year=1, crossref={a}} => references.bib: a has the crossref a, which makes a circle, a → a
@book{a, author={A}, title={T}, year=1, xdata={b}} @book{b, author={A}, title={T}, year=1, xdata={a}} => references.bib: a has the xdata a, which makes a circle, a → b → a; end it
@book{a, author={A}, title={T}, year=1, crossref={b}} => references.bib: a has the crossref b, which no entry has
@string{x = x # "a"} @book{a, author={A}, title=x, year=1} => references.bib:1:13: unknown abbreviation "x"; give it above
@book{a, author={B}, title={c}} => references.bib: a lacks its year or date
@book{a, author={B}, title={c}, year=2015, date={2016-02}} => references.bib: a has the year 2015 and the date 2016-02; keep one
@book{a, author={B}, title={c}, date={1988~}} => references.bib: a has the date
@book{a, author={B}, title={c}, date={2011-13}} => references.bib: a has the date "2011-13"; write it as 2011-03-01
@book{a, author={B}, title={c}, date={-0044-03-15/-0043}} => B, -0044: B. (-0044). *c*.
@book{a, author={B}, title={c}, year=1, Title={d}} => references.bib:1:41: duplicate key "title"; rename or remove one
@book{a, author={B}, title={c}, year=1, volume=2, isbn={3}} => references.bib: a has the field volume, which a @book does not show; put it in its note
@incollection{a, author={B}, title={c}, booktitle={d}, edition=2, year=1} => references.bib: a has the field edition
@book{a, author={B}, editor={E}, title={c}, year=1} => references.bib: a has the field editor
@book{a, author={A, B, C, D}, title={c}, year=1} => references.bib: a has "A, B, C, D" in its author; write `and` between names
@book{a, author={}, title={c}, year={1}} => references.bib: a lacks its author
@article{a, author={B}, title={c}, year={1}} => references.bib: a lacks its journal or journaltitle
@book{a, author={B}, title={c \foo{d}}, year={1}} => references.bib: a has \foo{d} in its title
@book{a, author={B}, title={c}, year={1}, doi={x}} => references.bib: a has the doi
@book{a, author={B}, title={c, year={1}} => references.bib:1:"#;

    #[test]
    fn each_entry_is_shown_as_it_is_meant_or_refused_by_its_key() {
        let mut wrong = Vec::new();
        for line in ENTRIES.lines().skip(1) {
            let (text, shown) = line.split_once(" => ").unwrap();
            wrong.extend(match list(text).map(|found| found.join(" | ")) {
                Ok(found) => (found != shown.replace('·', "\u{a0}")).then_some(found),
                Err(fault) => (!fault.starts_with(shown)).then_some(fault),
            });
        }
        assert!(wrong.is_empty(), "{wrong:#?}");
    }

    #[test]
    fn labels_go_on_after_z_and_never_repeat() {
        let entry = |i| format!("@book{{k{i}, author={{A}}, title={{{i:02}}}, year={{1}}}}\n");
        let mut text: String = (0..60).map(entry).collect();
        text += "@book{own, author={A}, title={T}, year={1ab}}";
        let library = Library::read(&text).unwrap();
        let list = library.list(&library.keys().map(String::from).collect());
        let years: Vec<&str> = list.iter().map(|one| one.year.as_str()).collect();
        assert_eq!(years[24..28], ["1y", "1z", "1aa", "1ac"], "1ab is taken");
        assert_eq!(years.iter().collect::<BTreeSet<_>>().len(), 61);
    }
}

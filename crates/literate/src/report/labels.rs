//! Numbers sections, figures, tables, equations and statements, and resolves references to them.

use super::bibliography::Library;
use super::document::{
    Block, Inline, Reference, Table, heading_place, place_on_page, rewrite, visit,
};
use super::edition::Document;
use super::error::{Error, Thing};
use super::filled::Part;
use crate::claims::Check;
use std::collections::{BTreeMap, BTreeSet};

#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What references show of it: a number, which has brackets for an equation.
    pub number: String,
    pub document: Document,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    labels: BTreeMap<String, Label>,
    /// Number of statements that have a place so far.
    statements: usize,
    signs: BTreeMap<String, char>,
    /// Ids by their document and their place on its page.
    places: BTreeMap<(&'static str, String), String>,
}

impl Labels {
    pub fn new(claims: &[Check]) -> Self {
        let signs = claims.iter().map(|claim| (claim.id.clone(), claim.verdict.sign())).collect();
        Labels { signs, ..Labels::default() }
    }

    fn add(&mut self, id: &str, number: &str, document: Document) -> Option<Error> {
        let error = |problem: &str| Error::named(Thing::Id, id, format!("{id}: {problem}"));
        let name = id.split_once(':').map_or(id, |(_, name)| name);
        let (shown, digits) = (number.trim_matches(['(', ')']), name.strip_prefix(document.letter));
        if digits.is_some_and(|it| it.parse::<u32>().is_ok()) && ![name, ""].contains(&shown) {
            return Some(error(&format!("its number is {shown}; give it an id of letters")));
        }
        if self.labels.insert(id.to_string(), Label { number: number.into(), document }).is_none() {
            return self.take_place(id, place_on_page(id), document.page);
        }
        Some(error("two things in the report have this id; give one of them another"))
    }

    /// Refuses a place on a page that another id has, of which links could find one only.
    fn take_place(&mut self, id: &str, place: String, page: &'static str) -> Option<Error> {
        let other = self.places.insert((page, place), id.to_string())?;
        let problem =
            format!("{id}: links cannot tell it from {other}; give one of them another id");
        Some(Error::named(Thing::Id, id, problem))
    }

    /// Refuses keys of references that have one place in the list.
    pub fn add_keys<'a>(&mut self, keys: impl Iterator<Item = &'a str>) -> Vec<Error> {
        let place = |key| place_on_page(&format!("ref:{key}"));
        keys.filter_map(|key| self.take_place(key, place(key), "references")).collect()
    }

    /// Adds labels to ids without a label, so that a reference to them is no error.
    pub fn add_missing(&mut self, part: &Part<'_>) {
        for (id, _) in part.named(Thing::Id) {
            let label = Label { number: "?".into(), document: part.document };
            self.labels.entry(id.to_string()).or_insert(label);
        }
    }

    pub fn get(&self, id: &str) -> Option<&Label> {
        self.labels.get(id)
    }

    /// Numbers what references can name, in order; a number that is given is kept.
    pub fn number_all(&mut self, blocks: &mut [Block], document: Document) -> Vec<Error> {
        let mut given: Vec<(&str, String)> = Vec::new();
        visit(blocks, &mut |inline| {
            if let Inline::Display { number, .. } = inline {
                given.push(("eq", number.clone()));
            }
        });
        given.extend(blocks.iter().filter_map(|block| match block {
            Block::Figure { number, .. } => Some(("fig", number.clone())),
            _ => None,
        }));
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        let mut next = |kind: &'static str| loop {
            let count = counts.entry(kind).or_default();
            *count += 1;
            let number = format!("{}{count}", document.letter);
            if !given.contains(&(kind, number.clone())) {
                return number;
            }
        };
        let (mut section, mut subsection) = (format!("{}0", document.letter), 0);
        let mut errors = Vec::new();
        for block in blocks.iter_mut() {
            let (kind, id, number) = match block {
                Block::Heading { level, number, id, text } => {
                    match number {
                        Some(number) if *level == 2 => {
                            (section, subsection) = (next("sec"), 0);
                            number.clone_from(&section);
                        }
                        Some(number) => {
                            subsection += 1;
                            *number = format!("{section}.{subsection}");
                        }
                        None => (),
                    }
                    if let Some(id) = id {
                        errors.extend(self.add(
                            id,
                            number.as_deref().unwrap_or_default(),
                            document,
                        ));
                    } else if number.is_some() {
                        let place = heading_place(None, number.as_deref(), text);
                        errors.extend(self.take_place(&place.clone(), place, document.page));
                    }
                    continue;
                }
                // A repeated figure has its label in another document.
                Block::Figure { id, number, .. } if !document.repeats => ("fig", Some(id), number),
                Block::Listing { id, number, .. } => ("lst", Some(id), number),
                Block::Table(Table { id, number: Some(number), .. }) => {
                    ("tab", id.as_mut(), number)
                }
                _ => continue,
            };
            if number.is_empty() {
                *number = next(kind);
            }
            errors.extend(id.and_then(|id| self.add(id, number, document)));
        }
        visit(blocks, &mut |inline| match inline {
            Inline::Anchor { id, number } => {
                self.statements += 1;
                *number = self.statements.to_string();
                errors.extend(self.add(id, number, document));
            }
            Inline::Display { id: Some(id), number, .. } => {
                if number.is_empty() {
                    *number = next("eq");
                }
                errors.extend(self.add(id, &format!("({number})"), document));
            }
            _ => (),
        });
        errors
    }

    /// Resolves all references of a document, and fills its list of references with what it cites.
    pub fn resolve(&self, blocks: &mut [Block], here: Document, library: &Library) -> Vec<Error> {
        let mut cited = BTreeSet::new();
        visit(blocks, &mut |inline| {
            if let Inline::Unresolved { ids, .. } = inline {
                cited.extend(ids.iter().filter(|id| is_key(id)).cloned());
            }
        });
        let mut errors: Vec<Error> = cited.iter().filter_map(|key| library.fault(key)).collect();
        let list = library.list(&cited);
        rewrite(blocks, &mut |inline| {
            let Inline::Unresolved { ids, in_sentence } = inline else { return vec![inline] };
            let keys = ids.iter().filter(|id| is_key(id)).count();
            let inlines = match keys {
                0 => self.resolve_ids(&ids, here),
                _ if keys == ids.len() => cite(&ids, in_sentence, &list, library),
                _ => Err(mixed(&ids)),
            };
            inlines.unwrap_or_else(|error| {
                errors.push(error);
                Vec::new()
            })
        });
        let mut has_list = false;
        for block in blocks {
            match block {
                // A repeated figure has the number that another document gives it.
                Block::Figure { id, number, .. } => match self.get(id) {
                    Some(label) => number.clone_from(&label.number),
                    None => errors.push(self.unknown(id, id)),
                },
                Block::Bibliography(entries) => (*entries, has_list) = (list.clone(), true),
                _ => (),
            }
        }
        if let (Some(Reference { key, .. }), false) = (list.first(), has_list) {
            let problem = "the document cites this and has no list of references; add a paragraph [@bibliography]";
            errors.push(Error::named(Thing::Reference, key, format!("[@{key}]: {problem}")));
        }
        errors
    }

    fn resolve_ids(&self, ids: &[String], here: Document) -> Result<Vec<Inline>, Error> {
        let (kind_asked, several) = (kind(&ids[0]), ids.len() > 1);
        let lower = kind_asked.to_lowercase();
        let names = kind_names(&lower).filter(|_| ids.iter().all(|id| kind(id) == kind_asked));
        let names = names.ok_or_else(|| mixed(ids))?;
        let name = names[usize::from(kind_asked != lower)][usize::from(several)];
        let is_verdict = name.is_empty();
        let words = |text: &str| Inline::Text(text.to_string());
        let mut inlines = Vec::new();
        if several && !is_verdict {
            inlines.push(words(&format!("{name}\u{a0}")));
        }
        for (i, id) in ids.iter().enumerate() {
            let suffix = &id[kind_asked.len()..];
            let to = format!("{}{suffix}", if is_verdict { "claim" } else { &lower });
            let label = self.get(&to).filter(|label| !label.number.is_empty());
            let Label { number, document } = label.ok_or_else(|| self.unknown(id, &to))?;
            if i > 0 {
                let last = i + 1 == ids.len() && !is_verdict;
                inlines.push(words(if last { " and " } else { ", " }));
            }
            let label = match self.signs.get(suffix.trim_start_matches(':')) {
                Some(sign) if lower == "sign" => sign.to_string(),
                Some(sign) if is_verdict => format!("{sign}\u{a0}{number}"),
                _ if several => number.clone(),
                _ => format!("{name}\u{a0}{number}"),
            };
            let within = (*document != here).then_some(*document);
            inlines.push(Inline::Reference { to, within, label });
        }
        Ok(if lower == "row" { vec![Inline::Raised(inlines)] } else { inlines })
    }

    /// Makes the error of a reference to something that has no number or does not exist.
    fn unknown(&self, asked: &str, id: &str) -> Error {
        let problem = match self.get(id) {
            Some(_) => "this section has no number to refer to; link to it by [words](#sec-id)",
            None => "nothing in the report has this id; correct or remove the reference",
        };
        let numbered = self.labels.iter().filter(|(_, label)| !label.number.is_empty());
        let alike = numbered.map(|(known, _)| known.as_str());
        let alike = alike.filter(|known| kind(known) == kind(id));
        Error::unknown(Thing::Reference, asked, &format!("[@{asked}]: {problem}"), alike)
    }
}

/// Returns the kind of an id, `fig` of `fig:3`, or all of it if it has no kind.
fn kind(id: &str) -> &str {
    id.split(':').next().unwrap_or_default()
}

/// Returns whether an id is a key of references.bib, which may have a colon too.
fn is_key(id: &str) -> bool {
    !id.contains(':') || kind_names(&kind(id).to_lowercase()).is_none()
}

fn mixed(ids: &[String]) -> Error {
    let ids = ids.join("; ");
    let problem = "references of different kinds; give each kind its own brackets";
    Error::named(Thing::Reference, &ids, format!("[@{ids}]: {problem}"))
}

/// Writes `[@rice1945]` as "[Rice, 1945]", and `@rice1945` in a sentence as "Rice (1945)".
fn cite(
    keys: &[String],
    in_sentence: bool,
    list: &[Reference],
    library: &Library,
) -> Result<Vec<Inline>, Error> {
    let mut inlines = Vec::new();
    for key in keys {
        let entry = list.iter().find(|entry| entry.key == *key);
        let Reference { names, year, .. } = entry.ok_or_else(|| {
            let problem = "nothing in the report and no entry of references.bib has this id";
            let problem = format!("[@{key}]: {problem}");
            let unknown = || Error::unknown(Thing::Reference, key, &problem, library.keys());
            library.fault(key).unwrap_or_else(unknown)
        })?;
        let (to, within) = (format!("ref:{key}"), None);
        if in_sentence {
            let label = format!("{names} ({year})");
            return Ok(vec![Inline::Reference { to, within, label }]);
        }
        inlines.push(Inline::Text(if inlines.is_empty() { "[" } else { "; " }.into()));
        inlines.push(Inline::Reference { to, within, label: format!("{names}, {year}") });
    }
    inlines.push(Inline::Text("]".into()));
    Ok(inlines)
}

/// Returns what references call things of a kind: one and several, in short and in full.
fn kind_names(kind: &str) -> Option<[[&'static str; 2]; 2]> {
    Some(match kind {
        "eq" => [["Eq.", "Eqs."], ["Equation", "Equations"]],
        "fig" => [["Fig.", "Figs."], ["Figure", "Figures"]],
        "sec" => [["Sec.", "Secs."], ["Section", "Sections"]],
        "tab" => [["Table", "Tables"]; 2],
        "claim" => [["claim", "claims"], ["Claim", "Claims"]],
        "lst" => [["Listing", "Listings"]; 2],
        // The sign of a verdict needs no name.
        "row" | "mark" | "sign" => [[""; 2]; 2],
        _ => return None,
    })
}

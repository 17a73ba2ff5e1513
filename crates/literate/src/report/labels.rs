//! Numbers what can be referred to, and resolves references and citations.

use super::Error;
use super::bibliography::Library;
use super::document::{Block, Inline, rewrite, visit};
use super::edition::Document;
use crate::claims::Check;
use std::collections::BTreeMap;

/// What can be referred to by an id.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What references show: a number, in brackets that of an equation, with its letter the part of a figure.
    pub shown: String,
    /// The document that has it.
    pub of: Document,
    /// Id of the place that references lead to.
    to: String,
}

/// Everything that can be referred to, of all documents, by its id.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    labels: BTreeMap<String, Label>,
    /// Places of statements so far.
    places: usize,
}

impl Labels {
    fn add(&mut self, id: &str, shown: &str, of: Document, to: &str) -> Result<(), Error> {
        let label = Label { shown: shown.into(), of, to: to.into() };
        match self.labels.insert(id.to_string(), label) {
            None => Ok(()),
            Some(_) => Err(Error::Label(id.to_string())),
        }
    }

    /// What an id refers to.
    pub fn get(&self, id: &str) -> Option<&Label> {
        self.labels.get(id)
    }

    /// Gives numbers to the sections, figures, equations, captioned tables, listings and anchors of a document, in order;
    /// figures and equations that have one keep it.
    pub fn number_all(&mut self, blocks: &mut [Block], of: Document) -> Result<(), Error> {
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
            let number = format!("{}{count}", of.letter);
            if !given.contains(&(kind, number.clone())) {
                return number;
            }
        };
        let (mut section, mut subsection) = (format!("{}0", of.letter), 0);
        for block in blocks.iter_mut() {
            let (id, number) = match block {
                Block::Heading { level, number, id, .. } => {
                    if number.is_some() && *level == 2 {
                        (section, subsection) = (next("sec"), 0);
                        *number = Some(section.clone());
                    } else if number.is_some() && *level == 3 {
                        subsection += 1;
                        *number = Some(format!("{section}.{subsection}"));
                    }
                    (id.clone(), number.clone().unwrap_or_default())
                }
                // What is shown again has its place elsewhere.
                Block::Figure { id, number, .. } if !of.repeats => {
                    if number.is_empty() {
                        *number = next("fig");
                    }
                    (Some(id.clone()), number.clone())
                }
                Block::Listing { id, number, .. } => {
                    *number = next("lst");
                    (Some(id.clone()), number.clone())
                }
                Block::Table { id, number: Some(number), .. } => {
                    *number = next("tab");
                    (id.clone(), number.clone())
                }
                _ => continue,
            };
            id.map_or(Ok(()), |id| self.add(&id, &number, of, &id))?;
        }
        rewrite(blocks, &mut |mut inline| {
            match &mut inline {
                Inline::Anchor { id, number } => {
                    self.places += 1;
                    *number = self.places.to_string();
                    self.add(id, number, of, id)?;
                }
                Inline::Display { id: Some(id), number, .. } => {
                    if number.is_empty() {
                        *number = next("eq");
                    }
                    self.add(id, &format!("({number})"), of, id)?;
                }
                _ => {}
            }
            Ok(vec![inline])
        })
    }

    /// Gives each judged statement that has its row more names: `row:id` and `mark:id`, shown as its verdict and number,
    /// and `sign:id`, shown as its verdict alone.
    pub fn judge(&mut self, claims: &[Check]) -> Result<(), Error> {
        let mut placed = self.labels.keys().filter_map(|id| id.strip_prefix("claim:"));
        if let Some(id) = placed.find(|id| !claims.iter().any(|claim| claim.id == *id)) {
            return Err(Error::Claim(id.to_string()));
        }
        for Check { id, verdict, .. } in claims {
            let to = format!("claim:{id}");
            let Some(Label { shown, of, .. }) = self.labels.get(&to).cloned() else { continue };
            let sign = verdict.sign();
            for kind in ["row", "mark"] {
                self.add(&format!("{kind}:{id}"), &format!("{sign}\u{a0}{shown}"), of, &to)?;
            }
            self.add(&format!("sign:{id}"), &sign.to_string(), of, &to)?;
        }
        Ok(())
    }

    /// Resolves all references of a document, and fills its list of references with what it cites.
    pub fn resolve(
        &self,
        blocks: &mut [Block],
        here: Document,
        library: &Library,
    ) -> Result<(), Error> {
        for block in blocks.iter_mut() {
            // A figure that is shown again has the number of its place.
            if let Block::Figure { id, number, .. } = block {
                let label = self.get(id).ok_or_else(|| Error::Reference(id.clone()))?;
                *number = label.shown.clone();
            }
        }
        let mut cited = Vec::new();
        rewrite(blocks, &mut |inline| match inline {
            Inline::Unresolved(ids) => self.refer(&ids, here, library, &mut cited),
            other => Ok(vec![other]),
        })?;
        cited.sort();
        cited.dedup();
        let lists = blocks.iter_mut().filter_map(|block| match block {
            Block::Bibliography(entries) => Some(entries),
            _ => None,
        });
        let lists: Vec<_> = lists.collect();
        if let (Some(key), true) = (cited.first(), lists.is_empty()) {
            let what = format!(
                "cites {key} but has no list of references; add a paragraph [@bibliography]"
            );
            return Err(Error::Template(format!("{}: {what}", here.prose)));
        }
        for entries in lists {
            *entries = library.entries(&cited)?;
        }
        Ok(())
    }

    /// Citations `[@rice1945; @toda1989]`, or references of one kind, `[@fig:3; @fig:8a]`.
    fn refer(
        &self,
        ids: &[String],
        here: Document,
        library: &Library,
        cited: &mut Vec<String>,
    ) -> Result<Vec<Inline>, Error> {
        let words = |text: &str| Inline::Text(text.to_string());
        let mut out = Vec::new();
        if ids.iter().all(|id| !id.contains(':')) {
            for key in ids {
                out.push(words(if out.is_empty() { "[" } else { "; " }));
                let (to, shown) = (format!("ref:{key}"), library.label(key)?);
                out.push(Inline::Reference { to, within: None, shown });
                cited.push(key.clone());
            }
            out.push(words("]"));
            return Ok(out);
        }
        let kind = |id: &String| id.split(':').next().unwrap_or_default().to_string();
        let (asked, several) = (kind(&ids[0]), ids.len() > 1);
        let lower = asked.to_lowercase();
        let names = names(&lower).filter(|_| ids.iter().all(|id| kind(id) == asked));
        let names = names.ok_or_else(|| Error::Reference(ids.join("; ")))?;
        let name = names[usize::from(several) + if asked == lower { 0 } else { 2 }];
        let is_verdict = name.is_empty();
        if several && !is_verdict {
            out.push(words(&format!("{name}\u{a0}")));
        }
        for (i, id) in ids.iter().enumerate() {
            let id = format!("{lower}{}", &id[asked.len()..]);
            let label = self.get(&id).filter(|label| !label.shown.is_empty());
            let Label { shown, of, to } = label.ok_or_else(|| Error::Reference(ids[i].clone()))?;
            if i > 0 {
                let last = i + 1 == ids.len() && !is_verdict;
                out.push(words(if last { " and " } else { ", " }));
            }
            let named = !several && !is_verdict;
            let shown = if named { format!("{name}\u{a0}{shown}") } else { shown.clone() };
            let within = (*of != here).then_some(*of);
            out.push(Inline::Reference { to: to.clone(), within, shown });
        }
        Ok(if lower == "row" { vec![Inline::Raised(out)] } else { out })
    }
}

/// Refuses an id that does not tell of which kind it is: a table with one of a figure would be called one.
pub(super) fn of_kind(kind: &str, id: &str) -> Result<(), Error> {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, ':' | '-' | '_' | '.');
    let name = id.strip_prefix(kind).and_then(|name| name.strip_prefix(':'));
    match name.is_some_and(|name| !name.is_empty() && name.chars().all(plain)) {
        true => Ok(()),
        false => Err(Error::Markup(format!(
            "the id {id:?} is not valid: write {kind}: followed by letters, digits or any of : - _ ."
        ))),
    }
}

/// What a kind of reference is called: short for one and several, and in full.
pub(super) fn names(kind: &str) -> Option<[&'static str; 4]> {
    Some(match kind {
        "eq" => ["Eq.", "Eqs.", "Equation", "Equations"],
        "fig" => ["Fig.", "Figs.", "Figure", "Figures"],
        "sec" => ["Sec.", "Secs.", "Section", "Sections"],
        "tab" => ["Table", "Tables", "Table", "Tables"],
        "claim" => ["claim", "claims", "Claim", "Claims"],
        "lst" => ["Listing", "Listings", "Listing", "Listings"],
        // Signs need no name.
        "row" | "mark" | "sign" => [""; 4],
        _ => return None,
    })
}

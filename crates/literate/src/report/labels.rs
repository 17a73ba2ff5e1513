//! Numbers sections, figures, tables, equations and statements, and resolves references to them.

use super::bibliography::Library;
use super::document::{Block, Inline, rewrite, visit};
use super::edition::Document;
use super::error::Error;
use crate::claims::Check;
use std::collections::BTreeMap;

/// What can be referred to by an id.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What references show: a number, which has brackets for an equation.
    pub shown: String,
    /// The document in which it stands.
    pub document: Document,
    /// Id of the place to which references lead.
    to: String,
}

/// All labels of all documents, by id.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    labels: BTreeMap<String, Label>,
    /// Number of statements that have a place so far.
    statements: usize,
}

impl Labels {
    fn add(&mut self, id: &str, shown: &str, document: Document, to: &str) -> Result<(), Error> {
        let label = Label { shown: shown.into(), document, to: to.into() };
        match self.labels.insert(id.to_string(), label) {
            None => Ok(()),
            Some(_) => Err(Error::Label(id.to_string())),
        }
    }

    /// Returns the label with this id.
    pub fn get(&self, id: &str) -> Option<&Label> {
        self.labels.get(id)
    }

    /// Numbers the sections, figures, equations, captioned tables, listings and statements of a
    /// document, in order; figures and equations that have a number keep it.
    pub fn number_all(&mut self, blocks: &mut [Block], document: Document) -> Result<(), Error> {
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
                // A repeated figure has its label in another document.
                Block::Figure { id, number, .. } if !document.repeats => {
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
            if let Some(id) = id {
                self.add(&id, &number, document, &id)?;
            }
        }
        rewrite(blocks, &mut |mut inline| {
            match &mut inline {
                Inline::Anchor { id, number } => {
                    self.statements += 1;
                    *number = self.statements.to_string();
                    self.add(id, number, document, id)?;
                }
                Inline::Display { id: Some(id), number, .. } => {
                    if number.is_empty() {
                        *number = next("eq");
                    }
                    self.add(id, &format!("({number})"), document, id)?;
                }
                _ => {}
            }
            Ok(vec![inline])
        })
    }

    /// Adds labels for the verdict of each statement that has a place: `row:id` and `mark:id` show
    /// its sign and number, `sign:id` its sign alone.
    pub fn add_verdicts(&mut self, claims: &[Check]) -> Result<(), Error> {
        let mut placed = self.labels.keys().filter_map(|id| id.strip_prefix("claim:"));
        if let Some(id) = placed.find(|id| !claims.iter().any(|claim| claim.id == *id)) {
            return Err(Error::Claim(id.to_string()));
        }
        for Check { id, verdict, .. } in claims {
            let to = format!("claim:{id}");
            let Some(Label { shown, document, .. }) = self.labels.get(&to).cloned() else {
                continue;
            };
            let sign = verdict.sign();
            for kind in ["row", "mark"] {
                self.add(&format!("{kind}:{id}"), &format!("{sign}\u{a0}{shown}"), document, &to)?;
            }
            self.add(&format!("sign:{id}"), &sign.to_string(), document, &to)?;
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
            // A repeated figure has the number that another document gives it.
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

    /// Writes citations, `[@rice1945; @toda1989]`, or references of one kind, `[@fig:3; @fig:8a]`.
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
        let name = Name::of(&lower).filter(|_| ids.iter().all(|id| kind(id) == asked));
        let name = name.ok_or_else(|| Error::Reference(ids.join("; ")))?;
        let name = match (asked == lower, several) {
            (true, false) => name.short,
            (true, true) => name.plural,
            (false, false) => name.long,
            (false, true) => name.long_plural,
        };
        let is_verdict = name.is_empty();
        if several && !is_verdict {
            out.push(words(&format!("{name}\u{a0}")));
        }
        for (i, id) in ids.iter().enumerate() {
            let lower_id = format!("{lower}{}", &id[asked.len()..]);
            let label = self.get(&lower_id).filter(|label| !label.shown.is_empty());
            let Label { shown, document, to } =
                label.ok_or_else(|| Error::Reference(id.clone()))?;
            if i > 0 {
                let last = i + 1 == ids.len() && !is_verdict;
                out.push(words(if last { " and " } else { ", " }));
            }
            let shown = match several || is_verdict {
                true => shown.clone(),
                false => format!("{name}\u{a0}{shown}"),
            };
            let within = (*document != here).then_some(*document);
            out.push(Inline::Reference { to: to.clone(), within, shown });
        }
        Ok(if lower == "row" { vec![Inline::Raised(out)] } else { out })
    }
}

/// Refuses an id that does not begin with the kind of what it names: a table with the id of a
/// figure would be called a figure.
pub(super) fn check_kind(kind: &str, id: &str) -> Result<(), Error> {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, ':' | '-' | '_' | '.');
    let name = id.strip_prefix(kind).and_then(|name| name.strip_prefix(':'));
    if name.is_some_and(|name| !name.is_empty() && name.chars().all(plain)) {
        return Ok(());
    }
    let what = "followed by letters, digits or any of : - _ .";
    Err(Error::Markup(format!("the id {id:?} is not valid: write {kind}: {what}")))
}

/// What references call the things of one kind.
struct Name {
    short: &'static str,
    plural: &'static str,
    long: &'static str,
    long_plural: &'static str,
}

impl Name {
    /// Returns the name of a kind, such as `fig`; none if there is no such kind.
    fn of(kind: &str) -> Option<Name> {
        let [short, plural, long, long_plural] = match kind {
            "eq" => ["Eq.", "Eqs.", "Equation", "Equations"],
            "fig" => ["Fig.", "Figs.", "Figure", "Figures"],
            "sec" => ["Sec.", "Secs.", "Section", "Sections"],
            "tab" => ["Table", "Tables", "Table", "Tables"],
            "claim" => ["claim", "claims", "Claim", "Claims"],
            "lst" => ["Listing", "Listings", "Listing", "Listings"],
            // The sign of a verdict needs no name.
            "row" | "mark" | "sign" => [""; 4],
            _ => return None,
        };
        Some(Name { short, plural, long, long_plural })
    }
}

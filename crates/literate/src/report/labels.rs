//! Numbers what can be referred to, and resolves references and citations.

use super::Error;
use super::bibliography::Library;
use super::document::{Block, Inline, rewrite, visit};
use std::collections::BTreeMap;

/// Everything that can be referred to: id → number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels(BTreeMap<String, String>);

impl Labels {
    fn add(&mut self, id: &str, number: &str) -> Result<(), Error> {
        let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, ':' | '-' | '_' | '.');
        if !id.chars().all(plain) {
            let what = format!("the id {id:?} has more than letters, digits and any of : - _ .");
            return Err(Error::Markup(what));
        }
        match self.0.insert(id.to_string(), number.to_string()) {
            None => Ok(()),
            Some(_) => Err(Error::Label(id.to_string())),
        }
    }

    /// The number of an id.
    pub fn number(&self, id: &str) -> Option<&str> {
        self.0.get(id).map(String::as_str)
    }

    /// Ids of one kind (`fig`, `eq`, `sec`, `tab`, `lst`, `claim`) that the report has.
    pub fn of_kind<'a>(&'a self, kind: &'a str) -> impl Iterator<Item = &'a str> {
        let own = move |id: &&str| id.split_once(':').is_some_and(|(before, _)| before == kind);
        self.0.keys().map(String::as_str).filter(own)
    }
}

/// Gives numbers to sections, captioned tables, listings and anchors, resolves all references, and fills
/// the list of references with what was cited.
///
/// # Errors
/// Two things with one id, a reference to nothing, a citation that references.bib lacks.
pub fn resolve(blocks: &mut [Block], library: &Library) -> Result<Labels, Error> {
    let labels = number(blocks)?;
    let mut cited = Vec::new();
    rewrite(blocks, &mut |inline| match inline {
        Inline::Unresolved(ids) => refer(&ids, &labels, library, &mut cited),
        other => Ok(vec![other]),
    })?;
    cited.sort();
    cited.dedup();
    for block in blocks.iter_mut() {
        if let Block::Bibliography(entries) = block {
            *entries = library.entries(&cited)?;
        }
    }
    Ok(labels)
}

fn number(blocks: &mut [Block]) -> Result<Labels, Error> {
    let mut labels = Labels::default();
    let (mut section, mut subsection, mut tables, mut listings) = (0, 0, 0, 0);
    for block in blocks.iter_mut() {
        match block {
            Block::Heading { level, number, id, .. } => {
                if let Some(number) = number {
                    if *level == 2 {
                        (section, subsection) = (section + 1, 0);
                        *number = section.to_string();
                    } else if *level == 3 {
                        subsection += 1;
                        *number = format!("{section}.{subsection}");
                    }
                }
                if let Some(id) = id {
                    labels.add(id, number.as_deref().unwrap_or_default())?;
                }
            }
            Block::Figure { id, number, .. } => labels.add(id, number)?,
            Block::Listing { id, number, .. } => {
                listings += 1;
                *number = listings.to_string();
                labels.add(id, number)?;
            }
            Block::Table { id, number: Some(number), .. } => {
                tables += 1;
                *number = tables.to_string();
                if let Some(id) = id {
                    labels.add(id, number)?;
                }
            }
            _ => {}
        }
    }
    let mut anchors: BTreeMap<String, usize> = BTreeMap::new();
    rewrite(blocks, &mut |inline| match inline {
        Inline::Anchor { id, .. } => {
            let kind = id.split(':').next().unwrap_or_default().to_string();
            let count = anchors.entry(kind).or_default();
            *count += 1;
            labels.add(&id, &count.to_string())?;
            Ok(vec![Inline::Anchor { id, number: count.to_string() }])
        }
        other => Ok(vec![other]),
    })?;
    let mut result = Ok(());
    visit(blocks, &mut |inline| {
        if let Inline::Display { tag: Some(tag), .. } = inline
            && result.is_ok()
        {
            result = labels.add(&format!("eq:{tag}"), tag);
        }
    });
    result.map(|()| labels)
}

/// What a kind of reference is called: short for one and several, and in full.
fn names(kind: &str) -> Option<[&'static str; 4]> {
    Some(match kind {
        "eq" => ["Eq.", "Eqs.", "Equation", "Equations"],
        "fig" => ["Fig.", "Figs.", "Figure", "Figures"],
        "sec" => ["Sec.", "Secs.", "Section", "Sections"],
        "tab" => ["Table", "Tables", "Table", "Tables"],
        "claim" => ["claim", "claims", "Claim", "Claims"],
        "lst" => ["Listing", "Listings", "Listing", "Listings"],
        "slip" => ["slip", "slips", "Slip", "Slips"],
        _ => return None,
    })
}

fn refer(
    ids: &[String],
    labels: &Labels,
    library: &Library,
    cited: &mut Vec<String>,
) -> Result<Vec<Inline>, Error> {
    let words = |text: &str| Inline::Text(text.to_string());
    let all = || ids.join("; ");
    // Citations have no colon; a list holds one kind only.
    if ids.iter().all(|id| !id.contains(':')) {
        let mut out = vec![words("[")];
        for (i, key) in ids.iter().enumerate() {
            if i > 0 {
                out.push(words("; "));
            }
            cited.push(key.clone());
            let shown = library.label(key)?;
            out.push(Inline::Reference { to: format!("ref:{key}"), shown });
        }
        out.push(words("]"));
        return Ok(out);
    }
    let kind = |id: &String| id.split(':').next().unwrap_or_default().to_string();
    let first = kind(&ids[0]);
    if ids.iter().any(|id| kind(id) != first) {
        return Err(Error::Reference(all()));
    }
    let full = first.starts_with(|c: char| c.is_ascii_uppercase());
    let lower = first.to_lowercase();
    let names = names(&lower).ok_or_else(|| Error::Reference(all()))?;
    let name = names[usize::from(ids.len() > 1) + if full { 2 } else { 0 }];
    let mut out = Vec::new();
    if ids.len() > 1 {
        out.push(words(&format!("{name}\u{a0}")));
    }
    for (i, id) in ids.iter().enumerate() {
        let id = format!("{lower}{}", &id[first.len()..]);
        // `[@fig:8a]` is part (a) of Fig. 8.
        let (target, part) = match labels.number(&id) {
            Some(_) => (id.as_str(), String::new()),
            None => match id.strip_suffix(|c: char| c.is_ascii_lowercase()) {
                Some(whole) if lower == "fig" => (whole, format!("({})", &id[whole.len()..])),
                _ => (id.as_str(), String::new()),
            },
        };
        let number = labels.number(target).filter(|number| !number.is_empty());
        let number = number.ok_or_else(|| Error::Reference(ids[i].clone()))?;
        let number = if lower == "eq" { format!("({number})") } else { format!("{number}{part}") };
        if i > 0 {
            out.push(words(if i + 1 == ids.len() { " and " } else { ", " }));
        }
        let shown = if ids.len() == 1 { format!("{name}\u{a0}{number}") } else { number };
        out.push(Inline::Reference { to: target.to_string(), shown });
    }
    Ok(out)
}

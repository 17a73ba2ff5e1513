//! Which values a claim states or is held against.
//!
//! A claim's text carries its numbers as they were computed, and so does a value: the same double
//! is the same number. Integers and numbers of few digits agree by chance, so they count only where the
//! prose names claim and value in one paragraph.

use super::document::{Block, Inline, visit};
use super::mark::ids;
use super::values::{Number, Registry};
use crate::claims::{Check, Text};
use std::collections::{BTreeMap, BTreeSet};

/// For each claim the ids of its values, sorted.
pub fn uses(
    claims: &[Check],
    values: &Registry,
    documents: &[&[Block]],
) -> BTreeMap<String, Vec<String>> {
    let together = together(documents);
    let one = |claim: &Check| {
        let numbers: Vec<f64> =
            [&claim.found, &claim.tolerance, &claim.note].into_iter().flat_map(numbers).collect();
        let near = together.get(&claim.id);
        let near = |id: &String| near.is_some_and(|near| near.contains(id));
        let states = |number: &Number, id: &String| match number {
            Number::Integer(n) => near(id) && numbers.contains(&(*n as f64)),
            Number::Real { value, .. } => (is_long(*value) || near(id)) && numbers.contains(value),
            Number::Interval { low, high } => numbers.contains(low) && numbers.contains(high),
            Number::Text(_) => false,
        };
        let printed = format!("printed.{}", claim.id);
        let used = values.iter().filter(|own| own.id == printed || states(&own.number, &own.id));
        (claim.id.clone(), used.map(|value| value.id.clone()).collect())
    };
    claims.iter().map(one).collect()
}

/// Whether a number has so many digits that no other agrees with it by chance.
fn is_long(value: f64) -> bool {
    format!("{value:e}").split('e').next().is_some_and(|mantissa| mantissa.len() > 8)
}

fn numbers(text: &Text) -> impl Iterator<Item = f64> + '_ {
    text.0.iter().filter_map(|piece| match piece {
        Number::Integer(value) => Some(*value as f64),
        Number::Real { value, .. } => Some(*value),
        Number::Interval { .. } | Number::Text(_) => None,
    })
}

/// For each claim the values that stand in one paragraph with a reference to it.
fn together(documents: &[&[Block]]) -> BTreeMap<String, BTreeSet<String>> {
    let mut out: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for block in documents.iter().copied().flatten().filter(|b| matches!(b, Block::Paragraph(_))) {
        let (mut claims, mut values) = (BTreeSet::new(), BTreeSet::new());
        visit(std::slice::from_ref(block), &mut |inline| match inline {
            Inline::Reference { to, .. } => {
                claims.extend(to.strip_prefix("claim:").map(String::from));
            }
            Inline::Value { id, .. } => {
                values.insert(id.clone());
            }
            Inline::Maths(tex) | Inline::Display { tex, .. } => {
                values.extend(ids(tex));
            }
            _ => {}
        });
        for claim in claims {
            out.entry(claim).or_default().extend(values.iter().cloned());
        }
    }
    out
}

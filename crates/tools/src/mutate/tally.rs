//! Which numbers are used, and how many of them are guarded.

use super::Mutations;
use impact_paper::claims::Check;
use impact_paper::report::mark::Mark;
use impact_paper::report::uses::uses;
use impact_paper::report::values::{Number, Registry, Value};
use impact_paper::report::{Error, Input, PROGRAM, Templates, assemble, equations, parse};
use impact_paper::table::table_of;
use std::collections::{BTreeMap, BTreeSet};

/// The numbers that prose or claims use.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Ids of those that a check notices in both directions.
    pub guarded: BTreeSet<String>,
    /// Ids of the others.
    pub unguarded: BTreeSet<String>,
}

impl Tally {
    /// Counts which of the numbers that are used are guarded.
    pub fn of(used: BTreeSet<String>, found: &Mutations) -> Tally {
        let noticed = |id: &String| found.get(id).is_some_and(super::Mutation::guarded);
        let (guarded, unguarded) = used.into_iter().partition(noticed);
        Tally { guarded, unguarded }
    }

    /// Whether this is a number that is used.
    pub fn knows(&self, id: &str) -> bool {
        self.guarded.contains(id) || self.unguarded.contains(id)
    }
}

/// Ids of the numbers that prose or claims use: what a template shows, and what a claim states or is
/// held against. Words are left out, and so are cells of tables: what a cell is stands once, in its column, and the
/// tests of its experiment hold the column to what it says.
///
/// # Errors
/// If the prose cannot be filled or read.
pub fn used(
    templates: &Templates,
    values: &Registry,
    rows: &BTreeMap<&'static str, serde_json::Value>,
    claims: &[Check],
) -> Result<BTreeSet<String>, Error> {
    let input = Input {
        templates,
        values,
        rows,
        claims,
        figures: &[],
        equations: &equations::entries(),
        scene: None,
        lab: None,
        program: PROGRAM,
    };
    let (values, _, filled) = assemble::fill(&input)?;
    let trees = filled.iter().map(|filled| Ok(parse::parse(filled, &values, PROGRAM)?.0));
    let trees: Vec<_> = trees.collect::<Result<_, Error>>()?;
    let trees: Vec<&[_]> = trees.iter().map(Vec::as_slice).collect();
    let marks = filled.iter().flat_map(|filled| Mark::split(&filled.text)).flatten();
    let shown = marks.map(|mark| mark.id);
    let stated = uses(claims, &values, &trees).into_values().flatten();
    let number = |id: &String| {
        if table_of(id).is_some() {
            return false;
        }
        let words = |value: &Value| matches!(value.number, Number::Text(_));
        values.get(id).is_some_and(|value| !words(value))
    };
    Ok(shown.chain(stated).filter(number).collect())
}

#[cfg(test)]
mod tests {
    use super::super::Mutation;
    use super::*;

    #[test]
    fn a_number_is_guarded_if_both_sides_are_noticed() {
        let seen = || vec!["claim".to_string()];
        let moved = |above, below| Mutation { by: 1.0, place: "report".into(), above, below };
        let found =
            [("both", seen(), seen()), ("above", seen(), vec![]), ("below", vec![], seen())];
        let found = found.map(|(id, above, below)| (id.to_string(), moved(above, below)));
        let used = ["both", "above", "below", "never moved"].map(String::from);
        let tally = Tally::of(used.into(), &found.into());
        assert_eq!(Vec::from_iter(&tally.guarded), ["both"]);
        assert_eq!(Vec::from_iter(&tally.unguarded), ["above", "below", "never moved"]);
        assert!(tally.knows("above") && !tally.knows("another"));
    }
}

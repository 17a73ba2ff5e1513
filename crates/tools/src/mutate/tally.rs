//! Which numbers are used, and how many of them are guarded.

use super::{Mutations, Reasons};
use impact_paper::claims::Check;
use impact_paper::report::guards::fits;
use impact_paper::report::mark::Mark;
use impact_paper::report::uses::uses;
use impact_paper::report::values::{Number, Registry, Value};
use impact_paper::report::{Error, Input, PROGRAM, Templates, assemble, equations, parse};
use impact_paper::table::table_of;
use std::collections::{BTreeMap, BTreeSet};

/// What is known of the numbers that prose or claims use.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Ids of those that a check notices in both directions.
    pub guarded: BTreeSet<String>,
    /// Of the others, ids by the kind that their reason gives them.
    pub excused: BTreeMap<String, BTreeSet<String>>,
    /// Of the others, ids without a reason.
    pub bare: BTreeSet<String>,
    /// Patterns of reasons that nothing needs: unknown ids, and guarded ones.
    pub needless: Vec<String>,
}

impl Tally {
    /// Counts what became of the numbers that are used.
    pub fn of(
        used: &BTreeSet<String>,
        found: &Mutations,
        reasons: &Reasons,
        values: &Registry,
    ) -> Tally {
        let mut tally = Tally::default();
        for id in used {
            if found.get(id).is_some_and(super::Mutation::guarded) {
                tally.guarded.insert(id.clone());
            } else if let Some(group) = reasons.of(id) {
                tally.excused.entry(group.kind.clone()).or_default().insert(id.clone());
            } else {
                tally.bare.insert(id.clone());
            }
        }
        let known = |pattern: &str| values.iter().any(|value| fits(pattern, &value.id));
        for pattern in reasons.groups().iter().flat_map(|group| &group.ids) {
            let mut own = used.iter().filter(|id| fits(pattern, id)).peekable();
            if !known(pattern) {
                tally.needless.push(format!("{pattern:?} (there is no such value)"));
            } else if own.peek().is_some() && own.all(|id| tally.guarded.contains(id)) {
                tally.needless.push(format!("{pattern:?} (guarded)"));
            }
        }
        tally
    }

    /// Whether this is a number that is used.
    pub fn knows(&self, id: &str) -> bool {
        let excused = || self.excused.values().any(|ids| ids.contains(id));
        self.guarded.contains(id) || self.bare.contains(id) || excused()
    }

    /// How many numbers are used.
    pub fn used(&self) -> usize {
        self.guarded.len() + self.unguarded()
    }

    /// How many of them are not guarded.
    pub fn unguarded(&self) -> usize {
        self.bare.len() + self.excused.values().map(BTreeSet::len).sum::<usize>()
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
        pdf: false,
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

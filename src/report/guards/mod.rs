//! Relations between numbers that must hold whatever was drawn, beside the claims.
//!
//! A claim holds a number against what the paper printed, and many numbers of this edition were never
//! printed. A guard holds them against one another, as two samples of one thing or a mean and its bound.
//! None compares a number with a copy of itself, or with bytes of an earlier run. `impact-paper check` names
//! each that fails.

mod maps;
mod nucleation;
mod printed;
mod restitution;
mod sweep;

use crate::claims::{self, Basis, Check, Kind, Published, Text, Verdict};
use crate::experiments::Results;
use impact_numerics::statistics::Estimate;

/// What a guard may look at.
#[derive(Clone, Copy, Debug)]
pub struct Look<'a> {
    /// Results of the experiments.
    pub results: &'a Results,
    /// What the paper printed.
    pub published: &'a Published,
}

/// A relation that must hold.
#[derive(Clone, Copy, Debug)]
pub struct Guard {
    /// Its name, as `check` tells it.
    pub name: &'static str,
    /// Ids of the values that it relates; a `*` at the end stands for any ending.
    pub ids: &'static [&'static str],
    /// What is wrong, if something is. The doc comment of the function says why it must hold.
    pub find: fn(Look<'_>) -> Option<String>,
}

/// All guards.
pub fn all() -> impl Iterator<Item = &'static Guard> {
    let files =
        [sweep::GUARDS, maps::GUARDS, nucleation::GUARDS, restitution::GUARDS, printed::GUARDS];
    files.into_iter().flatten()
}

/// All relations, as checks.
pub fn checks(look: Look<'_>) -> Vec<Check> {
    let one = |guard: &Guard| {
        let wrong = (guard.find)(look);
        let verdict = if wrong.is_some() { Verdict::Differs } else { Verdict::Reproduced };
        Check {
            kind: Kind::Relation,
            id: guard.name.into(),
            place: String::new(),
            statement: guard.name.replace('_', " "),
            printed: String::new(),
            ours: Text::words(wrong.unwrap_or_default()),
            tolerance: Text::default(),
            reason: String::new(),
            basis: Basis::Exact,
            verdict,
            note: Text::words(guard.ids.join(", ")),
        }
    };
    all().map(one).collect()
}

/// How far two estimates that chance alone separates may lie apart.
fn room(own: &Estimate, other: &Estimate) -> f64 {
    claims::level().quantile * (own.error * own.error + other.error * other.error).sqrt()
}

/// Complains unless it is so.
fn unless(so: bool, what: impl FnOnce() -> String) -> Option<String> {
    (!so).then(what)
}

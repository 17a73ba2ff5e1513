//! What restitution does to a chain: what chance must not break.

use super::{Guard, Look};
use literate::table::Table;

pub const GUARDS: &[Guard] = &[Guard {
    name: "no_half_before_an_impact",
    ids: &["restitution.curves*", "theory.relation.sigma_kept_half"],
    find: halves,
}];

fn table<'a>(look: Look<'a>, name: &'static str) -> Option<&'a Table> {
    look.results.table(name).ok()
}

/// No mean is at half of all gaps before half of the chains can have an impact at all.
fn halves(look: Look<'_>) -> Option<String> {
    let halves = table(look, "restitution.curves")?.estimates(&[], "r", "half_height");
    let bound = look.results.number("theory.relation.sigma_kept_half").ok()?;
    let early = halves.iter().find(|(_, own)| own.value <= bound - 5.0 * own.error);
    early.map(|(r, own)| format!("half height {} at r = {r}, below the bound {bound}", own.value))
}

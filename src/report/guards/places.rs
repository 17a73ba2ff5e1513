//! Curves through rows; differences of starts.

use super::{Guard, Look, far};

pub const GUARDS: &[Guard] = &[Guard {
    name: "differences_of_starts",
    ids: &["starts.*", "share_of_start", "theory.relation.sigma_half"],
    find: differences,
}];

/// Between the points of a curve on both sides of σ, in a straight line.
pub(super) fn between(points: &[(f64, f64)], sigma: f64) -> Option<f64> {
    let above = points.iter().position(|point| point.0 >= sigma)?;
    let (b, a) = (points[above], points[above.checked_sub(1)?]);
    Some(((b.0 - sigma) * a.1 + (sigma - a.0) * b.1) / (b.0 - a.0))
}

/// A difference of two starts added to the first gives the second; and the share that the start
/// explains leads from one half height to the other on the way to the theory's.
fn differences(look: Look<'_>) -> Option<String> {
    let rest = look.number("starts.rest")?;
    let ends = look.values.iter().find_map(|value| {
        let own = value.id.strip_suffix("_difference")?.strip_prefix("starts.")?.to_string();
        let [a, b] = [value.id.as_str(), &format!("starts.{own}")].map(|id| look.number(id));
        far(&value.id, rest + a?, b?)
    });
    ends.or_else(|| {
        let share = look.number("share_of_start")?;
        let theory = look.number("theory.relation.sigma_half")?;
        far("share_of_start", rest + share * (theory - rest), look.number("starts.random")?)
    })
}

//! Sections 3 and 4: the graph, and what its circuits stand for.

use super::judge::*;
use super::sec2::small;
use super::with_error;
use impact_chain::rise;

pub const ROWS: &[Judge] = &[
    cases("sec3_impact_types", "Every number of masses up to the number of cases.")
        .of("n + 1 = (n − 1) + 2"),
    by("sec3_vertices", Exact, |e, s| size(e.number("theory.graph.vertices")?, s)),
    by("sec3_edges", Exact, |e, s| size(e.number("theory.graph.edges")?, s)),
    statistical("sec4_few_and_many", OurMeasure, few_and_many),
];

fn size(found: f64, s: &Statement) -> Judged {
    let check = s.found(integer(found as usize), found == s.number()?);
    Ok(check.within("none", "an integer is exact"))
}

/// Different impacts of a chain in the window, as Sec. 6 counts them.
fn few_and_many(e: &Evidence, s: &Statement) -> Judged {
    let mean = |row: &rise::RisePoint| Some((row.sigma, row.mean?.value, row.mean?.error?));
    let (low, few, error) = some(mean(small(e)?))?;
    let (high, many, many_error) = some(e.sweep()?.first().rows.last().and_then(mean))?;
    let quarter = e.gaps()? / 4.0;
    let found = Text::of(
        "{} different impacts at σ = {}, {} at {}",
        [with_error(few, error), chosen(low), with_error(many, many_error), chosen(high)],
    );
    let reason = "ours: “few” and “many” as the quarters by which the rise is judged in Section 2; and \
                  the statistical error";
    Ok(s.found(found, few <= quarter + e.level.quantile * error && many >= 3.0 * quarter)
        .within("below a quarter, and above three quarters, of all gaps", reason)
        .note(
            "Means of the kept. That the orbits are periodic is an assumption. In Section 2 the paper says “very few”, \
             for which the measure is stricter.",
        ))
}

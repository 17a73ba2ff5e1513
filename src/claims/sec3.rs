//! Sections 3 and 4: the graph, and what its circuits stand for.

use super::Basis::{Exact, OurMeasure};
use super::row::{Error, Evidence, Row, cases, statistical, theory};
use super::sec2::{gaps, small};
use super::{Finding, open};
use super::{Judgement, Statement, Text};
use crate::experiments::SWEEP;
use crate::experiments::sweep;

pub const ROWS: &[Row] = &[
    theory("sec3_impact_types", Exact, |e, s| {
        cases(e, s, "Every number of masses up to the number of cases.")
    })
    .of("n + 1 = (n − 1) + 2"),
    theory("sec3_vertices", Exact, |e, s| size(e.number("theory.graph.vertices")?, s)),
    theory("sec3_edges", Exact, |e, s| size(e.number("theory.graph.edges")?, s)),
    statistical("sec4_few_and_many", OurMeasure, &[&SWEEP], few_and_many),
];

fn size(found: f64, s: &Statement) -> Result<Finding, Error> {
    Ok(Finding {
        ours: Text::default().integer(found as usize),
        tolerance: Text::words("none"),
        reason: "an integer is exact",
        judgement: Judgement::Plain { agrees: found == s.number()? },
        note: Text::default(),
    })
}

/// Different impacts of a chain in the window, as Sec. 6 counts them.
fn few_and_many(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = sweep::main(e.results)?;
    let mean =
        |row: &crate::experiments::rise::Row| Some((row.sigma, row.mean?.value, row.mean?.error?));
    let (Some((low, few, error)), Some((high, many, many_error))) =
        (small(e)?.and_then(mean), sweep.first().rows.last().and_then(mean))
    else {
        return Ok(open(Text::words("too few kept realisations"), "A row has no error."));
    };
    let quarter = gaps(sweep) / 4.0;
    Ok(Finding {
        ours: Text::with_error(Text::default(), few, error)
            .say(" different impacts at σ = ")
            .chosen(low)
            .say(", ")
            .with_error(many, many_error)
            .say(" at ")
            .chosen(high),
        tolerance: Text::words("below a quarter, and above three quarters, of all gaps"),
        reason: "ours: “few” and “many” as the quarters by which the rise is judged in Section 2; and \
                 the statistical error",
        judgement: Judgement::Plain {
            agrees: few <= quarter + e.level.quantile * error && many >= 3.0 * quarter,
        },
        note: Text::words(
            "Means of the kept. That the orbits are periodic is an assumption. In Section 2 the paper says “very few”, \
             for which the measure is stricter.",
        ),
    })
}

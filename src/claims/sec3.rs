//! Section 3: the graph.

use super::row::{Error, Evidence, Finding, Row, all_cases, exact};
use super::{Judgement, Statement, Text};

/// The rows of this section.
pub const ROWS: &[Row] = &[
    exact("sec3_impact_types", impact_types),
    exact("sec3_vertices", |e, s| size(e.results.identities.graph_vertices, s)),
    exact("sec3_edges", |e, s| size(e.results.identities.graph_edges, s)),
];

fn impact_types(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let cases = e.results.identities.impact_types;
    Ok(all_cases(cases.compared, cases.failed, "Every number of masses up to the number of cases."))
}

fn size(found: usize, s: &Statement) -> Result<Finding, Error> {
    Ok(Finding {
        ours: Text::default().integer(found),
        tolerance: Text::words("none"),
        reason: "an integer is exact",
        judgement: Judgement::Plain { agrees: found as f64 == s.number()? },
        note: Text::default(),
    })
}

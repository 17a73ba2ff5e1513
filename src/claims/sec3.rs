//! Judges Sections 3 and 4, the graph and the meaning of its circuits.

use super::sec2::small_force;
use super::shared::*;

pub fn rules() -> Vec<Rule> {
    vec![
        cases("sec3_impact_types").reads("n + 1 = (n − 1) + 2"),
        Rule::new("sec3_vertices", |e| size(e, e.number("theory.graph.vertices")?))
            .uses(&[("graph_masses", GRAPH_MASSES as f64)]),
        Rule::new("sec3_edges", |e| size(e, e.number("theory.graph.edges")?)),
        Rule::new("sec3_different_orbits", different_orbits),
        Rule::new("sec3_every_orbit", every_orbit).on(FiniteCases),
        Rule::new("sec3_realised", realised).on(OurMeasure),
        Rule::new("sec4_few_and_many", few_and_many).on(OurMeasure),
    ]
}

fn size(e: &Evidence<'_>, size: f64) -> Judged {
    e.check(size == e.statement.number()?, numbers![size])
}

/// The circuits are enumerated as cyclic orders of impacts, each kept once.
fn different_orbits(e: &Evidence<'_>) -> Judged {
    let [gaps, orders, circuits] = e.numbers("theory.commuting", ["gaps", "circuits", "by_eq7"])?;
    e.check(orders == circuits, numbers![orders, circuits, gaps])
}

/// An orbit without an impact has no vertex, and one of two impacts at one instant has no order.
fn every_orbit(e: &Evidence<'_>) -> Judged {
    let cells = ["impacts", "instants", "apart"];
    let [silent, _, drift] = e.numbers("segments.no_circuit[orbit=no impact]", cells)?;
    let row = "segments.no_circuit[orbit=impacts at once]";
    let [impacts, instants, apart] = e.numbers(row, cells)?;
    let apart = drift.max(apart);
    let is_exception = silent == 0.0 && instants < impacts && apart < 1e-9;
    let holds = silent > 0.0 && instants == impacts;
    Ok(e.check(holds, numbers![silent, impacts, instants, apart])?.explained_if(is_exception))
}

fn realised(e: &Evidence<'_>) -> Judged {
    let both = e.results.of(&SEGMENTS)?;
    let [fig05, fig06] = [&both.fig05, &both.fig06].map(|segment| segment.names().len());
    let [circuits, gaps, classes] =
        e.numbers("theory.commuting", ["circuits", "gaps", "classes"])?;
    e.check(None, numbers![fig05, fig06, circuits, gaps, classes])
}

/// Different impacts of a chain in the window, as Sec. 6 counts them.
fn few_and_many(e: &Evidence<'_>) -> Judged {
    let low = small_force(e)?.sigma;
    let high =
        e.results.table("sweep.rows")?.distinct("sigma")?.last().copied().ok_or(Undecided)?;
    let mean = |sigma: f64| e.estimate(&format!("sweep.rows[sigma={sigma}].mean"));
    e.check(None, numbers![few = mean(low)?, low, many = mean(high)?, high])
}

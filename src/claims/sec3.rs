//! Sections 3 and 4: the graph, and the meaning of its circuits.

use super::judge::*;
use super::sec2::small;
use super::with_error;
use impact_chain::rise;

pub const ROWS: &[Judge] = &[
    cases("sec3_impact_types", "Every number of masses up to the number of cases.")
        .of("n + 1 = (n − 1) + 2"),
    by("sec3_vertices", Exact, |e, s| size(e.number("theory.graph.vertices")?, s)),
    by("sec3_edges", Exact, |e, s| size(e.number("theory.graph.edges")?, s)),
    by("sec3_different_orbits", OurMeasure, different_orbits),
    by("sec4_few_and_many", OurMeasure, few_and_many),
];

fn size(found: f64, s: &Statement) -> Judged {
    let check = s.found(integer(found as usize), found == s.number()?);
    Ok(check.within("none", "an integer is exact"))
}

/// Impacts without a common mass may change places in the order of impacts.
fn different_orbits(e: &Evidence, s: &Statement) -> Judged {
    let columns = ["gaps", "circuits", "classes"];
    let [gaps, circuits, classes] = e.numbers("theory.commuting", columns)?;
    let count = |number: f64| integer(number as usize);
    let found = Text::of(
        "{} simple circuits of {} gaps, {} orders of impacts that a mass can tell apart",
        [count(circuits), count(gaps), count(classes)],
    );
    let sets = ((1_u64 << gaps as u32) - 1) as f64;
    Ok(s.found(found, circuits == classes).within(
        "as many as circuits",
        "ours: orbits are different if some mass can tell them apart; in phase space orders of impacts always differ",
    ).explained(
        Text::of(
            "Two impacts without a common mass may change places, and every mass still has its impacts in the same \
             order. In this sense all simple circuits through the same gaps are one, and of sets of gaps there are {}.",
            [count(sets)],
        ),
        classes == sets,
    ))
}

/// Different impacts of a chain in the window, as Sec. 6 counts them.
fn few_and_many(e: &Evidence, s: &Statement) -> Judged {
    let mean = |row: &rise::RisePoint| Some((row.sigma, row.mean?.value, row.mean?.error?));
    let (low, few, error) = some(mean(small(e)?))?;
    let (high, many, many_error) = some(e.sweep()?.first().rows.last().and_then(mean))?;
    let found = Text::of(
        "{} different impacts at σ = {}, {} at {}",
        [with_error(few, error), chosen(low), with_error(many, many_error), chosen(high)],
    );
    Ok(s.open(found).note(
        "What is found are means of realisations with at least one impact. That they consist of periodic orbits is an \
         assumption that no simulation can test, since the chain is chaotic; impacts in an orbit cannot be counted.",
    ))
}

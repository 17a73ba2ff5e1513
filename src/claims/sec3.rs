//! Judges Sections 3 and 4, the graph and the meaning of its circuits.

use super::sec2::small_force;
use super::shared::*;

pub fn rules() -> Vec<Rule> {
    vec![
        cases("sec3_impact_types", "Every number of masses up to the number of cases.")
            .reads("n + 1 = (n − 1) + 2"),
        Rule::new("sec3_vertices", |e| size(e, e.number("theory.graph.vertices")?)),
        Rule::new("sec3_edges", |e| size(e, e.number("theory.graph.edges")?)),
        Rule::new("sec3_different_orbits", different_orbits).on(OurMeasure),
        Rule::new("sec4_few_and_many", few_and_many).on(OurMeasure),
    ]
}

fn size(e: &Evidence<'_>, found: f64) -> Judged {
    let check = e.found(integer(found as usize), found == e.statement.number()?);
    Ok(check.within("none", "an integer is exact"))
}

/// Impacts without a common mass may change places in the order of impacts.
fn different_orbits(e: &Evidence<'_>) -> Judged {
    let columns = ["gaps", "circuits", "classes"];
    let [gaps, circuits, classes] = e.numbers("theory.commuting", columns)?;
    let count = |number: f64| integer(number as usize);
    let found = Text::of(
        "{} simple circuits of {} gaps, {} orders of impacts that a mass can tell apart",
        [count(circuits), count(gaps), count(classes)],
    );
    let sets = ((1_u64 << gaps as u32) - 1) as f64;
    Ok(e.found(found, circuits == classes).within(
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
fn few_and_many(e: &Evidence<'_>) -> Judged {
    let low = small_force(e)?.sigma;
    let high = e.results.table("sweep.rows")?.values("sigma").last().copied().ok_or(Undecided)?;
    let mean = |sigma: f64| e.estimate(&format!("sweep.rows[sigma={sigma}].mean"));
    let (few, many) = (mean(low)?, mean(high)?);
    let found = Text::of(
        "{} different impacts at σ = {}, {} at {}",
        [estimate(&few), chosen(low), estimate(&many), chosen(high)],
    );
    Ok(e.open(found).note(
        "What is found are means of realisations with at least one impact. That they consist of periodic orbits is an \
         assumption that no simulation can test, since the chain is chaotic; impacts in an orbit cannot be counted.",
    ))
}

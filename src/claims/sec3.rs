//! Judges Sections 3 and 4, the graph and the meaning of its circuits.

use super::sec2::small_force;
use super::shared::*;
use crate::experiments::SEGMENTS;

pub fn rules() -> Vec<Rule> {
    vec![
        cases("sec3_impact_types", "Every number of masses up to the number of cases.")
            .reads("n + 1 = (n − 1) + 2"),
        Rule::new("sec3_vertices", |e| size(e, e.number("theory.graph.vertices")?)),
        Rule::new("sec3_edges", |e| size(e, e.number("theory.graph.edges")?)),
        Rule::new("sec3_different_orbits", different_orbits),
        Rule::new("sec3_every_orbit", every_orbit).on(FiniteCases),
        Rule::new("sec3_realised", realised).on(OurMeasure),
        Rule::new("sec4_few_and_many", few_and_many).on(OurMeasure),
    ]
}

fn size(e: &Evidence<'_>, found: f64) -> Judged {
    let check = e.found(text!("{}", found), found == e.statement.number()?);
    Ok(check.within("none", "an integer is exact"))
}

/// The circuits are enumerated as cyclic orders of impacts, each kept once.
fn different_orbits(e: &Evidence<'_>) -> Judged {
    let [gaps, orders, circuits] = e.numbers("theory.commuting", ["gaps", "circuits", "by_eq7"])?;
    let text = "{} different orders of impacts for the {} simple circuits of {} gaps";
    let found = text!(text, orders, circuits, gaps);
    Ok(e.found(found, orders == circuits).within("none", "integers are exact"))
}

/// An orbit without an impact has no vertex, and one of two impacts at one instant has no order.
fn every_orbit(e: &Evidence<'_>) -> Judged {
    let cells = ["impacts", "instants", "apart"];
    let [silent, _, drift] = e.numbers("segments.no_circuit[orbit=no impact]", cells)?;
    let row = "segments.no_circuit[orbit=impacts at once]";
    let [impacts, instants, apart] = e.numbers(row, cells)?;
    let found =
        text!("orbits with {} impacts, and with {} at {} instants", silent, impacts, instants);
    let why = "Two masses that only follow weak forces never hit, and have no vertex; two masses that are driven against \
         each other hit both walls at one instant, so that no edge leads from one impact to the other. Two periods of \
         these orbits differ by at most {:1}. Orbits whose impacts have an order are circuits by definition.";
    let is_exception = silent == 0.0 && instants < impacts && drift.max(apart) < 1e-9;
    Ok(e.found(found, silent > 0.0 && instants == impacts)
        .within("none", "a single exception is enough")
        .explained(text!(why, drift.max(apart)), is_exception))
}

fn realised(e: &Evidence<'_>) -> Judged {
    let both = e.results.of(&SEGMENTS)?;
    let found = [&both.fig05, &both.fig06].map(|segment| segment.names().len());
    let text = "periodic orbits with the {} and the {} impacts of two circuits";
    let [circuits, gaps, classes] =
        e.numbers("theory.commuting", ["circuits", "gaps", "classes"])?;
    let note = "We searched for the orbits of Figs. 5 and 6 only, and chose the forces for them. For all circuits, \
         or for given forces, nothing is shown. Orbits with other orders of impacts differ. But two impacts without a \
         common mass may change places, and every mass still has its impacts in the same order: of the {} simple \
         circuits of {} gaps the masses can tell {} apart.";
    Ok(e.open(text!(text, found[0], found[1])).note(text!(note, circuits, gaps, classes)))
}

/// Different impacts of a chain in the window, as Sec. 6 counts them.
fn few_and_many(e: &Evidence<'_>) -> Judged {
    let low = small_force(e)?.sigma;
    let high =
        e.results.table("sweep.rows")?.distinct("sigma")?.last().copied().ok_or(Undecided)?;
    let mean = |sigma: f64| e.estimate(&format!("sweep.rows[sigma={sigma}].mean"));
    let (few, many) = (mean(low)?, mean(high)?);
    let found = text!("{} different impacts at σ = {}, {} at {}", few, low, many, high);
    let note = "What we find are means of realisations with at least one impact. That they consist of periodic \
         orbits is an assumption that no simulation can test, since the chain is chaotic; impacts in an orbit cannot \
         be counted.";
    Ok(e.open(found).note(note))
}

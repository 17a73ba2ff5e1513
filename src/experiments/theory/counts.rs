//! Counts circuits: Secs. 3 and 5, Fig. 7.

use super::basics::*;
use impact_circuits::graph::Graph;
use impact_circuits::{commuting, counting};
use std::f64::consts::LN_10;

/// Lengths that are less than N by at most this are about N (ours: a twentieth of N).
const ABOUT: usize = VERTICES / 20;

/// Gaps of the chain whose simple circuits are enumerated.
const ENUMERATED: usize = 7;

pub(super) fn graph() -> Table {
    let vertices = Graph::of_chain(GRAPH_MASSES).vertices() as u64;
    one_row("theory.graph", origin(Graph::of_chain))
        .count("vertices", "of the graph for three masses", |()| vertices)
        .count("edges", "of the same", |()| vertices * vertices)
        .done()
}

/// Returns the share of simple circuits of length k = 1..=N, and its decimal logarithm: Fig. 7.
pub fn shares() -> [Vec<f64>; 2] {
    let (shares, log_total) = expect_known(counting::shares(VERTICES));
    let logarithm = |k| (expect_known(counting::log_phi(VERTICES, k)) - log_total) / LN_10;
    [shares, (1..=VERTICES).map(logarithm).collect()]
}

pub(super) fn lengths() -> Table {
    const EXCEPTIONS: &str = "lengths k < N with over a tenth as many circuits as N";
    let (shares, _) = expect_known(counting::shares(VERTICES));
    let ratio = |k| counting::ratio_to_longest(VERTICES, k);
    let far = largest((1..VERTICES - ABOUT).map(ratio));
    let exceptions = (1..VERTICES).filter(|&k| ratio(k) > 0.1).count();
    let peak = (1..=VERTICES).max_by(|a, b| shares[a - 1].total_cmp(&shares[b - 1]));
    let long = sum(shares[VERTICES - ABOUT - 1..].iter().copied());
    one_row("theory.lengths", origin(counting::ratio_to_longest))
        .real("before_last", "1", 4, "Eq. (8) at k = N − 1", |()| ratio(VERTICES - 1))
        .real("largest_far", "1", 2, "the largest for k that are not about N", |()| far)
        .count("exceptions", EXCEPTIONS, |()| exceptions as u64)
        .count("peak", "the most frequent length", |()| peak.unwrap_or(VERTICES) as u64)
        .count("from", "a twentieth below N", |()| (VERTICES - ABOUT) as u64)
        .computed_by(origin(lengths), &["from"])
        .real("share", "1", 2, "of simple circuits that are as long or longer", |()| long)
        .computed_by(origin(counting::shares), &["peak", "share"])
        .done()
}

/// Makes the table of circuits that differ only by the order of impacts without a common mass.
pub(super) fn commuting_circuits() -> Table {
    let [circuits, classes] = commuting::simple_classes(ENUMERATED).map(|count| count as u64);
    let by_eq7: u128 = (1..=ENUMERATED).filter_map(|k| counting::phi(ENUMERATED, k)).sum();
    let mean = commuting::mean_without_orders(VERTICES, expect_known(p_jump(Simple, VERTICES)).p);
    one_row("theory.commuting", origin(commuting::simple_classes))
        .count("gaps", "gaps of a chain", |()| ENUMERATED as u64)
        .count("circuits", "simple circuits, each cyclic order of impacts once", |()| circuits)
        .count("by_eq7", "the same by Eq. (7)", |()| by_eq7 as u64)
        .computed_by(origin(counting::phi), &["by_eq7"])
        .count("classes", "of them that a mass tells apart", |()| classes)
        .real("mean", "1", 2, "mean number at the jump, each class with p^k once", |()| mean)
        .computed_by(origin(commuting::mean_without_orders), &["mean"])
        .done()
}

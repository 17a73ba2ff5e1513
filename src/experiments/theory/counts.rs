//! Counts circuits: Secs. 3 and 5, Fig. 7.

use super::basics::{known, one, sum};
use crate::experiments::prelude::*;
use crate::params::VERTICES;
use impact_circuits::distribution::SampleSpace;
use impact_circuits::graph::Graph;
use impact_circuits::{commuting, counting, jump};
use std::f64::consts::LN_10;

/// Gaps of the chain whose simple circuits are enumerated.
const ENUMERATED: usize = 7;

pub(super) fn tables() -> Vec<Table> {
    vec![graph(), lengths(), commuting_circuits()]
}

/// Makes the table of Sec. 3.
fn graph() -> Table {
    let graph = Graph::of_chain(3);
    one("theory.graph", origin(Graph::of_chain))
        .count("vertices", "of the graph for three masses", |()| graph.vertices() as u64)
        .count("edges", "of the same", |()| graph.edges().count() as u64)
        .done()
}

/// Returns the share of all simple circuits that have length k = 1..=N, and its decimal logarithm:
/// Fig. 7.
pub fn shares() -> [Vec<f64>; 2] {
    let (shares, log_total) = known(counting::shares(VERTICES));
    let logarithm = |k| (known(counting::log_phi(VERTICES, k)) - log_total) / LN_10;
    [shares, (1..=VERTICES).map(logarithm).collect()]
}

/// Makes the table of Sec. 5.
fn lengths() -> Table {
    let (shares, _) = known(counting::shares(VERTICES));
    let ratio = |k| counting::ratio_to_longest(VERTICES, k);
    let exceptions = || (1..VERTICES).filter(|&k| ratio(k) > 0.1);
    let peak = (1..=VERTICES).max_by(|a, b| shares[a - 1].total_cmp(&shares[b - 1]));
    one("theory.lengths", origin(counting::ratio_to_longest))
        .real("before_last", "1", 4, "Eq. (8) at k = N − 1", |()| ratio(VERTICES - 1))
        .real("largest_far", "1", 2, "the largest for k < N − 3", |()| {
            (1..VERTICES - 3).map(ratio).fold(0.0, f64::max)
        })
        .count("exceptions", "lengths k < N with over a tenth as many circuits as N", |()| {
            exceptions().count() as u64
        })
        .computed_by(origin(counting::shares))
        .count("peak", "the most frequent length", |()| peak.unwrap_or(VERTICES) as u64)
        .count("from", "N − 3", |()| VERTICES as u64 - 3)
        .real("share", "1", 2, "of simple circuits that are as long or longer", |()| {
            sum(shares[VERTICES - 4..].iter().copied())
        })
        .done()
}

/// Makes the table of simple circuits that differ only by the order of impacts without a common
/// mass.
fn commuting_circuits() -> Table {
    let [circuits, classes] = commuting::simple_classes(ENUMERATED);
    one("theory.commuting", origin(commuting::simple_classes))
        .count("gaps", "gaps of a chain", |()| ENUMERATED as u64)
        .count("circuits", "simple circuits, each cyclic order of impacts once", |()| {
            circuits as u64
        })
        .computed_by(origin(counting::phi))
        .count("by_eq7", "the same by Eq. (7)", |()| {
            (1..=ENUMERATED).filter_map(|k| counting::phi(ENUMERATED, k)).sum::<u128>() as u64
        })
        .computed_by(origin(commuting::simple_classes))
        .count("classes", "of them that a mass tells apart", |()| classes as u64)
        .computed_by(origin(commuting::mean_without_orders))
        .real("mean", "1", 2, "mean number at the jump, each class with p^k once", |()| {
            let leap = known(jump::p_jump(SampleSpace::Simple, VERTICES));
            commuting::mean_without_orders(VERTICES, leap.p)
        })
        .done()
}

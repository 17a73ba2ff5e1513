//! Maps the influence of the counting protocol: half height against transient T and window W.

use super::ensembles::{Ensembles, ensembles};
use crate::experiments::prelude::*;
use crate::params::{self, printed_interval};
use impact_chain::rise::Rise;

pub const PROTOCOL: Ensembles = ensembles("protocol", "protocol map", params::protocol, tables);

pub fn tables(ensembles: &Vec<Counted>) -> Vec<Table> {
    let Some(map) = find_ensemble(ensembles, PROTOCOL.name) else { return Vec::new() };
    let halves = map.curves.iter().filter_map(|cell| cell.rise.half_height);
    let mut halves: Vec<Estimate> = halves.collect();
    halves.sort_by(|a, b| a.value.total_cmp(&b.value));
    let printed = round_to_printed(map, printed_interval(), |rise| rise.half_height);
    let summary = Table::builder("protocol.all", &[map], |map| map.ensemble.realisations)
        .count("realisations", "chains at each σ", |map| map.ensemble.realisations as u64)
        .count("sigmas", "values of σ", |map| map.ensemble.sigmas.len() as u64)
        .count("combinations", "transients times windows", |map| map.curves.len() as u64)
        .count("as_printed", "half heights that round to the printed one", |_| printed as u64)
        .estimate("largest", SIGMA, "largest half height", |_| halves.last().copied())
        .estimate("least", SIGMA, "least half height", |_| halves.first().copied())
        .computed_by(origin(Curve::new), &["largest", "least"])
        .done();
    vec![cells(map), summary]
}

/// Counts the windows in which a place of the rise lies between the ends of the printed number.
pub fn round_to_printed(
    map: &Counted,
    [from, to]: [f64; 2],
    place: fn(&Rise) -> Option<Estimate>,
) -> usize {
    let places = map.curves.iter().filter_map(|curve| place(&curve.rise));
    places.filter(|place| (from..to).contains(&place.value)).count()
}

/// Returns how far the largest of some places lies from the least, or `None` without places.
pub fn range(places: impl Iterator<Item = Option<Estimate>>) -> Option<Estimate> {
    let places: Vec<Estimate> = places.flatten().collect();
    let least = places.iter().min_by(|a, b| a.value.total_cmp(&b.value))?;
    let most = places.iter().max_by(|a, b| a.value.total_cmp(&b.value))?;
    let error = (least.error * least.error + most.error * most.error).sqrt();
    Some(with_error(most.value - least.value, error))
}

fn cells(map: &Counted) -> Table {
    Table::builder("protocol.cells", &map.curves, |_| map.ensemble.realisations)
        .table_computed_by(origin(Curve::new))
        .key("transient", TIME, |cell| cell.protocol.transient)
        .key("window", TIME, |cell| cell.protocol.window)
        .estimate("half_height", SIGMA, OF_ACTIVE, |cell| cell.rise.half_height)
        .estimate("half_height_all", SIGMA, HALF_HEIGHT, |cell| cell.rise.half_height_all)
        .estimate("kept_half", SIGMA, HALF_OF_CHAINS, |cell| cell.rise.kept_half)
        .done()
}

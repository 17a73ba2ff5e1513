//! Maps the influence of the counting protocol: half height against transient T and window W.

use crate::experiments::prelude::*;

pub const PROTOCOL: Ensembles = ensembles("protocol", "protocol map", params::protocol, tables);

pub fn tables(ensembles: &Vec<Counted>) -> Vec<Table> {
    let Some(map) = find_ensemble(ensembles, PROTOCOL.name) else { return Vec::new() };
    let mut halves = Vec::from_iter(map.curves.iter().filter_map(|cell| cell.rise.half_height));
    halves.sort_by(|a, b| a.value.total_cmp(&b.value));
    let [from, to] = params::printed_interval();
    let printed = halves.iter().filter(|half| (from..to).contains(&half.value)).count();
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

//! Compares predicted half heights and mean counts with those of the map of the protocol.

use crate::experiments::prelude::*;
use crate::experiments::theory::comparison::root_mean_square;
use crate::experiments::{PROTOCOL, SEEDS, SWEEP};

const OFF: &str =
    "root mean square distance of the predicted mean counts from the simulated ones, in gaps";

/// Returns the mean count of all chains at a σ, or `None` where the runs were shorter.
fn mean(cell: &Curve, sigma: f64) -> Option<f64> {
    Some(cell.rows.iter().find(|row| row.sigma == sigma)?.mean_all?.value)
}

pub fn tables(results: &Results, computed: &[Table]) -> Option<Vec<Table>> {
    let table = |name: &str| computed.iter().find(|table| table.name() == name);
    let (means, rise) = (table("seeds.means")?, table("seeds.rise")?);
    let theory = table("theory.curve")?;
    let seeds = &results.of(&SEEDS).ok()?.parameters;
    let map = find_ensemble(results.of(&PROTOCOL).ok()?, "protocol")?;
    let window = seeds.window as f64 * seeds.bin;
    let transients = rise.distinct("transient").ok()?.into_iter();
    let cells = transients.filter_map(|transient| map.find_curve(Protocol { transient, window }));
    let cells: Vec<&Curve> = cells.collect();
    let everywhere = |sigma: &f64| cells.iter().all(|cell| mean(cell, *sigma).is_some());
    let sigmas: Vec<f64> = seeds.sigmas.iter().copied().filter(everywhere).collect();
    let off = |cell: &Curve, predicted: &[(f64, f64)]| {
        let means = sigmas.iter().filter_map(|sigma| Some((*sigma, mean(cell, *sigma)?)));
        root_mean_square(&means.collect::<Vec<_>>(), predicted)
    };
    let after = |transient: f64, column| {
        Some(rise.series(&[("transient", transient)], "transient", column).ok()?.first()?.1)
    };
    let column = |name| theory.curve(&[], "sigma", name).ok();
    let (simple, rest) = (column("simple")?, column("rest")?);
    let scores = Table::builder("seeds.scores", &cells, |_| map.ensemble.realisations)
        .key("transient", TIME, |cell| cell.protocol.transient)
        .estimate("half_height", SIGMA, "", |cell| cell.rise.half_height_all)
        .estimate("deficit", SIGMA, "simulated half height less the predicted one", |cell| {
            let predicted = after(cell.protocol.transient, "half_height")?;
            Some(difference(cell.rise.half_height_all?, predicted))
        })
        .real("eq25", "1", 2, OFF, |cell| off(cell, &simple))
        .real("from_rest", "1", 2, OFF, |cell| off(cell, &rest))
        .real("grown", "1", 2, OFF, |cell| {
            let keys = [("transient", cell.protocol.transient)];
            off(cell, &means.curve(&keys, "sigma", "grown").ok()?)
        })
        .done();
    // With the protocol of the main sweep.
    let transient = table("sweep.run")?.number(&[], "transient").ok()?;
    let swept = find_ensemble(results.of(&SWEEP).ok()?, SWEEP.name).and_then(half_height_all);
    let later = |column| Some(difference(swept?, after(transient, column)?));
    let compared = Table::builder("seeds.compared", &[()], |()| seeds.realisations)
        .count("sigmas", "values of σ that seeds and map have", |()| sigmas.len() as u64)
        .estimate("early", SIGMA, "half height of the sweep less this", |()| later("half_height"))
        .estimate("of_clumps", SIGMA, "the same if only clumps are seeds", |()| later("of_clumps"))
        .done();
    Some(vec![scores, compared])
}

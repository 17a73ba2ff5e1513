//! What is predicted beside what was simulated: by the main sweep, and after several transients by the map of the
//! protocol.

use crate::experiments::prelude::*;
use crate::experiments::protocol::address;
use crate::experiments::{PROTOCOL, SEEDS};
use impact_chain::rise::RisePoint;

/// One transient, by its half height in the map and its means there, with the cells that predict them.
struct Line<'a> {
    transient: f64,
    half_height: Option<Estimate>,
    /// Simulated means at the σ that all transients have.
    found: Vec<(f64, f64)>,
    means: &'a Table,
}

/// The tables; none where an experiment was not run.
pub fn tables(results: &Results, all: &[Table]) -> Option<Vec<Table>> {
    let of = |name: &str| all.iter().find(|table| table.name() == name);
    let (means, rise, found) = (of("seeds.means")?, of("seeds.rise")?, of("sweep.rows")?);
    let (seeds, map) = (&results.of(&SEEDS).ok()?.parameters, &results.of(&PROTOCOL).ok()?[0]);
    let window = seeds.window as f64 * seeds.bin;
    let mean = |row: &RisePoint| Some((row.sigma, row.mean_all?.value));
    let curve = |&transient: &f64| {
        let rows = &map.curve(transient, window)?.rows;
        Some((transient, rows.iter().filter_map(mean).collect::<Vec<_>>()))
    };
    let curves: Vec<_> = rise.values("transient").iter().filter_map(curve).collect();
    let common =
        |sigma: &f64| curves.iter().all(|(_, found)| found.iter().any(|at| at.0 == *sigma));
    let sigmas: Vec<f64> = seeds.sigmas.iter().copied().filter(common).collect();
    let line = |(transient, mut found): (f64, Vec<(f64, f64)>)| {
        found.retain(|(sigma, _)| sigmas.contains(sigma));
        let half_height = map.curve(transient, window).and_then(|cell| cell.rise.half_height_all);
        Line { transient, half_height, found, means }
    };
    let lines: Vec<Line<'_>> = curves.into_iter().map(line).collect();
    let scores = Table::of("seeds.scores", &lines, |_| map.ensemble.realisations)
        .key("transient", TIME, |line| line.transient)
        .estimate("half_height", SIGMA, "", |line| line.half_height)
        .same("half_height", |line| {
            map.curve(line.transient, window).map(|own| address(own, "half_height_all"))
        })
        .real("eq25", "1", 2, OFF, |line| line.off("eq25"))
        .real("from_rest", "1", 2, OFF, |line| line.off("from_rest"))
        .real("grown", "1", 2, OFF, |line| line.off("grown"))
        .done();
    // With the protocol of the main sweep.
    let transient = of("sweep.run")?.number(&[], "transient").ok()?;
    let grown = means.points(&[("transient", transient)], "sigma", "grown");
    let simulated =
        |(sigma, _): (f64, f64)| Some((sigma, found.number(&[("sigma", sigma)], "mean_all").ok()?));
    let against: Vec<(f64, f64)> = grown.into_iter().filter_map(simulated).collect();
    let half = rise.estimates(&[("transient", transient)], "transient", "half_height");
    let swept = of("sweep.rise")?.estimates(&[], "half_height_all", "half_height_all");
    let theory = of("seeds.theory")?;
    let root = |of: &dyn Fn(f64) -> Option<f64>| {
        let squares =
            against.iter().map(|at| of(at.0).map_or(f64::NAN, |own| (own - at.1) * (own - at.1)));
        (squares.sum::<f64>() / against.len() as f64).sqrt()
    };
    let by_circuits = |column: &str| root(&|sigma| theory.number(&[("sigma", sigma)], column).ok());
    let compared = Table::of("seeds.compared", &[()], |()| seeds.realisations)
        .count("sigmas", "values of σ that seeds and map have", |()| sigmas.len() as u64)
        .estimate("early", SIGMA, "half height of the main sweep less this", |()| {
            Some(difference(swept.first()?.1, half.first()?.1))
        })
        .count("swept", "values of σ that seeds and main sweep have", |()| against.len() as u64)
        .real("grown", "1", 2, OFF_SWEEP, |()| root(&|sigma| grown_at(means, transient, sigma)))
        .real("from_rest", "1", 2, OFF_SWEEP, |()| by_circuits("from_rest"))
        .real("eq25", "1", 2, OFF_SWEEP, |()| by_circuits("eq25"))
        .done();
    Some(vec![scores, compared])
}

const OFF_SWEEP: &str = "root mean square distance from the mean counts of the main sweep, in gaps";

/// The mean count by nucleation and growth.
fn grown_at(means: &Table, transient: f64, sigma: f64) -> Option<f64> {
    means.number(&[("transient", transient), ("sigma", sigma)], "grown").ok()
}

const OFF: &str =
    "root mean square distance of the predicted mean counts from the simulated ones, in gaps";

impl Line<'_> {
    fn off(&self, column: &str) -> f64 {
        let square = |(sigma, mean): &(f64, f64)| {
            let keys = [("transient", self.transient), ("sigma", *sigma)];
            let off = self.means.number(&keys, column).map_or(f64::NAN, |own| own - mean);
            off * off
        };
        (self.found.iter().map(square).sum::<f64>() / self.found.len() as f64).sqrt()
    }
}

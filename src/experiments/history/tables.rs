//! What follows from the counts, and what they stand beside.

use super::super::Results;
use super::super::protocol_tables::address;
use super::super::sweep::tables::mean_all;
use super::{Counts, History};
use crate::experiments::{HISTORY, PROTOCOL, SWEEP};
use impact_numerics::estimates::{average, half_height};
use impact_numerics::statistics::Estimate;
use literate::table::Table;

/// Chains at one σ, in the window after one transient.
struct Row<'a> {
    history: &'a History,
    sigma: f64,
    /// Place of the transient.
    after: usize,
    runs: &'a [Counts],
}

impl Row<'_> {
    fn transient(&self) -> f64 {
        self.history.parameters.transients[self.after]
    }

    fn counts(&self) -> Vec<f64> {
        self.runs.iter().flatten().map(|counts| counts[self.after] as f64).collect()
    }
}

fn row(history: &History, at: usize, after: usize) -> Row<'_> {
    Row { history, sigma: history.parameters.sigmas[at], after, runs: &history.rows[at] }
}

/// All tables.
pub fn tables(history: &History) -> Vec<Table> {
    let parameters = &history.parameters;
    let transients = 0..parameters.transients.len();
    let rows: Vec<Row<'_>> = (0..history.rows.len())
        .flat_map(|at| transients.clone().map(move |after| row(history, at, after)))
        .collect();
    let lowered = Table::of("history.lowered", &rows, |row| row.runs.len())
        .key("sigma", "d omega^2", |row| row.sigma)
        .key("transient", "1/omega", Row::transient)
        .estimate("mean_count", "1", "different gaps with an impact, mean of all", |row| {
            average(&row.counts())
        })
        .done();
    let run = Table::of("history.run", &[parameters], |own| own.realisations)
        .chosen("hot", "d omega^2", "σ of the force at first", |own| Some(own.hot))
        .chosen("heating", "1/omega", "for so long", |own| Some(own.heating))
        .chosen("window", "1/omega", "", |own| Some(own.window))
        .count("realisations", "chains at each σ", |own| own.realisations as u64)
        .done();
    vec![lowered, rise(history), run]
}

/// Where the mean of all passes half of all gaps, after each transient.
fn rise(history: &History) -> Table {
    let parameters = &history.parameters;
    let whole: Vec<usize> = (0..parameters.transients.len()).collect();
    Table::of("history.rise", &whole, |_| parameters.realisations)
        .key("transient", "1/omega", |after| parameters.transients[*after])
        .estimate("half_height", "d omega^2", "the mean of all passes half of all gaps", |after| {
            let counts: Vec<Vec<f64>> =
                (0..history.rows.len()).map(|at| row(history, at, *after).counts()).collect();
            half_height(&parameters.sigmas, &counts, 0.5 * parameters.chain.gaps() as f64)
        })
        .done()
}

/// Chains from rest: counts of the main sweep at each σ, and half heights of the map after each transient.
pub fn beside(results: &Results, _: &[Table]) -> Option<Vec<Table>> {
    let (history, sweep) = (&results.of(&HISTORY).ok()?.parameters, results.of(&SWEEP).ok()?);
    let map = results.of(&PROTOCOL).ok()?;
    let found = |sigma: &f64| {
        let row = sweep.rows.iter().find(|row| row.sigma == *sigma)?;
        mean_all(row).map(|[value, error]| Estimate { value, error, interval: [value; 2] })
    };
    let counts = Table::of("history.from_rest", &history.sigmas, |_| 0)
        .key("sigma", "d omega^2", |sigma| *sigma)
        .estimate("mean_count", "1", "different gaps with an impact, mean of all", found)
        .same("mean_count", |sigma| {
            found(sigma).map(|_| format!("sweep.rows[sigma={sigma}].mean_all"))
        })
        .done();
    let half = |transient: &f64| map.cell(*transient, history.window)?.half_height_all;
    let rise = Table::of("history.rise_from_rest", &history.transients, |_| 0)
        .key("transient", "1/omega", |transient| *transient)
        .estimate("half_height", "d omega^2", "the mean of all passes half of all gaps", half)
        .same("half_height", |transient| {
            let cell =
                map.cell(*transient, history.window).filter(|_| half(transient).is_some())?;
            Some(address("protocol", cell, "half_height_all"))
        })
        .done();
    Some(vec![counts, rise])
}

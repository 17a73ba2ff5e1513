//! Counts the impacts of many scenarios, on all cores.

use crate::{Array, compute_detached, to_python};
use impact_chain::{
    Abreast, Counts, Engine, Error, LATEST, Protocol, Scenario, Watch, check_range,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Counts the impacts of scenarios of one chain: side by side if they fill a batch, and by the
/// engine what that leaves.
fn count(scenarios: &[&Scenario], window: Protocol, stop: &AtomicBool) -> Result<Counts, Error> {
    let stopped = || stop.load(Relaxed);
    let (chain, end) = (scenarios[0].chain(), window.end());
    let batch = Abreast::batch_size(&chain);
    let mut counts: Vec<Option<Counts>> = vec![None; scenarios.len()];
    if scenarios.len() >= batch
        && let Some(abreast) = Abreast::new(&chain, &[window], end)
    {
        let run = |part: &[&Scenario]| {
            let part: Vec<Scenario> = part.iter().map(|&scenario| scenario.clone()).collect();
            abreast.run(&part, &stopped)
        };
        let runs = scenarios.par_chunks(batch).take_any_while(|_| !stopped()).flat_map_iter(run);
        counts = runs.map(|run| run.map(|mut run| run.counts())).collect();
    }
    let complete = |(counts, scenario): (Option<Counts>, &&Scenario)| match counts {
        Some(counts) => Ok(counts),
        None => Watch::new(&chain, &[window]).run(Engine::new(scenario), 0, end, &stopped),
    };
    let counts = counts.into_par_iter().zip(scenarios).take_any_while(|_| !stopped());
    let counts: Result<Vec<_>, _> = counts.map(complete).collect();
    Ok(counts?.into_iter().collect())
}

/// Counts the impacts of many scenarios up to a time, on all cores.
///
/// Parameters
/// ----------
/// scenarios : sequence of Scenario
///     Each with its own forces, walls and start, or drawn: `[Scenario.draw(0.3, i) for i in ...]`.
/// until : float
/// transient : float, optional
///     Impacts are counted that are later than this, and not later than `until`.
///
/// Returns
/// -------
/// distinct, impacts : ndarray of int64, shape (len(scenarios),)
///     For each scenario the number of gaps with an impact, −1 where the start overlaps or the
///     engine ended the run early, and the number of impacts.
///
/// Notes
/// -----
/// A scenario has the counts of `impacts`. Enough in a row that differ in forces and start only,
/// without `places` or `walls`, are simulated side by side in half of the time, with the same
/// impacts until rounding parts them.
#[pyfunction]
#[pyo3(signature = (scenarios, until, *, transient = 0.0))]
pub fn ensemble<'py>(
    py: Python<'py>,
    scenarios: Vec<Py<crate::Scenario>>,
    until: f64,
    transient: f64,
) -> PyResult<(Array<'py, i64>, Array<'py, i64>)> {
    check_range("until", until, 0.0, LATEST).map_err(to_python)?;
    check_range("transient", transient, 0.0, until).map_err(to_python)?;
    let window = Protocol { transient, window: until - transient };
    let counts: Counts = compute_detached(py, |stop| {
        let scenarios: Vec<&Scenario> = scenarios.iter().map(|one| &one.get().0).collect();
        let groups = scenarios.par_chunk_by(|one, next| one.chain() == next.chain());
        let counts: Result<Vec<_>, _> = groups.map(|group| count(group, window, stop)).collect();
        Ok(counts?.into_iter().collect())
    })?;
    let distinct = counts.distinct.iter().flatten().map(|gaps| gaps.map_or(-1, i64::from));
    let impacts = counts.impacts.iter().flatten().map(|&impacts| impacts as i64);
    Ok((PyArray1::from_iter(py, distinct), PyArray1::from_iter(py, impacts)))
}

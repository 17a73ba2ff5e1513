//! Shares, half heights and widths from what the realisations showed.

use super::super::{Error, Progress};
use super::{Chains, Curve, Ensemble, Part, Run, cases, chain, pieces};
use crate::params::{ChainCurve, ChainsParams};
use impact_numerics::estimates::{average, half_height, width};
use rayon::prelude::*;

pub(crate) fn join(
    parameters: &ChainsParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<Chains, Error> {
    let mut rows = cases(parameters).zip(parts).map(|((curve, sigma), parts)| {
        progress.check()?;
        Ok(ensemble(&sizes(parameters, curve), sigma, parts.concat()))
    });
    let of = |own: &ChainCurve| rows.by_ref().take(own.sigmas.len()).collect();
    let rows: Vec<Vec<Ensemble>> =
        parameters.curves.iter().map(of).collect::<Result<_, Error>>()?;
    let curves = parameters.curves.par_iter().zip(rows);
    let curves = curves.map(|(own, rows)| curve(parameters, own, rows)).collect();
    Ok(Chains { parameters: parameters.clone(), curves })
}

fn sizes(parameters: &ChainsParams, curve: &ChainCurve) -> Vec<usize> {
    pieces(chain(parameters, curve).gaps(), parameters.piece)
}

/// The shares of all pieces of all runs in one window.
fn shares<'a>(
    runs: &'a [Run],
    sizes: &'a [usize],
    window: usize,
) -> impl Iterator<Item = f64> + 'a {
    let of = move |run: &'a Run| run.counts[window].iter().zip(sizes);
    runs.iter().flat_map(of).map(|(&k, &size)| f64::from(k) / size as f64)
}

fn ensemble(sizes: &[usize], sigma: f64, found: Part) -> Ensemble {
    let failed = found.iter().filter(|run| run.is_none()).count() as u64;
    let runs: Vec<Run> = found.into_iter().flatten().collect();
    let windows = runs.first().map_or(0, |run| run.counts.len());
    let share = |window| average(&shares(&runs, sizes, window).collect::<Vec<_>>());
    Ensemble { sigma, shares: (0..windows).map(share).collect(), failed, runs }
}

pub(crate) fn curve(parameters: &ChainsParams, own: &ChainCurve, rows: Vec<Ensemble>) -> Curve {
    let sizes = sizes(parameters, own);
    let in_window = |window: usize| -> Vec<Vec<f64>> {
        let of = |row: &Ensemble| match row.shares.len() > window {
            true => shares(&row.runs, &sizes, window).collect(),
            false => Vec::new(),
        };
        rows.iter().map(of).collect()
    };
    let windows: Vec<Vec<Vec<f64>>> = (0..own.transients.len()).map(in_window).collect();
    Curve {
        name: own.name.clone(),
        half_heights: windows
            .iter()
            .map(|samples| half_height(&own.sigmas, samples, 0.5))
            .collect(),
        widths: windows.iter().map(|samples| width(&own.sigmas, samples, [0.1, 0.9])).collect(),
        rows,
    }
}

//! Shares, half heights and widths from what the realisations showed.

use super::super::{Error, Progress};
use super::{Chains, Curve, Ensemble, Part, Run, cases, chain, pieces};
use crate::circuits::nucleation::chain::{Chances, half};
use crate::circuits::nucleation::reach::Reach;
use crate::numerics::estimates::{average, half_height, width};
use crate::params::{Chain, ChainCurve, ChainsParams};
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

fn alive(run: &Run) -> bool {
    run.counts.last().is_some_and(|own| own.iter().any(|&k| k > 0))
}

fn ensemble(sizes: &[usize], sigma: f64, found: Part) -> Ensemble {
    let failed = found.iter().filter(|run| run.is_none()).count() as u64;
    let runs: Vec<Run> = found.into_iter().flatten().collect();
    let windows = runs.first().map_or(0, |run| run.counts.len());
    let share = |window| average(&shares(&runs, sizes, window).collect::<Vec<_>>());
    let count = |of: &dyn Fn(&Run) -> bool| runs.iter().filter(|run| of(run)).count() as u64;
    Ensemble {
        sigma,
        shares: (0..windows).map(share).collect(),
        silent: [true, false].map(|open| count(&|run| (run.open > 0) == open && !alive(run))),
        chains: [true, false].map(|open| count(&|run| (run.open > 0) == open)),
        failed,
        runs,
    }
}

pub(crate) fn curve(parameters: &ChainsParams, own: &ChainCurve, rows: Vec<Ensemble>) -> Curve {
    let (sizes, chain) = (sizes(parameters, own), chain(parameters, own));
    let reaches = reaches(parameters, own);
    let in_window = |window: usize| -> Vec<Vec<f64>> {
        let of = |row: &Ensemble| match row.shares.len() > window {
            true => shares(&row.runs, &sizes, window).collect(),
            false => Vec::new(),
        };
        rows.iter().map(of).collect()
    };
    let windows: Vec<Vec<Vec<f64>>> = (0..own.transients.len()).map(in_window).collect();
    let lives =
        |row: &Ensemble| row.runs.iter().map(|run| f64::from(u8::from(alive(run)))).collect();
    let lives: Vec<Vec<f64>> = rows.iter().map(lives).collect();
    let at = |samples: &Vec<Vec<f64>>, level| half_height(&own.sigmas, samples, level);
    Curve {
        name: own.name.clone(),
        half_heights: windows.iter().map(|samples| at(samples, 0.5)).collect(),
        widths: windows.iter().map(|samples| width(&own.sigmas, samples, [0.1, 0.9])).collect(),
        kept_half: at(&lives, 0.5),
        kept_half_expected: reaches.as_ref().map(|[ever, there]| {
            let half = |own: &Reach| half(&chain, own, &own.every(ANGLES[1]));
            rayon::join(|| half(ever), || half(there)).into()
        }),
        kept_expected: reaches.map_or(Vec::new(), |both| {
            drawn(&own.sigmas, |sigma| both.each_ref().map(|own| share(&chain, own, sigma)))
        }),
        rows,
    }
}

/// Angles at which the reach of a gap is computed, and of which each of so many serves for neighbours.
const ANGLES: [usize; 2] = [256, 4];

/// Values at equal steps from the first σ to the last.
fn drawn(sigmas: &[f64], shares: impl Fn(f64) -> [f64; 2] + Sync) -> Vec<[f64; 3]> {
    let (Some(from), Some(to)) = (sigmas.first(), sigmas.last()) else { return Vec::new() };
    let at = |i: u32| from + (to - from) * f64::from(i) / 20.0;
    let row = |sigma| {
        let [ever, there] = shares(sigma);
        [sigma, ever, there]
    };
    (0..21).into_par_iter().map(at).map(row).collect()
}

/// How far a gap reaches that closes by itself, at another frequency than the paper's: in unlimited time if the
/// frequencies have no common period, and until the end of the last window as they are.
fn reaches(parameters: &ChainsParams, curve: &ChainCurve) -> Option<[Reach; 2]> {
    let chain = chain(parameters, curve);
    if chain.forcing_frequency == parameters.chain.forcing_frequency {
        return None;
    }
    let until = curve.transients.last()? + parameters.window;
    let within = Reach::within(&chain, &[until], ANGLES[0]).pop()?;
    Some([Reach::ever(&chain, ANGLES[0]), within])
}

/// The share of the chains in which such a gap closes.
fn share(chain: &Chain, reach: &Reach, sigma: f64) -> f64 {
    let chances = Chances::new(chain, reach, &reach.every(ANGLES[1]), sigma);
    chances.at_least_one(chain.masses, chain.boundary).value
}

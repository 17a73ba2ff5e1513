//! Means, errors and laws from what the realisations showed.

use super::super::estimates::{average, average_count, half_height, jackknife, ratio};
use super::super::{Error, Progress};
use super::{Case, Curve, Ensemble, Hot, Part, Restitution, Run, cases, chain, hot};
use crate::circuits::balance::variance_ratio;
use crate::numerics::regression::line;
use crate::numerics::statistics::{Estimate, last_rise};
use crate::params::RestitutionParams;
use pxfm::{f_exp, f_log};

/// Windows at the end over which an exponent is fitted.
pub(super) const LAST: usize = 4;

pub(crate) fn join(
    parameters: &RestitutionParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<Restitution, Error> {
    progress.check()?;
    let mut all = cases(parameters)
        .into_iter()
        .zip(parts)
        .map(|(case, parts)| ensemble(parameters, &case, parts.concat()));
    let curves = parameters
        .restitutions
        .iter()
        .map(|&r| curve(parameters, r, all.by_ref().take(parameters.sigmas.len()).collect()))
        .collect::<Result<Vec<Curve>, Error>>()?;
    let heated: Vec<Ensemble> = all.collect();
    let begins = std::iter::once(0.0).chain(parameters.ends.iter().copied());
    let window = |(begin, &end)| hot(&parameters.chain, parameters.heated_sigma, begin, end);
    let hot: Vec<Hot> = begins.zip(&parameters.ends).map(window).collect();
    Ok(Restitution {
        shift: shift(parameters, &curves),
        able_expected: parameters.sigmas.iter().map(|&sigma| able(parameters, sigma)).collect(),
        able_drawn: (20..=120)
            .map(|i| f64::from(i) / 200.0)
            .map(|sigma| [sigma, able(parameters, sigma)])
            .collect(),
        exponents: heated.iter().map(|own| exponent(parameters, own)).collect(),
        parameters: parameters.clone(),
        curves,
        heated,
        hot,
    })
}

/// The share of gaps with |ΔF| > d ω²: the amplitudes of ΔF are normal with the variance 2 σ² between
/// masses, and σ² at a wall, so that its square over twice that is exponential.
pub(crate) fn able(parameters: &RestitutionParams, sigma: f64) -> f64 {
    let (d, omega) = (parameters.chain.spacing, parameters.chain.natural_frequency);
    let least = d * omega * omega / sigma;
    let (inner, gaps) = (f_exp(-0.25 * least * least), parameters.chain.gaps() as f64);
    let wall = f_exp(-0.5 * least * least);
    ((gaps - 2.0) * inner + 2.0 * wall) / gaps
}

pub(crate) fn curve(
    parameters: &RestitutionParams,
    restitution: f64,
    rows: Vec<Ensemble>,
) -> Result<Curve, Error> {
    let refused = |error: crate::circuits::Error| {
        Error::input("parameters", error.to_string(), "see src/params/restitution.rs")
    };
    let counts: Vec<Vec<u64>> = rows.iter().map(counts).collect();
    let counts: Vec<&[u64]> = counts.iter().map(Vec::as_slice).collect();
    Ok(Curve {
        restitution,
        half_height: half_height(&parameters.sigmas, &counts, half(parameters)),
        balanced: variance_ratio(&chain(parameters, restitution)).map_err(refused)?,
        rows,
    })
}

fn half(parameters: &RestitutionParams) -> f64 {
    0.5 * parameters.chain.gaps() as f64
}

fn counts(row: &Ensemble) -> Vec<u64> {
    row.runs.iter().map(|run| run.distinct).collect()
}

/// The difference of both ends' half heights: each realisation is left out of both together.
pub(crate) fn shift(parameters: &RestitutionParams, curves: &[Curve]) -> Option<Estimate> {
    let ends = [curves.first()?, curves.last()?];
    let all = ends.map(|curve| curve.rows.iter().map(counts).collect::<Vec<_>>());
    let realisations = all.iter().flatten().map(Vec::len).min()?;
    jackknife(realisations, |out| {
        let place = |rows: &[Vec<u64>]| {
            let mean = |own: &Vec<u64>| {
                let kept = own.iter().enumerate().filter(|(at, _)| Some(*at) != out);
                let (n, sum) = kept.fold((0, 0), |(n, sum), (_, k)| (n + 1, sum + k));
                (n > 0).then(|| sum as f64 / f64::from(n))
            };
            let means: Vec<Option<f64>> = rows.iter().map(mean).collect();
            last_rise(&parameters.sigmas, &means, half(parameters))
        };
        Some(place(&all[1])? - place(&all[0])?)
    })
}

/// Over the last windows, whose lengths and middles double, ln of the impacts per unit of time grows in
/// a straight line with ln t if it is a power of t.
fn exponent(parameters: &RestitutionParams, own: &Ensemble) -> Option<Estimate> {
    let ends = &parameters.ends;
    let first = ends.len().saturating_sub(LAST).max(1);
    jackknife(own.runs.len(), |out| {
        let point = |place: usize| {
            let kept = own.runs.iter().enumerate().filter(|(at, _)| Some(*at) != out);
            let impacts: u64 = kept.map(|(_, run)| run.impacts[place]).sum();
            let rate = impacts as f64 / (ends[place] - ends[place - 1]);
            (rate > 0.0).then(|| (f_log(ends[place]), f_log(rate), 1.0))
        };
        let points: Option<Vec<_>> = (first..ends.len()).map(point).collect();
        Some(line(&points?)?.slope)
    })
}

fn ensemble(parameters: &RestitutionParams, case: &Case, found: Part) -> Ensemble {
    let (masses, gaps) = (parameters.chain.masses as f64, parameters.chain.gaps() as f64);
    let failed = found.iter().filter(|run| run.is_none()).count();
    let runs: Vec<Run> = found.into_iter().flatten().collect();
    let begins: Vec<f64> = std::iter::once(0.0).chain(case.ends.iter().copied()).collect();
    let mean = |of: &dyn Fn(&Run) -> f64| average(&runs.iter().map(of).collect::<Vec<_>>());
    let rate = |place: usize| {
        let time = case.ends[place] - begins[place];
        mean(&|run| run.impacts[place] as f64 / time)
    };
    let heat = masses * case.sigma * case.sigma;
    let sum = |of: fn(&Run) -> u64| runs.iter().map(of).sum();
    let pairs = |of: &dyn Fn(&Run) -> [f64; 2]| ratio(&runs.iter().map(of).collect::<Vec<_>>());
    let loss = 0.5 * (1.0 - case.restitution);
    Ensemble {
        sigma: case.sigma,
        restitution: case.restitution,
        count: average_count(&runs.iter().map(|run| run.distinct).collect::<Vec<_>>()),
        rates: (0..case.ends.len()).map(rate).collect(),
        ratios: (0..case.ends.len()).map(|i| mean(&|run| run.free[i] / heat)).collect(),
        balance: pairs(&|run| [run.products, loss * run.squares]),
        phases: pairs(&|run| [run.phases as f64, run.impacts.last().map_or(0.0, |&n| n as f64)]),
        touched: mean(&|run| (run.able_touched + run.others_touched) as f64 / gaps),
        held: pairs(&|run| [run.held as f64, run.looks as f64 * gaps]),
        able: sum(|run| run.able),
        able_touched: sum(|run| run.able_touched),
        others_touched: sum(|run| run.others_touched),
        failed,
        runs,
    }
}

//! From realisations to ensembles, with what the theory says of them.

use super::{Heat, Part, Run, Warmth, ensembles};
use crate::circuits;
use crate::circuits::balance::{variance_ratio, variance_ratio_at};
use crate::circuits::distribution::SampleSpace;
use crate::circuits::impact_probability::ImpactProbability;
use crate::circuits::jump;
use crate::experiments::estimates::{average, average_count, jackknife, ratio, sums};
use crate::experiments::{Error, Progress};
use crate::numerics::bisection;
use crate::numerics::statistics::{Estimate, mean};
use crate::params::{Chain, HeatParams, HeatRow};

/// All ensembles.
pub fn join(
    parameters: &HeatParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<Heat, Error> {
    progress.check()?;
    let big_n = parameters.chain.gaps();
    let parts: Vec<Part> = parts.iter().map(|own| own.concat()).collect();
    let all = ensembles(parameters).zip(&parts);
    let all = all.map(|((row, chain), part)| warmth(parameters, row, &chain, part));
    let mut rows = all.collect::<Result<Vec<_>, _>>().map_err(refused)?;
    let ring = rows.split_off(parameters.rows.len());
    let (between_walls, on_ring) = parts.split_at(rows.len());
    let balance = [(&parameters.rows, between_walls), (&parameters.ring, on_ring)]
        .map(|(rows, parts)| balance(parameters.realisations, rows, parts));
    let jump = jump::p_jump(SampleSpace::Simple, big_n).map_err(refused)?.p;
    let ratio = variance_ratio(&parameters.chain).map_err(refused)?;
    let reaches = |sigma: f64| balanced(&parameters.chain, sigma, ratio).unwrap_or(0.0) >= jump;
    let sigma_jump = bisection::bracket(0.0, 1.0, reaches)[1];
    let sigmas = (10..=90).map(|i| f64::from(i) / 200.0);
    let drawn = |sigma| Ok([sigma, balanced(&parameters.chain, sigma, ratio)?]);
    let restitutions = (40..100).map(|i| f64::from(i) / 100.0);
    let at = |r| Ok([r, variance_ratio(&Chain { restitution: r, ..parameters.chain.clone() })?]);
    Ok(Heat {
        parameters: parameters.clone(),
        rows,
        ring,
        balance,
        balanced: sigmas.map(drawn).collect::<Result<_, _>>().map_err(refused)?,
        expected: restitutions.map(at).collect::<Result<_, _>>().map_err(refused)?,
        sigma_jump,
    })
}

fn refused(error: circuits::Error) -> Error {
    Error::input("parameters", error.to_string(), "see src/params/heat.rs")
}

/// Sums of M V F and of (1 − r) M V²/2 over the impacts of a realisation.
fn work(row: &HeatRow, run: &Run) -> [f64; 2] {
    [run.products, 0.5 * (1.0 - row.restitution) * run.squares]
}

/// The mean over ensembles of the ratio of the two sums; a realisation has the same forces in all.
pub(crate) fn balance(realisations: usize, rows: &[HeatRow], parts: &[Part]) -> Option<Estimate> {
    let all: Vec<Vec<[f64; 2]>> = rows
        .iter()
        .zip(parts)
        .map(|(row, part)| {
            part.iter().map(|run| run.map_or([0.0; 2], |run| work(row, &run))).collect()
        })
        .collect();
    jackknife(realisations, |out| {
        let ratios = all.iter().map(|own| sums(own, out)).filter(|[_, below]| *below > 0.0);
        let ratios: Vec<f64> = ratios.map(|[above, below]| above / below).collect();
        mean(&ratios)
    })
}

/// p of a chain whose free parts have that variance over σ².
fn balanced(chain: &Chain, sigma: f64, ratio: f64) -> Result<f64, circuits::Error> {
    gap(chain, sigma)?.heated(ratio)?.p()
}

fn gap(chain: &Chain, sigma: f64) -> Result<ImpactProbability, circuits::Error> {
    let (d, omega, big_omega) = (chain.spacing, chain.natural_frequency, chain.forcing_frequency);
    ImpactProbability::new(sigma, d, omega, big_omega)
}

pub(crate) fn warmth(
    parameters: &HeatParams,
    row: &HeatRow,
    chain: &Chain,
    runs: &Part,
) -> Result<Warmth, circuits::Error> {
    let (masses, gaps) = (chain.masses as f64, chain.gaps());
    let sigma2 = row.sigma * row.sigma;
    let ran: Vec<&Run> = runs.iter().flatten().collect();
    let ratios: Vec<f64> = ran.iter().map(|run| run.free / (masses * sigma2)).collect();
    let of_hit: Vec<[f64; 2]> =
        ran.iter().map(|run| [run.free_of_hit, run.hit as f64 * sigma2]).collect();
    let work: Vec<[f64; 2]> = ran.iter().map(|run| work(row, run)).collect();
    let imbalance = |run: &&Run| match run.lost > 0.0 {
        true => (run.changed - run.gained).abs() / run.lost,
        false => run.changed.abs(),
    };
    let each = |count: fn(&Run) -> u64| ran.iter().map(|run| count(run)).collect::<Vec<u64>>();
    let expected = variance_ratio(chain)?;
    let hit: u64 = each(|run| run.hit).iter().sum();
    let impacts = each(|run| run.impacts);
    // Each impact is one of two masses.
    let rate =
        2.0 * impacts.iter().sum::<u64>() as f64 / (hit.max(1) as f64 * parameters.protocol.window);
    let law = gap(chain, row.sigma)?;
    let (p, p_rest) = (law.p()?, law.p_from_rest()?);
    let p_balanced = balanced(chain, row.sigma, expected)?;
    let counts: Vec<u64> = ran.iter().map(|run| run.distinct).collect();
    let closing = each(|run| run.closing);
    let p_measured = closing.iter().sum::<u64>() as f64 / (gaps * ran.len()).max(1) as f64;
    Ok(Warmth {
        row: *row,
        ratio: average(&ratios),
        ratios,
        hit,
        warmth_of_hit: sums(&of_hit, None),
        ratio_of_hit: ratio(&of_hit),
        expected,
        rate,
        expected_at_rate: variance_ratio_at(chain, rate)?,
        balance: ratio(&work),
        work: sums(&work, None),
        impacts,
        count: average_count(&counts),
        counts,
        imbalance: (!ran.iter().any(|run| run.contact))
            .then(|| ran.iter().map(imbalance).fold(0.0, f64::max)),
        closing,
        p_measured,
        p,
        p_rest,
        p_balanced,
        failed: runs.len() - ran.len(),
    })
}

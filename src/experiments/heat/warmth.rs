//! From realisations to ensembles, with what the theory says of them.

use super::{Heat, Part, Run, Warmth, chain};
use crate::circuits;
use crate::circuits::balance::{variance_ratio, variance_ratio_at};
use crate::circuits::distribution::{Law, SampleSpace};
use crate::circuits::impact_probability::ImpactProbability;
use crate::circuits::jump;
use crate::experiments::estimates::{average, average_count, ratio, sums};
use crate::experiments::{Error, Progress};
use crate::numerics::bisection;
use crate::params::{Chain, HeatParams, HeatRow};

/// All ensembles.
pub fn join(
    parameters: &HeatParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<Heat, Error> {
    progress.check()?;
    let big_n = parameters.chain.gaps();
    let rows = parameters.rows.iter().zip(parts);
    let rows = rows.map(|(row, parts)| warmth(parameters, row, &parts.concat()));
    let rows = rows.collect::<Result<_, _>>().map_err(refused)?;
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
        balanced: sigmas.map(drawn).collect::<Result<_, _>>().map_err(refused)?,
        expected: restitutions.map(at).collect::<Result<_, _>>().map_err(refused)?,
        sigma_jump,
    })
}

fn refused(error: circuits::Error) -> Error {
    Error::input("parameters", error.to_string(), "see src/params/heat.rs")
}

/// p of a chain whose free parts have that variance over σ².
fn balanced(chain: &Chain, sigma: f64, ratio: f64) -> Result<f64, circuits::Error> {
    gap(chain, sigma)?.heated(ratio)?.p()
}

fn gap(chain: &Chain, sigma: f64) -> Result<ImpactProbability, circuits::Error> {
    let (d, omega, big_omega) = (chain.spacing, chain.natural_frequency, chain.forcing_frequency);
    ImpactProbability::new(sigma, d, omega, big_omega)
}

fn warmth(parameters: &HeatParams, row: &HeatRow, runs: &Part) -> Result<Warmth, circuits::Error> {
    let chain = chain(parameters, row);
    let (masses, gaps) = (chain.masses as f64, chain.gaps());
    let sigma2 = row.sigma * row.sigma;
    let ran: Vec<&Run> = runs.iter().flatten().collect();
    let ratios: Vec<f64> = ran.iter().map(|run| run.free / (masses * sigma2)).collect();
    let of_hit: Vec<[f64; 2]> =
        ran.iter().map(|run| [run.free_of_hit, run.hit as f64 * sigma2]).collect();
    let loss = 0.5 * (1.0 - row.restitution);
    let work: Vec<[f64; 2]> = ran.iter().map(|run| [run.products, loss * run.squares]).collect();
    let imbalance = |run: &&Run| match run.lost > 0.0 {
        true => (run.changed - run.gained).abs() / run.lost,
        false => run.changed.abs(),
    };
    let each = |count: fn(&Run) -> u64| ran.iter().map(|run| count(run)).collect::<Vec<u64>>();
    let expected = variance_ratio(&chain)?;
    let hit: u64 = each(|run| run.hit).iter().sum();
    let impacts = each(|run| run.impacts);
    // Each impact is one of two masses.
    let rate =
        2.0 * impacts.iter().sum::<u64>() as f64 / (hit.max(1) as f64 * parameters.protocol.window);
    let law = gap(&chain, row.sigma)?;
    let (p, p_rest) = (law.p()?, law.p_from_rest()?);
    let p_balanced = balanced(&chain, row.sigma, expected)?;
    let counts: Vec<u64> = ran.iter().map(|run| run.distinct).collect();
    let closing = each(|run| run.closing);
    let mean_of = |p: f64| Ok(Law::new(SampleSpace::Simple, gaps, p)?.mean());
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
        expected_at_rate: variance_ratio_at(&chain, rate)?,
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
        means: [mean_of(p)?, mean_of(p_rest)?, mean_of(p_balanced)?, mean_of(p_measured)?],
        failed: runs.len() - ran.len(),
    })
}

//! Runs two masses under a low force, which never hit: a remark of Sec. 2.
//!
//! After a start from rest every gap keeps R1 + R2 < d, and so never closes, while the amplitudes
//! are below a bound in closed form. With growing amplitude the first impact must come at that
//! bound or above, and close to it in long times, because ω and Ω are incommensurable.

use crate::experiments::prelude::*;
use impact_circuits::nucleation::{closing_pull, pulls};

pub const TWO_MASSES: Experiment<TwoMassesParams, TwoMasses> = Experiment {
    own: &["src/experiments/two_masses.rs"],
    how: Whole(run, |parameters| parameters.directions.realisations as u64 * WORK_PER_SECOND / 800),
    ..Experiment::new("two_masses", TwoMassesParams::new, run, tables)
};

/// The worst directions for Ω > ω: opposite forces that the start from rest amplifies.
const WORST: [[f64; 2]; 2] = [[0.0, 1.0], [0.0, -1.0]];

/// The smallest forces that lead to an impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoMasses {
    pub parameters: TwoMassesParams,
    /// For each time the least and the largest amplitude with an impact by then, over its bound.
    pub excess: Vec<[f64; 2]>,
    /// Impacts below the bound, over all directions and times: must be 0.
    pub violations: u64,
}

/// How far below its bound a direction is tried for an impact that must not come.
const BELOW: f64 = 1.0 - 1e-9;

const HALVINGS: usize = 28;

pub fn run(parameters: &TwoMassesParams, progress: &Progress) -> Result<TwoMasses, Error> {
    let directions = parameters.directions.realisations;
    let stage = progress.stage("two masses", directions as u64 + 1);
    // The last direction is the worst one.
    let draws = (0..directions as u64).map(|index| parameters.directions.scenario(index).forcing);
    let searches = run_each(&stage, progress, draws.chain([WORST.to_vec()]), |forcing| {
        thresholds(parameters, &forcing, progress)
    })?;
    let excess = |i: usize| {
        let ratios = searches[..directions].iter().map(|(_, ratios)| ratios[i]);
        ratios.fold([f64::INFINITY, 0.0], |[least, most], x| [least.min(x), most.max(x)])
    };
    Ok(TwoMasses {
        parameters: parameters.clone(),
        excess: (0..parameters.times.len()).map(excess).collect(),
        violations: searches.iter().map(|(violations, _)| violations).sum(),
    })
}

pub fn tables(two_masses: &TwoMasses) -> Vec<Table> {
    let bound = Table::builder("two_masses.bound", &[&two_masses.parameters.directions], |_| 0)
        .real("force", SIGMA, 4, "below this two masses never hit", |runs| safe_force(&runs.chain))
        .computed_by(origin(safe_force), &["force"])
        .count("directions", "random directions of the forcing", |runs| runs.realisations as u64)
        .done();
    const GREATEST: &str = "largest of the least forces with an impact, over bounds";
    let excess: Vec<_> = two_masses.parameters.times.iter().zip(&two_masses.excess).collect();
    let excess = Table::builder("two_masses.excess", &excess, |_| 0)
        .table_computed_by(origin(run))
        .key("time", TIME, |(time, _)| time.floor())
        .real("greatest", "1", 6, GREATEST, |row| row.1[1])
        .done();
    vec![bound, excess]
}

/// Returns the amplitude of two neighbours below which R1 + R2 < d in every direction, from rest:
/// forces differ by at most 2F, so R2 ≤ 2F/|ω² − Ω²| and R1 ≤ max(1, Ω/ω) R2.
pub fn safe_force(chain: &Chain) -> f64 {
    bound(chain, &WORST)
}

/// Returns the factor on `forcing` below which R1 + R2 < d in every gap, after a start from rest.
fn bound(chain: &Chain, forcing: &[[f64; 2]]) -> f64 {
    let wall = [[0.0; 2]];
    closing_pull(chain) / pulls(chain, &[&wall, forcing, &wall].concat()).fold(0.0, f64::max)
}

/// Returns the impacts below the bound, and the smallest ratio with an impact by each time.
fn thresholds(
    parameters: &TwoMassesParams,
    forcing: &[[f64; 2]],
    progress: &Progress,
) -> Result<(u64, Vec<f64>), Error> {
    let chain = &parameters.directions.chain;
    let bound = bound(chain, forcing);
    let hits = |ratio: f64, until: f64| -> Result<bool, Error> {
        progress.check()?;
        let amplitudes = forcing.iter().map(|pair| pair.map(|x| ratio * bound * x)).collect();
        let first = Scenario::given(chain, amplitudes)
            .and_then(|scenario| Engine::new(&scenario)?.next_impact(until));
        Ok(first.map_err(|source| Error::failed("two masses", source))?.is_some())
    };
    let latest = parameters.times.last().copied().unwrap_or(0.0);
    let violations = u64::from(hits(BELOW, latest)?);
    let mut ratios = Vec::with_capacity(parameters.times.len());
    for &time in &parameters.times {
        let (mut quiet, mut hitting) = (BELOW, 2.0);
        while !hits(hitting, time)? {
            (quiet, hitting) = (hitting, 2.0 * hitting);
        }
        // The threshold is monotone.
        for _ in 0..HALVINGS {
            let middle = 0.5 * (quiet + hitting);
            if hits(middle, time)? {
                hitting = middle;
            } else {
                quiet = middle;
            }
        }
        ratios.push(hitting);
    }
    Ok((violations, ratios))
}

//! Two masses (the remark of Sec. 2): under a low enough force they never hit.
//!
//! For a start from rest every gap keeps R1 + R2 < d, and so stays open for ever, as long as the
//! amplitudes are below a bound in closed form. A chain with fixed directions of the forcing and
//! growing amplitude must therefore have its first impact at that bound or above, and come close
//! to it when given time, because ω and Ω are incommensurable.

use super::ensembles::each;
use super::{Error, Progress};
use crate::params::{Boundary, Chain, TwoMassesParams};
use impact_chain::{Engine, Initial, Scenario};
use impact_numerics::random::NormalPairs;
use literate::table::Table;
use literate::value::origin;
use serde::{Deserialize, Serialize};

/// The smallest forces that lead to an impact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoMasses {
    /// What was run.
    pub parameters: TwoMassesParams,
    /// The force amplitude √(α² + β²) of each mass below which no direction of the forcing lets
    /// the two masses hit each other, in closed form.
    pub safe_force: f64,
    /// Over random directions: smallest amplitude with an impact divided by the bound of that
    /// direction, for each time.
    pub excess: Vec<ExcessWithinTime>,
    /// Impacts seen below the bound, over all directions and times: must be 0.
    pub violations: u64,
}

/// Simulated threshold over its bound, over random directions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExcessWithinTime {
    /// The time.
    pub time: f64,
    /// Smallest ratio.
    pub least: f64,
    /// Largest ratio.
    pub greatest: f64,
}

/// How far below its bound a direction is tried for an impact that must not come.
const BELOW: f64 = 1.0 - 1e-9;

/// Runs the experiment.
pub fn run(parameters: &TwoMassesParams, progress: &Progress) -> Result<TwoMasses, Error> {
    let chain = &parameters.chain;
    let stage = progress.stage("two masses", parameters.directions as u64);
    let safe_force = safe_force(chain);
    // The worst directions: opposite forces in the quadrature that the start from rest amplifies.
    let quadrature = usize::from(chain.forcing_frequency > chain.natural_frequency);
    let mut opposite = vec![[0.0; 2]; chain.masses];
    (opposite[0][quadrature], opposite[1][quadrature]) = (1.0, -1.0);
    let worst = Direction { chain, forcing: &opposite, bound: safe_force };
    let directions = each(&stage, progress, 0..parameters.directions, |index| {
        let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index as u64);
        let forcing = Scenario::draw(chain, 1.0, &mut normals).forcing;
        let direction = Direction { chain, forcing: &forcing, bound: bound(chain, &forcing) };
        direction.thresholds(parameters, progress)
    })?;
    let (mut violations, _) = worst.thresholds(parameters, progress)?;
    violations += directions.iter().map(|(violations, _)| violations).sum::<u64>();
    let excess = |(i, &time): (usize, &f64)| {
        let ratios = || directions.iter().map(|(_, found)| found[i]);
        let (least, greatest) = (ratios().reduce(f64::min), ratios().reduce(f64::max));
        Some(ExcessWithinTime { time, least: least?, greatest: greatest? })
    };
    let excess = parameters.times.iter().enumerate().filter_map(excess).collect();
    Ok(TwoMasses { parameters: parameters.clone(), safe_force, excess, violations })
}

/// What follows: the bound, and how near to its own bound each direction has an impact.
pub fn tables(found: &TwoMasses) -> Vec<Table> {
    let bound = Table::of("two_masses.bound", &[found], |_| 0)
        .computed_by(origin(safe_force))
        .real("force", "d omega^2", 4, "force amplitude below which two masses never hit", |own| {
            own.safe_force
        })
        .count("directions", "random directions of the forcing", |own| {
            own.parameters.directions as u64
        })
        .done();
    let excess = Table::of("two_masses.excess", &found.excess, |_| 0)
        .key("time", "1/omega", |own| own.time.floor())
        .computed_by(origin(run))
        .real(
            "least",
            "1",
            6,
            "least force with an impact within the time, over its bound",
            |own| own.least,
        )
        .real("greatest", "1", 6, "the same, largest of all directions", |own| own.greatest)
        .done();
    vec![bound, excess]
}

/// The amplitude of each of two neighbouring masses below which R1 + R2 < d in their gap for every
/// direction, after a start from rest: forces at most F differ by at most 2F, so
/// R2 ≤ 2F/|ω² − Ω²| and R1 ≤ max(1, Ω/ω) R2.
pub fn safe_force(chain: &Chain) -> f64 {
    let (w, big_w) = (chain.natural_frequency, chain.forcing_frequency);
    let response = (w * w - big_w * big_w).abs();
    chain.spacing * response / (2.0 * (1.0 + (big_w / w).max(1.0)))
}

/// The factor on `forcing` below which R1 + R2 < d in every gap, after a start from rest.
pub fn bound(chain: &Chain, forcing: &[[f64; 2]]) -> f64 {
    let (w, big_w) = (chain.natural_frequency, chain.forcing_frequency);
    let response = (w * w - big_w * big_w).abs();
    let wall = [0.0; 2];
    let n = forcing.len();
    let gaps: Vec<[[f64; 2]; 2]> = match chain.boundary {
        Boundary::Walls => (0..=n)
            .map(|j| [if j == 0 { wall } else { forcing[j - 1] }, *forcing.get(j).unwrap_or(&wall)])
            .collect(),
        Boundary::Ring => (0..n).map(|j| [forcing[j], forcing[(j + 1) % n]]).collect(),
    };
    let reach = gaps
        .iter()
        .map(|[left, right]| {
            let [alpha, beta] = [right[0] - left[0], right[1] - left[1]];
            let free = beta * big_w / w;
            (alpha * alpha + free * free).sqrt() + (alpha * alpha + beta * beta).sqrt()
        })
        .fold(0.0, f64::max);
    chain.spacing * response / reach
}

/// Fixed directions of the forcing with the factor below which nothing can hit.
struct Direction<'a> {
    chain: &'a Chain,
    forcing: &'a [[f64; 2]],
    bound: f64,
}

impl Direction<'_> {
    /// Time of the first impact up to `until`, with the forcing scaled to `ratio` bounds.
    fn first_impact(&self, ratio: f64, until: f64) -> Result<Option<f64>, Error> {
        let scale = ratio * self.bound;
        let scenario = Scenario {
            spacing: self.chain.spacing,
            natural_frequency: self.chain.natural_frequency,
            forcing_frequency: self.chain.forcing_frequency,
            restitution: self.chain.restitution,
            boundary: self.chain.boundary,
            initial: Initial::Rest,
            forcing: self.forcing.iter().map(|pair| pair.map(|x| scale * x)).collect(),
            overtones: Vec::new(),
        };
        let failed = |source| Error::failed("two masses", source);
        let mut engine = Engine::new(&scenario).map_err(failed)?;
        Ok(engine.next_impact(until).map_err(failed)?.map(|impact| impact.time))
    }

    /// Impacts below the bound, and for each time the smallest ratio to the bound with an impact.
    fn thresholds(
        &self,
        parameters: &TwoMassesParams,
        progress: &Progress,
    ) -> Result<(u64, Vec<f64>), Error> {
        let latest = parameters.times.last().copied().unwrap_or(0.0);
        let violations = u64::from(self.first_impact(BELOW, latest)?.is_some());
        let mut found = Vec::with_capacity(parameters.times.len());
        for &time in &parameters.times {
            progress.check()?;
            let (mut quiet, mut hitting) = (BELOW, 2.0);
            while self.first_impact(hitting, time)?.is_none() {
                (quiet, hitting) = (hitting, 2.0 * hitting);
            }
            // An impact at time t' with amplitude s comes from an excursion that a smaller
            // amplitude reaches too late or never: the threshold is monotone in the amplitude.
            for _ in 0..parameters.halvings {
                let middle = 0.5 * (quiet + hitting);
                if self.first_impact(middle, time)?.is_some() {
                    hitting = middle;
                } else {
                    quiet = middle;
                }
            }
            found.push(hitting);
        }
        Ok((violations, found))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Profile;

    #[test]
    fn the_worst_direction_meets_the_general_bound() {
        // ω = 1, Ω = √2: 1/(2(1 + √2)) = (√2 − 1)/2.
        let chain = Chain { masses: 2, ..Chain::default() };
        let safe = safe_force(&chain);
        assert!((safe - 0.5 * (2.0_f64.sqrt() - 1.0)).abs() < 1e-15);
        assert!((bound(&chain, &[[0.0, 1.0], [0.0, -1.0]]) - safe).abs() < 1e-15);
        // No direction of unit forces has a smaller bound for the gap between the masses.
        let mut normals = NormalPairs::new("test-two", 1, 0);
        for _ in 0..1000 {
            let unit = |[x, y]: [f64; 2]| [x, y].map(|c| c / (x * x + y * y).sqrt());
            let forcing = [unit(normals.pair()), unit(normals.pair())];
            assert!(bound(&chain, &forcing) >= safe * (1.0 - 1e-14));
        }
    }

    #[test]
    fn thresholds_lie_above_the_bound_and_fall_towards_it() {
        let mut parameters = TwoMassesParams::new(Profile::Quick);
        parameters.directions = 6;
        let found = run(&parameters, &Progress::silent()).unwrap();
        assert_eq!(found.violations, 0);
        assert!(found.excess.windows(2).all(|w| w[1].greatest <= w[0].greatest));
        assert!(found.excess.iter().all(|excess| excess.least >= 1.0 && excess.least < 1.01));
    }
}

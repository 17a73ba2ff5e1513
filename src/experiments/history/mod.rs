//! Whether the count depends on the past: chains that run under a large force, which is then lowered.

pub mod tables;

use super::ensembles::{Begun, Ensembles, Ran, Running};
use super::{Error, Progress, weights};
use crate::params::HistoryParams;
use impact_chain::{Initial, Scenario};
use impact_numerics::random::NormalPairs;
use literate::experiments::cutting::Row;

/// Counts after a larger force, for each σ, rising.
pub type History = Ran<HistoryParams, Counts>;

/// Counts of one realisation, for each transient; none where the engine gave up.
pub type Counts = Option<Vec<u64>>;

fn until(parameters: &HistoryParams) -> f64 {
    parameters.transients.last().copied().unwrap_or(0.0) + parameters.window
}

fn weight(parameters: &HistoryParams, sigma: f64) -> u64 {
    weights::run(&parameters.chain, parameters.hot, parameters.heating)
        + weights::run(&parameters.chain, sigma, until(parameters))
}

impl Ensembles for HistoryParams {
    type One = Counts;

    fn rows(&self) -> Vec<Row> {
        let row = |&sigma: &f64| Row {
            covers: format!("sigma = {sigma}"),
            realisations: self.realisations,
            weight: weight(self, sigma),
        };
        self.sigmas.iter().map(row).collect()
    }

    fn row<'a>(&'a self, row: usize, progress: &'a Progress) -> Begun<'a, Counts> {
        Ok(Box::new(move |index| realisation(self, self.sigmas[row], index, progress)))
    }

    fn fits(&self, _: usize, counts: &Counts) -> bool {
        let (number, gaps) = (self.transients.len(), self.chain.gaps() as u64);
        let fits = |counts: &Vec<u64>| counts.len() == number && counts.iter().all(|&k| k <= gaps);
        counts.as_ref().is_none_or(fits)
    }
}

fn realisation(
    parameters: &HistoryParams,
    sigma: f64,
    index: u64,
    progress: &Progress,
) -> Result<Counts, Error> {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let hot = Scenario::draw(&parameters.chain, parameters.hot, &mut normals);
    let Some(mut motion) = Running::new(&hot, "history", progress)? else { return Ok(None) };
    if !motion.go(parameters.heating, |_| ())? {
        return Ok(None);
    }
    let free = motion.engine.free_parts();
    let lowered = lowered(&hot, &free, parameters.heating, sigma / parameters.hot);
    let Some(mut motion) = Running::new(&lowered, "history", progress)? else {
        return Ok(None);
    };
    let Some(passages) = motion.passages(&parameters.transients, until(parameters))? else {
        return Ok(None);
    };
    let counts = passages.counts(&[parameters.window], until(parameters));
    Ok(Some(counts.into_iter().flatten().map(u64::from).collect()))
}

/// The scenario that goes on from a time at which all forces change by a factor: places and velocities
/// stay, so the free parts take what the forced parts lose.
fn lowered(hot: &Scenario, free: &[[f64; 2]], time: f64, factor: f64) -> Scenario {
    let (omega, big_omega) = (hot.natural_frequency, hot.forcing_frequency);
    let lost = (1.0 - factor) / (omega * omega - big_omega * big_omega);
    let mut now = hot.later(free, time);
    if let Initial::Free(parts) = &mut now.initial {
        for ([a, b], force) in parts.iter_mut().zip(&now.forcing) {
            *a += lost * force[0];
            *b += lost * big_omega / omega * force[1];
        }
    }
    for force in &mut now.forcing {
        *force = force.map(|x| factor * x);
    }
    now
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Chain;

    #[test]
    fn places_and_velocities_go_on_when_the_force_is_lowered() {
        let chain = Chain { masses: 5, ..Chain::default() };
        let mut normals = NormalPairs::new("test of history", 1, 1);
        let hot = Scenario::draw(&chain, 0.3, &mut normals);
        let free: Vec<[f64; 2]> = (0..5).map(|_| normals.pair()).collect();
        let (time, h) = (7.3, 1e-5);
        let place = |scenario: &Scenario, free: [f64; 2], j: usize, t: f64| {
            let [alpha, beta] = scenario.forcing[j];
            let (sin, cos) = pxfm::f_sincos(t);
            let (forced_sin, forced_cos) = pxfm::f_sincos(scenario.forcing_frequency * t);
            free[0] * cos + free[1] * sin - alpha * forced_cos - beta * forced_sin
        };
        let after = lowered(&hot, &free, time, 0.4);
        let Initial::Free(parts) = &after.initial else { panic!() };
        for j in 0..5 {
            let before = |t| place(&hot, free[j], j, t);
            let then = |t| place(&after, parts[j], j, t);
            assert!((before(time) - then(0.0)).abs() < 1e-12);
            let speeds = [before(time + h) - before(time - h), then(h) - then(-h)];
            assert!((speeds[0] - speeds[1]).abs() < 1e-9 * h.sqrt(), "{speeds:?}");
        }
    }
}

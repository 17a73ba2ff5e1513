//! Measures how long a run can be trusted, by twins that differ in the last bit of every amplitude.
//!
//! Every operation of a run rounds, in every mass, so the twins differ in all; in one run of four a
//! change of one amplitude alone is rounded away.

use crate::experiments::prelude::*;

pub const HORIZON: Experiment<Runs, Horizon> = Experiment {
    own: &["src/experiments/horizon.rs"],
    how: Whole(run, |parameters| parameters.realisations as u64 * WORK_PER_SECOND / 300),
    ..Experiment::new("horizon", Runs::horizon, run, tables)
};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Horizon {
    pub parameters: Runs,
    pub twins: Vec<Twins>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Twins {
    /// Time of the first impact whose gap differs and the number of impacts before it, or `None` if
    /// all gaps agree.
    pub order: Option<(f64, u64)>,
    /// Growth rate λ of their difference in time, e-folds per unit of time.
    pub growth: Option<f64>,
}

impl Horizon {
    /// Estimates the growth rate λ over all twins.
    pub fn growth(&self) -> Option<Estimate> {
        average(&self.twins.iter().filter_map(|twins| twins.growth).collect::<Vec<_>>())
    }
}

pub fn run(parameters: &Runs, progress: &Progress) -> Result<Horizon, Error> {
    let stage = progress.stage("horizon", parameters.realisations as u64);
    let twins = run_each(&stage, progress, 0..parameters.realisations as u64, |index| {
        run_twins(parameters, index).map_err(|source| Error::failed("horizon", source))
    })?;
    Ok(Horizon { parameters: parameters.clone(), twins })
}

pub fn tables(horizon: &Horizon) -> Vec<Table> {
    let orders = horizon.twins.iter().filter_map(|pair| pair.order);
    let (times, before): (Vec<f64>, Vec<f64>) = orders.map(|(t, n)| (t, n as f64)).unzip();
    let least = times.iter().copied().fold(f64::INFINITY, f64::min);
    let table = Table::builder("horizon.twins", &[horizon], |horizon| horizon.twins.len())
        .table_computed_by(origin(run))
        .count("pairs", "pairs of twins", |horizon| horizon.twins.len() as u64)
        .chosen("sigma", SIGMA, "", |horizon| Some(horizon.parameters.sigma))
        .estimate("order", TIME, "time of the first impact of another gap", |_| average(&times))
        .estimate("impacts", "1", "impacts before it", |_| average(&before))
        .real("first_order", TIME, 3, "least time of the first impact of another gap", |_| least)
        .done();
    vec![table]
}

/// Differences that follow the growth: above the rounding of the times, below saturation.
const GROWING: std::ops::Range<f64> = 1e-13..1e-4;

/// Units of time in which the largest difference is one point of the growth.
const STRIDE: f64 = 5.0;

/// Returns λ, the slope of a line through the largest logarithm of each stride, or `None` below
/// three points.
fn growth_rate(differences: &[(f64, f64)]) -> Option<f64> {
    let stride = |point: &(f64, f64)| (point.0 / STRIDE) as u64;
    let points: Vec<(f64, f64)> = differences
        .chunk_by(|a, b| stride(a) == stride(b))
        .map(|points| (stride(&points[0]), points.iter().map(|point| point.1).fold(0.0, f64::max)))
        .filter(|(_, largest)| GROWING.contains(largest))
        .map(|(stride, largest)| ((stride as f64 + 0.5) * STRIDE, pxfm::f_log(largest)))
        .collect();
    (points.len() >= 3).then(|| slope(&points)).flatten()
}

/// Runs a scenario and its twin, whose amplitudes are one bit larger and smaller in turn.
fn run_twins(parameters: &Runs, index: u64) -> Result<Twins, impact_chain::Error> {
    let scenario = parameters.scenario(index);
    let mut twin = scenario.clone();
    for (j, amplitude) in twin.forcing.iter_mut().flatten().enumerate() {
        *amplitude = if j % 2 == 0 { amplitude.next_up() } else { amplitude.next_down() };
    }
    let first = Engine::new(&scenario)?.impacts(parameters.until)?;
    let (mut growth, mut order, mut twin) = (Vec::new(), None, Engine::new(&twin)?);
    for (one, before) in first.iter().zip(0..) {
        let Some(other) = twin.next_impact(parameters.until)? else { break };
        if one.gap != other.gap {
            order = Some((one.time.min(other.time), before));
            break;
        }
        growth.push((one.time, (one.time - other.time).abs()));
    }
    Ok(Twins { order, growth: growth_rate(&growth) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_lies_between_rounding_and_saturation_counts() {
        // e^(t/4), hidden by rounding before and by saturation after.
        let difference = |time: f64| (1e-15 * pxfm::f_exp(0.25 * time)).clamp(1e-14, 1e-3);
        let times = || (0..200).map(|i| 0.5 * f64::from(i));
        let growth = growth_rate(&times().map(|time| (time, difference(time))).collect::<Vec<_>>());
        assert!((growth.unwrap() - 0.25).abs() < 1e-3, "{growth:?}");
        assert_eq!(growth_rate(&times().map(|time| (time, 1e-15)).collect::<Vec<_>>()), None);
    }
}

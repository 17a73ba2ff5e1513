//! What a method does to the mean number of gaps that impact: the same chains by every method, and
//! the differences chain by chain.

use super::routes::method;
use crate::dynamics::methods::{Cost, State};
use crate::dynamics::{Impact, Scenario};
use crate::experiments::progress::Stage;
use crate::experiments::{Error, Progress};
use crate::numerics::random::NormalPairs;
use crate::numerics::statistics::{mean, standard_error};
use crate::params::{BiasParams, MethodName, Protocol, Setting};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Bias of all methods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Biases {
    /// What was run.
    pub parameters: BiasParams,
    /// The certified engine, one row for each σ.
    pub certified: Vec<Own>,
    /// The methods: settings in their order, for each σ in its order.
    pub rows: Vec<BiasRow>,
}

/// The certified engine at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Own {
    /// σ.
    pub sigma: f64,
    /// Realisations.
    pub realisations: u64,
    /// Mean number of distinct gaps, of all realisations.
    pub mean: f64,
    /// Evaluations per impact.
    pub evaluations_per_impact: Option<f64>,
}

/// One method at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BiasRow {
    /// Method and setting.
    pub setting: Setting,
    /// σ.
    pub sigma: f64,
    /// Chains that both ran to the end.
    pub pairs: u64,
    /// Chains that the method gave up.
    pub failed: u64,
    /// Mean number of distinct gaps by the certified engine, on these chains.
    pub own_mean: Option<f64>,
    /// Mean difference of the method from it.
    pub bias: Option<f64>,
    /// Standard error of the mean difference, from the differences chain by chain.
    pub error: Option<f64>,
    /// Evaluations per impact of the method.
    pub evaluations_per_impact: Option<f64>,
}

/// One realisation by one method: distinct gaps, and cost.
#[derive(Clone, Copy, Debug)]
struct Counted {
    distinct: Option<f64>,
    cost: Cost,
}

/// Runs everything.
///
/// # Errors
/// [`Error::Interrupted`].
pub fn run(parameters: &BiasParams, progress: &Progress) -> Result<Biases, Error> {
    let most = parameters.settings.iter().map(|(_, n)| *n).max().unwrap_or(0);
    let own = Setting { method: MethodName::Certified, value: 0.0 };
    let chains = most + parameters.settings.iter().map(|(_, n)| n).sum::<usize>();
    let stage = progress.stage("bias of methods", (chains * parameters.scenes.len()) as u64);
    let (mut certified, mut rows) = (Vec::new(), Vec::new());
    for &(sigma, protocol) in &parameters.scenes {
        let scene = (sigma, protocol);
        let ours = ensemble(parameters, own, scene, most, (&stage, progress))?;
        let counts: Vec<f64> = ours.iter().filter_map(|run| run.distinct).collect();
        certified.push(Own {
            sigma,
            realisations: counts.len() as u64,
            mean: mean(&counts).unwrap_or(0.0),
            evaluations_per_impact: evaluations_per_impact(&ours),
        });
        for &(setting, n) in &parameters.settings {
            let theirs = ensemble(parameters, setting, scene, n, (&stage, progress))?;
            let pairs: Vec<(f64, f64)> =
                theirs.iter().zip(&ours).filter_map(|(a, b)| a.distinct.zip(b.distinct)).collect();
            let differences: Vec<f64> = pairs.iter().map(|(a, b)| a - b).collect();
            rows.push(BiasRow {
                setting,
                sigma,
                pairs: pairs.len() as u64,
                failed: theirs.iter().filter(|run| run.distinct.is_none()).count() as u64,
                own_mean: mean(&pairs.iter().map(|p| p.1).collect::<Vec<_>>()),
                bias: mean(&differences),
                error: standard_error(&differences),
                evaluations_per_impact: evaluations_per_impact(&theirs),
            });
        }
    }
    Ok(Biases { parameters: parameters.clone(), certified, rows })
}

fn evaluations_per_impact(runs: &[Counted]) -> Option<f64> {
    let sum = |of: fn(&Cost) -> u64| runs.iter().map(|run| of(&run.cost)).sum::<u64>();
    let impacts = sum(|cost| cost.impacts);
    (impacts > 0).then(|| sum(|cost| cost.evaluations) as f64 / impacts as f64)
}

fn ensemble(
    parameters: &BiasParams,
    setting: Setting,
    (sigma, protocol): (f64, Protocol),
    realisations: usize,
    (stage, progress): (&Stage, &Progress),
) -> Result<Vec<Counted>, Error> {
    (0..realisations)
        .into_par_iter()
        .with_max_len(1)
        .map(|index| {
            progress.check()?;
            let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index as u64);
            let scenario = Scenario::draw(&parameters.chain, sigma, &mut normals);
            let counted = count(setting, &scenario, protocol, progress);
            progress.check()?;
            stage.advance(1);
            Ok(counted)
        })
        .collect()
}

/// Distinct gaps that impact in the window (T, T + W].
fn count(
    setting: Setting,
    scenario: &Scenario,
    protocol: Protocol,
    progress: &Progress,
) -> Counted {
    let mut hit = vec![false; scenario.gaps()];
    let mut see = |impact: Impact| {
        if impact.time > protocol.transient {
            hit[impact.gap] = true;
        }
        !progress.stopped()
    };
    let until = protocol.transient + protocol.window;
    let ran = method(setting).run(scenario, &State::of(scenario), until, &mut see);
    let distinct = hit.iter().filter(|hit| **hit).count() as f64;
    match ran {
        Ok(cost) => Counted { distinct: Some(distinct), cost },
        Err(_) => Counted { distinct: None, cost: Cost::default() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::sweep;
    use crate::params::{Profile, SweepParams};

    /// Certified counts are those of the main sweep, by its own way of counting.
    #[test]
    fn the_same_chains_as_in_the_sweep() {
        let mut parameters = BiasParams::new(Profile::Quick);
        let short = Protocol { transient: 50.0, window: 20.0 };
        parameters.scenes = vec![(0.3, short)];
        let own = Setting { method: MethodName::Certified, value: 0.0 };
        let coarse = Setting { method: MethodName::Verlet, value: 0.1 };
        parameters.settings = vec![(own, 3), (coarse, 2)];
        let found = run(&parameters, &Progress::silent()).unwrap();
        let sweep = SweepParams {
            sigmas: vec![0.3],
            realisations: 3,
            protocol: short,
            ..SweepParams::main(Profile::Quick)
        };
        let stage = Progress::silent().stage("test", 0);
        let sample = sweep::at(&sweep, 0.3, &stage, &Progress::silent()).unwrap();
        assert_eq!(Some(found.certified[0].mean), sample.row.mean_all);
        // Against itself nothing differs; a coarse method differs, on chains of its own number.
        assert_eq!((found.rows[0].bias, found.rows[0].error), (Some(0.0), Some(0.0)));
        assert_eq!((found.rows[1].pairs, found.rows[1].failed), (2, 0));
        assert_ne!(found.rows[1].bias, Some(0.0));
        assert_eq!(found, run(&parameters, &Progress::silent()).unwrap());
    }
}

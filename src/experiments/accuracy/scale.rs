//! Counted work of an impact against the number of masses.

use super::routes::method;
use crate::dynamics::methods::State;
use crate::dynamics::{Impact, Scenario};
use crate::experiments::{Error, Progress};
use crate::numerics::random::NormalPairs;
use crate::params::{ScaleParams, Setting};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Counted work of all methods at all sizes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scale {
    /// What was run.
    pub parameters: ScaleParams,
    /// Settings in their order, for each its numbers of masses, rising.
    pub rows: Vec<ScaleRow>,
}

/// One method at one number of masses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScaleRow {
    /// Method and setting.
    pub setting: Setting,
    /// n.
    pub masses: usize,
    /// Evaluations per impact.
    pub evaluations_per_impact: f64,
}

/// Runs everything.
///
/// # Errors
/// [`Error::Interrupted`]; [`Error::Failed`] if a method gives up.
pub fn run(parameters: &ScaleParams, progress: &Progress) -> Result<Scale, Error> {
    let cases: Vec<(Setting, usize)> = parameters
        .settings
        .iter()
        .flat_map(|&(setting, largest)| {
            let masses = parameters.masses.iter().filter(move |n| **n <= largest);
            masses.map(move |&n| (setting, n))
        })
        .collect();
    let stage = progress.stage("work against size", cases.len() as u64);
    let rows = cases
        .into_par_iter()
        .with_max_len(1)
        .map(|(setting, masses)| {
            progress.check()?;
            let chain = crate::params::Chain { masses, ..parameters.chain.clone() };
            let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, 0);
            let scenario = Scenario::draw(&chain, parameters.sigma, &mut normals);
            let until = parameters.until(masses, setting.method);
            let mut go_on = |_: Impact| !progress.stopped();
            let cost = method(setting).run(&scenario, &State::of(&scenario), until, &mut go_on);
            progress.check()?;
            let cost = cost.map_err(|source| Error::failed("scale", source))?;
            stage.advance(1);
            let evaluations_per_impact = cost.evaluations as f64 / cost.impacts.max(1) as f64;
            Ok(ScaleRow { setting, masses, evaluations_per_impact })
        })
        .collect::<Result<_, Error>>()?;
    Ok(Scale { parameters: parameters.clone(), rows })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{MethodName, Profile};

    #[test]
    fn work_grows_with_n_for_integrators_only() {
        let scale = run(&ScaleParams::new(Profile::Quick), &Progress::silent()).unwrap();
        let at = |method: MethodName, n: usize| {
            let mut rows = scale.rows.iter().filter(|r| r.setting.method == method);
            rows.find(|r| r.masses == n).unwrap().evaluations_per_impact
        };
        let ours = at(MethodName::Certified, 1000) / at(MethodName::Certified, 10);
        assert!((0.3..2.0).contains(&ours), "{ours}");
        // Three times as many masses have three times as many impacts, and each costs all masses:
        // a step of fixed length costs n, and n impacts share n steps.
        let events = at(MethodName::RungeKutta, 30) / at(MethodName::RungeKutta, 10);
        assert!(events > 1.7, "{events}");
        let steps = at(MethodName::Verlet, 30) / at(MethodName::Verlet, 10);
        assert!((0.3..3.0).contains(&steps), "{steps}");
    }
}

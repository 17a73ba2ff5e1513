//! Counts the work of an impact against the number of masses.

use crate::experiments::prelude::*;
use impact_chain::methods::Task;

/// The work of a method on a chain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorkPoint {
    pub setting: Setting,
    pub masses: usize,
    /// Its mean, or `None` if there was no impact.
    pub evaluations_per_impact: Option<f64>,
}

/// Methods in their order, the numbers of masses of each rising.
pub type Scale = Vec<WorkPoint>;

pub fn run(parameters: &ScaleParams, progress: &Progress) -> Result<Scale, Error> {
    let is_engine = |setting: Setting| setting.method == MethodName::Certified;
    // The simulated time of `benches/peers/measure.rs`, and a short one for rivals.
    let until = |setting: Setting, masses: usize| {
        if is_engine(setting) { (200_000.0 / masses as f64).clamp(10.0, 200.0) } else { 20.0 }
    };
    let mut cases = Vec::new();
    for &setting in &parameters.settings {
        let most = if is_engine(setting) { usize::MAX } else { parameters.largest_for_rivals };
        let masses = parameters.masses.iter().filter(|masses| **masses <= most);
        cases.extend(masses.map(|masses| (setting, *masses)));
    }
    let stage = progress.stage("work against size", cases.len() as u64);
    run_each(&stage, progress, cases, |(setting, masses)| {
        let chain = Chain { masses, ..Chain::default() };
        let mut normals = NormalPairs::new(params::BENCH_STREAM, Seed(params::BENCH_SEED), 0);
        let scenario = Scenario::draw(&chain, parameters.sigma, &mut normals);
        let (start, until) = (State::from_scenario(&scenario), until(setting, masses));
        let mut go_on = |_| !progress.stopped();
        let task = Task { scenario: &scenario, start: &start, until };
        let cost = setting.method().run(task, &mut go_on);
        progress.check()?;
        let cost = cost.map_err(|source| Error::failed("scale", source))?;
        Ok(WorkPoint { setting, masses, evaluations_per_impact: cost.evaluations_per_impact() })
    })
}

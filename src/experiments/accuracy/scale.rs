//! Counts the work of an impact against the number of masses.

use crate::experiments::prelude::*;
use crate::params::{BENCH, MethodName, ScaleParams, Setting};
use impact_chain::methods::Task;

/// Method, number of masses n, evaluations per impact: methods in their order, for each n rising.
pub type Scale = Vec<(Setting, usize, f64)>;

pub fn run(parameters: &ScaleParams, progress: &Progress) -> Result<Scale, Error> {
    let mut cases = Vec::new();
    for &setting in &parameters.settings {
        cases.extend(parameters.masses.iter().map(|n| (setting, *n)));
    }
    let ours = |setting: Setting| setting.method == MethodName::Certified;
    // The simulated time of `benches/peers/measure.rs`, and a short one for rivals.
    let until = |setting: Setting, masses: usize| {
        if ours(setting) { (200_000.0 / masses as f64).clamp(10.0, 200.0) } else { 20.0 }
    };
    cases.retain(|(setting, masses)| ours(*setting) || *masses <= parameters.rivals);
    let stage = progress.stage("work against size", cases.len() as u64);
    run_each(&stage, progress, cases, |(setting, masses)| {
        let chain = Chain { masses, ..Chain::default() };
        let mut normals = NormalPairs::new(BENCH.0, Seed(BENCH.1), 0);
        let scenario = Scenario::draw(&chain, parameters.sigma, &mut normals);
        let (start, until) = (State::from_scenario(&scenario), until(setting, masses));
        let mut go_on = |_| !progress.stopped();
        let task = Task { scenario: &scenario, start: &start, until };
        let cost = setting.method().run(task, &mut go_on);
        progress.check()?;
        let cost = cost.map_err(|source| Error::failed("scale", source))?;
        Ok((setting, masses, cost.evaluations_per_impact().unwrap_or(0.0)))
    })
}

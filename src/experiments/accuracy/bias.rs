//! What a method does to the mean number of gaps that impact: the same chains by every method, and
//! the differences chain by chain.

use crate::experiments::prelude::*;
use crate::params::{BiasParams, MethodName, Protocol, Setting};

/// All realisations by all methods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Biases {
    /// What was run.
    pub parameters: BiasParams,
    /// For each σ, in their order, the realisations by the engine, and by each setting.
    pub runs: Vec<Vec<Vec<Counted>>>,
}

/// Distinct gaps that impact in the window (T, T + W] of one realisation; none if the method gave it up.
pub type Counted = Option<u32>;

/// Runs everything.
pub fn run(parameters: &BiasParams, progress: &Progress) -> Result<Biases, Error> {
    let most = parameters.settings.iter().map(|(_, n)| *n).max().unwrap_or(0);
    let engine = (Setting { method: MethodName::Certified, value: 0.0 }, most);
    let settings: Vec<_> = std::iter::once(engine).chain(parameters.settings.clone()).collect();
    let mut all = Vec::new();
    for scene in &parameters.scenes {
        for (setting, realisations) in &settings {
            all.extend((0..*realisations as u64).map(|index| (*scene, *setting, index)));
        }
    }
    let stage = progress.stage("bias of methods", all.len() as u64);
    let counted = each(&stage, progress, all, |((sigma, protocol), setting, index)| {
        let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
        let scenario = Scenario::draw(&parameters.chain, sigma, &mut normals);
        let counted = count(setting, &scenario, protocol, progress);
        progress.check()?;
        Ok(counted)
    })?;
    let mut counted = counted.into_iter();
    let mut of = |(_, n): &(Setting, usize)| counted.by_ref().take(*n).collect();
    let runs = parameters.scenes.iter().map(|_| settings.iter().map(&mut of).collect());
    Ok(Biases { runs: runs.collect(), parameters: parameters.clone() })
}

fn count(
    setting: Setting,
    scenario: &Scenario,
    protocol: Protocol,
    progress: &Progress,
) -> Counted {
    let mut hit = vec![false; scenario.gaps()];
    let mut see = |impact: Impact| {
        hit[impact.gap] |= impact.time > protocol.transient;
        !progress.stopped()
    };
    let until = protocol.transient + protocol.window;
    let method = setting.method.with(setting.value);
    let ran = method.run((scenario, &State::of(scenario), until), &mut see).ok();
    ran.map(|_| hit.iter().map(|hit| u32::from(*hit)).sum())
}

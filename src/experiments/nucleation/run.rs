//! Runs chains to their first impact, and computes how many should have one by the reach of gaps.

use crate::experiments::prelude::*;
use impact_circuits::nucleation::{ANGLES, Chances, PAIR_ANGLES, Reach, sigma_at_which_half_close};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Nucleation {
    pub parameters: NucleationParams,
    /// For each length and σ, length by length, the time of each chain's first impact.
    pub rows: Vec<Vec<Option<f64>>>,
    pub gaps: Vec<Gaps>,
    /// Within the latest time, at σ that lie closer together, for curves.
    pub curve: Vec<(f64, Chances)>,
    /// The σ at which half of the chains of the paper have such a gap, in unlimited time.
    pub half: f64,
}

/// The chances of gaps to close by themselves at one σ, by the theory.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gaps {
    pub sigma: f64,
    pub within: Vec<Chances>,
    pub ever: Chances,
}

pub fn run(parameters: &NucleationParams, progress: &Progress) -> Result<Nucleation, Error> {
    let stage = progress.stage("first impacts", parameters.chains());
    let first_impacts = |runs: Runs| {
        run_each(&stage, progress, 0..runs.realisations as u64, |index| {
            let impact = Engine::new(&runs.scenario(index))
                .and_then(|mut engine| engine.next_impact(runs.until))
                .map_err(|source| Error::failed("nucleation", source))?;
            Ok(impact.map(|impact| impact.time))
        })
    };
    let rows = parameters.runs().map(first_impacts).collect::<Result<_, _>>()?;
    let chain = &Chain::default();
    let reaches = Reach::within_times(chain, &parameters.times, ANGLES);
    let ever = Reach::in_unlimited_time(chain, PAIR_ANGLES);
    let gaps = |&sigma: &f64| {
        let within = reaches.iter().map(|reach| Chances::new(chain, reach, sigma)).collect();
        Gaps { sigma, within, ever: Chances::new(chain, &ever, sigma) }
    };
    let curve = reaches.last().map_or(Vec::new(), |last| {
        let sigmas = (55..=165_u32).into_par_iter().map(|step| f64::from(step) / 1000.0);
        sigmas.map(|sigma| (sigma, Chances::new(chain, last, sigma))).collect()
    });
    let gaps = parameters.sigmas.par_iter().map(gaps).collect();
    let parameters = parameters.clone();
    Ok(Nucleation { parameters, rows, gaps, curve, half: sigma_at_which_half_close(chain, &ever) })
}

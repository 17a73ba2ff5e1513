//! What a method does to the mean number of gaps that impact: the same chains by every method, and
//! the differences chain by chain.

use super::routes::method;
use crate::experiments::{Error, Progress};
use crate::params::{BiasParams, Chain, MethodName, Protocol, Setting};
use impact_chain::methods::{Cost, State};
use impact_chain::{Impact, Scenario};
use impact_numerics::random::NormalPairs;
use impact_numerics::statistics::{mean, standard_error};
use literate::experiments::cutting::{Cutting, Row, Unit};
use literate::experiments::progress::Stage;
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
    /// Mean number of distinct gaps by the certified engine, on these chains.
    pub own_mean: Option<f64>,
    /// Mean difference of the method from it.
    pub bias: Option<f64>,
    /// Standard error of the mean difference, from the differences chain by chain.
    pub error: Option<f64>,
    /// Evaluations per impact of the method.
    pub evaluations_per_impact: Option<f64>,
}

/// One realisation by one method: distinct gaps (none if it was given up), and cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Counted {
    distinct: Option<f64>,
    impacts: u64,
    evaluations: u64,
}

/// Realisations of one method at one σ.
pub type Part = Vec<Counted>;

/// The ensembles in units of work: for each scene the certified engine and then every setting.
pub const CUTTING: Cutting<BiasParams, Part, Biases> =
    Cutting { rows, part, fits: |_, unit, part| part.len() == unit.realisations.len(), join };

/// Runs everything.
pub fn run(parameters: &BiasParams, progress: &Progress) -> Result<Biases, Error> {
    CUTTING.run(parameters, "bias of methods", progress)
}

/// One ensemble: what is run of which scene by which method, and how often.
struct Ensemble {
    sigma: f64,
    protocol: Protocol,
    setting: Setting,
    realisations: usize,
}

/// Looks of a rival at one mass or gap, with their sines, that take as long as an impact in the engine.
const LOOKS: f64 = 30.0;

impl Ensemble {
    /// Work of one realisation, in impacts.
    fn weight(&self, chain: &Chain) -> u64 {
        let time = self.protocol.transient + self.protocol.window;
        let own = impact_chain::work(chain, self.sigma, time);
        let (impacts, masses) = (own as f64, chain.masses as f64);
        let grid = masses * time / self.setting.value;
        let looks = match self.setting.method {
            MethodName::Certified => return own,
            // At each point of the grid all gaps, and around an impact a root in its own.
            MethodName::Sampled => 4.0 * grid + 20.0 * impacts,
            // Integration stops at each impact, and starts anew with all masses.
            MethodName::RungeKutta => 25.0 * masses * impacts,
            // A step needs no sines of its own for each mass.
            MethodName::MoreauJean | MethodName::Verlet | MethodName::Penalty => 0.3 * grid,
        };
        1 + (looks / LOOKS) as u64
    }
}

fn ensembles(parameters: &BiasParams) -> Vec<Ensemble> {
    let most = parameters.settings.iter().map(|(_, n)| *n).max().unwrap_or(0);
    let own = (Setting { method: MethodName::Certified, value: 0.0 }, most);
    let of = |&(sigma, protocol): &(f64, Protocol)| {
        let settings = std::iter::once(own).chain(parameters.settings.iter().copied());
        settings.map(move |(setting, realisations)| Ensemble {
            sigma,
            protocol,
            setting,
            realisations,
        })
    };
    parameters.scenes.iter().flat_map(of).collect()
}

fn rows(parameters: &BiasParams) -> Vec<Row> {
    let row = |ensemble: &Ensemble| {
        let Setting { method, value } = ensemble.setting;
        let method = match method {
            MethodName::Certified => method.id().into(),
            _ => format!("{} at {value}", method.id()),
        };
        Row {
            covers: format!("{method}, sigma = {}", ensemble.sigma),
            realisations: ensemble.realisations,
            weight: ensemble.weight(&parameters.chain),
        }
    };
    ensembles(parameters).iter().map(row).collect()
}

fn part(own: &BiasParams, unit: &Unit, stage: &Stage, progress: &Progress) -> Result<Part, Error> {
    let ensemble = ensembles(own).swap_remove(unit.row);
    unit.each(stage, |index| {
        let mut normals = NormalPairs::new(&own.stream, own.seed, index);
        let scenario = Scenario::draw(&own.chain, ensemble.sigma, &mut normals);
        let counted = count(ensemble.setting, &scenario, ensemble.protocol, progress);
        progress.check()?;
        Ok(counted)
    })
}

fn join(parameters: &BiasParams, parts: Vec<Vec<Part>>, _: &Progress) -> Result<Biases, Error> {
    let (mut certified, mut rows) = (Vec::new(), Vec::new());
    let mut runs = parts.iter().map(|parts| parts.concat());
    for &(sigma, _) in &parameters.scenes {
        let ours = runs.next().unwrap_or_default();
        let counts: Vec<f64> = ours.iter().filter_map(|run| run.distinct).collect();
        certified.push(Own {
            sigma,
            realisations: counts.len() as u64,
            mean: mean(&counts).unwrap_or(0.0),
        });
        for (&(setting, _), theirs) in parameters.settings.iter().zip(runs.by_ref()) {
            let pairs: Vec<(f64, f64)> =
                theirs.iter().zip(&ours).filter_map(|(a, b)| a.distinct.zip(b.distinct)).collect();
            let differences: Vec<f64> = pairs.iter().map(|(a, b)| a - b).collect();
            rows.push(BiasRow {
                setting,
                sigma,
                pairs: pairs.len() as u64,
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
    let sum = |of: fn(&Counted) -> u64| runs.iter().map(of).sum::<u64>();
    let impacts = sum(|run| run.impacts);
    (impacts > 0).then(|| sum(|run| run.evaluations) as f64 / impacts as f64)
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
        Ok(Cost { impacts, evaluations, .. }) => {
            Counted { distinct: Some(distinct), impacts, evaluations }
        }
        Err(_) => Counted { distinct: None, impacts: 0, evaluations: 0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Profile;
    use impact_chain::{Counts, Ensemble, rise};

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
        let stream = parameters.stream.clone();
        let sweep = Ensemble { protocols: vec![short], stream, ..Ensemble::default() };
        let counts: Counts = (0..3).map(|i| sweep.realisation(0.3, i, || false).unwrap()).collect();
        let row = rise::Row::new(0.3, &counts, 0, 101, [None; 2]);
        assert_eq!(Some(found.certified[0].mean), row.mean_all.map(|mean| mean.value));
        // Against itself nothing differs; a coarse method differs, on chains of its own number.
        assert_eq!((found.rows[0].bias, found.rows[0].error), (Some(0.0), Some(0.0)));
        assert_eq!(found.rows[1].pairs, 2);
        assert_ne!(found.rows[1].bias, Some(0.0));
    }
}

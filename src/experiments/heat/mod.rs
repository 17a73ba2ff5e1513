//! How hot a running chain is: the variance of the free parts, and the balance of energy that sets it.

mod realisation;
pub(crate) mod warmth;

use self::realisation::realisation;
use super::cutting::{Cutting, Row, Unit};
use super::progress::Stage;
use super::{Error, Progress, weights};
use crate::numerics::statistics::Estimate;
use crate::params::{Boundary, Chain, HeatParams, HeatRow};
use serde::{Deserialize, Serialize};

/// How hot chains are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Heat {
    /// What was run.
    pub parameters: HeatParams,
    /// One for each ensemble.
    pub rows: Vec<Warmth>,
    /// One for each ensemble on a ring.
    pub ring: Vec<Warmth>,
    /// The mean of [`Warmth::balance`] over the ensembles with impacts, between walls and on a ring.
    pub balance: [Option<Estimate>; 2],
    /// (σ, p) with the balanced variance, to be drawn.
    pub balanced: Vec<[f64; 2]>,
    /// (r, s²/σ²) that the balance of rare impacts lets expect, to be drawn.
    pub expected: Vec<[f64; 2]>,
    /// σ at which p with the balanced variance reaches the jump of the most likely number, for N gaps.
    pub sigma_jump: f64,
}

/// One ensemble.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Warmth {
    /// Which.
    pub row: HeatRow,
    /// s²/σ² of each realisation when the window ends: the mean over its masses of half the sum of
    /// the squares of both free amplitudes, over σ².
    pub ratios: Vec<f64>,
    /// Their mean.
    pub ratio: Option<Estimate>,
    /// Masses that were hit in the window, over all realisations.
    pub hit: u64,
    /// Half the sum of squares of their free amplitudes, and their number times σ².
    pub warmth_of_hit: [f64; 2],
    /// s²/σ² of these alone.
    pub ratio_of_hit: Option<Estimate>,
    /// s²/σ² that the balance of rare impacts lets expect.
    pub expected: f64,
    /// Impacts of a mass with others in a unit of time, over the masses that were hit.
    pub rate: f64,
    /// s²/σ² that the balance lets expect at that rate.
    pub expected_at_rate: f64,
    /// 2 ⟨M V F⟩ / ((1 − r) ⟨M V²⟩) over all impacts in the window: one in a steady state.
    pub balance: Option<Estimate>,
    /// Sums of M V F and of (1 − r) M V²/2 over them.
    pub work: [f64; 2],
    /// Number of impacts of two masses, of each realisation.
    pub impacts: Vec<u64>,
    /// The largest difference between the change of energy in the window and the sum of the changes at
    /// impacts, over the energy lost at them; none where masses stayed in contact.
    pub imbalance: Option<f64>,
    /// Different gaps with an impact in the window, of each realisation.
    pub counts: Vec<u64>,
    /// Their mean.
    pub count: Option<Estimate>,
    /// Gaps that can close by themselves when the window ends (Y_0 + Y_1 ≥ d), of each realisation.
    pub closing: Vec<u64>,
    /// Their share of all gaps.
    pub p_measured: f64,
    /// Eq. (25).
    pub p: f64,
    /// p for a start from rest.
    pub p_rest: f64,
    /// p with free parts as hot as the balance says.
    pub p_balanced: f64,
    /// Realisations that the engine ended early.
    pub failed: usize,
}

impl Heat {
    /// The rows at the paper's restitution, with rising σ.
    pub fn rising(&self) -> impl Iterator<Item = &Warmth> {
        self.rows.iter().take(self.number_rising())
    }

    /// The rows at one σ, with rising restitution.
    pub fn others(&self) -> impl Iterator<Item = &Warmth> {
        self.rows.iter().skip(self.number_rising())
    }

    fn number_rising(&self) -> usize {
        let rise = |pair: &&[Warmth]| pair[0].row.sigma < pair[1].row.sigma;
        (1 + self.rows.windows(2).take_while(rise).count()).min(self.rows.len())
    }
}

/// One realisation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Half the sum of squares of the free amplitudes of all masses at the end.
    free: f64,
    /// The same of those that were hit in the window.
    free_of_hit: f64,
    /// Their number.
    hit: u64,
    /// Change of `free` in the window.
    changed: f64,
    /// Sum of the changes at impacts.
    gained: f64,
    /// Sum of what restitution took.
    lost: f64,
    /// Impacts of two masses in the window.
    impacts: u64,
    /// Sum of M V² over all impacts in the window.
    squares: f64,
    /// Sum of M V F.
    products: f64,
    /// Different gaps with an impact in the window.
    distinct: u64,
    /// Gaps that can close by themselves.
    closing: u64,
    /// Whether masses stayed in contact.
    contact: bool,
}

/// Some realisations of one ensemble; none where the engine gave up.
pub type Part = Vec<Option<Run>>;

/// The experiment in units of work.
pub const CUTTING: Cutting<HeatParams, Part, Heat> =
    Cutting { rows, part, fits, join: warmth::join };

/// Runs all ensembles.
///
/// # Errors
/// [`Error::Interrupted`]; [`Error::Dynamics`] if the chain is not allowed.
pub fn run(parameters: &HeatParams, progress: &Progress) -> Result<Heat, Error> {
    CUTTING.run(parameters, "heat", progress)
}

fn until(parameters: &HeatParams) -> f64 {
    parameters.protocol.transient + parameters.protocol.window
}

/// Each ensemble with its chain, those on a ring last.
fn ensembles(parameters: &HeatParams) -> impl Iterator<Item = (&HeatRow, Chain)> {
    let of = |boundary| {
        move |row: &HeatRow| Chain {
            restitution: row.restitution,
            boundary,
            ..parameters.chain.clone()
        }
    };
    let between_walls = of(parameters.chain.boundary);
    let walls = parameters.rows.iter().map(move |row| (row, between_walls(row)));
    let on_ring = of(Boundary::Ring);
    walls.chain(parameters.ring.iter().map(move |row| (row, on_ring(row))))
}

fn rows(parameters: &HeatParams) -> Vec<Row> {
    let row = |(row, chain): (&HeatRow, Chain)| Row {
        covers: format!("sigma = {}, r = {}, {:?}", row.sigma, row.restitution, chain.boundary),
        realisations: parameters.realisations,
        weight: weights::run(&chain, row.sigma, until(parameters)),
    };
    ensembles(parameters).map(row).collect()
}

fn part(
    parameters: &HeatParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Part, Error> {
    let Some((row, chain)) = ensembles(parameters).nth(unit.row) else { return Ok(Vec::new()) };
    unit.each(stage, |index| realisation(parameters, row, &chain, index, progress))
}

fn fits(parameters: &HeatParams, unit: &Unit, runs: &Part) -> bool {
    let (masses, gaps) = (parameters.chain.masses as u64, parameters.chain.gaps() as u64);
    let fits = |run: &Run| run.hit <= masses && run.closing <= gaps && run.distinct <= gaps;
    runs.len() == unit.realisations.len() && runs.iter().flatten().all(fits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circuits::balance::energy_change;
    use crate::dynamics::{Engine, Scenario};
    use crate::dynamics::{Initial, Simultaneous};
    use crate::params::{Profile, Protocol};

    fn small() -> HeatParams {
        let mut parameters = HeatParams::new(Profile::Quick);
        parameters.chain.masses = 12;
        parameters.protocol = Protocol { transient: 150.0, window: 60.0 };
        parameters.rows = vec![
            HeatRow { sigma: 0.03, restitution: 0.8 },
            HeatRow { sigma: 0.3, restitution: 0.8 },
            HeatRow { sigma: 0.3, restitution: 0.5 },
        ];
        parameters.ring = parameters.rows[1..2].to_vec();
        parameters.realisations = 5;
        parameters
    }

    #[test]
    fn one_impact_changes_the_energy_by_as_much() {
        // Two masses meet once, and a mass meets a wall: energies before and after by the engine.
        let omega = std::f64::consts::SQRT_2;
        for (free, hit) in [(vec![[0.5, 0.9], [-0.5, -0.7]], 1), (vec![[-0.9, -0.8], [0.0; 2]], 0)]
        {
            let scenario = Scenario {
                spacing: 1.0,
                natural_frequency: 1.0,
                forcing_frequency: omega,
                restitution: 0.7,
                boundary: Boundary::Walls,
                initial: Initial::Free(free),
                forcing: vec![[0.1, -0.2], [0.05, 0.15]],
                overtones: Vec::new(),
                simultaneous: Simultaneous::default(),
            };
            let mut engine = Engine::new(&scenario).unwrap();
            let energy = |engine: &Engine| -> f64 {
                engine.free_parts().iter().flatten().map(|x| 0.5 * x * x).sum()
            };
            let before = energy(&engine);
            let mut seen = None;
            engine
                .run(20.0, |impact| {
                    seen = Some(impact);
                    false
                })
                .unwrap();
            let impact = seen.unwrap();
            assert_eq!(impact.gap, hit);
            let velocity = |mass: usize| {
                let Some([a, b]) = mass.checked_sub(1).and_then(|j| scenario.forcing.get(j)) else {
                    return 0.0;
                };
                let (sin, cos) = pxfm::f_sincos(omega * impact.time);
                omega * (b * cos - a * sin) / (1.0 - omega * omega)
            };
            let forced = velocity(hit) - velocity(hit + 1);
            let mass = if hit == 0 { 1.0 } else { 0.5 };
            let change = energy_change(mass, 0.7, impact.closing_speed, forced);
            assert!((energy(&engine) - before - change).abs() < 1e-12, "{change}");
        }
    }

    #[test]
    fn energy_is_accounted_for_and_a_quiet_chain_is_as_it_started() {
        let heat = run(&small(), &Progress::silent()).unwrap();
        let [quiet, hot, tame] = &heat.rows[..] else { panic!() };
        assert_eq!((quiet.hit, quiet.p_measured, quiet.balance), (0, 0.0, None));
        assert_eq!(quiet.impacts, [0; 5]);
        // From rest a free part has amplitudes −α and −Ω/ω β: (1 + 2)/2 of σ² in the mean. Twelve
        // masses, five times: the mean of 120 squares.
        let ratio = quiet.ratio.unwrap();
        assert!((ratio.value - 1.5).abs() < 5.0 * ratio.error && ratio.error < 0.4, "{ratio:?}");
        assert_eq!(quiet.imbalance, Some(0.0));
        for row in [hot, tame, &heat.ring[0]] {
            assert!(row.imbalance.is_none_or(|off| off < 1e-10), "{:?}", row.imbalance);
            assert!(row.impacts.iter().all(|&n| n > 50) && row.hit > 50, "{row:?}");
        }
        assert!(hot.imbalance.is_some());
        // What a chain gains is what its balance is above one: changes of both over what restitution took.
        let [walls, ring] = heat.balance.map(|own| own.unwrap().value);
        assert_eq!(ring, heat.ring[0].balance.unwrap().value);
        let both = 0.5 * (hot.balance.unwrap().value + tame.balance.unwrap().value);
        assert!((walls - both).abs() < 1e-12 && (walls - 1.0).abs() < 0.2, "{walls} {both}");
        assert!(hot.ratio.unwrap().value > tame.ratio.unwrap().value);
        assert!(hot.p_measured > 0.5 && hot.p_balanced > hot.p_rest && hot.p_rest > hot.p);
        assert!((hot.expected - 18.0).abs() < 1e-12 && (tame.expected - 6.0).abs() < 1e-12);
    }
}

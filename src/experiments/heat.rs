//! How hot a running chain is: the variance of the free parts, and the balance of energy that sets it.

use super::cutting::{Cutting, Row, Unit};
use super::estimates::{average, average_count, ratio, sums};
use super::progress::Stage;
use super::{Error, Progress, weights};
use crate::circuits;
use crate::circuits::balance::{energy_change, variance_ratio};
use crate::circuits::distribution::{Law, SampleSpace};
use crate::circuits::impact_probability::{ImpactProbability, amplitude};
use crate::circuits::jump;
use crate::dynamics::{self, Engine, Scenario};
use crate::numerics::bisection;
use crate::numerics::random::NormalPairs;
use crate::numerics::statistics::Estimate;
use crate::params::{Chain, HeatParams, HeatRow};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// How hot chains are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Heat {
    /// What was run.
    pub parameters: HeatParams,
    /// One for each ensemble.
    pub rows: Vec<Warmth>,
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
    /// 2 ⟨V F⟩ / ((1 − r) ⟨V²⟩) over the impacts of two masses in the window: one in a steady state.
    pub balance: Option<Estimate>,
    /// Sums of V F and of (1 − r) V²/2 over those impacts.
    pub work: [f64; 2],
    /// Number of those impacts, of each realisation.
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
    /// Expected number of different impacts of N gaps: by [`Warmth::p`], [`Warmth::p_rest`],
    /// [`Warmth::p_balanced`] and the measured share of closing gaps.
    pub means: [f64; 4],
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
    /// Sum of V² over them.
    squares: f64,
    /// Sum of V F.
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
pub const CUTTING: Cutting<HeatParams, Part, Heat> = Cutting { rows, part, fits, join };

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

fn chain(parameters: &HeatParams, row: &HeatRow) -> Chain {
    Chain { restitution: row.restitution, ..parameters.chain.clone() }
}

fn rows(parameters: &HeatParams) -> Vec<Row> {
    let row = |row: &HeatRow| Row {
        covers: format!("sigma = {}, r = {}", row.sigma, row.restitution),
        realisations: parameters.realisations,
        weight: weights::run(&parameters.chain, row.sigma, until(parameters)),
    };
    parameters.rows.iter().map(row).collect()
}

fn part(
    parameters: &HeatParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Part, Error> {
    let row = &parameters.rows[unit.row];
    let weight = weights::run(&parameters.chain, row.sigma, until(parameters));
    let one = |index| {
        let found = realisation(parameters, row, index as u64, progress);
        stage.advance(weight);
        found
    };
    unit.realisations.clone().into_par_iter().with_max_len(1).map(one).collect()
}

fn fits(parameters: &HeatParams, unit: &Unit, runs: &Part) -> bool {
    let (masses, gaps) = (parameters.chain.masses as u64, parameters.chain.gaps() as u64);
    let fits = |run: &Run| run.hit <= masses && run.closing <= gaps && run.distinct <= gaps;
    runs.len() == unit.realisations.len() && runs.iter().flatten().all(fits)
}

/// Half the sum of squares of free amplitudes.
fn energy<'a>(parts: impl Iterator<Item = &'a [f64; 2]>) -> f64 {
    parts.map(|[a, b]| 0.5 * (a * a + b * b)).sum()
}

/// Amplitudes of the forced part of a mass, from 1; those of a wall are zero.
fn forced(scenario: &Scenario, mass: usize) -> [f64; 2] {
    let (omega, big_omega) = (scenario.natural_frequency, scenario.forcing_frequency);
    let factor = omega * omega - big_omega * big_omega;
    let own = mass.checked_sub(1).and_then(|index| scenario.forcing.get(index));
    own.map_or([0.0; 2], |pair| pair.map(|amplitude| amplitude / factor))
}

/// Closing speed of the forced parts of a gap.
fn forced_closing(scenario: &Scenario, gap: usize, time: f64) -> f64 {
    let big_omega = scenario.forcing_frequency;
    let (sin, cos) = pxfm::f_sincos(big_omega * time);
    let velocity = |[a, b]: [f64; 2]| big_omega * (b * cos - a * sin);
    velocity(forced(scenario, gap)) - velocity(forced(scenario, gap + 1))
}

fn realisation(
    parameters: &HeatParams,
    row: &HeatRow,
    index: u64,
    progress: &Progress,
) -> Result<Option<Run>, Error> {
    progress.check()?;
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(&chain(parameters, row), row.sigma, &mut normals);
    let fault = |source| Error::Dynamics { experiment: "heat", source };
    let mut engine = Engine::new(&scenario).map_err(fault)?;
    let ended = engine.run(parameters.protocol.transient, |_| true);
    progress.check()?;
    match ended {
        Ok(()) => {}
        Err(dynamics::Error::Work { .. }) => return Ok(None),
        Err(source) => return Err(fault(source)),
    }
    let before = energy(engine.free_parts().iter());
    let contacts = engine.counters().contact_phases;
    let masses = scenario.forcing.len();
    let mut run = Run::default();
    // One more at each end, for the walls.
    let mut hit = vec![false; masses + 2];
    let mut gaps = vec![false; masses + 1];
    let ended = engine.run(until(parameters), |impact| {
        let (v, r) = (impact.closing_speed, row.restitution);
        let f = forced_closing(&scenario, impact.gap, impact.time);
        let wall = impact.gap == 0 || impact.gap == masses;
        let reduced = if wall { 1.0 } else { 0.5 };
        run.gained += energy_change(reduced, r, v, f);
        run.lost += 0.5 * reduced * (1.0 - r * r) * v * v;
        if !wall {
            run.impacts += 1;
            run.squares += v * v;
            run.products += v * f;
        }
        gaps[impact.gap] = true;
        hit[impact.gap] = true;
        hit[impact.gap + 1] = true;
        !progress.stopped()
    });
    progress.check()?;
    match ended {
        Ok(()) => {}
        Err(dynamics::Error::Work { .. }) => return Ok(None),
        Err(source) => return Err(fault(source)),
    }
    let parts = engine.free_parts();
    let struck = || parts.iter().zip(&hit[1..]).filter(|(_, hit)| **hit).map(|(part, _)| part);
    run.free = energy(parts.iter());
    run.free_of_hit = energy(struck());
    run.hit = struck().count() as u64;
    run.changed = run.free - before;
    run.contact = engine.counters().contact_phases > contacts;
    run.distinct = gaps.iter().map(|&gap| u64::from(gap)).sum();
    run.closing = closing(&scenario, &parts);
    Ok(Some(run))
}

/// Gaps whose amplitudes reach from one mass to the other, Y_0 + Y_1/|ω² − Ω²| ≥ d.
fn closing(scenario: &Scenario, parts: &[[f64; 2]]) -> u64 {
    let free = |mass: usize| {
        let own = mass.checked_sub(1).and_then(|index| parts.get(index));
        own.copied().unwrap_or([0.0; 2])
    };
    let differ = |[a, b]: [f64; 2], [c, d]: [f64; 2]| amplitude(c - a, d - b);
    let reaches = |gap: &usize| {
        let own = differ(free(*gap), free(gap + 1));
        own + differ(forced(scenario, *gap), forced(scenario, gap + 1)) >= scenario.spacing
    };
    (0..scenario.gaps()).filter(reaches).count() as u64
}

fn join(
    parameters: &HeatParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<Heat, Error> {
    progress.check()?;
    let big_n = parameters.chain.gaps();
    let rows = parameters.rows.iter().zip(parts);
    let rows = rows.map(|(row, parts)| warmth(parameters, row, &parts.concat()));
    let rows = rows.collect::<Result<_, _>>().map_err(refused)?;
    let jump = jump::p_jump(SampleSpace::Simple, big_n).map_err(refused)?.p;
    let ratio = variance_ratio(&parameters.chain).map_err(refused)?;
    let reaches = |sigma: f64| balanced(&parameters.chain, sigma, ratio).unwrap_or(0.0) >= jump;
    let sigma_jump = bisection::bracket(0.0, 1.0, reaches)[1];
    let sigmas = (10..=90).map(|i| f64::from(i) / 200.0);
    let drawn = |sigma| Ok([sigma, balanced(&parameters.chain, sigma, ratio)?]);
    let restitutions = (40..100).map(|i| f64::from(i) / 100.0);
    let at = |r| Ok([r, variance_ratio(&Chain { restitution: r, ..parameters.chain.clone() })?]);
    Ok(Heat {
        parameters: parameters.clone(),
        rows,
        balanced: sigmas.map(drawn).collect::<Result<_, _>>().map_err(refused)?,
        expected: restitutions.map(at).collect::<Result<_, _>>().map_err(refused)?,
        sigma_jump,
    })
}

fn refused(error: circuits::Error) -> Error {
    Error::input("parameters", error.to_string(), "see src/params/heat.rs")
}

/// p of a chain whose free parts have that variance over σ².
fn balanced(chain: &Chain, sigma: f64, ratio: f64) -> Result<f64, circuits::Error> {
    gap(chain, sigma)?.heated(ratio)?.p()
}

fn gap(chain: &Chain, sigma: f64) -> Result<ImpactProbability, circuits::Error> {
    let (d, omega, big_omega) = (chain.spacing, chain.natural_frequency, chain.forcing_frequency);
    ImpactProbability::new(sigma, d, omega, big_omega)
}

fn warmth(parameters: &HeatParams, row: &HeatRow, runs: &Part) -> Result<Warmth, circuits::Error> {
    let chain = chain(parameters, row);
    let (masses, gaps) = (chain.masses as f64, chain.gaps());
    let sigma2 = row.sigma * row.sigma;
    let ran: Vec<&Run> = runs.iter().flatten().collect();
    let ratios: Vec<f64> = ran.iter().map(|run| run.free / (masses * sigma2)).collect();
    let of_hit: Vec<[f64; 2]> =
        ran.iter().map(|run| [run.free_of_hit, run.hit as f64 * sigma2]).collect();
    let loss = 0.5 * (1.0 - row.restitution);
    let work: Vec<[f64; 2]> = ran.iter().map(|run| [run.products, loss * run.squares]).collect();
    let imbalance = |run: &&Run| match run.lost > 0.0 {
        true => (run.changed - run.gained).abs() / run.lost,
        false => run.changed.abs(),
    };
    let each = |count: fn(&Run) -> u64| ran.iter().map(|run| count(run)).collect::<Vec<u64>>();
    let expected = variance_ratio(&chain)?;
    let law = gap(&chain, row.sigma)?;
    let (p, p_rest) = (law.p()?, law.p_from_rest()?);
    let p_balanced = balanced(&chain, row.sigma, expected)?;
    let counts: Vec<u64> = ran.iter().map(|run| run.distinct).collect();
    let closing = each(|run| run.closing);
    let mean_of = |p: f64| Ok(Law::new(SampleSpace::Simple, gaps, p)?.mean());
    let p_measured = closing.iter().sum::<u64>() as f64 / (gaps * ran.len()).max(1) as f64;
    Ok(Warmth {
        row: *row,
        ratio: average(&ratios),
        ratios,
        hit: each(|run| run.hit).iter().sum(),
        warmth_of_hit: sums(&of_hit, None),
        ratio_of_hit: ratio(&of_hit),
        expected,
        balance: ratio(&work),
        work: sums(&work, None),
        impacts: each(|run| run.impacts),
        count: average_count(&counts),
        counts,
        imbalance: (!ran.iter().any(|run| run.contact))
            .then(|| ran.iter().map(imbalance).fold(0.0, f64::max)),
        closing,
        p_measured,
        p,
        p_rest,
        p_balanced,
        means: [mean_of(p)?, mean_of(p_rest)?, mean_of(p_balanced)?, mean_of(p_measured)?],
        failed: runs.len() - ran.len(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::{Initial, Simultaneous};
    use crate::params::{Boundary, Profile, Protocol};

    fn small() -> HeatParams {
        let mut parameters = HeatParams::new(Profile::Quick);
        parameters.chain.masses = 12;
        parameters.protocol = Protocol { transient: 150.0, window: 60.0 };
        parameters.rows = vec![
            HeatRow { sigma: 0.03, restitution: 0.8 },
            HeatRow { sigma: 0.3, restitution: 0.8 },
            HeatRow { sigma: 0.3, restitution: 0.5 },
        ];
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
        for row in [hot, tame] {
            assert!(row.imbalance.is_none_or(|off| off < 1e-10), "{:?}", row.imbalance);
            assert!(row.impacts.iter().all(|&n| n > 50) && row.hit > 50, "{row:?}");
        }
        assert!(hot.imbalance.is_some());
        assert!(hot.ratio.unwrap().value > tame.ratio.unwrap().value);
        assert!(hot.p_measured > 0.5 && hot.p_balanced > hot.p_rest && hot.p_rest > hot.p);
        assert!((hot.expected - 18.0).abs() < 1e-12 && (tame.expected - 6.0).abs() < 1e-12);
    }
}

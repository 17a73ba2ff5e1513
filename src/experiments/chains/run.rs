//! One realisation: forces of several components, strokes of damping, counts by pieces.

use super::super::nucleation::differences;
use super::super::{Error, Progress};
use super::{Run, chain, pieces};
use crate::dynamics::{self, Engine, Impact, Initial, Overtone, Scenario};
use crate::numerics::random::NormalPairs;
use crate::params::{Boundary, ChainCurve, ChainsParams};

/// Squares of the frequencies of the components after the first, in units of ω². With √2 and 1 these roots
/// have no sum with whole coefficients that is zero: no number under a root is a square times another.
pub const FREQUENCIES: [f64; 7] = [3.0, 5.0, 6.0, 7.0, 10.0, 11.0, 13.0];

/// A chain whose force has several components, Eq. (3). All give rise to equally large motions, and together
/// to motions as large as one component with this σ gives.
pub(super) fn draw(
    parameters: &ChainsParams,
    curve: &ChainCurve,
    sigma: f64,
    normals: &mut NormalPairs,
) -> Scenario {
    let each = sigma / (curve.components as f64).sqrt();
    let mut scenario = Scenario::draw(&chain(parameters, curve), each, normals);
    let square = scenario.natural_frequency * scenario.natural_frequency;
    let detuning = |frequency: f64| (square - frequency * frequency).abs();
    let first = detuning(scenario.forcing_frequency);
    for own in FREQUENCIES.iter().take(curve.components.saturating_sub(1)) {
        let frequency = (own * square).sqrt();
        let scale = each * detuning(frequency) / first;
        let amplitudes = (0..curve.masses).map(|_| normals.pair().map(|x| scale * x)).collect();
        scenario.overtones.push(Overtone { frequency, amplitudes });
    }
    scenario
}

/// Gaps that the forced motion alone closes: the sum of the amplitudes of its components exceeds d.
pub(super) fn open(scenario: &Scenario) -> u32 {
    let square = scenario.natural_frequency * scenario.natural_frequency;
    let mut widest = vec![0.0; scenario.gaps()];
    for (frequency, amplitudes) in scenario.components() {
        let response = 1.0 / (square - frequency * frequency).abs();
        let mut between: Vec<[f64; 2]> = differences(amplitudes).collect();
        if scenario.boundary == Boundary::Ring {
            // Its first gap is that of the last mass and the first.
            let last = between.pop().unwrap_or_default();
            between[0] = [0, 1].map(|i| between[0][i] + last[i]);
        }
        for (sum, [a, b]) in widest.iter_mut().zip(between) {
            *sum += response * (a * a + b * b).sqrt();
        }
    }
    widest.iter().filter(|own| **own > scenario.spacing).count() as u32
}

/// A chain on its way, with strokes of damping.
///
/// Between strokes the motion is the engine's. At a stroke every velocity falls by the same factor
/// e^{−2c h} that a friction 2cẋ takes in the time h between two strokes: the law of a viscous friction
/// that acts on and off, and that law itself as h → 0.
pub(super) struct Journey {
    scenario: Scenario,
    engine: Engine,
    /// The engine's clock began at this time.
    begun: f64,
    /// Number of the next stroke, time between two, and their factor; none without damping.
    strokes: Option<(u64, f64, f64)>,
}

impl Journey {
    pub fn new(scenario: Scenario, damping: f64, stroke: f64) -> Result<Journey, dynamics::Error> {
        let strokes = (damping > 0.0).then(|| (1, stroke, pxfm::f_exp(-2.0 * damping * stroke)));
        Ok(Journey { engine: Engine::new(&scenario)?, scenario, begun: 0.0, strokes })
    }

    /// Goes on until a time; impacts come with theirs.
    pub fn run(
        &mut self,
        until: f64,
        mut sink: impl FnMut(Impact) -> bool,
    ) -> Result<(), dynamics::Error> {
        while let Some((number, every, factor)) = self.strokes {
            let time = number as f64 * every;
            if time > until {
                break;
            }
            self.engine.run(time - self.begun, &mut sink)?;
            self.strike(time, factor)?;
            self.strokes = Some((number + 1, every, factor));
        }
        self.engine.run(until - self.begun, sink)
    }

    /// Positions at a time since the last event.
    #[cfg(test)]
    pub fn place(&self, time: f64) -> Vec<f64> {
        self.engine.positions(time - self.begun)
    }

    fn strike(&mut self, time: f64, factor: f64) -> Result<(), dynamics::Error> {
        let mut now = self.scenario.later(&self.engine.free_parts(), time - self.begun);
        let omega = now.natural_frequency;
        // Time is zero: velocities are ω b, and Ω β/(ω² − Ω²) of each component of the force.
        let mut lost: Vec<f64> = vec![0.0; now.forcing.len()];
        for (frequency, amplitudes) in now.components() {
            let response = frequency / (omega * omega - frequency * frequency);
            lost.iter_mut().zip(amplitudes).for_each(|(sum, [_, beta])| *sum += response * beta);
        }
        if let Initial::Free(parts) = &mut now.initial {
            for ([_, b], forced) in parts.iter_mut().zip(lost) {
                *b = factor * *b + (factor - 1.0) * forced / omega;
            }
        }
        self.engine = Engine::new(&now)?;
        (self.scenario, self.begun) = (now, time);
        Ok(())
    }
}

pub(super) fn realisation(
    parameters: &ChainsParams,
    curve: &ChainCurve,
    sigma: f64,
    index: u64,
    progress: &Progress,
) -> Result<Option<Run>, Error> {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = draw(parameters, curve, sigma, &mut normals);
    let open = open(&scenario);
    let sizes = pieces(scenario.gaps(), parameters.piece);
    let mut counts = Vec::with_capacity(curve.transients.len());
    let go = || {
        let mut motion = Journey::new(scenario, curve.damping, parameters.stroke)?;
        for transient in &curve.transients {
            motion.run(*transient, |_| !progress.stopped())?;
            let mut hit = vec![false; sizes.iter().sum()];
            motion.run(transient + parameters.window, |impact| {
                // A ring counts its gaps from 1.
                let gap = impact.gap % hit.len();
                hit[gap] = true;
                !progress.stopped()
            })?;
            let mut rest = hit.as_slice();
            let of = |size: &usize| {
                let (own, after) = rest.split_at(*size);
                rest = after;
                own.iter().map(|&hit| u32::from(hit)).sum()
            };
            counts.push(sizes.iter().map(of).collect());
        }
        Ok(())
    };
    let ended = go();
    progress.check()?;
    match ended {
        Ok(()) => Ok(Some(Run { counts, open })),
        // Masses in contact at a stroke may be left an ulp inside each other.
        Err(dynamics::Error::Work { .. } | dynamics::Error::Overlap { .. }) => Ok(None),
        Err(source) => Err(Error::failed("chains", source)),
    }
}

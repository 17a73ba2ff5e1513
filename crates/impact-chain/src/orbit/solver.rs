//! The times of the impacts of a periodic orbit, by Newton's method.

use super::PeriodicKick;
use crate::Boundary;
use crate::{Error, Scenario};
use impact_numerics::dense::Square;

/// Impacts in a period at most.
const LONGEST: usize = 64;

/// Newton steps before a start is given up.
const STEPS: usize = 25;

/// Halvings of a step before a start is given up.
const HALVINGS: usize = 5;

/// Steps shorter than this are of the size of rounding, and may go either way.
const SETTLED: f64 = 1e-11;

/// Gaps smaller than this, over d, are shut.
const SHUT: f64 = 1e-13;

/// The equations of a periodic orbit with given impacts.
#[derive(Clone, Debug)]
pub struct Solver<'a> {
    scenario: &'a Scenario,
    gaps: Vec<usize>,
    period: f64,
    kick: PeriodicKick,
}

/// A periodic solution of the impact equations; whether it is a motion of the chain, [`super::replay()`] says.
#[derive(Clone, Debug, PartialEq)]
pub struct Orbit {
    /// The gap of each impact: its circuit.
    pub gaps: Vec<usize>,
    /// The times of the impacts, rising, the first in [0, P).
    pub times: Vec<f64>,
    /// The momentum that each impact passes to its right (at the right wall: to its left).
    pub impulses: Vec<f64>,
    /// The speeds of closing.
    pub speeds: Vec<f64>,
    /// The free parts (a, b) of the masses at t = 0.
    pub free: Vec<[f64; 2]>,
    /// The period P.
    pub period: f64,
}

/// The equations at given times.
struct Residual {
    /// The gaps at the impacts.
    open: Vec<f64>,
    /// The impulses.
    impulses: Vec<f64>,
    /// Displacement of each gap by each impulse.
    place: Square,
    /// Restitution: this times the impulses is the closing speed of the forced parts.
    velocity: Square,
    /// The forced parts of the gaps: value, first and second rate.
    forced: Vec<[f64; 3]>,
}

impl<'a> Solver<'a> {
    /// For the impacts `gaps`, in this cyclic order, within `periods` periods of the forcing.
    ///
    /// # Errors
    /// [`Error::Input`] if the scenario is invalid, has a ring or several components of forcing, or if
    /// there is no impact, one of another chain or too many, or no period.
    pub fn new(scenario: &'a Scenario, gaps: &[usize], periods: usize) -> Result<Self, Error> {
        scenario.validate()?;
        if scenario.boundary != Boundary::Walls || !scenario.overtones.is_empty() {
            let problem = "periodic orbits are solved between walls with one forcing frequency";
            return Err(Error::input("scenario", problem, "give such a scenario"));
        }
        if gaps.is_empty() || gaps.len() > LONGEST || gaps.iter().any(|&g| g >= scenario.gaps()) {
            let problem = format!("{gaps:?} are not the impacts of a circuit of this chain");
            return Err(Error::input("gaps", problem, format!("give 1 to {LONGEST} of its gaps")));
        }
        if periods == 0 {
            return Err(Error::input("periods", "there is none", "give a number from 1"));
        }
        let period = periods as f64 * std::f64::consts::TAU / scenario.forcing_frequency;
        let kick = PeriodicKick::new(scenario.natural_frequency, period);
        Ok(Solver { scenario, gaps: gaps.to_vec(), period, kick })
    }

    /// The period P.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The orbit to which Newton's method comes from these times, which rise by less than P in all; none if
    /// it does not settle, if the order of the impacts is lost, or if a gap is hit from behind.
    pub fn from(&self, times: &[f64]) -> Option<Orbit> {
        let mut times = times.to_vec();
        let mut here = self.residual(&times)?;
        let size = |open: &[f64]| open.iter().fold(0.0, |sum: f64, x| sum + x * x);
        for _ in 0..STEPS {
            let mut shift = [here.open.clone()];
            let now = size(&here.open);
            if self.jacobian(&here).solve(&mut shift) == 0.0 {
                return None;
            }
            let longest = shift[0].iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            // No time moves by more than a quarter of a period at once.
            let mut part = (0.25 * self.period / longest).min(1.0);
            let mut tried = 0;
            let (next, found) = loop {
                let next: Vec<f64> =
                    times.iter().zip(&shift[0]).map(|(t, x)| t - part * x).collect();
                if self.ordered(&next)
                    && let Some(found) = self.residual(&next)
                    && (size(&found.open) < now || longest < SETTLED)
                {
                    break (next, found);
                }
                tried += 1;
                if tried > HALVINGS {
                    return None;
                }
                part *= 0.5;
            };
            (times, here) = (next, found);
            let worst = here.open.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            if worst < SHUT * self.scenario.spacing {
                return self.orbit(times, here.impulses);
            }
        }
        None
    }

    fn ordered(&self, times: &[f64]) -> bool {
        let span = times[times.len() - 1] - times[0];
        times.windows(2).all(|pair| pair[0] < pair[1]) && span < self.period
    }

    /// How strongly an impulse in one gap moves another gap: its right side forwards, its left back.
    fn coupling(&self, gap: usize, other: usize) -> f64 {
        let masses = self.scenario.forcing.len();
        match gap.abs_diff(other) {
            0 if gap == 0 || gap == masses => 1.0,
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        }
    }

    /// The forced part of a gap: value and first and second rate.
    pub(super) fn forced(&self, gap: usize, time: f64) -> [f64; 3] {
        let (w, big_w) = (self.scenario.natural_frequency, self.scenario.forcing_frequency);
        let own = |mass: usize| {
            let pair = mass.checked_sub(1).and_then(|j| self.scenario.forcing.get(j));
            pair.copied().unwrap_or([0.0; 2])
        };
        let ([a, b], [c, d]) = (own(gap), own(gap + 1));
        let factor = (w - big_w) * (w + big_w);
        let [cosine, sine] = [(c - a) / factor, (d - b) / factor];
        let (sin, cos) = pxfm::f_sincos(big_w * time);
        let value = cosine * cos + sine * sin;
        [value, big_w * (sine * cos - cosine * sin), -(big_w * big_w * value)]
    }

    /// Solves restitution for the impulses, and says how far the gaps are open then; none if there is no solution.
    fn residual(&self, times: &[f64]) -> Option<Residual> {
        let k = times.len();
        let (d, r) = (self.scenario.spacing, self.scenario.restitution);
        let (mut velocity, mut place) = (Square::zero(k), Square::zero(k));
        let forced: Vec<[f64; 3]> =
            times.iter().zip(&self.gaps).map(|(&t, &gap)| self.forced(gap, t)).collect();
        for i in 0..k {
            for j in 0..k {
                let coupling = self.coupling(self.gaps[i], self.gaps[j]);
                if coupling == 0.0 {
                    continue;
                }
                let [u, v] = self.kick.after(self.kick.since(times[j], times[i]));
                place[(i, j)] = coupling * u;
                velocity[(i, j)] = coupling * v;
            }
            // Before its own kick the velocity is −1/2 of a unit, and the kick is (1 + r)/K times the speed.
            let own = self.coupling(self.gaps[i], self.gaps[i]);
            velocity[(i, i)] = own * (1.0 - r) / (2.0 * (1.0 + r));
        }
        let mut impulses = [forced.iter().map(|[_, rate, _]| -rate).collect()];
        if velocity.clone().solve(&mut impulses) == 0.0 {
            return None;
        }
        let [impulses] = impulses;
        let open =
            |i: usize| (0..k).fold(d + forced[i][0], |sum, j| sum + place[(i, j)] * impulses[j]);
        let open: Vec<f64> = (0..k).map(open).collect();
        let finite = open.iter().all(|x| x.is_finite());
        finite.then_some(Residual { open, impulses, place, velocity, forced })
    }

    /// Derivatives of the gaps at the impacts by the times, with the impulses following restitution.
    fn jacobian(&self, here: &Residual) -> Square {
        let k = here.open.len();
        let w2 = self.scenario.natural_frequency * self.scenario.natural_frequency;
        // Of the restitution equations by the times, column by column; then of the impulses.
        let mut columns = vec![vec![0.0; k]; k];
        let mut jacobian = Square::zero(k);
        for i in 0..k {
            for j in (0..k).filter(|&j| j != i) {
                let rate = here.velocity[(i, j)] * here.impulses[j];
                let second = -w2 * here.place[(i, j)] * here.impulses[j];
                jacobian[(i, j)] -= rate;
                jacobian[(i, i)] += rate;
                columns[j][i] += second;
                columns[i][i] -= second;
            }
            jacobian[(i, i)] += here.forced[i][1];
            columns[i][i] -= here.forced[i][2];
        }
        here.velocity.clone().solve(&mut columns);
        for i in 0..k {
            for (j, column) in columns.iter().enumerate() {
                jacobian[(i, j)] += (0..k).fold(0.0, |sum, l| sum + here.place[(i, l)] * column[l]);
            }
        }
        jacobian
    }

    fn orbit(&self, mut times: Vec<f64>, impulses: Vec<f64>) -> Option<Orbit> {
        let r = self.scenario.restitution;
        if impulses.iter().any(|&impulse| impulse <= 0.0) {
            return None;
        }
        let speed = |(&gap, impulse): (&usize, &f64)| impulse * self.coupling(gap, gap) / (1.0 + r);
        let mut speeds: Vec<f64> = self.gaps.iter().zip(&impulses).map(speed).collect();
        let (mut gaps, mut impulses) = (self.gaps.clone(), impulses);
        // Into [0, P), the earliest first.
        times.iter_mut().for_each(|t| *t -= self.period * (*t / self.period).floor());
        let first =
            (0..times.len()).fold(0, |best, i| if times[i] < times[best] { i } else { best });
        times.rotate_left(first);
        gaps.rotate_left(first);
        impulses.rotate_left(first);
        speeds.rotate_left(first);
        let mut free = vec![[0.0; 2]; self.scenario.forcing.len()];
        let w = self.scenario.natural_frequency;
        for i in 0..times.len() {
            let [u, v] = self.kick.after(self.kick.since(times[i], 0.0));
            for (mass, sign) in [(gaps[i], -1.0), (gaps[i] + 1, 1.0)] {
                if let Some([a, b]) = mass.checked_sub(1).and_then(|j| free.get_mut(j)) {
                    *a += sign * impulses[i] * u;
                    *b += sign * impulses[i] * v / w;
                }
            }
        }
        Some(Orbit { gaps, times, impulses, speeds, free, period: self.period })
    }
}

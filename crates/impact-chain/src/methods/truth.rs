//! Computes the motion of a chain to 106 bits, with which every method is compared.
//!
//! Nothing is taken from the engine or its search. Each gap goes from an instant at which it is
//! certainly open to the next, the zero of a parabola below it, until these instants converge.
//! Chaos enlarges 1e−31 to 1e−3 in about twice the time of the rounding of doubles, so runs are
//! right far beyond the horizon of any method.

use super::method::Task;
use super::rival::{Rival, Run};
use crate::{Boundary, Error, Scenario, State};
pub use impact_numerics::double_double::DoubleDouble;
use impact_numerics::double_double::sin_cos;

/// The true motion as a method.
///
/// - Source: this project, [`TrueMotion`].
/// - Order: none, it has no step. Times are right to some thirty digits as long as the gaps are.
/// - Fails: a ring, several frequencies and gaps that touch without speed are refused.
#[derive(Clone, Copy, Debug, Default)]
pub struct Truth;

fn refused(field: &str, problem: impl Into<String>) -> Error {
    Error::input(field, problem, "use another method")
}

impl Rival for Truth {
    const NAME: &'static str = "truth";

    fn begin(&self, Task { scenario, start, until }: Task) -> Result<Run, Error> {
        if scenario.boundary == Boundary::Ring {
            return Err(refused("boundary", "truth supports walls only"));
        }
        if !scenario.overtones.is_empty() {
            return Err(refused("forcing_frequencies", "truth supports one frequency only"));
        }
        scenario.check_uniform()?;
        start.displacements(scenario)?;
        let mut motion = TrueMotion::from_state(scenario, start);
        Ok(Box::new(move |tally| {
            while let Some(hit) = motion.next(until)? {
                motion.advance(&hit);
                tally.impact(hit.gap, hit.time.to_f64(), hit.closing_speed)?;
            }
            Ok(())
        }))
    }
}

fn dd(x: f64) -> DoubleDouble {
    DoubleDouble::from(x)
}

/// The true motion of a chain. Bodies count from the left wall (0) to the right one (n + 1).
#[derive(Clone, Debug)]
pub struct TrueMotion {
    scenario: Scenario,
    rates: [DoubleDouble; 2],
    /// Free parts (a, b) of the bodies.
    free: Vec<[DoubleDouble; 2]>,
    /// Forced responses (c, s) of the bodies.
    forced: Vec<[DoubleDouble; 2]>,
    time: DoubleDouble,
    /// The gap that has just been hit and is shut now.
    shut: Option<usize>,
    /// The time until which each gap is certainly open.
    open: Vec<DoubleDouble>,
}

/// An impact of the true motion.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Hit {
    /// Time t, to some thirty digits.
    pub time: DoubleDouble,
    /// The gap, as in [`Impact`](crate::Impact).
    pub gap: usize,
    /// −Δ' just before the impact.
    pub closing_speed: f64,
}

/// Separation speed, in units of d ω, up to which a gap does not open.
const AT_REST: f64 = 1e-10;

/// A gap is shut when it is certainly open for less than this, in units of 1 + t.
const CONVERGED: f64 = 1e-30;

const FOR_EVER: f64 = 1e300;

const INFLATION: f64 = 1.0 + 1e-12;

type TruePhases = [[DoubleDouble; 2]; 2];

impl TrueMotion {
    /// Starts exactly at a state: one component of forcing, no contact, walls at both ends.
    pub fn from_state(scenario: &Scenario, state: &State) -> TrueMotion {
        let rates = [scenario.natural_frequency, scenario.forcing_frequency].map(dd);
        let factor = rates[0] * rates[0] - rates[1] * rates[1];
        let n = scenario.forcing.len();
        let mut forced = vec![[DoubleDouble::ZERO; 2]; n + 2];
        for (forced, pair) in forced[1..].iter_mut().zip(&scenario.forcing) {
            *forced = pair.map(|x| dd(x) / factor);
        }
        let free = vec![[DoubleDouble::ZERO; 2]; n + 2];
        let (scenario, time) = (scenario.clone(), dd(state.time));
        let open = vec![time; n + 1];
        let mut truth = TrueMotion { scenario, rates, free, forced, time, shut: None, open };
        let phases = truth.phases(time);
        for m in 1..=n {
            let [v, rate] = truth.forced_motion(m, &phases);
            let u = dd(state.positions[m - 1]) - truth.place(m) - v;
            let quadrature = (dd(state.velocities[m - 1]) - rate) / rates[0];
            let [sin, cos] = phases[0];
            truth.free[m] = [u * cos - quadrature * sin, u * sin + quadrature * cos];
        }
        truth
    }

    fn phases(&self, t: DoubleDouble) -> TruePhases {
        self.rates.map(|rate| sin_cos(rate * t))
    }

    fn place(&self, m: usize) -> DoubleDouble {
        dd(self.scenario.spacing) * m as f64
    }

    fn forced_motion(&self, m: usize, [_, [sin, cos]]: &TruePhases) -> [DoubleDouble; 2] {
        let [c, s] = self.forced[m];
        [c * *cos + s * *sin, self.rates[1] * (s * *cos - c * *sin)]
    }

    fn motion(&self, m: usize, phases: &TruePhases) -> [DoubleDouble; 2] {
        let [v, rate] = self.forced_motion(m, phases);
        let [a, b] = self.free[m];
        let [sin, cos] = phases[0];
        [a * cos + b * sin + v, self.rates[0] * (b * cos - a * sin) + rate]
    }

    fn gap(&self, gap: usize, phases: &TruePhases) -> [DoubleDouble; 2] {
        let [left, right] = [gap, gap + 1].map(|m| self.motion(m, phases));
        [dd(self.scenario.spacing) + (right[0] - left[0]), right[1] - left[1]]
    }

    /// Returns the amplitudes R₁ and R₂ of a gap's free and forced part until a side is hit.
    fn amplitudes(&self, gap: usize) -> [f64; 2] {
        [&self.free, &self.forced].map(|parts| {
            let [left, right] = [gap, gap + 1].map(|m| parts[m].map(DoubleDouble::to_f64));
            let [x, y] = [right[0] - left[0], right[1] - left[1]];
            (x * x + y * y).sqrt()
        })
    }

    /// Returns d + R₁ + R₂ of a gap: the scale of its rounding.
    #[must_use]
    pub fn scale(&self, gap: usize) -> f64 {
        self.amplitudes(gap).iter().fold(self.scenario.spacing, |sum, r| sum + r)
    }

    /// Returns the present state, rounded to doubles; the gap just hit is shut to the last bit.
    pub fn state(&self) -> State {
        let (n, phases) = (self.scenario.forcing.len(), self.phases(self.time));
        let motions = (1..=n).map(|m| {
            let [u, rate] = self.motion(m, &phases);
            ((u + self.place(m)).to_f64(), rate.to_f64())
        });
        let (mut positions, velocities): (Vec<f64>, Vec<f64>) = motions.unzip();
        match self.shut {
            Some(0) => positions[0] = 0.0,
            Some(gap) if gap < n => positions[gap] = positions[gap - 1],
            Some(_) => positions[n - 1] = self.scenario.spacing * (n + 1) as f64,
            None => (),
        }
        State { time: self.time.to_f64(), positions, velocities }
    }

    /// Finds the next impact up to `until`, or none; a gap that touches without speed is an error.
    pub fn next(&mut self, until: f64) -> Result<Option<Hit>, Error> {
        loop {
            let earlier = |a: usize, b: usize| if self.open[b] < self.open[a] { b } else { a };
            let gap = (1..self.open.len()).fold(0, earlier);
            let time = self.open[gap];
            if time > dd(until) {
                return Ok(None);
            }
            let [width, rate] = self.gap(gap, &self.phases(time));
            let is_shut = time == self.time && self.shut == Some(gap);
            let width = if is_shut { DoubleDouble::ZERO } else { width };
            let wait = self.certainly_open(gap, width, rate);
            if wait.hi > CONVERGED * (1.0 + time.hi.abs()) {
                self.open[gap] = time + wait;
                continue;
            }
            let Scenario { spacing, natural_frequency, restitution, .. } = self.scenario;
            let closing_speed = -rate.to_f64();
            if restitution * closing_speed <= AT_REST * spacing * natural_frequency {
                let problem = format!(
                    "gap {gap} comes to rest at t = {}; truth does not support contact",
                    time.to_f64()
                );
                return Err(refused("restitution", problem));
            }
            return Ok(Some(Hit { time, gap, closing_speed }));
        }
    }

    /// Returns a time for which a gap is certainly open: to the zero of f + g s − b s²/2, where b
    /// bounds its second derivative; for ever if its amplitudes add up to less than d.
    fn certainly_open(&self, gap: usize, f: DoubleDouble, g: DoubleDouble) -> DoubleDouble {
        let [free, forced] = self.amplitudes(gap).map(|r| r * INFLATION);
        if free + forced < self.scenario.spacing {
            return dd(FOR_EVER);
        }
        let [w, big_w] = self.rates.map(DoubleDouble::to_f64);
        let b = w * w * free + big_w * big_w * forced;
        let root = (g * g + f * (2.0 * b)).sqrt();
        if g.hi < 0.0 { f * 2.0 / (root - g) } else { (g + root) / dd(b) }
    }

    /// Carries out the impact that [`next`](TrueMotion::next) found.
    pub fn advance(&mut self, hit: &Hit) {
        let phases = self.phases(hit.time);
        let [_, rate] = self.gap(hit.gap, &phases);
        let sides = [(hit.gap, -1.0), (hit.gap + 1, 1.0)];
        let masses = sides.iter().filter(|(m, _)| (1..=self.scenario.forcing.len()).contains(m));
        // Two equal masses share the jump, a wall leaves all of it to its mass.
        let shared = 1.0 / masses.clone().count() as f64;
        let jump = -rate * (dd(1.0) + dd(self.scenario.restitution)) * shared / self.rates[0];
        let [sin, cos] = phases[0];
        for &(m, sign) in masses {
            let [a, b] = self.free[m];
            self.free[m] = [a - jump * sin * sign, b + jump * cos * sign];
        }
        (self.time, self.shut) = (hit.time, Some(hit.gap));
        for near in hit.gap.saturating_sub(1)..=(hit.gap + 1).min(self.open.len() - 1) {
            self.open[near] = hit.time;
        }
    }

    /// Runs to time `until`; returns the impacts, with the state right after each.
    pub fn run(&mut self, until: f64) -> Result<Vec<(Hit, State)>, Error> {
        let mut hits = Vec::new();
        while let Some(hit) = self.next(until)? {
            self.advance(&hit);
            hits.push((hit, self.state()));
        }
        Ok(hits)
    }
}

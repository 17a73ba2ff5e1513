//! Computes the motion of a chain to 106 bits, with which every method is compared.
//!
//! The certified engine, started from the state rounded to doubles, finds which gap closes next;
//! the instant, and all that follows from it, is then computed by Newton's iteration on plain
//! amplitudes of 106 bits. Chaos enlarges 1e−31 to 1e−3 in about twice the time in which it
//! enlarges the rounding of doubles, so runs are right far beyond the horizon of any method. A tie
//! of two gaps within the rounding of doubles could be taken in the wrong order; it has a
//! probability of about 1e−14 an impact.

use super::certified::Certified;
use super::method::{Cost, Method, Task};
use super::steps::check_end;
use super::tally::{Stop, Tally};
use crate::contact::CONTACT_SPEED;
use crate::{Boundary, Engine, Error, Impact, Scenario, Sink, State};
use impact_numerics::double_double::{DoubleDouble, sin_cos};

/// The true motion as a method.
///
/// - Source: this project, [`TrueMotion`].
/// - Order: none, it has no step. Times are right to some thirty digits as long as the gaps are.
/// - Fails: it shares the engine's choice of the next gap, so it misses an impact that the engine
///   misses. A ring, several frequencies and contact are refused.
#[derive(Clone, Copy, Debug, Default)]
pub struct Truth;

const REMEDY: &str = "use another method";

impl Method for Truth {
    fn name(&self) -> &'static str {
        "truth"
    }

    fn run(&self, (scenario, start, until): Task, sink: Sink) -> Result<Cost, Error> {
        check_end(until)?;
        let refused = |field: &str, problem: &str| Error::input(field, problem, REMEDY);
        if scenario.boundary == Boundary::Ring {
            return Err(refused("boundary", "truth supports walls only"));
        }
        if !scenario.overtones.is_empty() {
            return Err(refused("forcing_frequencies", "truth supports one frequency only"));
        }
        scenario.check_uniform()?;
        let engine = Engine::new(&start.as_scenario(scenario)?)?;
        if !engine.contacts(0.0)?.is_empty() {
            return Err(refused("initial", "a gap is in contact, which truth does not support"));
        }
        let slow = CONTACT_SPEED * scenario.spacing * scenario.natural_frequency;
        let mut tally = Tally::new(scenario, sink);
        let mut motion = TrueMotion::of(scenario, start);
        let mut run = || -> Result<(), Stop> {
            while let Some(hit) = motion.next(until)? {
                let (gap, time, speed) = (hit.gap, hit.time.to_f64(), hit.closing_speed);
                if scenario.restitution * speed <= slow {
                    let problem = format!(
                        "gap {gap} comes to rest at t = {time}; truth does not support contact"
                    );
                    return Err(refused("restitution", &problem).into());
                }
                motion.advance(&hit);
                tally.impact(gap, time, speed)?;
            }
            Ok(())
        };
        let ended = run();
        tally.finish(ended)
    }
}

fn dd(x: f64) -> DoubleDouble {
    DoubleDouble::from(x)
}

/// The true motion of a chain between walls. Bodies are numbered from the left wall (0) to the
/// right one (n + 1).
#[derive(Clone, Debug)]
pub struct TrueMotion {
    scenario: Scenario,
    /// ω and Ω.
    rates: [DoubleDouble; 2],
    /// Free parts (a, b) of the bodies.
    free: Vec<[DoubleDouble; 2]>,
    /// Forced responses (c, s) of the bodies.
    forced: Vec<[DoubleDouble; 2]>,
    time: DoubleDouble,
    /// The gap that has just been hit and is shut now.
    shut: Option<usize>,
}

/// An impact of the true motion.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    pub time: DoubleDouble,
    pub gap: usize,
    /// −Δ' just before the impact.
    pub closing_speed: f64,
}

/// Sine and cosine of ωt and Ωt.
type TruePhases = [[DoubleDouble; 2]; 2];

impl TrueMotion {
    /// Starts the chain of a scenario from exactly the state that is given. It must have one
    /// component of forcing, no contact, and walls at both ends.
    pub fn of(scenario: &Scenario, state: &State) -> TrueMotion {
        let rates = [scenario.natural_frequency, scenario.forcing_frequency].map(dd);
        let factor = rates[0] * rates[0] - rates[1] * rates[1];
        let n = scenario.forcing.len();
        let mut forced = vec![[DoubleDouble::ZERO; 2]; n + 2];
        for (forced, pair) in forced[1..].iter_mut().zip(&scenario.forcing) {
            *forced = pair.map(|x| dd(x) / factor);
        }
        let free = vec![[DoubleDouble::ZERO; 2]; n + 2];
        let (scenario, time) = (scenario.clone(), dd(state.time));
        let mut truth = TrueMotion { scenario, rates, free, forced, time, shut: None };
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

    /// Returns the place m d of body m.
    fn place(&self, m: usize) -> DoubleDouble {
        dd(self.scenario.spacing) * m as f64
    }

    /// Returns the forced response of body m and its rate.
    fn forced_motion(&self, m: usize, [_, [sin, cos]]: &TruePhases) -> [DoubleDouble; 2] {
        let [c, s] = self.forced[m];
        [c * *cos + s * *sin, self.rates[1] * (s * *cos - c * *sin)]
    }

    /// Returns displacement and velocity of body m.
    fn motion(&self, m: usize, phases: &TruePhases) -> [DoubleDouble; 2] {
        let [v, rate] = self.forced_motion(m, phases);
        let [a, b] = self.free[m];
        let [sin, cos] = phases[0];
        [a * cos + b * sin + v, self.rates[0] * (b * cos - a * sin) + rate]
    }

    /// Returns width and rate of a gap.
    fn gap(&self, gap: usize, phases: &TruePhases) -> [DoubleDouble; 2] {
        let [left, right] = [gap, gap + 1].map(|m| self.motion(m, phases));
        [dd(self.scenario.spacing) + (right[0] - left[0]), right[1] - left[1]]
    }

    /// Returns d + R₁ + R₂ of a gap, as long as neither side is hit: the scale of its rounding.
    pub fn scale(&self, gap: usize) -> f64 {
        let length = |parts: &[[DoubleDouble; 2]]| {
            let [left, right] = [gap, gap + 1].map(|m| parts[m].map(DoubleDouble::to_f64));
            let [x, y] = [right[0] - left[0], right[1] - left[1]];
            (x * x + y * y).sqrt()
        };
        self.scenario.spacing + length(&self.free) + length(&self.forced)
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

    /// Finds the next impact up to time `until`, or none if there is no impact; does not advance.
    ///
    /// # Errors
    /// As [`Method::run`] of the engine.
    pub fn next(&self, until: f64) -> Result<Option<Hit>, Error> {
        let found = Certified.first((&self.scenario, &self.state(), until))?;
        Ok(found.map(|impact| self.refined(impact)))
    }

    /// Returns the impact at the zero of its gap nearest to the time that the engine found.
    fn refined(&self, found: Impact) -> Hit {
        let mut time = dd(found.time);
        for _ in 0..8 {
            let [width, rate] = self.gap(found.gap, &self.phases(time));
            let step = width / rate;
            // At a grazing impact the rate nearly vanishes, and a Newton step would be far too
            // long.
            if step.hi.is_nan() || step.hi.abs() >= 1e-3 {
                break;
            }
            time = time - step;
            if step.hi.abs() < 1e-30 * (1.0 + found.time.abs()) {
                break;
            }
        }
        let [_, rate] = self.gap(found.gap, &self.phases(time));
        Hit { time, gap: found.gap, closing_speed: -rate.to_f64() }
    }

    /// Advances to an impact and carries it out.
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
    }

    /// Runs to time `until`; returns the impacts, with the state right after each.
    ///
    /// # Errors
    /// As [`TrueMotion::next`].
    pub fn run(&mut self, until: f64) -> Result<Vec<(Hit, State)>, Error> {
        let mut hits = Vec::new();
        while let Some(hit) = self.next(until)? {
            self.advance(&hit);
            hits.push((hit, self.state()));
        }
        Ok(hits)
    }
}

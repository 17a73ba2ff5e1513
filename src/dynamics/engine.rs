//! The exact event-driven engine.
//!
//! Nothing is integrated. Each gap knows the instant of its next impact, found by the certified
//! search from its own local frame; the earliest is taken from a winner tree, two masses are
//! kicked, and the three gaps that they border are framed anew. Exact three-way impacts are taken
//! one after the other, lowest gap first.

use super::flight::{Motion, Phases};
use super::gap;
use super::impact::jumps;
use super::topology::Topology;
use super::{Error, Initial, Scenario};
use crate::numerics::clock::{Instant, Rate};
use crate::numerics::first_root::{Next, Work, first_root};
use crate::numerics::local_frame::{Frame, Frequencies};
use crate::numerics::winner_tree::WinnerTree;

/// One impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Time t, in the units of the scenario.
    pub time: f64,
    /// The gap that closed: 0 is left wall–mass 1, j is mass j–mass j + 1.
    pub gap: usize,
    /// Closing speed −Δ' just before the impact, ≥ 0.
    pub closing_speed: f64,
}

/// Counted work of a run: deterministic, and a result like any other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Impacts.
    pub impacts: u64,
    /// Contact phases begun, one per gap.
    pub contact_phases: u64,
    /// Searches started.
    pub searches: u64,
    /// Evaluations of a gap by the root search.
    pub evaluations: u64,
    /// Decisions taken inside the undecidable band of the search.
    pub undecided: u64,
}

/// What a gap waits for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Awaits {
    /// It cannot close until a neighbour is hit.
    Nothing,
    /// An impact at this speed.
    Impact(f64),
    /// Certified open until then; the search goes on from there.
    Search,
    /// In contact, until the contact force vanishes (or, with `Search`, is looked at again).
    Release,
}

/// A gap with its local frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// The gap (or in contact its contact force) seen from `origin`.
    pub frame: Frame<f64>,
    pub origin: Instant,
    pub awaits: Awaits,
    pub in_contact: bool,
}

/// Events that one gap may need within one unit of time 1/ω on average before a run is given up.
/// A hot chain has about one impact a gap; a chatter with r = 0.99 takes some 2500.
const EVENTS_PER_GAP: u64 = 100_000;

/// Below this fraction of d a gap is carried on in its own frame when a neighbour is hit: as a
/// difference of two positions it would have lost its digits.
const NEARLY_SHUT: f64 = 1e-9;

/// Overlap, as a fraction of d + R₁ + R₂, beyond which a gap cannot be explained by rounding.
const ROUNDING: f64 = 1e-12;

/// The simulation of one scenario.
#[derive(Clone, Debug)]
pub struct Engine {
    pub(super) spacing: f64,
    pub(super) restitution: f64,
    pub(super) frequencies: Frequencies,
    pub(super) rates: [Rate; 2],
    pub(super) topology: Topology,
    /// Masses 1..n; 0 and n + 1 are the walls.
    pub(super) motions: Vec<Motion<f64>>,
    /// The forced response (c, s) of each mass on its own.
    pub(super) forced: Vec<[f64; 2]>,
    pub(super) gaps: Vec<Gap>,
    /// Contact force of each gap in contact: constant, cos Ωt and sin Ωt parts.
    pub(super) forces: Vec<[f64; 3]>,
    pub(super) queue: WinnerTree,
    pub(super) now: Instant,
    pub(super) work: Work,
    impacts: u64,
    pub(super) contact_phases: u64,
    budget_end: Instant,
    budget_left: u64,
}

impl Engine {
    /// Sets a scenario at t = 0.
    ///
    /// # Errors
    /// [`Error::Input`] for values outside the model, [`Error::Overlap`] for an overlapping start.
    pub fn new(scenario: &Scenario) -> Result<Engine, Error> {
        scenario.validate()?;
        let (w, big_w) = (scenario.natural_frequency, scenario.forcing_frequency);
        let n = scenario.forcing.len();
        let topology = Topology::new(n, scenario.boundary);
        // The response of an undamped oscillator to Eq. (5), with ω² − Ω² as (ω − Ω)(ω + Ω).
        let factor = (w - big_w) * (w + big_w);
        let mut motions = vec![Motion::still(); n + 2];
        let mut forced = vec![[0.0; 2]; n + 2];
        for (j, &[alpha, beta]) in scenario.forcing.iter().enumerate() {
            let [c, s] = [alpha / factor, beta / factor];
            let [a, b] = match &scenario.initial {
                Initial::Rest => [-c, -(big_w / w * s)],
                Initial::Zero => [0.0; 2],
                Initial::Free(parts) => parts[j],
            };
            motions[j + 1] = Motion { a, b, c, s, offset: 0.0 };
            forced[j + 1] = [c, s];
        }
        let zero = Frame { f0: 0.0, g0: 0.0, alpha: 0.0, gamma: 0.0, delta: 0.0, bound: 0.0 };
        let gap =
            Gap { frame: zero, origin: Instant::ZERO, awaits: Awaits::Nothing, in_contact: false };
        let gaps = topology.gaps();
        let mut engine = Engine {
            spacing: scenario.spacing,
            restitution: scenario.restitution,
            frequencies: Frequencies::new(w, big_w),
            rates: [Rate::new(w), Rate::new(big_w)],
            topology,
            motions,
            forced,
            gaps: vec![gap; gaps],
            forces: vec![[0.0; 3]; gaps],
            queue: WinnerTree::new(gaps),
            now: Instant::ZERO,
            work: Work::default(),
            impacts: 0,
            contact_phases: 0,
            budget_end: Instant::ZERO.after(1.0 / w),
            budget_left: EVENTS_PER_GAP * gaps as u64,
        };
        engine.start()?;
        Ok(engine)
    }

    /// Frames all gaps at t = 0; those shut and at rest are settled together.
    fn start(&mut self) -> Result<(), Error> {
        let phases = Phases::at(&self.rates, self.now);
        let mut shut = Vec::new();
        for k in 0..self.gaps.len() {
            let (frame, reach) = self.look(k, &phases);
            if frame.f0 < -ROUNDING * (reach.mean.abs() + reach.excursion) {
                return Err(Error::Overlap { gap: self.topology.label(k), depth: -frame.f0 });
            }
            let f0 = if frame.f0 <= 4.0 * f64::EPSILON * (reach.mean.abs() + reach.excursion) {
                0.0
            } else {
                frame.f0
            };
            if f0 == 0.0 && frame.g0 == 0.0 {
                shut.push(k);
            }
            self.set_frame(k, &phases, f0, frame.g0);
        }
        if !shut.is_empty() {
            self.settle(&phases, &shut, None);
        }
        Ok(())
    }

    /// Runs until time `until`, and hands each impact to `sink` in order; stops early, right
    /// after that impact, when `sink` returns false. May be called again with a later time.
    ///
    /// # Errors
    /// [`Error::Work`] when the bound on work is exceeded.
    pub fn run(&mut self, until: f64, mut sink: impl FnMut(Impact) -> bool) -> Result<(), Error> {
        let end = Instant::at(until);
        loop {
            let (k, at) = self.queue.first();
            if at > end {
                return Ok(());
            }
            self.now = at;
            let phases = Phases::at(&self.rates, at);
            match self.gaps[k].awaits {
                Awaits::Impact(speed) => {
                    self.spend(k)?;
                    self.impacts += 1;
                    self.collide(k, speed, &phases);
                    let gap = self.topology.label(k);
                    if !sink(Impact { time: at.time(), gap, closing_speed: speed }) {
                        return Ok(());
                    }
                }
                Awaits::Search if self.gaps[k].in_contact => self.watch_contact(k, &phases),
                Awaits::Search => {
                    if at == self.gaps[k].origin {
                        self.spend(k)?;
                    }
                    self.reframe(k, &phases, 0.0);
                }
                Awaits::Release => {
                    self.spend(k)?;
                    self.release(k, &phases);
                }
                Awaits::Nothing => unreachable!("a gap that awaits nothing has the key NEVER"),
            }
        }
    }

    /// Takes one event from the budget of the current unit of time.
    fn spend(&mut self, k: usize) -> Result<(), Error> {
        let bound = EVENTS_PER_GAP * self.gaps.len() as u64;
        if self.now >= self.budget_end {
            self.budget_end = self.now.after(1.0 / self.frequencies.omega);
            self.budget_left = bound;
        }
        if self.budget_left == 0 {
            return Err(Error::Work { gap: self.topology.label(k), time: self.now.time(), bound });
        }
        self.budget_left -= 1;
        Ok(())
    }

    /// The impact of gap k at `speed`.
    fn collide(&mut self, k: usize, speed: f64, phases: &Phases<f64>) {
        if self.is_contact_matter(k, speed) {
            return self.collide_in_contact(k, speed, phases);
        }
        let jumps = self.kick_neighbours(k, speed, phases);
        self.set_frame(k, phases, 0.0, self.restitution * speed);
        let [before, after] = self.topology.adjacent(k);
        for near in [before, after].into_iter().flatten() {
            self.reframe(near, phases, self.jump_of_gap(near, k, jumps));
            if before == after {
                break;
            }
        }
    }

    /// Applies the impact law to the two neighbours of gap k; returns the jumps of their velocity.
    pub(super) fn kick_neighbours(&mut self, k: usize, speed: f64, p: &Phases<f64>) -> [f64; 2] {
        let sides = self.topology.sides(k);
        let inverse = sides.map(|m| self.topology.inverse_mass(m));
        let jumps = jumps(speed, self.restitution, inverse);
        for (side, jump) in sides.into_iter().zip(jumps) {
            self.motions[side].kick(jump / self.frequencies.omega, p);
        }
        jumps
    }

    /// The jump of the rate of gap `near` when the neighbours of gap `k` jump by `jumps`.
    pub(super) fn jump_of_gap(&self, near: usize, k: usize, jumps: [f64; 2]) -> f64 {
        let sides = self.topology.sides(k);
        let of = |m: usize| {
            sides
                .iter()
                .zip(jumps)
                .filter(|(side, _)| **side == m)
                .map(|(_, jump)| jump)
                .sum::<f64>()
        };
        let [left, right] = self.topology.sides(near);
        of(right) - of(left)
    }

    /// The frame of gap k from the motions of its neighbours.
    pub(super) fn look(&self, k: usize, phases: &Phases<f64>) -> (Frame<f64>, gap::Reach<f64>) {
        let [left, right] = self.topology.sides(k);
        let motion = self.motions[right].minus(&self.motions[left]);
        gap::frame(self.spacing, &motion, phases, &self.frequencies)
    }

    /// Looks at gap k anew, `jump` being what its rate has just jumped by.
    pub(super) fn reframe(&mut self, k: usize, phases: &Phases<f64>, jump: f64) {
        let (mut frame, reach) = self.look(k, phases);
        if let Some([f0, g0]) = self.carried(k, &frame, jump) {
            (frame.f0, frame.g0) = (f0, g0);
        }
        self.await_next(k, frame, &reach);
    }

    /// Frames gap k now with width `f0` and rate `g0`, which are known better than by looking.
    pub(super) fn set_frame(&mut self, k: usize, phases: &Phases<f64>, f0: f64, g0: f64) {
        let (mut frame, reach) = self.look(k, phases);
        (frame.f0, frame.g0) = (f0, g0);
        self.await_next(k, frame, &reach);
    }

    /// Width and rate of a nearly shut gap from its own last frame.
    pub(super) fn carried(&self, k: usize, seen: &Frame<f64>, jump: f64) -> Option<[f64; 2]> {
        let old = &self.gaps[k];
        if seen.f0 >= NEARLY_SHUT * self.spacing || old.in_contact {
            return None;
        }
        let s = self.now.since(old.origin);
        let p = if s == 0.0 {
            old.frame.start(&self.frequencies)
        } else if s <= self.frequencies.reach {
            old.frame.at(s, &self.frequencies)
        } else {
            return None;
        };
        Some([p.f, p.g + jump])
    }

    /// Takes a frame of gap k at this instant and looks for its next impact.
    fn await_next(&mut self, k: usize, mut frame: Frame<f64>, reach: &gap::Reach<f64>) {
        // A width below zero by rounding is zero unless the gap is closing, and then due now.
        if frame.g0 >= 0.0 {
            frame.f0 = frame.f0.max(0.0);
        }
        let (awaits, key) = if reach.excursion < reach.mean && frame.f0 > 0.0 {
            (Awaits::Nothing, Instant::NEVER)
        } else {
            match first_root(&frame, self.frequencies.reach, &self.frequencies, &mut self.work) {
                Next::Root { s, speed } => (Awaits::Impact(speed), self.now.after(s)),
                Next::Clear { s } => (Awaits::Search, self.now.after(s)),
            }
        };
        self.gaps[k] = Gap { frame, origin: self.now, awaits, in_contact: false };
        self.queue.set(k, key);
    }

    /// Positions x_1..x_n at `time`, exact between the last event and the next.
    pub fn positions(&self, time: f64) -> Vec<f64> {
        let phases = Phases::at(&self.rates, Instant::at(time));
        self.masses(|j, motion| {
            let seen = motion.seen(&phases);
            j as f64 * self.spacing + motion.offset + (seen.u + seen.v)
        })
    }

    /// Velocities of the masses 1..n at `time`, exact between the last event and the next.
    pub fn velocities(&self, time: f64) -> Vec<f64> {
        let phases = Phases::at(&self.rates, Instant::at(time));
        self.masses(|_, motion| {
            let seen = motion.seen(&phases);
            self.frequencies.omega * seen.u_quadrature
                + self.frequencies.big_omega * seen.v_quadrature
        })
    }

    /// Free parts (a_j, b_j) of the masses 1..n; those in contact share that of their cluster.
    pub fn free_parts(&self) -> Vec<[f64; 2]> {
        self.masses(|_, motion| [motion.a, motion.b])
    }

    fn masses<T>(&self, of: impl Fn(usize, &Motion<f64>) -> T) -> Vec<T> {
        let n = self.motions.len() - 2;
        (1..=n).map(|j| of(j, &self.motions[j])).collect()
    }

    /// Time of the last event.
    pub fn time(&self) -> f64 {
        self.now.time()
    }

    /// Counted work so far.
    pub fn counters(&self) -> Counters {
        Counters {
            impacts: self.impacts,
            contact_phases: self.contact_phases,
            searches: self.work.searches,
            evaluations: self.work.evaluations,
            undecided: self.work.undecided,
        }
    }
}

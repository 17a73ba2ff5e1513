//! The main loop of the event-driven engine.
//!
//! Nothing is integrated. A certified search in the local frame of each gap finds the instant of its next impact; the
//! earliest is taken from a winner tree, two masses are kicked, and the three gaps that they border get new frames.
//! Of gaps that close at the same instant the lowest comes first, each by the law for two, until none closes. Instants
//! are whole numbers of ticks, so "the same" is exact; such ties come from symmetries, and are counted.

use super::engine::{Impact, Sink};
use super::flight::{Motion, Phases, Rates};
use super::force::Force;
use super::impact::jumps;
use super::topology::Topology;
use super::{Error, Initial, Scenario};
use crate::search::clock::Instant;
use crate::search::earliest::Earliest;
use crate::search::first_root::{Counters, Next, Search};
use crate::search::local_frame::{Frame, Frequencies};
use crate::search::window::next_window;

/// The response (c, s) of an undamped oscillator to a component of Eq. (3), with ω² − Ω² as
/// (ω − Ω)(ω + Ω).
pub(super) fn response(w: f64, big_w: f64, amplitudes: [f64; 2]) -> [f64; 2] {
    let factor = (w - big_w) * (w + big_w);
    amplitudes.map(|amplitude| amplitude / factor)
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Awaits {
    /// It cannot close until a neighbour is hit.
    Nothing,
    /// An impact at this speed.
    Impact(f64),
    /// Certified open until then; the search goes on from there. `whole_reach` if that is the
    /// end of a frame which came from the motions.
    Search { whole_reach: bool },
    /// In contact, until the contact force vanishes (or, with `Search`, is looked at again).
    Release,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Gap<const M: usize> {
    /// The gap (or in contact its contact force) in the local frame of `origin`.
    pub frame: Frame<M>,
    pub origin: Instant,
    pub awaits: Awaits,
    pub in_contact: bool,
}

/// Events that one gap may need within one unit of time 1/ω on average before a run is given up.
/// A hot chain has about one impact a gap; a chatter with r = 0.99 takes some 2500.
const EVENTS_PER_GAP: u64 = 100_000;

/// Below this fraction of d a gap is carried on in its last frame when a neighbour is hit: as a
/// difference of two positions it would have lost its digits.
pub(super) const NEARLY_SHUT: f64 = 1e-9;

/// Overlap, as a fraction of `Frame::size`, beyond which a gap cannot be explained by rounding.
const OVERLAP: f64 = 1e-12;

/// Below this fraction of the sum of the terms of its positions at t = 0, a gap may be exactly shut:
/// roundings of amplitudes and sums add up to 5 · 2^-53.
const SHUT_AT_START: f64 = 4.0 * f64::EPSILON;

/// The simulation of one scenario with `M` components of the forcing.
#[derive(Clone, Debug)]
pub(super) struct Simulation<const M: usize> {
    pub(super) spacing: f64,
    pub(super) restitution: f64,
    pub(super) search: Search<M>,
    pub(super) rates: Rates<M>,
    pub(super) topology: Topology,
    /// Masses 1..n; 0 and n + 1 are the walls.
    pub(super) motions: Vec<Motion<M>>,
    /// Low words of their free parts as double-doubles; empty unless r = 1 (`elastic`).
    pub(super) remainders: Vec<[f64; 2]>,
    /// The forced response (c, s) of each mass outside a cluster.
    pub(super) forced: Vec<[[f64; 2]; M]>,
    pub(super) gaps: Vec<Gap<M>>,
    /// Contact force of each gap in contact: constant, cos Ωt and sin Ωt parts.
    pub(super) forces: Vec<Force<M>>,
    pub(super) queue: Earliest,
    pub(super) now: Instant,
    pub(super) work: Counters,
    /// The last instant at which neighbouring gaps closed together.
    pub(super) tied: Option<Instant>,
    pub(super) budget_end: Instant,
    pub(super) budget_left: u64,
}

/// Sets a width below zero by rounding to zero, unless the gap is closing: then its impact is due now.
#[inline(always)]
fn clamp_width<const M: usize>(frame: &mut Frame<M>) {
    if frame.f0 < 0.0 && frame.g0 >= 0.0 {
        frame.f0 = 0.0;
    }
}

impl<const M: usize> Simulation<M> {
    pub fn new(scenario: &Scenario) -> Result<Self, Error> {
        scenario.validate()?;
        let w = scenario.natural_frequency;
        let frequencies = Frequencies::new(w, scenario.frequencies());
        let n = scenario.forcing.len();
        let topology = Topology::new(n, scenario.boundary);
        let mut motions = vec![Motion::STILL; n + 2];
        let mut responses = vec![[[0.0; 2]; M]; n + 2];
        for j in 0..n {
            let amplitudes = scenario.amplitudes::<M>(j);
            let forced: [[f64; 2]; M] =
                std::array::from_fn(|m| response(w, frequencies.big_omegas[m], amplitudes[m]));
            let [a, b] = match &scenario.initial {
                Initial::Rest => frequencies
                    .big_omegas
                    .iter()
                    .zip(forced)
                    .fold([0.0; 2], |[a, b], (big_w, [c, s])| [a - c, b - big_w / w * s]),
                Initial::Free(parts) => parts[j],
            };
            motions[j + 1] = Motion { a, b, forced, offset: 0.0 };
            responses[j + 1] = forced;
        }
        let gap = Gap {
            frame: Frame::ZERO,
            origin: Instant::ZERO,
            awaits: Awaits::Nothing,
            in_contact: false,
        };
        let gaps = topology.gaps();
        let mut simulation = Simulation {
            spacing: scenario.spacing,
            restitution: scenario.restitution,
            search: Search::new(frequencies),
            rates: Rates::new(&frequencies),
            topology,
            motions,
            remainders: vec![[0.0; 2]; if scenario.restitution == 1.0 { n + 2 } else { 0 }],
            forced: responses,
            gaps: vec![gap; gaps],
            forces: vec![Force::ZERO; gaps],
            queue: Earliest::new(gaps),
            now: Instant::ZERO,
            work: Counters::default(),
            tied: None,
            budget_end: Instant::ZERO.after(1.0 / w),
            budget_left: EVENTS_PER_GAP * gaps as u64,
        };
        simulation.start()?;
        Ok(simulation)
    }

    /// Frames all gaps at t = 0; those shut and at rest are settled together.
    fn start(&mut self) -> Result<(), Error> {
        let phases = Phases::at(&self.rates, self.now);
        let mut shut = Vec::new();
        for k in 0..self.gaps.len() {
            let frame = self.frame_of(k, &phases);
            if frame.f0 < -OVERLAP * frame.size {
                return Err(Error::Overlap { gap: self.topology.label(k), depth: -frame.f0 });
            }
            let f0 = if frame.f0 <= SHUT_AT_START * self.made_of(k) { 0.0 } else { frame.f0 };
            if f0 == 0.0 && frame.g0 == 0.0 {
                shut.push(k);
            }
            if f0 == 0.0 || !self.try_long_wait(k, &phases) {
                self.set_and_search(k, &phases, f0, frame.g0);
            }
        }
        if !shut.is_empty() {
            self.settle(&phases, &shut, None);
        }
        Ok(())
    }

    /// d plus the absolute terms of both neighbours' positions at t = 0, the scale of their rounding.
    fn made_of(&self, k: usize) -> f64 {
        let parts = |side: usize| {
            let motion = &self.motions[side];
            motion.forced.iter().fold(motion.a.abs(), |sum, [c, _]| sum + c.abs())
        };
        self.topology.sides(k).into_iter().fold(self.spacing, |sum, side| sum + parts(side))
    }

    pub fn run(&mut self, until: f64, sink: Sink) -> Result<(), Error> {
        let end = Instant::at(until);
        while let Some(k) = self.next_event(end) {
            if let Some(impact) = self.step(k)?
                && !sink(impact)
            {
                return Ok(());
            }
        }
        Ok(())
    }

    /// Goes to the next event up to `end`; returns its gap.
    #[inline(always)]
    fn next_event(&mut self, end: Instant) -> Option<usize> {
        let (mut k, mut at) = self.queue.first();
        // A search has no effect on other gaps, so its order among equal events does not matter.
        let seen = !matches!(self.gaps[k].awaits, Awaits::Search { .. });
        if (at > end || seen) && self.queue.is_close(k) {
            (k, at) = self.queue.first_in_full();
        }
        if at > end {
            return None;
        }
        self.now = at;
        Some(k)
    }

    /// Handles the event of gap k at the instant `now`; returns the impact if it is one.
    #[inline(always)]
    fn step(&mut self, k: usize) -> Result<Option<Impact>, Error> {
        match self.gaps[k].awaits {
            // Touching without speed is no impact, but contact may begin.
            Awaits::Impact(0.0) => {
                self.spend(k)?;
                let phases = Phases::at(&self.rates, self.now);
                self.collide_in_contact(k, 0.0, &phases);
            }
            Awaits::Impact(speed) => {
                let impact = self.count_impact(k, speed)?;
                let phases = Phases::at(&self.rates, self.now);
                if self.queue.ties_with_neighbour(k) {
                    self.count_tie(k);
                }
                self.collide(k, speed, &phases);
                return Ok(Some(impact));
            }
            Awaits::Search { whole_reach: true } if !self.gaps[k].in_contact => {
                // After an empty reach the frame is rotated, which is cheap; after the next one it comes from the
                // motions, which do not drift, and a longer wait is tried.
                let gap = &mut self.gaps[k];
                gap.frame = gap.frame.advanced(&self.search.frequencies);
                clamp_width(&mut gap.frame);
                let key = self.search_gap(k, false);
                self.queue.set(k, [key]);
            }
            Awaits::Search { .. } => {
                if self.now == self.gaps[k].origin {
                    // no progress, which must not repeat for ever
                    self.spend(k)?;
                }
                let phases = Phases::at(&self.rates, self.now);
                if self.gaps[k].in_contact {
                    self.watch_contact(k, &phases);
                } else if !self.try_long_wait(k, &phases) {
                    self.renew_and_search(k, &phases, 0.0);
                }
            }
            Awaits::Release => {
                self.spend(k)?;
                let phases = Phases::at(&self.rates, self.now);
                self.release(k, &phases);
            }
            Awaits::Nothing => unreachable!("a gap that awaits nothing has the key NEVER"),
        }
        Ok(None)
    }

    /// Counts this instant, once, if a gap next to gap k closes now as well.
    #[cold]
    fn count_tie(&mut self, k: usize) {
        let is_due = |near: usize| {
            matches!(self.gaps[near].awaits, Awaits::Impact(_)) && self.queue.key(near) == self.now
        };
        let ties = self.topology.adjacent(k).into_iter().flatten().any(is_due);
        if ties && self.tied != Some(self.now) {
            self.work.simultaneous += 1;
            self.tied = Some(self.now);
        }
    }

    /// Counts the impact of gap k now, and takes it from the budget.
    #[inline(always)]
    fn count_impact(&mut self, k: usize, closing_speed: f64) -> Result<Impact, Error> {
        self.spend(k)?;
        self.work.impacts += 1;
        Ok(Impact { time: self.now.time(), gap: self.topology.label(k), closing_speed })
    }

    /// Takes one event from the budget of the current unit of time.
    fn spend(&mut self, k: usize) -> Result<(), Error> {
        let bound = EVENTS_PER_GAP * self.gaps.len() as u64;
        if self.now >= self.budget_end {
            self.budget_end = self.now.after(1.0 / self.search.frequencies.omega);
            self.budget_left = bound;
        }
        if self.budget_left == 0 {
            return Err(Error::Work { gap: self.topology.label(k), time: self.now.time(), bound });
        }
        self.budget_left -= 1;
        Ok(())
    }

    /// Carries out the impact of gap k at `speed`.
    #[inline(always)]
    fn collide(&mut self, k: usize, speed: f64, phases: &Phases<M>) {
        if self.is_contact_matter(k, speed) {
            return self.collide_in_contact(k, speed, phases);
        }
        if self.is_conservative(k, speed) {
            return self.reflect(k, speed, phases);
        }
        let jumps = self.kick_neighbours(k, speed, phases);
        if k > 0 && k + 1 < self.gaps.len() {
            // Each neighbour shares one mass with the gap.
            self.renew(k - 1, phases, jumps[0]);
            self.renew(k + 1, phases, -jumps[1]);
            let mut frame = self.frame_of(k, phases);
            (frame.f0, frame.g0) = (0.0, self.restitution * speed);
            self.gaps[k].frame = frame;
            let mut keys = [Instant::NEVER; 3];
            for (near, key) in (k - 1..).zip(&mut keys) {
                *key = self.search_gap(near, true);
            }
            return self.queue.set(k - 1, keys);
        }
        self.set_and_search(k, phases, 0.0, self.restitution * speed);
        self.renew_adjacent(k, phases, jumps);
    }

    /// Takes new frames of the gaps next to gap k, whose masses' velocities have just jumped by `jumps`.
    pub(super) fn renew_adjacent(&mut self, k: usize, phases: &Phases<M>, jumps: [f64; 2]) {
        let [before, after] = self.topology.adjacent(k);
        for near in [before, after].into_iter().flatten() {
            self.renew_and_search(near, phases, self.jump_of_gap(near, k, jumps));
            if before == after {
                break;
            }
        }
    }

    /// Applies the impact law to the two neighbours of gap k; returns the jumps of their velocity.
    pub(super) fn kick_neighbours(&mut self, k: usize, speed: f64, p: &Phases<M>) -> [f64; 2] {
        let sides = self.topology.sides(k);
        let jumps = jumps(speed, self.restitution, self.topology.inverse_masses(k));
        for (side, jump) in sides.into_iter().zip(jumps) {
            self.motions[side].kick(jump / self.search.frequencies.omega, p);
        }
        jumps
    }

    /// The jump of the rate of gap `near` when the neighbours of gap `k` jump by `jumps`.
    pub(super) fn jump_of_gap(&self, near: usize, k: usize, jumps: [f64; 2]) -> f64 {
        let sides = self.topology.sides(k);
        let of = |m: usize| {
            let both = sides.iter().zip(jumps).filter(|(side, _)| **side == m);
            both.map(|(_, jump)| jump).sum::<f64>()
        };
        let [left, right] = self.topology.sides(near);
        of(right) - of(left)
    }

    /// The frame of gap k from the motions of its neighbours.
    #[inline(always)]
    pub(super) fn frame_of(&self, k: usize, phases: &Phases<M>) -> Frame<M> {
        let [left, right] = self.topology.sides(k);
        let motion = self.motions[right].minus(&self.motions[left]);
        motion.frame(self.spacing, phases, &self.search.frequencies)
    }

    /// Takes a new frame of gap k, whose rate has just jumped by `jump`.
    #[inline(always)]
    fn renew(&mut self, k: usize, phases: &Phases<M>, jump: f64) {
        let mut frame = self.frame_of(k, phases);
        if let Some([f0, g0]) = self.carried(k, &frame, jump) {
            (frame.f0, frame.g0) = (f0, g0);
        }
        clamp_width(&mut frame);
        self.gaps[k].frame = frame;
    }

    /// The same, and looks for the next impact of gap k.
    pub(super) fn renew_and_search(&mut self, k: usize, phases: &Phases<M>, jump: f64) {
        self.renew(k, phases, jump);
        let key = self.search_gap(k, true);
        self.queue.set(k, [key]);
    }

    /// Takes a new frame of gap k with width `f0` and rate `g0`, which are more accurate than those of
    /// the motions, and searches its next impact.
    pub(super) fn set_and_search(&mut self, k: usize, phases: &Phases<M>, f0: f64, g0: f64) {
        let mut frame = Frame { f0, g0, ..self.frame_of(k, phases) };
        clamp_width(&mut frame);
        // For a gap at rest the rounding of its acceleration must not decide, or a released one would shut again.
        if f0 == 0.0 && g0 == 0.0 {
            frame.not_falling(&self.search.frequencies);
        }
        self.gaps[k].frame = frame;
        let key = self.search_gap(k, true);
        self.queue.set(k, [key]);
    }

    /// Width and rate of a nearly shut gap from its last frame.
    #[inline(always)]
    pub(super) fn carried(&self, k: usize, seen: &Frame<M>, jump: f64) -> Option<[f64; 2]> {
        if seen.f0 >= NEARLY_SHUT * self.spacing || self.gaps[k].in_contact {
            return None;
        }
        self.carried_on(k, jump)
    }

    #[cold]
    fn carried_on(&self, k: usize, jump: f64) -> Option<[f64; 2]> {
        let old = &self.gaps[k];
        let s = self.now.since(old.origin);
        let p = if s == 0.0 {
            old.frame.start(&self.search.frequencies)
        } else if s <= self.search.frequencies.reach {
            old.frame.at(s, &self.search.frequencies)
        } else {
            return None;
        };
        Some([p.f, p.d1 + jump])
    }

    /// Searches the frame of gap k, taken at this instant; returns the key of what it now awaits.
    /// `from_motions` if the frame came from the motions.
    #[inline(always)]
    fn search_gap(&mut self, k: usize, from_motions: bool) -> Instant {
        let gap = &mut self.gaps[k];
        gap.origin = self.now;
        gap.in_contact = false;
        match self.search.first_root(&gap.frame, &mut self.work) {
            Next::Root { s, speed } => {
                gap.awaits = Awaits::Impact(speed);
                self.now.after(s)
            }
            Next::Clear { s } => {
                let whole_reach = from_motions && s == self.search.frequencies.reach;
                gap.awaits = Awaits::Search { whole_reach };
                self.now.after(s)
            }
        }
    }

    /// Lets gap k, which is open, wait without a search for as long as it certainly stays open, if
    /// that is longer than the reach of a search.
    fn try_long_wait(&mut self, k: usize, phases: &Phases<M>) -> bool {
        let [left, right] = self.topology.sides(k);
        let motion = self.motions[right].minus(&self.motions[left]);
        let seen = motion.seen(phases);
        let mean = self.spacing + motion.offset;
        let free = [seen.u, seen.u_quadrature];
        let frequencies = &self.search.frequencies;
        let (awaits, key) = match next_window(mean, free, &seen.forced, frequencies) {
            None => (Awaits::Nothing, Instant::NEVER),
            Some(s) if s > frequencies.reach => {
                (Awaits::Search { whole_reach: false }, self.now.after(s))
            }
            Some(_) => return false,
        };
        self.gaps[k].awaits = awaits;
        self.gaps[k].origin = self.now;
        self.queue.set(k, [key]);
        true
    }

    // Documented in `Engine`, under the same names.
    pub fn positions(&self, time: f64) -> Vec<f64> {
        let phases = Phases::at(&self.rates, Instant::at(time));
        self.masses(|j, motion| {
            j as f64 * self.spacing + motion.offset + motion.seen(&phases).place()
        })
    }

    pub fn velocities(&self, time: f64) -> Vec<f64> {
        let phases = Phases::at(&self.rates, Instant::at(time));
        self.masses(|_, motion| motion.seen(&phases).velocity(&self.search.frequencies))
    }

    pub fn free_parts(&self) -> Vec<[f64; 2]> {
        self.masses(|_, motion| [motion.a, motion.b])
    }

    fn masses<T>(&self, of: impl Fn(usize, &Motion<M>) -> T) -> Vec<T> {
        let n = self.motions.len() - 2;
        (1..=n).map(|j| of(j, &self.motions[j])).collect()
    }
}

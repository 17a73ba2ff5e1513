//! Holds the state of a simulation, and keeps the frame and the next event of each gap.

use super::budget::Budget;
use super::error::Error;
use super::flight::{Motion, Phases};
use super::force::Force;
use super::impact::jumps;
use super::state::State;
use super::topology::Topology;
use crate::Event;
use crate::search::clock::{Instant, LATEST};
use crate::search::earliest::Earliest;
use crate::search::first_root::Search;
use crate::search::local_frame::{Frame, NEARLY_SHUT};
use crate::search::outcome::{Counters, Graze, Next};
use crate::search::window::next_window;
use std::sync::Arc;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Awaits {
    /// None: the gap cannot close until a neighbour is hit.
    Nothing,
    /// An impact at this closing speed.
    Impact(f64),
    /// The search goes on: open until then; `whole_reach` if a frame from the motions ends there.
    Search { whole_reach: bool },
    /// In contact: the contact force vanishes (or, with `Search`, must be searched further).
    Release,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Gap<const M: usize> {
    /// The width of the gap (in contact, its contact force) in the local frame of `origin`.
    pub frame: Frame<M>,
    pub origin: Instant,
    pub awaits: Awaits,
    pub in_contact: bool,
    /// Whether it had an impact at t = 0, where a gap may also be shut by the start.
    pub hit_at_start: bool,
}

/// An event that is known before its turn.
#[derive(Clone, Debug)]
pub(super) struct Waiting {
    pub instant: Instant,
    /// Of a graze the gap, and width and rate of its frame, which an impact before it changes.
    pub dip: Option<(usize, [f64; 2])>,
    pub event: Event,
}

/// The simulation of one scenario with `M` components of the forcing.
#[derive(Clone, Debug)]
pub(super) struct Simulation<const M: usize> {
    pub(super) spacing: f64,
    pub(super) restitution: f64,
    pub(super) search: Arc<Search<M>>,
    pub(super) topology: Topology,
    /// The distance of the place of each body from m d: 0 in the paper.
    pub(super) shifts: Vec<f64>,
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
    /// The instant at which observers have t = 0: not that of the start if a state goes on.
    pub(super) zero: Instant,
    /// The time of the last event that was returned.
    pub(super) event_time: f64,
    pub(super) waiting: Vec<Waiting>,
    /// Gaps whose contact ended or began in the change that is being made.
    pub(super) freed: Vec<usize>,
    pub(super) stuck: Vec<usize>,
    /// The last instant at which contact was involved, and the gaps hit then without rebound.
    pub(super) joined: (Instant, Vec<usize>),
    pub(super) work: Counters,
    /// How many undecided dips are noted, and the first of them.
    pub(super) noted: u64,
    pub(super) first_graze: Option<Graze>,
    pub(super) budget: Budget<Instant>,
}

/// Sets a width below zero to zero, unless the gap is closing: then its impact is due now.
#[inline(always)]
pub(super) fn clamp_width<const M: usize>(frame: &mut Frame<M>) {
    if frame.f0 < 0.0 && frame.g0 >= 0.0 {
        frame.f0 = 0.0;
    }
}

impl<const M: usize> Simulation<M> {
    /// Returns the time of an instant for observers.
    #[inline(always)]
    pub(super) fn time(&self, instant: Instant) -> f64 {
        instant.since(self.zero)
    }

    /// Applies the impact law to the two neighbours of gap k; returns the jumps of their velocity.
    #[inline(always)]
    pub(super) fn kick_neighbours(&mut self, k: usize, speed: f64, p: &Phases<M>) -> [f64; 2] {
        let sides = self.topology.sides(k);
        let jumps = jumps(speed, self.restitution, self.topology.inverse_masses(k));
        for (side, jump) in sides.into_iter().zip(jumps) {
            self.motions[side].kick(jump / self.search.frequencies.omega, p);
        }
        jumps
    }

    /// Takes and searches new frames of the gaps next to gap k, whose masses jumped by `jumps`.
    pub(super) fn renew_adjacent(&mut self, k: usize, phases: &Phases<M>, jumps: [f64; 2]) {
        for near in self.topology.near(k) {
            self.renew_and_search(near, phases, self.jump_of_gap(near, k, jumps));
        }
    }

    /// Returns the jump of the rate of gap `near` when the neighbours of gap k jump by `jumps`.
    pub(super) fn jump_of_gap(&self, near: usize, k: usize, jumps: [f64; 2]) -> f64 {
        let sides = self.topology.sides(k);
        let jump_of_mass = |m: usize| {
            let both = sides.iter().zip(jumps).filter(|(side, _)| **side == m);
            both.map(|(_, jump)| jump).sum::<f64>()
        };
        let [left, right] = self.topology.sides(near);
        jump_of_mass(right) - jump_of_mass(left)
    }

    /// Computes the frame of gap k from the motions of its neighbours.
    #[inline(always)]
    pub(super) fn frame_of(&self, k: usize, phases: &Phases<M>) -> Frame<M> {
        let [left, right] = self.topology.sides(k);
        let motion = self.motions[right].minus(&self.motions[left]);
        motion.frame(self.spacing, phases, &self.search.frequencies)
    }

    /// Takes a new frame of gap k, whose rate has just jumped by `jump`.
    #[inline(always)]
    pub(super) fn renew(&mut self, k: usize, phases: &Phases<M>, jump: f64) {
        let mut frame = self.frame_of(k, phases);
        if let Some([f0, g0]) = self.carried(k, &frame, jump) {
            (frame.f0, frame.g0) = (f0, g0);
        }
        clamp_width(&mut frame);
        self.gaps[k].frame = frame;
    }

    pub(super) fn renew_and_search(&mut self, k: usize, phases: &Phases<M>, jump: f64) {
        self.renew(k, phases, jump);
        let key = self.search_gap(k, true);
        self.queue.set(k, [key]);
    }

    /// Searches gap k from `f0` and `g0`, more accurate than the motions, in a new frame.
    pub(super) fn set_and_search(&mut self, k: usize, phases: &Phases<M>, f0: f64, g0: f64) {
        let mut frame = Frame { f0, g0, ..self.frame_of(k, phases) };
        clamp_width(&mut frame);
        // At rest the rounding of the acceleration must not decide, or a gap would shut again.
        if f0 == 0.0 && g0 == 0.0 {
            frame.prevent_fall(&self.search.frequencies);
        }
        self.gaps[k].frame = frame;
        let key = self.search_gap(k, true);
        self.queue.set(k, [key]);
    }

    /// Returns width and rate of gap k from its last frame, or `None` if it is not nearly shut.
    /// `computed` is its frame from the motions.
    #[inline(always)]
    pub(super) fn carried(&self, k: usize, computed: &Frame<M>, jump: f64) -> Option<[f64; 2]> {
        if computed.f0 >= NEARLY_SHUT * self.spacing || self.gaps[k].in_contact {
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

    /// Searches the frame of gap k, taken at this instant; returns the key of its next event.
    /// `from_motions` if the frame came from the motions.
    #[inline(always)]
    pub(super) fn search_gap(&mut self, k: usize, from_motions: bool) -> Instant {
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

    /// Lets an open gap k wait without a search if it certainly stays open for longer than a search
    /// looks ahead; returns whether it does.
    pub(super) fn try_long_wait(&mut self, k: usize, phases: &Phases<M>) -> bool {
        let [left, right] = self.topology.sides(k);
        let motion = self.motions[right].minus(&self.motions[left]);
        let parts = motion.parts(phases);
        let mean = self.spacing + motion.offset;
        let free = [parts.u, parts.u_quadrature];
        let frequencies = &self.search.frequencies;
        let (awaits, key) = match next_window(mean, free, &parts.forced, frequencies) {
            None => (Awaits::Nothing, Instant::NEVER),
            Some(s) if s > frequencies.reach => {
                (Awaits::Search { whole_reach: false }, self.now.after(s))
            }
            Some(_) => return false,
        };
        // The frame and its origin stay: until a neighbour is hit they describe the gap.
        self.gaps[k].awaits = awaits;
        self.queue.set(k, [key]);
        true
    }

    /// Returns the phases at a time from the last event to the next.
    fn phases_in_flight(&self, time: f64) -> Result<Phases<M>, Error> {
        let (_, next) = self.queue.first_in_full(|_| 0.0);
        let latest = Instant::at(LATEST).shifted(self.zero);
        let (from, to) = (self.event_time, self.time(next.min(latest)));
        if (from..=to).contains(&time) {
            let instant = Instant::at(time).shifted(self.zero);
            return Ok(Phases::at(&self.search.frequencies, instant));
        }
        let problem = format!("{time:?} is not between the last event and the next");
        let remedy = format!("give {from:?} to {to:?}, or run the engine to that time first");
        Err(Error::input("time", problem, remedy))
    }

    // These three are documented in `Engine`, under the same names.
    pub fn state(&self, time: f64) -> Result<State, Error> {
        let phases = self.phases_in_flight(time)?;
        let (mut positions, mut velocities) = (Vec::new(), Vec::new());
        for (j, motion) in self.masses() {
            let parts = motion.parts(&phases);
            let centre = j as f64 * self.spacing + motion.offset;
            positions.push(centre + parts.displacement());
            velocities.push(parts.velocity(&self.search.frequencies));
        }
        Ok(State { time, positions, velocities })
    }

    pub fn contacts(&self, time: f64) -> Result<Vec<(usize, f64)>, Error> {
        let phases = self.phases_in_flight(time)?;
        let gaps = (0..self.gaps.len()).filter(|&k| self.gaps[k].in_contact);
        Ok(gaps.map(|k| (self.topology.label(k), self.forces[k].value(&phases))).collect())
    }

    pub fn free_parts(&self) -> Vec<[f64; 2]> {
        self.masses().map(|(_, motion)| [motion.a, motion.b]).collect()
    }

    fn masses(&self) -> impl Iterator<Item = (usize, &Motion<M>)> {
        let n = self.motions.len() - 2;
        self.motions.iter().enumerate().skip(1).take(n)
    }
}

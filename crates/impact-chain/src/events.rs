//! Sets a scenario at t = 0 and goes from event to event.
//!
//! Nothing is integrated. A certified search in the local frame of each gap finds the instant of
//! its next impact; the earliest is taken from a winner tree, two masses are kicked, and the three
//! gaps next to them get new frames. Of several gaps that close at the same instant the fastest
//! comes first (the lowest of equally fast ones), each by the law for two bodies, until none
//! closes. Instants are whole numbers of ticks, so "the same" is exact. Such ties come from
//! symmetries and from hits of masses in contact, and are counted.

use super::budget::Budget;
use super::flight::{Motion, Phases, response};
use super::force::Force;
use super::impact::Impact;
use super::simulation::{Awaits, Gap, Simulation, Waiting, clamp_width};
use super::state::AT_REST;
use super::topology::Topology;
use super::{Error, Event, Scenario, check_range};
use crate::search::clock::{Instant, LATEST};
use crate::search::earliest::Earliest;
use crate::search::first_root::Search;
use crate::search::local_frame::{Frame, Frequencies};
use crate::search::outcome::{Counters, Graze};
use crate::search::stepping::{SHALLOW, hidden_dip};

/// Overlap, as a fraction of `Frame::size`, beyond which a gap cannot be explained by rounding.
const OVERLAP: f64 = 1e-12;

/// A gap at t = 0 may be shut below this part of its positions' terms: they round to 5 · 2^-53.
const SHUT_AT_START: f64 = 4.0 * f64::EPSILON;

/// Rate of a shut gap at t = 0, over the terms of its sides' speeds, up to which it is at rest.
const AT_REST_OF_TERMS: f64 = 64.0 * f64::EPSILON;

impl<const M: usize> Simulation<M> {
    /// Sets a scenario at its time zero, which is `epoch` for observers.
    pub fn new(scenario: &Scenario, epoch: f64) -> Result<Self, Error> {
        scenario.validate()?;
        let w = scenario.natural_frequency;
        let frequencies = Frequencies::new(w, scenario.frequencies());
        let n = scenario.forcing.len();
        let topology = Topology::new(n, scenario.boundary);
        let shifts: Vec<f64> = (0..n + 2).map(|m| scenario.shift(m)).collect();
        let still = |&offset: &f64| Motion { offset, ..Motion::STILL };
        let mut motions: Vec<Motion<M>> = shifts.iter().map(still).collect();
        let mut responses = vec![[[0.0; 2]; M]; n + 2];
        for j in 0..n {
            let amplitudes = scenario.amplitudes::<M>(j);
            let forced: [[f64; 2]; M] =
                std::array::from_fn(|m| response(w, frequencies.big_omegas[m], amplitudes[m]));
            let [a, b] = scenario.free_part(j);
            motions[j + 1] = Motion { a, b, forced, ..motions[j + 1] };
            responses[j + 1] = forced;
        }
        let gap = Gap {
            frame: Frame::ZERO,
            origin: Instant::ZERO,
            awaits: Awaits::Nothing,
            in_contact: false,
            hit_at_start: false,
        };
        let gaps = topology.gaps();
        let mut simulation = Simulation {
            spacing: scenario.spacing,
            restitution: scenario.restitution,
            search: Search::shared(frequencies),
            topology,
            shifts,
            motions,
            remainders: vec![[0.0; 2]; if scenario.restitution == 1.0 { n + 2 } else { 0 }],
            forced: responses,
            gaps: vec![gap; gaps],
            forces: vec![Force::ZERO; gaps],
            queue: Earliest::new(gaps),
            now: Instant::ZERO,
            zero: Instant::at(-epoch),
            event_time: epoch,
            waiting: Vec::new(),
            freed: Vec::new(),
            stuck: Vec::new(),
            joined: (Instant::NEVER, Vec::new()),
            work: Counters::default(),
            noted: 0,
            first_graze: None,
            budget: Budget::new(gaps, Instant::ZERO.after(1.0 / w)),
        };
        simulation.start()?;
        simulation.note_grazes();
        Ok(simulation)
    }

    /// Takes the frames of all gaps at t = 0, and settles those that are shut and at rest together.
    fn start(&mut self) -> Result<(), Error> {
        let phases = Phases::at(&self.search.frequencies, self.now);
        let mut shut = Vec::new();
        for k in 0..self.gaps.len() {
            let frame = self.frame_of(k, &phases);
            if frame.f0 < -OVERLAP * frame.size {
                let (field, gap) = ("initial".to_string(), self.topology.label(k));
                return Err(Error::Overlap { field, gap, depth: -frame.f0 });
            }
            self.gaps[k].frame = frame;
            let [width, rate] = self.rounding_at_start(k, &phases);
            let f0 = if frame.f0 <= width { 0.0 } else { frame.f0 };
            let at_rest = f0 == 0.0 && frame.g0.abs() <= rate;
            let g0 = if at_rest { 0.0 } else { frame.g0 };
            if f0 == 0.0 && g0 == 0.0 {
                shut.push(k);
            }
            if f0 == 0.0 || !self.try_long_wait(k, &phases) {
                self.set_and_search(k, &phases, f0, g0);
            }
        }
        if !shut.is_empty() {
            self.settle(&phases, &shut, None);
        }
        Ok(())
    }

    /// Returns width and rate of gap k at t = 0 up to which rounding of its terms explains them.
    fn rounding_at_start(&self, k: usize, phases: &Phases<M>) -> [f64; 2] {
        let frequencies = &self.search.frequencies;
        let (mut width, mut fastest, mut rate) = (self.spacing, 0.0_f64, 0.0);
        for side in self.topology.sides(k) {
            let motion = &self.motions[side];
            width += motion.offset.abs();
            width += motion.forced.iter().fold(motion.a.abs(), |sum, [c, _]| sum + c.abs());
            fastest = fastest.max(motion.parts(phases).velocity(frequencies).abs());
            rate += frequencies.omega * motion.b.abs();
            for (big_omega, [_, s]) in frequencies.big_omegas.iter().zip(&motion.forced) {
                rate += big_omega * s.abs();
            }
        }
        [SHUT_AT_START * width, AT_REST * fastest + AT_REST_OF_TERMS * rate]
    }

    /// Returns the last instant of the run whose time is `until`, not before the last event.
    pub fn end(&self, until: f64) -> Result<Instant, Error> {
        check_range("until", until, self.event_time, LATEST)?;
        Ok(Instant::last_at(until).shifted(self.zero))
    }

    /// Carries out the next event up to `end` and returns it, or `None` if there is no event.
    #[inline(always)]
    pub fn next(&mut self, end: Instant) -> Result<Option<Event>, Error> {
        loop {
            if !self.waiting.is_empty()
                && let Some(first) = self.first_waiting(end)
            {
                let event = self.waiting.remove(first).event;
                self.event_time = event.time();
                return Ok(Some(event));
            }
            let Some((k, is_close)) = self.next_event(end) else { return Ok(None) };
            let impact = self.step(k, is_close)?;
            if self.work.undecided > self.noted {
                self.note_grazes();
            }
            if let Some(impact) = impact {
                self.event_time = impact.time;
                return Ok(Some(Event::Impact(impact)));
            }
        }
    }

    /// Searches on until the next event up to `end` is known; returns its time, or `None` if there
    /// is no event.
    pub fn next_time(&mut self, end: Instant) -> Result<Option<f64>, Error> {
        loop {
            if let Some(first) = self.first_waiting(end) {
                return Ok(Some(self.waiting[first].event.time()));
            }
            // The queue goes on to the epoch of its first key.
            self.queue.first();
            let (k, instant) = self.queue.first_in_full(|_| 0.0);
            if instant > end {
                return Ok(None);
            }
            if !matches!(self.gaps[k].awaits, Awaits::Search { .. }) {
                return Ok(Some(self.time(instant)));
            }
            self.now = instant;
            self.step(k, false)?;
            self.note_grazes();
        }
    }

    /// Forgets grazes that an impact has prevented; returns the place of the first waiting event,
    /// or `None` if it is after `end` or another event.
    #[cold]
    fn first_waiting(&mut self, end: Instant) -> Option<usize> {
        let gaps = &self.gaps;
        let stays = |k: usize, [f0, g0]: [f64; 2]| [gaps[k].frame.f0, gaps[k].frame.g0] == [f0, g0];
        self.waiting.retain(|event| event.dip.is_none_or(|(k, frame)| stays(k, frame)));
        let first = (0..self.waiting.len()).min_by_key(|&i| self.waiting[i].instant)?;
        let (_, next) = self.queue.first_in_full(|_| 0.0);
        (self.waiting[first].instant <= end.min(next)).then_some(first)
    }

    /// Notes dips that rounding could not decide, by searching frames of this instant again.
    #[cold]
    fn note_grazes(&mut self) {
        if self.work.undecided == std::mem::replace(&mut self.noted, self.work.undecided) {
            return;
        }
        for (k, gap) in self.gaps.iter().enumerate().filter(|(_, gap)| gap.origin == self.now) {
            let mut work = Counters::default();
            self.search.first_root(&gap.frame, &mut work);
            let hidden = hidden_dip(&gap.frame, &self.search.frequencies).map(|[dip, _]| dip);
            let undecided = (work.undecided > 0).then_some(work.dip);
            let dip = Some((k, [gap.frame.f0, gap.frame.g0]));
            let is_known = self.waiting.iter().any(|event| event.dip == dip);
            let Some(wait) = undecided.or(hidden).filter(|_| !is_known) else { continue };
            let instant = self.now.after(wait);
            let graze = Graze { time: self.time(instant), gap: self.topology.label(k) };
            self.first_graze.get_or_insert(graze);
            self.waiting.push(Waiting { instant, dip, event: Event::Graze(graze) });
        }
    }

    /// Goes to the next event up to `end`; returns its gap and, of an impact, whether another event
    /// may be due at the same instant, or `None` if there is no event.
    #[inline(always)]
    fn next_event(&mut self, end: Instant) -> Option<(usize, bool)> {
        let (mut k, mut instant) = self.queue.first();
        // A search has no effect on other gaps, so its order among equal events does not matter.
        let order_matters = !matches!(self.gaps[k].awaits, Awaits::Search { .. });
        let is_close = (instant > end || order_matters) && self.queue.is_close(k);
        if is_close {
            let speed = |k: usize| match self.gaps[k].awaits {
                Awaits::Impact(speed) => speed,
                _ => 0.0,
            };
            (k, instant) = self.queue.first_in_full(speed);
        }
        if instant > end {
            return None;
        }
        self.now = instant;
        Some((k, is_close))
    }

    /// Handles the event of gap k at the instant `now`; returns the impact if it is one.
    #[inline(always)]
    fn step(&mut self, k: usize, is_close: bool) -> Result<Option<Impact>, Error> {
        match self.gaps[k].awaits {
            // Touching without speed is no impact, but contact may begin.
            Awaits::Impact(0.0) => {
                self.spend(k)?;
                let phases = Phases::at(&self.search.frequencies, self.now);
                self.collide_in_contact(k, 0.0, &phases);
            }
            Awaits::Impact(speed) => {
                self.spend(k)?;
                self.work.impacts += 1;
                let (time, gap) = (self.time(self.now), self.topology.label(k));
                let impact = Impact { time, gap, closing_speed: speed };
                let phases = Phases::at(&self.search.frequencies, self.now);
                if is_close | (self.gaps[k].origin == self.now) {
                    self.count_tie(k);
                }
                self.collide(k, speed, &phases);
                return Ok(Some(impact));
            }
            Awaits::Search { whole_reach: true } => {
                // After an empty reach the frame is rotated, which is cheap; after the next one it
                // comes from the motions, which do not drift, and a longer wait is tried.
                let gap = &mut self.gaps[k];
                gap.frame = gap.frame.advanced(&self.search.frequencies);
                let key = self.pass_dip(k).unwrap_or_else(|| {
                    clamp_width(&mut self.gaps[k].frame);
                    self.search_gap(k, false)
                });
                self.queue.set(k, [key]);
            }
            Awaits::Search { .. } => {
                if self.now == self.gaps[k].origin {
                    // No progress, which must not repeat for ever.
                    self.spend(k)?;
                }
                let phases = Phases::at(&self.search.frequencies, self.now);
                if self.gaps[k].in_contact {
                    self.watch_contact(k, &phases);
                } else if !self.try_long_wait(k, &phases) {
                    self.gaps[k].frame = self.frame_of(k, &phases);
                    match self.pass_dip(k) {
                        Some(key) => self.queue.set(k, [key]),
                        None => self.renew_and_search(k, &phases, 0.0),
                    }
                }
            }
            Awaits::Release => {
                self.spend(k)?;
                let phases = Phases::at(&self.search.frequencies, self.now);
                self.release(k, &phases);
            }
            Awaits::Nothing => unreachable!("a gap that awaits nothing has the key NEVER"),
        }
        Ok(None)
    }

    /// Passes a dip of gap k that rounding hides; returns the next key of the gap, or `None` if
    /// there is no dip.
    #[inline(always)]
    fn pass_dip(&mut self, k: usize) -> Option<Instant> {
        let frame = &self.gaps[k].frame;
        if frame.f0 > SHALLOW * frame.size {
            return None;
        }
        let [dip, after] = hidden_dip(frame, &self.search.frequencies)?;
        self.work.undecided += 1;
        self.work.dip = dip;
        self.gaps[k].origin = self.now;
        self.gaps[k].awaits = Awaits::Search { whole_reach: false };
        Some(self.now.after(after))
    }

    /// Counts the impact of gap k if one of a neighbouring gap is or was due at this instant.
    #[cold]
    fn count_tie(&mut self, k: usize) {
        let at_start = self.now == Instant::ZERO;
        let renewed = self.gaps[k].origin == self.now;
        self.gaps[k].hit_at_start |= at_start;
        for near in self.topology.adjacent(k).into_iter().flatten() {
            let gap = &self.gaps[near];
            let is_due =
                matches!(gap.awaits, Awaits::Impact(_)) && self.queue.key(near) == self.now;
            let was_hit = gap.origin == self.now && gap.frame.f0 == 0.0;
            if is_due || renewed && was_hit && (gap.hit_at_start || !at_start) {
                self.work.simultaneous += 1;
                return;
            }
        }
    }

    /// Takes one event of gap k from the budget of the current unit of time.
    fn spend(&mut self, k: usize) -> Result<(), Error> {
        let (now, frequencies) = (self.now, &self.search.frequencies);
        if self.budget.spend(now, || now.after(1.0 / frequencies.omega)) {
            return Ok(());
        }
        let (gap, time) = (self.topology.label(k), self.time(now));
        Err(Error::Work { gap, time, bound: self.budget.bound })
    }

    #[inline(always)]
    fn collide(&mut self, k: usize, speed: f64, phases: &Phases<M>) {
        if self.involves_contact(k, speed) {
            return self.collide_in_contact(k, speed, phases);
        }
        if self.is_reflected(k, speed) {
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
}

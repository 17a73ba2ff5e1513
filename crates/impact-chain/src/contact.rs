//! Brings chattering gaps to rest, keeps pressed gaps in contact, and releases them.
//!
//! When a gap bounces off more slowly than [`CONTACT_SPEED`] d ω, its remaining impacts fall
//! within a time far below the rounding of t, and the run of gaps that are shut and slow is
//! *settled*: their masses take a common velocity (momentum is kept), and the contact forces of the
//! whole run decide which gaps are pressed. These form rigid clusters; the others open. Contact is
//! decided for the whole run, not pair by pair: a gap that would open alone may be held shut by its
//! neighbours.
//!
//! In a cluster each contact force is L + C cos Ωt + S sin Ωt exactly, so its first zero is
//! found by the same certified search as an impact. A hit from outside frees the masses of the
//! cluster, is carried through it by the impact law, and slow gaps are settled again. Masses that
//! an impact without rebound has joined move as one until the next instant, so without restitution
//! each gap of a cluster is hit once.

use super::complementarity::contact_forces;
use super::flight::{Motion, Phases};
use super::force::Force;
use super::simulation::{Awaits, Simulation, Waiting};
use crate::Event;
use crate::search::clock::Instant;
use crate::search::local_frame::ROUNDING;
use crate::search::outcome::Next;
use crate::search::window::next_window;
use std::collections::BTreeMap;
use std::iter::successors;
use std::mem::take;

/// Separation speed, in units of d ω, below which a chatter is taken to have come to rest.
pub(super) const CONTACT_SPEED: f64 = 1e-10;

/// Rate, in units of d ω, and width, in units of d, up to which a gap belongs to a settled run.
const SETTLED_RATE: f64 = 10.0 * CONTACT_SPEED;
const SETTLED_WIDTH: f64 = 1e-16;

/// A gap after a change of its rate.
#[derive(Clone, Copy)]
struct Changed {
    width: f64,
    rate: f64,
    /// Whether it is shut and slow, so that its run takes a common velocity.
    is_settled: bool,
}

const STILL: Changed = Changed { width: 0.0, rate: 0.0, is_settled: true };

impl<const M: usize> Simulation<M> {
    /// Returns whether the impact of gap k is so slow that contact may begin, or hits a cluster.
    #[inline(always)]
    pub(super) fn involves_contact(&self, k: usize, speed: f64) -> bool {
        let [before, after] = self.topology.adjacent(k);
        let in_contact = |gap: Option<usize>| gap.is_some_and(|gap| self.gaps[gap].in_contact);
        self.restitution * speed <= CONTACT_SPEED * self.spacing * self.search.frequencies.omega
            || in_contact(before)
            || in_contact(after)
    }

    /// Carries out an impact of gap k at `speed` that involves contact.
    pub(super) fn collide_in_contact(&mut self, k: usize, speed: f64, phases: &Phases<M>) {
        let mut freed = Vec::new();
        for near in self.topology.near(k) {
            if self.gaps[near].in_contact {
                freed.extend(self.free_cluster(near, phases));
            }
        }
        let rate = self.restitution * speed;
        let inelastic = rate <= CONTACT_SPEED * self.spacing * self.search.frequencies.omega;
        if self.joined.0 != self.now {
            self.joined = (self.now, Vec::new());
        }
        let jumps = self.kick_neighbours(k, speed, phases);
        let has_joined = |near: usize| inelastic && self.joined.1.contains(&near);
        let mut changed = BTreeMap::new();
        for near in freed {
            let rate = self.jump_of_gap(near, k, jumps);
            let is_settled = has_joined(near) || self.is_settled(0.0, rate);
            changed.insert(near, Changed { width: 0.0, rate, is_settled });
        }
        changed.insert(k, Changed { width: 0.0, rate, is_settled: self.is_settled(0.0, rate) });
        for near in self.topology.near(k) {
            changed.entry(near).or_insert_with(|| {
                let jump = self.jump_of_gap(near, k, jumps);
                let mut gap = self.changed(near, phases, jump);
                gap.is_settled |= has_joined(near) && self.is_settled(gap.width, gap.rate - jump);
                gap
            });
        }
        if inelastic {
            self.joined.1.push(k);
        }
        self.settle_runs(changed, phases, None);
    }

    pub(super) fn release(&mut self, k: usize, phases: &Phases<M>) {
        let freed = self.free_cluster(k, phases);
        self.settle(phases, &freed, Some(k));
    }

    /// Settles gaps that are shut and at rest; the gap `released` is pressed no longer.
    pub(super) fn settle(&mut self, p: &Phases<M>, shut: &[usize], released: Option<usize>) {
        self.settle_runs(shut.iter().map(|&k| (k, STILL)).collect(), p, released);
    }

    /// Returns the state of gap k now, after a jump of its rate.
    fn changed(&self, k: usize, phases: &Phases<M>, jump: f64) -> Changed {
        let frame = self.frame_of(k, phases);
        let [width, rate] = self.carried(k, &frame, jump).unwrap_or([frame.f0, frame.g0]);
        Changed { width, rate, is_settled: self.is_settled(width, rate) }
    }

    fn is_settled(&self, width: f64, rate: f64) -> bool {
        width <= SETTLED_WIDTH * self.spacing
            && rate.abs() <= SETTLED_RATE * self.spacing * self.search.frequencies.omega
    }

    /// Grows gaps that have just changed to runs of shut and slow gaps, settles and reframes them.
    fn settle_runs(
        &mut self,
        mut changed: BTreeMap<usize, Changed>,
        p: &Phases<M>,
        released: Option<usize>,
    ) {
        // Grow by neighbours of settled gaps that are shut and slow too, or in contact.
        let mut order: Vec<usize> = changed.keys().copied().collect();
        let mut next = 0;
        while let Some(&k) = order.get(next) {
            next += 1;
            if !changed[&k].is_settled {
                continue;
            }
            for near in self.topology.near(k) {
                if changed.contains_key(&near) {
                    continue;
                }
                if self.gaps[near].in_contact {
                    // Settling moves its masses, so its cluster is freed first.
                    for freed in self.free_cluster(near, p) {
                        changed.insert(freed, STILL);
                        order.push(freed);
                    }
                } else {
                    changed.insert(near, self.changed(near, p, 0.0));
                    order.push(near);
                }
            }
        }
        // The jumps of the rates of the gaps next to the runs.
        let mut jumps: BTreeMap<usize, f64> = BTreeMap::new();
        for run in self.runs(&changed) {
            let rates: Vec<f64> = run.iter().map(|k| changed[k].rate).collect();
            let [first, last] = self.settle_run(&run, &rates, p, released);
            let before = self.topology.adjacent(run[0])[0].map(|near| (near, first));
            let after = self.topology.adjacent(run[run.len() - 1])[1].map(|near| (near, -last));
            for (near, jump) in before.into_iter().chain(after) {
                *jumps.entry(near).or_default() += jump;
            }
            if run.len() > 1 {
                changed.extend(run.into_iter().map(|k| (k, STILL)));
            }
        }
        let jump = |k: usize| jumps.get(&k).copied().unwrap_or(0.0);
        // The motions are final now: take the frames of all other gaps that were touched.
        for (&k, gap) in &changed {
            if !self.gaps[k].in_contact {
                self.set_and_search(k, p, gap.width, gap.rate + jump(k));
            }
        }
        for &k in changed.keys() {
            for near in self.topology.near(k) {
                if !changed.contains_key(&near) && !self.gaps[near].in_contact {
                    self.renew_and_search(near, p, jump(near));
                }
            }
        }
        self.note_contacts();
    }

    /// Notes the gaps whose contact has just ended, and those where it has begun.
    fn note_contacts(&mut self) {
        let (mut freed, stuck) = (take(&mut self.freed), take(&mut self.stuck));
        freed.retain(|&k| !self.gaps[k].in_contact);
        let (instant, time) = (self.now, self.time(self.now));
        for (mut gaps, is_stuck) in [(freed, false), (stuck, true)] {
            if gaps.is_empty() {
                continue;
            }
            gaps.sort_unstable();
            let gaps = gaps.into_iter().map(|k| self.topology.label(k)).collect();
            let event =
                if is_stuck { Event::Stick { time, gaps } } else { Event::Release { time, gaps } };
            self.waiting.push(Waiting { instant, dip: None, event });
        }
    }

    /// Lists the maximal runs of settled gaps from the left; on a ring one may pass the last gap.
    fn runs(&self, changed: &BTreeMap<usize, Changed>) -> Vec<Vec<usize>> {
        let follows = |run: &[usize], k: usize| {
            run.last().is_some_and(|last| self.topology.adjacent(*last)[1] == Some(k))
        };
        let mut runs: Vec<Vec<usize>> = Vec::new();
        for (&k, _) in changed.iter().filter(|(_, gap)| gap.is_settled) {
            match runs.last_mut() {
                Some(run) if follows(run, k) => run.push(k),
                _ => runs.push(vec![k]),
            }
        }
        if runs.len() > 1 && follows(&runs[runs.len() - 1], runs[0][0]) {
            let first = runs.remove(0);
            runs.last_mut().expect("there were two").extend(first);
        }
        runs
    }

    /// Gives a run a common velocity, decides what stays shut; returns its end masses' jumps.
    fn settle_run(
        &mut self,
        gaps: &[usize],
        rates: &[f64],
        p: &Phases<M>,
        released: Option<usize>,
    ) -> [f64; 2] {
        let allowed: Vec<bool> = gaps.iter().map(|&k| Some(k) != released).collect();
        let accelerations: Vec<_> = gaps.iter().map(|&k| self.acceleration(k)).collect();
        // The acceleration of a gap by a unit of its contact force: the sum of the inverse masses.
        let inverse_mass = |&k: &usize| self.topology.inverse_masses(k).iter().sum();
        let inverse_mass: Vec<f64> = gaps.iter().map(inverse_mass).collect();
        let forces =
            contact_forces(&accelerations, &inverse_mass, &allowed, p, &self.search.frequencies);
        let alone = gaps.len() == 1;
        if alone && (rates[0] < 0.0 || forces[0].is_none()) {
            return [0.0; 2];
        }
        let jumps = self.jumps_of_run(gaps, rates);
        if !alone {
            // Perfectly inelastic end of a chatter or collapse: one velocity for all.
            self.make_rigid(gaps);
            self.make_free(gaps, p);
        }
        let mut cluster = Vec::new();
        for (i, &k) in gaps.iter().enumerate() {
            if let Some(force) = forces[i] {
                self.forces[k] = force;
                cluster.push(k);
            }
            let ends = i + 1 == gaps.len() || forces[i + 1].is_none();
            if ends && !cluster.is_empty() {
                self.make_rigid(&cluster);
                for k in take(&mut cluster) {
                    if self.gaps[k].awaits != Awaits::Release {
                        self.work.contact_phases += 1;
                        self.stuck.push(k);
                    }
                    self.gaps[k].in_contact = true;
                    self.watch_contact(k, p);
                }
            }
        }
        jumps
    }

    /// Returns the jumps of the end masses of `gaps` to one velocity, all relative to the first.
    fn jumps_of_run(&self, gaps: &[usize], rates: &[f64]) -> [f64; 2] {
        let members = self.members(gaps);
        let mut last = 0.0;
        let mut velocities = vec![last];
        for rate in rates {
            last += rate;
            velocities.push(last);
        }
        let common = match members.iter().position(|&m| self.topology.is_wall(m)) {
            Some(wall) => velocities[wall],
            None => velocities.iter().sum::<f64>() / velocities.len() as f64,
        };
        [common, common - last]
    }

    /// Returns the acceleration of a gap without contact forces, at width zero: ω² d + ΔF_j(t).
    fn acceleration(&self, k: usize) -> Force<M> {
        let w = self.search.frequencies.omega;
        let [left, right] = self.topology.sides(k).map(|m| self.forced[m]);
        let forced = std::array::from_fn(|m| {
            let big_w = self.search.frequencies.big_omegas[m];
            let factor = (w - big_w) * (w + big_w);
            [0, 1].map(|i| factor * (right[m][i] - left[m][i]))
        });
        let [left, right] = self.topology.sides(k).map(|m| self.shifts[m]);
        Force { constant: w * w * (self.spacing + (right - left)), forced }
    }

    /// Gives the masses along `gaps` (adjacent, left to right) one common motion.
    fn make_rigid(&mut self, gaps: &[usize]) {
        let members = self.members(gaps);
        let place = |i: usize| i as f64 * self.spacing;
        let wall = members.iter().position(|&m| self.topology.is_wall(m));
        let mut common = Motion::STILL;
        // The centre, counted from the first member's place.
        let centre = if let Some(wall) = wall {
            place(wall) + self.shifts[members[wall]]
        } else {
            let share = 1.0 / members.len() as f64;
            for &m in &members {
                let motion = &self.motions[m];
                common.a += share * motion.a;
                common.b += share * motion.b;
                for (common, part) in common.forced.iter_mut().zip(self.forced[m]) {
                    common[0] += share * part[0];
                    common[1] += share * part[1];
                }
            }
            let places = members.iter().enumerate().map(|(i, &m)| place(i) + self.shifts[m]);
            share * places.sum::<f64>()
        };
        for (i, &m) in members.iter().enumerate() {
            if !self.topology.is_wall(m) {
                self.motions[m] = Motion { offset: centre - place(i), ..common };
            }
        }
    }

    /// Gives each mass along `gaps` a separate motion again, at unchanged position and velocity.
    fn make_free(&mut self, gaps: &[usize], p: &Phases<M>) {
        for m in self.members(gaps) {
            if self.topology.is_wall(m) {
                continue;
            }
            let common = self.motions[m];
            let offset = self.shifts[m];
            let alone = Motion { forced: self.forced[m], offset, ..Motion::STILL };
            let (parts, parts_alone) = (common.parts(p), alone.parts(p));
            let (mut u, mut quadrature) = (common.offset - offset + parts.u, parts.u_quadrature);
            for (i, (common, alone)) in parts.forced.iter().zip(parts_alone.forced).enumerate() {
                let frequencies = &self.search.frequencies;
                let ratio = frequencies.big_omegas[i] / frequencies.omega;
                u += common[0] - alone[0];
                quadrature += ratio * (common[1] - alone[1]);
            }
            let a = u * p.cos - quadrature * p.sin;
            let b = u * p.sin + quadrature * p.cos;
            self.motions[m] = Motion { a, b, ..alone };
        }
    }

    /// Lists the masses (and walls) along adjacent gaps, left to right.
    fn members(&self, gaps: &[usize]) -> Vec<usize> {
        let first = self.topology.sides(gaps[0])[0];
        std::iter::once(first).chain(gaps.iter().map(|&k| self.topology.sides(k)[1])).collect()
    }

    /// Frees the cluster that gap k belongs to; returns its gaps, left to right.
    fn free_cluster(&mut self, k: usize, phases: &Phases<M>) -> Vec<usize> {
        let contact = |side: usize, k: usize| {
            self.topology.adjacent(k)[side].filter(|&near| self.gaps[near].in_contact)
        };
        let first = successors(Some(k), |&k| contact(0, k)).last();
        let gaps: Vec<usize> = successors(first, |&k| contact(1, k)).collect();
        self.make_free(&gaps, phases);
        for &k in &gaps {
            self.gaps[k].in_contact = false;
            // A mark: if the gap is pressed again at once, its contact phase goes on.
            self.gaps[k].awaits = Awaits::Release;
        }
        self.freed.extend(&gaps);
        gaps
    }

    pub(super) fn watch_contact(&mut self, k: usize, p: &Phases<M>) {
        let force = self.forces[k];
        let frequencies = &self.search.frequencies;
        let motion = Motion { forced: force.forced, ..Motion::STILL };
        let mut frame = motion.frame(force.constant, p, frequencies);
        // A force that grows from zero by its curvature alone must not end by rounding.
        let rounding = ROUNDING * force.size();
        if frame.f0.abs() <= rounding {
            frame.f0 = 0.0;
            if frame.g0.abs() <= rounding * frequencies.fastest {
                frame.g0 = 0.0;
            }
        }
        let window = next_window(force.constant, [0.0; 2], &frame.forced, frequencies);
        self.gaps[k].frame = frame;
        self.gaps[k].origin = self.now;
        let (awaits, key) = match window.map(|_| self.search.first_root(&frame, &mut self.work)) {
            None => (Awaits::Release, Instant::NEVER),
            Some(Next::Root { s, .. }) => (Awaits::Release, self.now.after(s)),
            Some(Next::Clear { s }) => (Awaits::Search { whole_reach: false }, self.now.after(s)),
        };
        self.gaps[k].awaits = awaits;
        self.queue.set(k, [key]);
    }
}

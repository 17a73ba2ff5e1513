//! A long chain between walls on two cores: the front from each end goes through a half of its own, up to where the other could
//! have been. What is left about the middle is then taken by itself, from both sides.
//!
//! The halves are simulations of their own, cut at a mass that neither touches. Each event looks for what came out of order as
//! everywhere along a front (`front`), so the impacts are the same bits; a slice in which one finds that, or comes too
//! near to a cut, is undone in both halves and left to the whole chain.

use super::engine::Sink;
use super::flight::Motion;
use super::force::Force;
use super::front::{Front, NEARBY, Slice};
use super::simulation::{Gap, Simulation};
use super::simultaneous::Ties;
use super::topology::Topology;
use super::{Boundary, Error};
use impact_numerics::clock::Instant;
use impact_numerics::earliest::{Begins, Earliest};
use impact_numerics::first_root::Work;

/// Gaps next to a cut that no event may concern: more than one of contact does.
const MARGIN: usize = NEARBY + 4;

/// Gaps before the cut that are left to the middle, besides those that the front spans.
const LEFT: usize = 4 * MARGIN;

/// Gaps of each half that belong to the middle, where the front spans so many places: as far as events are left, and more.
fn reach(places: usize) -> usize {
    places + places / 4 + 2 * LEFT
}

/// Units of time that a slice has at least: words tell places apart in it.
const SHORT: f64 = 1e-3;

impl<const M: usize> Simulation<M> {
    /// Runs towards `end`, by halves where that is worth it; false if the receiver wants no more.
    pub(super) fn run_on_two_cores(
        &mut self,
        front: &mut Front<M>,
        end: Instant,
        sink: Sink,
    ) -> Result<bool, Error> {
        let mut begin = self.now;
        // On a ring the fronts begin side by side.
        let is_ring = self.topology.adjacent(0)[0].is_some();
        if is_ring || self.gaps.len() < 4 * reach(front.places) {
            return Ok(true);
        }
        while front.height > SHORT && end.since(begin) > front.height {
            let Some(reached) = self.run_by_halves(front, begin, end, sink)? else {
                return Ok(false);
            };
            begin = reached.after(front.pause.min(end.since(reached)));
            if !self.run_in_order(begin, sink)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Runs slice by slice, until one is a waste or longer than what is left: tells up to when, or nothing if the receiver
    /// wants no more.
    fn run_by_halves(
        &mut self,
        front: &mut Front<M>,
        mut begin: Instant,
        end: Instant,
        sink: Sink,
    ) -> Result<Option<Instant>, Error> {
        let mut right = self.split();
        let mut others = [Slice::NEW, Slice::NEW];
        loop {
            let height = front.next_height(end.since(begin));
            let counted = [self.counted(), right.counted()];
            let followed = self.follow_halves(&mut right, front, &mut others, begin, height);
            #[cfg(test)]
            {
                front.by_halves += u32::from(followed.is_some());
            }
            front.learn(height, followed.as_ref().map(|(events_per_gap, _)| *events_per_gap));
            let handed =
                followed.as_ref().and_then(|_| self.hand_out_found(&front.slice.found, sink));
            if let (Some((_, middle)), None) = (&followed, handed) {
                self.put_back(&mut right, middle);
                begin = begin.after(height);
                if front.pause == 0.0 && end.since(begin) > front.height {
                    continue;
                }
            } else {
                self.undo(&mut front.slice, counted[0]);
                right.undo(&mut others[1], counted[1]);
            }
            self.join(right);
            return match handed {
                None => Ok(Some(begin)),
                Some(handed) => self.run_again(begin.after(height), handed).map(|_| None),
            };
        }
    }

    /// Takes the events of a slice: those of both halves at once, then those of the middle, which is returned with their number for
    /// each gap; nothing if one of them cannot be taken there.
    fn follow_halves(
        &mut self,
        right: &mut Self,
        front: &mut Front<M>,
        [of_middle, of_right]: &mut [Slice<M>; 2],
        begin: Instant,
        height: f64,
    ) -> Option<(f64, Self)> {
        let (places, slice) = (front.places, &mut front.slice);
        let [left_gaps, right_gaps] = [self.gaps.len(), right.gaps.len()];
        let (up_to, from) = (Begins::AtFirst(LEFT), Begins::AtLast(LEFT));
        let (one, other) = rayon::join(
            || self.follow(slice, begin, height, places, up_to, 0..left_gaps - MARGIN),
            || right.follow(of_right, begin, height, places, from, MARGIN..right_gaps),
        );
        let events = one? + other?;
        let reach = reach(places);
        let mut middle = self.middle(right, reach);
        let inside = MARGIN..2 * reach - MARGIN;
        let events =
            events + middle.follow(of_middle, begin, height, places, Begins::AtEnds, inside)?;
        slice.add(of_middle, left_gaps - reach);
        slice.add(of_right, left_gaps);
        slice.is_sorted().then(|| (events as f64 / (left_gaps + right_gaps) as f64, middle))
    }

    /// Keeps the left half of the gaps, and returns the right one. Both have the mass between them.
    fn split(&mut self) -> Self {
        let cut = self.gaps.len() / 2;
        let motions = self.motions.split_off(cut);
        let forced = self.forced.split_off(cut);
        self.motions.push(motions[0]);
        self.forced.push(forced[0]);
        let keys = self.queue.keys();
        let (left, right) = (keys[..cut].to_vec(), keys[cut..].to_vec());
        let (gaps, forces) = (self.gaps.split_off(cut), self.forces.split_off(cut));
        let right = self.part(motions, forced, gaps, forces, right);
        self.queue = Earliest::of(left);
        self.topology = Topology::new(cut - 1, Boundary::Walls);
        right
    }

    /// The whole again.
    fn join(&mut self, mut right: Self) {
        self.motions.pop();
        self.forced.pop();
        self.motions.append(&mut right.motions);
        self.forced.append(&mut right.forced);
        self.gaps.append(&mut right.gaps);
        self.forces.append(&mut right.forces);
        self.queue = Earliest::of([self.queue.keys(), right.queue.keys()].concat());
        self.topology = Topology::new(self.gaps.len() - 1, Boundary::Walls);
        self.add_counts(&right);
    }

    fn add_counts(&mut self, part: &Self) {
        self.now = self.now.max(part.now);
        self.work += part.work;
        self.impacts += part.impacts;
        self.contact_phases += part.contact_phases;
    }

    /// So many gaps on either side of the cut, as a simulation of their own.
    fn middle(&self, right: &Self, gaps: usize) -> Self {
        let from = self.gaps.len() - gaps;
        self.part(
            [&self.motions[from..], &right.motions[1..=gaps]].concat(),
            [&self.forced[from..], &right.forced[1..=gaps]].concat(),
            [&self.gaps[from..], &right.gaps[..gaps]].concat(),
            [&self.forces[from..], &right.forces[..gaps]].concat(),
            [&self.queue.keys()[from..], &right.queue.keys()[..gaps]].concat(),
        )
    }

    /// What the middle became.
    fn put_back(&mut self, right: &mut Self, middle: &Self) {
        let gaps = middle.gaps.len() / 2;
        let from = self.gaps.len() - gaps;
        self.motions[from..].copy_from_slice(&middle.motions[..=gaps]);
        right.motions[..=gaps].copy_from_slice(&middle.motions[gaps..]);
        self.gaps[from..].copy_from_slice(&middle.gaps[..gaps]);
        right.gaps[..gaps].copy_from_slice(&middle.gaps[gaps..]);
        self.forces[from..].copy_from_slice(&middle.forces[..gaps]);
        right.forces[..gaps].copy_from_slice(&middle.forces[gaps..]);
        for (k, &key) in middle.queue.keys().iter().enumerate() {
            if k < gaps {
                self.queue.restore(from + k, key);
            } else {
                right.queue.restore(k - gaps, key);
            }
        }
        self.add_counts(middle);
    }

    /// A stretch of the chain, which has counted nothing.
    fn part(
        &self,
        motions: Vec<Motion<M>>,
        forced: Vec<[[f64; 2]; M]>,
        gaps: Vec<Gap<M>>,
        forces: Vec<Force<M>>,
        keys: Vec<Instant>,
    ) -> Self {
        Simulation {
            spacing: self.spacing,
            restitution: self.restitution,
            search: self.search.clone(),
            rates: self.rates,
            topology: Topology::new(gaps.len() - 1, Boundary::Walls),
            motions,
            forced,
            gaps,
            forces,
            queue: Earliest::of(keys),
            now: self.now,
            work: Work::default(),
            impacts: 0,
            contact_phases: 0,
            ties: Ties::new(self.ties.law),
            budget_end: self.budget_end,
            budget_left: self.budget_left,
            front: None,
        }
    }
}

//! Neighbouring gaps that close at exactly the same instant.
//!
//! What follows when one mass is hit from both sides at once is no matter of mechanics alone. The declared law: one gap
//! after the other, lowest first, each by the law for two, until none closes. The instants of the engine are whole numbers
//! of ticks, so "the same" means the same; exact ties come from exact symmetries, and are counted here.

use super::simulation::{Awaits, Simulation};
use impact_numerics::clock::Instant;
use std::collections::{BTreeSet, VecDeque};

/// The ties of a simulation.
#[derive(Clone, Debug)]
pub(super) struct Ties {
    /// Runs of neighbouring gaps that closed at the same instant.
    pub count: u64,
    /// The gaps that were counted at the instant `at`.
    counted: BTreeSet<usize>,
    at: Instant,
}

impl Ties {
    /// Nothing seen yet.
    pub const NONE: Self = Ties { count: 0, counted: BTreeSet::new(), at: Instant::ZERO };
}

impl<const M: usize> Simulation<M> {
    /// Gap k is hit now: counts the tie that it is part of, if any, once.
    #[cold]
    pub(super) fn count_tie(&mut self, k: usize) {
        let run = self.run_around(k);
        if run.iter().filter(|&&near| self.is_due(near)).count() < 2 {
            return;
        }
        let ties = &mut self.ties;
        if ties.at != self.now {
            ties.at = self.now;
            ties.counted.clear();
        }
        if !ties.counted.contains(&k) {
            ties.count += 1;
            ties.counted.extend(&run);
        }
    }

    /// Whether gap k has its impact now.
    fn is_due(&self, k: usize) -> bool {
        matches!(self.gaps[k].awaits, Awaits::Impact(_)) && self.queue.key(k) == self.now
    }

    /// Gap k and the gaps on both sides, one next to the other, that have their impact now or are
    /// in contact, from left to right.
    fn run_around(&self, k: usize) -> Vec<usize> {
        let mut run = VecDeque::from([k]);
        // On a ring the run may come to its own other end.
        let next = |from: usize, side: usize, end: usize| {
            let near = self.topology.adjacent(from)[side]?;
            let joins = self.gaps[near].in_contact || self.is_due(near);
            (joins && near != end).then_some(near)
        };
        while let Some(before) = next(run[0], 0, k) {
            run.push_front(before);
        }
        while let Some(after) = next(run[run.len() - 1], 1, run[0]) {
            run.push_back(after);
        }
        Vec::from(run)
    }
}

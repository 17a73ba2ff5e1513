//! Neighbouring gaps that close at exactly the same instant: two declared laws.
//!
//! What follows when one mass is hit from both sides at once is no matter of mechanics alone, so the
//! law is chosen by the scenario ([`Simultaneous`]). The instants of the engine are whole numbers
//! of ticks, so "the same" means the same; exact ties come from exact symmetries.
//!
//! **Sequential**: one gap after the other, lowest first, each by the law for two, until none
//! closes. It needs nothing of its own.
//!
//! **Joint**: Newton's restitution for all of them at once. The run is made of the neighbouring gaps that close at this
//! instant or are in contact. Each opens afterwards at w_i = −r g_i, where g_i ≤ 0 is its rate
//! before (0 in contact). With impulses λ_i ≥ 0, and K_i the sum of the inverse masses beside
//! gap i, K_i λ_i − λ_{i−1} − λ_{i+1} = −(1 + r) g_i.
//!
//! - No gap is pulled: the matrix is an M-matrix, its inverse has no negative element, and the right
//!   sides are not negative. So the linear complementarity problem is solved by its equations
//!   alone, and there is no gap to be dropped. (The matrix is regular: not all gaps of a chain are ever shut at once, for they
//!   have its length to share.)
//! - A gap that is shut but opens faster than contact takes no part. If the impact drives it
//!   shut again, it is hit next, at the same instant, as after any impact.
//! - Energy never increases for r ≤ 1: it changes by ½ Σ λ_i (w_i + g_i) = ½ Σ λ_i (1 − r) g_i ≤ 0.
//!
//! A single hit on masses in contact is such a run as well, and its cluster moves on as one body;
//! under the sequential law the hit is passed on from mass to mass.

use super::Impact;
use super::contact::Resting;
use super::engine::Sink;
use super::flight::Phases;
use super::simulation::{Awaits, Simulation};
use impact_numerics::clock::Instant;
use serde::Deserialize;
use std::collections::{BTreeSet, VecDeque};

/// What happens when neighbouring gaps close at exactly the same instant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Simultaneous {
    /// One after the other, lowest gap first.
    #[default]
    Sequential,
    /// All at once, each with Newton's restitution.
    Joint,
}

/// What a simulation knows of simultaneous impacts.
#[derive(Clone, Debug)]
pub(super) struct Ties {
    pub law: Simultaneous,
    /// Runs of neighbouring gaps that closed at the same instant.
    pub count: u64,
    /// The gaps that were counted at the instant `at`.
    counted: BTreeSet<usize>,
    at: Instant,
    /// Impacts of a joint impact that are yet to be handed out.
    pub left: VecDeque<Impact>,
}

impl Ties {
    /// Nothing seen yet.
    pub fn new(law: Simultaneous) -> Self {
        Ties { law, count: 0, counted: BTreeSet::new(), at: Instant::ZERO, left: VecDeque::new() }
    }
}

impl<const M: usize> Simulation<M> {
    /// Gap k is hit now, perhaps in a tie: counts that, and has the whole run hit if the law is the
    /// joint one. False if the impact is still to be dealt with.
    #[cold]
    pub(super) fn collide_tied(&mut self, k: usize, phases: &Phases<M>) -> bool {
        let run = self.run_around(k);
        if run.iter().filter(|&&near| self.is_due(near)).count() < 2 {
            return false;
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
        if self.ties.law == Simultaneous::Sequential {
            return false;
        }
        self.collide_jointly(k, phases);
        true
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

    /// The joint impact of the run around gap k, whose own impact is counted already.
    pub(super) fn collide_jointly(&mut self, k: usize, p: &Phases<M>) {
        let run = self.run_around(k);
        let speed = |near: usize| match self.gaps[near].awaits {
            Awaits::Impact(speed) => speed,
            _ => 0.0,
        };
        let speeds: Vec<f64> = run.iter().map(|&near| speed(near)).collect();
        let mut others: Vec<(usize, f64)> = run.iter().copied().zip(speeds.clone()).collect();
        others.retain(|&(near, _)| near != k && !self.gaps[near].in_contact);
        others.sort_by_key(|&(near, _)| near);
        for (near, speed) in others {
            let impact = self.count_another(near, speed);
            self.ties.left.push_back(impact);
        }
        for &near in &run {
            if self.gaps[near].in_contact {
                self.free_cluster(near, p);
            }
        }
        let r = self.restitution;
        let wanted: Vec<f64> = speeds.iter().map(|speed| (1.0 + r) * speed).collect();
        let jumps = self.kick_run(&run, &impulses(&wanted, &self.stiffness(&run)), p);
        let mut known: Vec<Resting> = run
            .iter()
            .zip(&speeds)
            .map(|(&k, speed)| Resting { k, f0: 0.0, g0: r * speed })
            .collect();
        let beside = [
            (self.topology.adjacent(run[0])[0], jumps[0]),
            (self.topology.adjacent(run[run.len() - 1])[1], -jumps[jumps.len() - 1]),
        ];
        let mut outer: Vec<(usize, f64)> = Vec::new();
        for (near, jump) in beside {
            let Some(near) = near.filter(|near| !run.contains(near)) else { continue };
            match outer.first_mut() {
                // On a ring the only gap outside the run is beside both its ends.
                Some((first, sum)) if *first == near => *sum += jump,
                _ => outer.push((near, jump)),
            }
        }
        // Gaps in contact are at rest, and so slow.
        if known.iter().any(|r| self.is_slow(r.g0)) {
            known.extend(outer.into_iter().map(|(near, jump)| self.resting(near, p, jump)));
            return self.settle_runs(known, p, None);
        }
        for r in known {
            self.set_frame(r.k, p, r.f0, r.g0);
        }
        for (near, jump) in outer {
            self.reframe(near, p, jump);
        }
    }

    /// Gives the masses along a run the impulses of its gaps; returns the jumps of their velocity,
    /// 0 for a wall.
    fn kick_run(&mut self, run: &[usize], impulses: &[f64], p: &Phases<M>) -> Vec<f64> {
        let of = |i: usize| impulses.get(i).copied().unwrap_or(0.0);
        let members = self.members(run);
        let mut jumps = Vec::with_capacity(members.len());
        for (i, m) in members.into_iter().enumerate() {
            let impulse = of(i.wrapping_sub(1)) - of(i);
            let jump = self.topology.inverse_mass(m) * impulse;
            self.motions[m].kick(jump / self.search.frequencies.omega, p);
            jumps.push(jump);
        }
        jumps
    }

    /// Hands out what a joint impact has left; false if the receiver wants no more.
    #[cold]
    pub(super) fn hand_out(&mut self, sink: Sink) -> bool {
        while let Some(impact) = self.ties.left.pop_front() {
            if !sink(impact) {
                return false;
            }
        }
        true
    }
}

/// The impulses λ_i ≥ 0 with K_i λ_i − λ_{i−1} − λ_{i+1} = `wanted`_i ≥ 0, where K_i is `stiffness`.
///
/// Each is found by elimination from both ends, so the mirrored problem has the mirrored solution to
/// the last bit. No difference is taken but of pivots, which lie between 1 and 2.
fn impulses(wanted: &[f64], stiffness: &[f64]) -> Vec<f64> {
    let n = wanted.len();
    // For gap i, what the gaps before it (then: after it) take from its pivot, and add to its right side.
    let eliminate = |order: &mut dyn Iterator<Item = usize>| {
        let mut taken = vec![[0.0; 2]; n];
        let [mut pivot, mut right] = [0.0; 2];
        for i in order {
            taken[i] = [pivot, right];
            let own = stiffness[i] - pivot;
            (pivot, right) = (1.0 / own, (wanted[i] + right) / own);
        }
        taken
    };
    let before = eliminate(&mut (0..n));
    let after = eliminate(&mut (0..n).rev());
    let of = |i: usize| {
        let [[pivot, right], [other_pivot, other_right]] = [before[i], after[i]];
        (wanted[i] + (right + other_right)) / (stiffness[i] - (pivot + other_pivot))
    };
    (0..n).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::random::NormalPairs;

    /// The equations hold, no impulse is negative, energy falls as it should, and the mirrored
    /// problem has the mirrored solution; between masses, at a wall, with gaps in contact.
    #[test]
    fn impulses_solve_the_run() {
        let mut normals = NormalPairs::new("joint", 1, 0);
        for n in 1..12 {
            for wall in [false, true] {
                let mut stiffness = vec![2.0; n];
                stiffness[0] = if wall { 1.0 } else { 2.0 };
                let mut wanted: Vec<f64> = (0..n).map(|_| normals.pair()[0].abs()).collect();
                wanted[n / 2] = if n > 3 { 0.0 } else { wanted[n / 2] };
                let found = impulses(&wanted, &stiffness);
                let of = |i: usize| found.get(i).copied().unwrap_or(0.0);
                for i in 0..n {
                    let left = stiffness[i] * of(i) - of(i.wrapping_sub(1)) - of(i + 1);
                    assert!((left - wanted[i]).abs() < 1e-13 * (1.0 + of(i)), "{n}: {found:?}");
                    assert!(of(i) >= 0.0, "{found:?}");
                }
                let turned = |x: &[f64]| x.iter().rev().copied().collect::<Vec<f64>>();
                assert_eq!(impulses(&turned(&wanted), &turned(&stiffness)), turned(&found));
            }
        }
        // One gap is the law for two.
        assert_eq!(impulses(&[0.9], &[2.0]), [0.45]);
        assert_eq!(impulses(&[0.9], &[1.0]), [0.9]);
    }
}

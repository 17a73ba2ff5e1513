//! Keeps one of the chains that are simulated side by side.

use super::plan::{Phases, Plan};
use super::proof::{Local, Outcome, Part, SLOW, blur, cos_sin};
use crate::Watch;

#[derive(Clone, Copy, Debug)]
pub struct Root {
    /// Time after the middle of the step.
    pub s: f64,
    pub gap: usize,
    pub speed: f64,
    /// Jump of the rate of the gap times sine and cosine of the phase ωt.
    pub jump: [f64; 2],
}

pub struct Slot {
    pub watch: Watch,
    /// First roots of gaps within this step, in any order.
    pub roots: Vec<Root>,
    /// Place of the earliest of them.
    pub first: usize,
    /// Whether it has roots or candidates in this step.
    pub is_pending: bool,
    pub handed_over: bool,
    pub has_ended: bool,
    /// Which gaps were hit since the time from which they count, and how many more end the chain.
    is_hit: Vec<bool>,
    to_hit: usize,
    /// Gaps of which the tests side by side did not tell.
    pub decided: u64,
}

impl Slot {
    /// Creates a chain that ends when so many gaps are hit.
    pub fn new(watch: Watch, gaps: usize, to_hit: usize) -> Slot {
        Slot {
            watch,
            roots: Vec::new(),
            first: 0,
            is_pending: false,
            handed_over: false,
            has_ended: false,
            is_hit: vec![false; gaps],
            to_hit,
            decided: 0,
        }
    }

    /// Counts a gap that is hit; returns whether it was the last that the chain waits for.
    pub fn hit(&mut self, gap: usize) -> bool {
        self.to_hit -= usize::from(!self.is_hit[gap]);
        self.is_hit[gap] = true;
        self.to_hit == 0
    }

    pub fn end(&mut self) {
        self.has_ended = true;
        self.roots.clear();
    }

    pub fn hand_over(&mut self) {
        self.handed_over = true;
        self.end();
    }

    /// Takes the earliest root out, and those of two gaps beside it, which the impact outdates.
    #[inline(always)]
    pub fn take_first(&mut self, [left, right]: [usize; 2]) {
        self.roots.swap_remove(self.first);
        let (mut place, mut first, mut earliest) = (0, 0, f64::INFINITY);
        while let Some(&Root { s, gap, .. }) = self.roots.get(place) {
            if gap == left || gap == right {
                self.roots.swap_remove(place);
                continue;
            }
            (first, earliest) = if s < earliest { (place, s) } else { (first, earliest) };
            place += 1;
        }
        self.first = first;
    }

    /// Adds a root of a gap, if an impact there is certain and its order too: `after` is the time
    /// up to which an adjacent gap may have been hit.
    #[inline(always)]
    pub fn add(&mut self, root: Root, after: f64, half: f64, restitution: f64) {
        let blur = blur(root.speed);
        let sure =
            root.speed * restitution >= SLOW && root.s - after > blur && half - root.s > blur;
        if sure && !self.handed_over {
            if self.roots.get(self.first).is_none_or(|first| root.s < first.s) {
                self.first = self.roots.len();
            }
            self.roots.push(root);
        } else {
            self.hand_over();
        }
    }

    /// Finds the first root of a gap in a part of the step by itself.
    #[cold]
    #[inline(never)]
    pub fn decide(
        &mut self,
        plan: &Plan,
        middle: Phases,
        gap: usize,
        amplitudes: [f64; 4],
        part: Part,
    ) {
        self.decided += 1;
        match Local::new(amplitudes, middle, plan.ratio).first_root(part) {
            Outcome::Open => (),
            Outcome::Root { s, speed } => {
                let (cos, sin) = cos_sin(s);
                let jump = (1.0 + plan.restitution) * speed;
                let jump = [
                    jump * (cos * middle[1] + sin * middle[0]),
                    jump * (cos * middle[0] - sin * middle[1]),
                ];
                self.add(Root { s, gap, speed, jump }, part.after, part.end, plan.restitution);
            }
            Outcome::Unsure => self.hand_over(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Chain;

    /// They are fast, and far from an earlier one and the end of the step: here by 1.25e-12.
    #[test]
    fn roots_of_certain_impacts() {
        let (unit, far) = (blur(1.0), 2.0 * blur(1.0));
        for (s, speed, after, end, restitution, is_certain) in [
            (0.0, 1.0, -far, far, 0.5, true),
            (0.0, 1.0, -unit, far, 0.5, false),
            (0.0, 1.0, -far, unit, 0.5, false),
            (far, 1.0, 0.0, far, 0.5, false),
            (0.0, 2.0 * SLOW, -1.0, 1.0, 0.5, true),
            (0.0, 1.9 * SLOW, -1.0, 1.0, 0.5, false),
        ] {
            let mut slot = Slot::new(Watch::new(&Chain::default(), &[]), 2, 2);
            slot.add(Root { s, gap: 0, speed, jump: [0.0; 2] }, after, end, restitution);
            assert_eq!(slot.roots.len(), usize::from(is_certain), "{s} {speed} {after} {end}");
            assert_eq!(slot.handed_over, !is_certain);
        }
    }
}

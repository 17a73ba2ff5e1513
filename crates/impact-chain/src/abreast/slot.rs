//! Keeps one of the chains that are simulated side by side.

use super::grid::Phases;
use super::plan::Plan;
use super::proof::{LARGEST, Local, MARGIN, Outcome, Part, SLOW, blur, cos_sin};
use crate::Watch;
use fearless_simd::{f64x4, prelude::*};
use std::ops::Range;

/// Gaps side by side. Four, whatever the processor has: nothing depends on its width.
pub const WIDTH: usize = 4;

/// Rows of [`Slot::rows`], a gap in each column: the amplitudes of cos ωt, sin ωt, cos Ωt, sin Ωt.
pub const A: usize = 0;
pub const B: usize = 1;
pub const C: usize = 2;
pub const D: usize = 3;
/// M₂ h²/8: f is not below zero within a step if it is not below this at both ends.
pub const SAG: usize = 4;
/// A gap can close if A² + B² is larger than this, (1 − R₂)².
pub const REACH: usize = 5;
/// ρ² R₂, the forced part of M₂.
pub const FORCED: usize = 6;
/// A gap whose SAG is below this is tame: (1 − |ρ² − 1| R₂)/4.
pub const TAME: usize = 7;
/// f less [`MARGIN`] when the gap was looked at last.
pub const LAST: usize = 8;

#[derive(Clone, Copy, Debug)]
pub struct Root {
    /// Time after the middle of the step.
    pub s: f64,
    pub gap: usize,
    pub speed: f64,
    /// Jump of the rate of the gap times sine and cosine of the phase ωt.
    pub jump: [f64; 2],
}

/// One of the chains that are simulated side by side.
pub struct Slot {
    /// A gap in each column. The column before gap 0 and that after the last gap are of no gap
    /// between walls, and copies of the last and the first gap on a ring, with a SAG of −1.
    pub rows: [Vec<f64>; LAST + 1],
    pub gaps: usize,
    pub watch: Watch,
    /// First roots of gaps within this step, in any order.
    pub roots: Vec<Root>,
    /// Place of the earliest of them.
    pub first: usize,
    /// The first columns of blocks with a gap that can close, and whether a block is among them.
    pub active: Vec<usize>,
    is_active: Vec<bool>,
    /// Whether the chain has to be simulated by the engine.
    pub handed_over: bool,
    /// Whether it is not simulated any further.
    ended: bool,
    /// Gaps of which the tests side by side did not tell.
    pub decided: u64,
}

impl Slot {
    /// Creates a chain of gaps that never close.
    pub fn new(gaps: usize, watch: Watch) -> Slot {
        let columns = (gaps + WIDTH - 1).next_multiple_of(WIDTH);
        let fill = |row| [0.0, -1.0, f64::INFINITY, 0.0, 1.0, 1.0][usize::max(row, D) - D];
        Slot {
            rows: std::array::from_fn(|row| vec![fill(row); columns]),
            gaps,
            watch,
            roots: Vec::new(),
            first: 0,
            active: Vec::new(),
            is_active: vec![false; columns / WIDTH],
            handed_over: false,
            ended: false,
            decided: 0,
        }
    }

    /// Sets a gap; hands the chain over if amplitudes are beyond the bounds of the proofs.
    pub fn set(&mut self, gap: usize, amplitudes: [f64; 4], plan: &Plan) {
        let [a, b, c, d] = amplitudes;
        let (free, forced) = ((a * a + b * b).sqrt(), (c * c + d * d).sqrt());
        let square = plan.ratio * plan.ratio;
        // Rounded outwards, by far more than the roundings of amplitudes.
        let left = 1.0 - forced;
        let reach = if left > 0.0 { left * left * (1.0 - 1e-9) } else { -1.0 };
        let sag = (free + square * forced) * plan.eighth;
        let tame = 0.25 * (1.0 - (square - 1.0).abs() * forced) * (1.0 - 1e-9);
        // The width at t = 0.
        let last = 1.0 - MARGIN + a + c;
        let column = [a, b, c, d, sag, reach, square * forced, tame, last];
        for (row, value) in self.rows.iter_mut().zip(column) {
            row[gap + 1] = value;
        }
        self.handed_over |= !(forced < LARGEST && free + square * forced < LARGEST);
        if plan.ring {
            self.copy_ends(gap + 1..gap + 2);
        }
    }

    /// Returns the amplitudes of a gap: of cos ωt, sin ωt, cos Ωt and sin Ωt, in units of d.
    pub fn amplitudes(&self, gap: usize) -> [f64; 4] {
        [A, B, C, D].map(|row| self.rows[row][gap + 1])
    }

    /// Returns the gap of a column, on a ring also of a copy.
    #[inline(always)]
    pub fn gap(&self, column: usize) -> usize {
        match column {
            0 => self.gaps - 1,
            _ if column > self.gaps => 0,
            _ => column - 1,
        }
    }

    /// Copies columns of a ring that have changed to their other places, if they have two.
    #[cold]
    pub fn copy_ends(&mut self, columns: Range<usize>) {
        let last = self.gaps;
        for column in columns {
            let other = match self.gap(column) {
                0 => last + 2 - column,
                gap if gap + 1 == last => last - column,
                _ => continue,
            };
            self.rows.iter_mut().for_each(|row| row[other] = row[column]);
            self.activate(other, 1);
        }
        (self.rows[SAG][0], self.rows[SAG][last + 1]) = (-1.0, -1.0);
    }

    /// Ends the simulation of the chain.
    pub fn end(&mut self) {
        self.ended = true;
        self.roots.clear();
        self.active.clear();
    }

    pub fn hand_over(&mut self) {
        self.handed_over = true;
        self.end();
    }

    /// Looks from now on at gaps that can close: bits of the columns from this one on.
    #[inline(always)]
    pub fn activate(&mut self, column: usize, bits: usize) {
        let (block, bits) = (column / WIDTH, bits << (column % WIDTH));
        for (block, bits) in [(block, bits % (1 << WIDTH)), (block + 1, bits >> WIDTH)] {
            if bits != 0 && !self.is_active[block] {
                self.is_active[block] = true;
                self.active.push(WIDTH * block);
            }
        }
    }

    /// Lists the blocks with a gap that can close.
    #[inline(always)]
    pub fn list_active<S: Simd>(&mut self, simd: S) {
        let over = self.handed_over || self.ended;
        self.active.clear();
        for block in 0..self.is_active.len() {
            self.is_active[block] = !over && self.can_close(simd, WIDTH * block) != 0;
            if self.is_active[block] {
                self.active.push(WIDTH * block);
            }
        }
    }

    #[inline(always)]
    pub fn four<S: Simd>(&self, simd: S, row: usize, column: usize) -> f64x4<S> {
        f64x4::from_slice(simd, &self.rows[row][column..column + WIDTH])
    }

    /// Returns which of four gaps can close: the others are not looked at.
    #[inline(always)]
    pub fn can_close<S: Simd>(&self, simd: S, column: usize) -> u8 {
        let [a, b] = [self.four(simd, A, column), self.four(simd, B, column)];
        (a * a + b * b).simd_gt(self.four(simd, REACH, column)).to_bitmask() as u8
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
    pub fn decide(&mut self, plan: &Plan, middle: Phases, gap: usize, part: Part) {
        self.decided += 1;
        match Local::new(self.amplitudes(gap), middle, plan.ratio).first_root(part) {
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

    #[test]
    fn bounds_of_a_gap() {
        let chain = Chain { masses: 1, forcing_frequency: 3.0, ..Chain::default() };
        let mut slot = Slot::new(2, Watch::new(&chain, &[]));
        slot.set(1, [3.0, 4.0, 0.15, 0.2], &Plan::new(&chain, 0.125));
        let exact = [7.25 / 512.0, 0.75 * 0.75, 2.25, (1.0 - 8.0 * 0.25) / 4.0];
        let off = [SAG, REACH, FORCED, TAME].map(|row| slot.rows[row][2] - exact[row - SAG]);
        assert!(off.iter().all(|off| off.abs() < 2e-9), "{off:?}");
    }

    /// Impacts are certain that are fast enough and far enough from an earlier one and from the end
    /// of the step: here 1.25e-12 is far enough, for more than one.
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
            let mut slot = Slot::new(2, Watch::new(&Chain::default(), &[]));
            slot.add(Root { s, gap: 0, speed, jump: [0.0; 2] }, after, end, restitution);
            assert_eq!(slot.roots.len(), usize::from(is_certain), "{s} {speed} {after} {end}");
            assert_eq!(slot.handed_over, !is_certain);
        }
    }
}

//! Keeps the gaps of all chains that are simulated side by side.

use super::plan::Plan;
use super::proof::{LARGEST, MARGIN};
use fearless_simd::{f64x4, prelude::*};
use std::ops::Range;

/// Gaps side by side. Four, whatever the processor has: nothing depends on its width.
pub const WIDTH: usize = 4;

/// Rows of [`Columns::rows`]: the amplitudes of cos ωt, sin ωt, cos Ωt and sin Ωt.
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

/// The gaps of all chains, those of a chain in columns one after another.
pub struct Columns {
    /// A gap in each column. The column before gap 0 and that after the last gap are of no gap
    /// between walls, and copies of the last and the first gap on a ring, with a SAG of −1.
    pub rows: [Vec<f64>; LAST + 1],
    gaps: usize,
    stride: usize,
    /// The first columns of blocks with a gap that can close, and whether a block is among them.
    pub active: Vec<usize>,
    is_active: Vec<bool>,
}

impl Columns {
    /// Creates chains of gaps that never close.
    pub fn new(chains: usize, gaps: usize) -> Columns {
        let stride = (gaps + WIDTH - 1).next_multiple_of(WIDTH);
        let fill = |row| [0.0, -1.0, f64::INFINITY, 0.0, 1.0, 1.0][usize::max(row, D) - D];
        Columns {
            rows: std::array::from_fn(|row| vec![fill(row); chains * stride]),
            gaps,
            stride,
            active: Vec::new(),
            is_active: vec![false; chains * stride / WIDTH],
        }
    }

    /// Sets a gap; returns whether its amplitudes are within the bounds of the proofs.
    pub fn set(&mut self, chain: usize, gap: usize, amplitudes: [f64; 4], plan: &Plan) -> bool {
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
        let values = [a, b, c, d, sag, reach, square * forced, tame, last];
        let column = self.before(chain, gap) + 1;
        for (row, value) in self.rows.iter_mut().zip(values) {
            row[column] = value;
        }
        if plan.ring {
            self.copy_ends(column..column + 1);
        }
        forced < LARGEST && free + square * forced < LARGEST
    }

    /// Returns the amplitudes of the gap in a column, in units of d: of cos ωt, sin ωt, cos Ωt and
    /// sin Ωt.
    #[inline(always)]
    pub fn amplitudes(&self, column: usize) -> [f64; 4] {
        [A, B, C, D].map(|row| self.rows[row][column])
    }

    /// Returns the column before that of a gap.
    #[inline(always)]
    pub fn before(&self, chain: usize, gap: usize) -> usize {
        chain * self.stride + gap
    }

    /// Returns the chain and the gap of a column, on a ring also of a copy.
    #[inline(always)]
    pub fn place(&self, column: usize) -> [usize; 2] {
        let chain = column / self.stride;
        let gap = match column - chain * self.stride {
            0 => self.gaps - 1,
            column if column > self.gaps => 0,
            column => column - 1,
        };
        [chain, gap]
    }

    /// Copies columns of a ring that have changed to their other places, if they have two.
    #[cold]
    pub fn copy_ends(&mut self, columns: Range<usize>) {
        let [chain, _] = self.place(columns.start);
        let (first, last) = (chain * self.stride, chain * self.stride + self.gaps + 1);
        for column in columns {
            let other = match self.place(column) {
                [_, 0] => first + last + 1 - column,
                [_, gap] if gap + 1 == self.gaps => first + last - 1 - column,
                _ => continue,
            };
            self.rows.iter_mut().for_each(|row| row[other] = row[column]);
            self.activate(other, 1);
        }
        (self.rows[SAG][first], self.rows[SAG][last]) = (-1.0, -1.0);
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

    /// Lists the blocks with a gap that can close, of chains that have not ended.
    #[inline(always)]
    pub fn list_active<S: Simd>(&mut self, simd: S, has_ended: impl Fn(usize) -> bool) {
        self.active.clear();
        for block in 0..self.is_active.len() {
            let column = WIDTH * block;
            let is_active = !has_ended(column / self.stride) && self.can_close(simd, column) != 0;
            self.is_active[block] = is_active;
            if is_active {
                self.active.push(column);
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Chain;

    #[test]
    fn bounds_of_a_gap() {
        let chain = Chain { masses: 1, forcing_frequency: 3.0, ..Chain::default() };
        let mut columns = Columns::new(1, 2);
        assert!(columns.set(0, 1, [3.0, 4.0, 0.15, 0.2], &Plan::new(&chain, 0.125)));
        let exact = [7.25 / 512.0, 0.75 * 0.75, 2.25, (1.0 - 8.0 * 0.25) / 4.0];
        let off = [SAG, REACH, FORCED, TAME].map(|row| columns.rows[row][2] - exact[row - SAG]);
        assert!(off.iter().all(|off| off.abs() < 2e-9), "{off:?}");
    }
}

//! Keeps one of the chains that are simulated side by side.

use super::grid::Phases;
use super::plan::Plan;
use super::proof::{LARGEST, Local, Outcome, Part, SLOW, blur, cos_sin};
use crate::Watch;
use fearless_simd::{f64x4, prelude::*};

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
pub const ROWS: usize = 8;

#[derive(Clone, Copy, Debug)]
pub struct Root {
    /// Time after the middle of the step.
    pub s: f64,
    pub gap: usize,
    pub speed: f64,
    /// Jump of the rate of the gap times sine and cosine of the phase ωt.
    pub jump: [f64; 2],
}

/// One chain.
pub struct Slot {
    /// A gap in each column. The column before gap 0 and that after the last gap are of no gap
    /// between walls, and copies of the last and the first gap on a ring.
    pub rows: [Vec<f64>; ROWS],
    pub gaps: usize,
    /// Columns, a whole number of blocks.
    pub columns: usize,
    pub watch: Watch,
    /// First roots of gaps within this step, in any order.
    pub roots: Vec<Root>,
    /// Whether it is among the chains that may have a root in this step.
    pub in_turn: bool,
    /// Whether the chain has to be simulated by the engine.
    pub handed_over: bool,
    /// Whether it has had the impact that was asked for.
    pub ended: bool,
}

impl Slot {
    /// Creates a chain of gaps that never close.
    pub fn new(gaps: usize, watch: Watch) -> Slot {
        let columns = (gaps + WIDTH - 1).next_multiple_of(WIDTH);
        let fill = |row| [0.0, -1.0, f64::INFINITY, 0.0, 1.0][usize::max(row, D) - D];
        let rows = std::array::from_fn(|row| vec![fill(row); columns]);
        let (in_turn, handed_over, ended) = (false, false, false);
        Slot { rows, gaps, columns, watch, roots: Vec::new(), in_turn, handed_over, ended }
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
        let column = [a, b, c, d, sag, reach, square * forced, tame];
        for (row, value) in self.rows.iter_mut().zip(column) {
            row[gap + 1] = value;
        }
        self.handed_over |= !(forced < LARGEST && free + square * forced < LARGEST);
        if plan.ring {
            self.copy_ends(gap + 1);
        }
    }

    /// Returns the amplitudes of a gap: of cos ωt, sin ωt, cos Ωt and sin Ωt, in units of d.
    pub fn amplitudes(&self, gap: usize) -> [f64; 4] {
        [A, B, C, D].map(|row| self.rows[row][gap + 1])
    }

    /// Copies a column of a ring that has changed to its other place, if it has two.
    pub fn copy_ends(&mut self, column: usize) {
        let last = self.gaps;
        let other = match column {
            0 => last,
            1 => last + 1,
            _ if column == last => 0,
            _ if column == last + 1 => 1,
            _ => return,
        };
        self.rows.iter_mut().for_each(|row| row[other] = row[column]);
    }

    pub fn hand_over(&mut self) {
        self.handed_over = true;
        self.roots.clear();
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

    /// Adds a root of a gap, if an impact there is certain and its order too: `after` is the time
    /// up to which an adjacent gap may have been hit.
    #[inline(always)]
    pub fn add(&mut self, root: Root, after: f64, half: f64, restitution: f64) {
        let blur = blur(root.speed);
        let sure =
            root.speed * restitution >= SLOW && root.s - after > blur && half - root.s > blur;
        if sure && !self.handed_over {
            self.roots.push(root);
        } else {
            self.hand_over();
        }
    }

    /// Finds the first root of a gap in a part of the step by itself.
    #[cold]
    #[inline(never)]
    pub fn decide(&mut self, plan: &Plan, middle: Phases, gap: usize, part: Part) {
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
}

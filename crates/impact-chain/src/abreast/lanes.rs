//! Keeps the gaps of many chains in lanes of wide registers, and looks at all of them step by step.

use super::columns::{A, B, C, Columns, D, FORCED, LAST, REACH, SAG, TAME, WIDTH};
use super::plan::{Grid, Phases, Plan, Step};
use super::proof::{LARGEST, MARGIN, Part, blur, least_width};
use super::roots::Candidates;
use super::slot::Slot;
use crate::Impact;
use fearless_simd::{f64x4, prelude::*};

/// Steps after which a run checks again whether to stop, and which gaps can close.
const CHECK_EVERY: usize = 128;

pub struct Lanes<'a> {
    plan: &'a Plan,
    pub slots: Vec<Slot>,
    pub columns: Columns,
    candidates: Candidates,
    /// First columns of the blocks to look at, with the bits of gaps: none in the last.
    flagged: Vec<(usize, u8)>,
    /// Slots with roots or candidates in this step.
    pending: Vec<usize>,
}

/// Evaluates a cos ωt + b sin ωt + c cos Ωt + d sin Ωt.
#[inline(always)]
fn sum<S: Simd>(
    [a, b, c, d]: [f64x4<S>; 4],
    [cos, sin, forced_cos, forced_sin]: Phases,
) -> f64x4<S> {
    (a * cos + b * sin) + (c * forced_cos + d * forced_sin)
}

/// Evaluates its derivative in units of ω.
#[inline(always)]
fn slope<S: Simd>(
    [a, b, c, d]: [f64x4<S>; 4],
    [cos, sin, forced_cos, forced_sin]: Phases,
    ratio: f64,
) -> f64x4<S> {
    (b * cos - a * sin) + (d * forced_cos - c * forced_sin) * ratio
}

impl<'a> Lanes<'a> {
    pub fn new(plan: &'a Plan, slots: Vec<Slot>, columns: Columns) -> Self {
        let blocks = columns.rows[A].len() / WIDTH;
        Lanes {
            plan,
            slots,
            columns,
            candidates: Candidates::default(),
            flagged: vec![(0, 0); blocks + 1],
            pending: Vec::new(),
        }
    }

    /// Simulates all chains to the end, unless `stopped` returns true before.
    #[inline(always)]
    pub fn run<S: Simd>(&mut self, simd: S, grid: &Grid, end: f64, stopped: &dyn Fn() -> bool) {
        let (mut i, mut start, mut listed) = (0, grid.start(), 0);
        for piece in grid.pieces() {
            for step in &*piece {
                let running = self.slots.iter().filter(|slot| !slot.has_ended).count();
                if i % CHECK_EVERY == 0 || running != listed {
                    listed = running;
                    self.columns.list_active(simd, |chain| self.slots[chain].has_ended);
                    // No gap can close any more.
                    if stopped() || self.columns.active.is_empty() {
                        return;
                    }
                }
                let middle = (i as f64 + 0.5) * grid.length;
                call_apart(
                    simd,
                    #[inline(always)]
                    || self.look(simd, start, step),
                );
                while !self.pending.is_empty() {
                    let Lanes { plan, slots, candidates, .. } = self;
                    call_apart(
                        simd,
                        #[inline(always)]
                        || candidates.locate(simd, plan, step.middle, slots),
                    );
                    call_apart(
                        simd,
                        #[inline(always)]
                        || self.advance(simd, step, [middle, end]),
                    );
                }
                (i, start) = (i + 1, step.end);
            }
        }
    }

    #[inline(always)]
    fn look<S: Simd>(&mut self, simd: S, start: Phases, step: &Step) {
        self.scan(simd, step.end);
        for place in 0.. {
            let (column, look) = self.flagged[place];
            if look == 0 {
                break;
            }
            self.sift(simd, column, look, start, step);
        }
    }

    /// Flags the gaps whose width is below SAG at the end of the step, or was at its start.
    ///
    /// Of all others f lies above the chord less M₂ h²/8, that is, above zero throughout.
    #[inline(always)]
    fn scan<S: Simd>(&mut self, simd: S, end: Phases) {
        let Columns { rows: [a, b, c, d, sag, .., last], active, .. } = &mut self.columns;
        // Of one length, so that one check of bounds is left.
        let (columns, last) = (a.len(), &mut last[..a.len()]);
        let rows = [&a[..columns], &b[..columns], &c[..columns], &d[..columns], &sag[..columns]];
        let (flags, mut flagged) = (&mut self.flagged[..=active.len()], 0);
        for &column in &*active {
            let four = |row: &[f64]| f64x4::from_slice(simd, &row[column..column + WIDTH]);
            let [a, b, c, d, sag] = rows;
            let f = sum([four(a), four(b), four(c), four(d)], end) + (1.0 - MARGIN);
            let look = f.min(four(last)).simd_lt(four(sag)).to_bitmask() as u8;
            f.store_slice(&mut last[column..column + WIDTH]);
            flags[flagged] = (column, look);
            flagged += usize::from(look != 0);
        }
        flags[flagged] = (0, 0);
    }

    /// Makes candidates of the flagged gaps of a block that are below zero at the end of the step,
    /// and decides about the others.
    ///
    /// A tame gap with a root has a minimum ≤ 0 within the step and is convex there (see
    /// [`Part::tame`]), so f' < 0 at the start and f' ≥ 0 at the end, and the tangents meet below
    /// zero.
    #[inline(always)]
    fn sift<S: Simd>(&mut self, simd: S, column: usize, look: u8, start: Phases, step: &Step) {
        let Plan { ratio, step: length, half, .. } = *self.plan;
        let columns = &self.columns;
        let four = |row| columns.four(simd, row, column);
        let parts = [four(A), four(B), four(C), four(D)];
        let f = sum(parts, step.end) + 1.0;
        let below = f.simd_lt(0.0).to_bitmask() as u8 & look;
        let mut dips = look & !below;
        let tame = four(SAG).simd_lt(four(TAME)).to_bitmask() as u8;
        if dips != 0 {
            let f0 = sum(parts, start) + 1.0;
            let (rate0, rate1) = (slope(parts, start, ratio), slope(parts, step.end, ratio));
            let meet = ((f - MARGIN) * rate0 - (f0 - MARGIN) * rate1) - rate1 * rate0 * length;
            let dip = rate1.simd_ge(0.0) & rate0.simd_lt(0.0) & meet.simd_ge(0.0);
            dips &= dip.to_bitmask() as u8 | !tame;
            if dips != 0 {
                dips &= columns.can_close(simd, column);
            }
        }
        let part = Part { start: -half, end: half, after: -half, just_hit: false, tame: false };
        self.find(column, [below, dips, tame], part, step.middle);
    }

    /// Makes candidates of gaps that are below zero at the end of a part of the step, and decides
    /// about other gaps by themselves: bits of the columns from this one on. The second may have
    /// just been hit.
    #[inline(always)]
    fn find(&mut self, column: usize, [below, dips, tame]: [u8; 3], part: Part, middle: Phases) {
        let mut bits = below | dips;
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize;
            bits &= bits - 1;
            let has_lane = |bits: u8| bits >> lane & 1 == 1;
            let part = Part { just_hit: part.just_hit && lane == 1, tame: has_lane(tame), ..part };
            let [place, gap] = self.columns.place(column + lane);
            let (chain, amplitudes) =
                (&mut self.slots[place], self.columns.amplitudes(column + lane));
            if chain.has_ended {
                return;
            }
            if !chain.is_pending {
                chain.is_pending = true;
                self.pending.push(place);
            }
            if has_lane(below) {
                self.candidates.push(amplitudes, place, gap, part);
            } else {
                chain.decide(self.plan, middle, gap, amplitudes, part);
            }
        }
    }

    /// Lets each chain with a root go to its next impact, given the middle of the step and the end.
    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, step: &Step, times: [f64; 2]) {
        let mut left = 0;
        for place in 0..self.pending.len() {
            let slot = self.pending[place];
            self.pending[left] = slot;
            let is_pending = self.impact(simd, slot, step, times);
            self.slots[slot].is_pending = is_pending;
            left += usize::from(is_pending);
        }
        self.pending.truncate(left);
    }

    /// Lets the gap with the earliest root be hit; returns whether there is one until the end.
    #[inline(always)]
    fn impact<S: Simd>(&mut self, simd: S, slot: usize, step: &Step, times: [f64; 2]) -> bool {
        let plan = self.plan;
        let chain = &mut self.slots[slot];
        let Some(now) = chain.roots.get(chain.first).copied() else { return false };
        let [middle, end] = times;
        let time = middle + now.s / plan.omega;
        if time <= end {
            let closing_speed = now.speed * plan.speed;
            chain.watch.count(Impact { time, gap: now.gap + plan.first, closing_speed });
        }
        if time > end || time > plan.end.1 && chain.hit(now.gap) {
            chain.end();
            return false;
        }
        // The impact pushes masses into the gaps beside it: one of these that had a root at nearly
        // this time has it even sooner, and is a tie there.
        chain.take_first(plan.neighbours[now.gap]);
        // The three columns of the gap and its neighbours, and a fourth that does not change.
        let columns = &mut self.columns;
        let column = columns.before(slot, now.gap);
        let weights = f64x4::from_slice(simd, &plan.weights[now.gap]);
        let a = columns.four(simd, A, column) + weights * now.jump[0];
        let b = columns.four(simd, B, column) - weights * now.jump[1];
        let parts = [a, b, columns.four(simd, C, column), columns.four(simd, D, column)];
        let free = a * a + b * b;
        let bend = free.sqrt() + columns.four(simd, FORCED, column);
        let sag = bend * plan.eighth;
        let f = sum(parts, step.end) + 1.0;
        for (row, new) in [(A, a), (B, b), (SAG, sag), (LAST, f - MARGIN)] {
            new.store_slice(&mut columns.rows[row][column..column + WIDTH]);
        }
        if sag.simd_gt(LARGEST * plan.eighth).any_true() {
            chain.hand_over();
            return true;
        }
        let can_close = free.simd_gt(columns.four(simd, REACH, column)).to_bitmask() as u8 & 0b111;
        columns.activate(column, usize::from(can_close));
        if plan.ring && (now.gap < 2 || now.gap + 3 > plan.weights.len()) {
            columns.copy_ends(column..column + 3);
        }
        let tame = sag.simd_lt(columns.four(simd, TAME, column));
        let below = f.simd_lt(0.0).to_bitmask() as u8 & 0b111;
        let ends = [f, slope(parts, step.end, plan.ratio), bend];
        let (opening, left) = (now.speed * plan.restitution, plan.half - now.s);
        let width = least_width(simd, ends, [tame, weights.simd_lt(0.0)], opening, left);
        let dips = width.simd_le(MARGIN).to_bitmask() as u8 & can_close & !below;
        let tame = tame.to_bitmask() as u8;
        let after = now.s + blur(now.speed);
        let part = Part { start: now.s, end: plan.half, after, just_hit: true, tame: false };
        self.find(column, [below, dips, tame], part, step.middle);
        true
    }
}

/// Calls a closure in a function of its own, which then has all registers.
#[inline(never)]
fn call_apart<S: Simd, R>(simd: S, closure: impl FnOnce() -> R) -> R {
    simd.vectorize(closure)
}

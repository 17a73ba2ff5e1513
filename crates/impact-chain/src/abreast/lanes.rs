//! Keeps the gaps of many chains in lanes of wide registers, and looks at all of them step by step.

use super::grid::{Grid, Phases, Step};
use super::plan::Plan;
use super::proof::{LARGEST, MARGIN, Part, blur};
use super::roots::{Candidate, Candidates};
use super::slot::{A, B, C, D, FORCED, REACH, SAG, Slot, TAME, WIDTH};
use crate::Impact;
use fearless_simd::{f64x4, prelude::*};

/// Steps after which a run checks again whether to stop, and which gaps can close.
const CHECK_EVERY: usize = 128;

/// What is read at each step of four gaps, a bit of each byte for each gap.
#[derive(Clone, Copy, Default)]
struct Block {
    /// Rows A to SAG.
    rows: [[f64; WIDTH]; 5],
    /// Gaps with f below SAG at the last end of a step.
    low: u8,
    tame: u8,
    /// Whether the block is among the active.
    is_active: bool,
}

pub struct Lanes<'a> {
    plan: &'a Plan,
    pub slots: Vec<Slot>,
    /// Blocks of all chains, of each as many: columns 4 i to 4 i + 3, without the copies of a ring.
    blocks: Vec<Block>,
    blocks_each: usize,
    candidates: Candidates,
    /// Blocks with a gap that can close, and their chains.
    active: Vec<[u32; 2]>,
    /// Places in `active` of blocks to look at, with the bits of gaps.
    flagged: Vec<[u32; 2]>,
    /// Slots with roots or candidates in this step.
    todo: Vec<usize>,
    changed: bool,
    /// Half the length of a step in units of 1/ω.
    half: f64,
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

#[inline(always)]
fn row<S: Simd>(simd: S, block: &Block, row: usize) -> f64x4<S> {
    f64x4::from_slice(simd, &block.rows[row])
}

#[inline(always)]
fn amplitudes<S: Simd>(simd: S, block: &Block) -> [f64x4<S>; 4] {
    [row(simd, block, A), row(simd, block, B), row(simd, block, C), row(simd, block, D)]
}

/// Lists the places of the bits of a byte.
#[inline(always)]
fn places(mut bits: u8) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = bits.trailing_zeros() as usize;
        (bits != 0).then(|| bits &= bits - 1)?;
        Some(place)
    })
}

impl<'a> Lanes<'a> {
    pub fn new(plan: &'a Plan, slots: Vec<Slot>) -> Self {
        let (gaps, columns) = slots.first().map_or((0, 0), |slot| (slot.gaps, slot.columns));
        let blocks_each = columns / WIDTH;
        let number = slots.len() * blocks_each;
        let mut never = Block::default();
        never.rows[SAG] = [-1.0; WIDTH];
        let mut lanes = Lanes {
            plan,
            blocks: vec![never; number],
            blocks_each,
            slots,
            candidates: Candidates::default(),
            active: Vec::new(),
            flagged: Vec::new(),
            todo: Vec::new(),
            changed: true,
            half: 0.5 * plan.step,
        };
        for slot in 0..lanes.slots.len() {
            (1..=gaps).for_each(|column| lanes.copy_column(slot, column));
        }
        lanes
    }

    /// Copies what is read at each step of a gap to its block.
    #[inline(always)]
    fn copy_column(&mut self, slot: usize, column: usize) {
        let chain = &self.slots[slot];
        let place = slot * self.blocks_each + column / WIDTH;
        let block = &mut self.blocks[place];
        for (block, row) in block.rows.iter_mut().zip(&chain.rows) {
            block[column % WIDTH] = row[column];
        }
        // At the start, t = 0.
        let is_low =
            1.0 - MARGIN + chain.rows[A][column] + chain.rows[C][column] < chain.rows[SAG][column];
        block.low |= u8::from(is_low) << (column % WIDTH);
        let is_tame = chain.rows[SAG][column] < chain.rows[TAME][column];
        block.tame |= u8::from(is_tame) << (column % WIDTH);
    }

    /// Simulates all chains to the end, unless `stopped` returns true before.
    #[inline(always)]
    pub fn run<S: Simd>(&mut self, simd: S, grid: &Grid, end: f64, stopped: &dyn Fn() -> bool) {
        let (mut i, mut start) = (0, grid.start());
        for piece in grid.pieces() {
            for step in &*piece {
                if i % CHECK_EVERY == 0 {
                    self.changed = true;
                    if stopped() {
                        return;
                    }
                }
                if self.changed {
                    self.list_active(simd);
                    // No gap can close any more.
                    if self.active.is_empty() {
                        return;
                    }
                }
                let middle = (i as f64 + 0.5) * grid.length;
                scan_apart(self, simd, step.end);
                if !self.flagged.is_empty() {
                    sift_apart(self, simd, start, step);
                    while !self.todo.is_empty() {
                        let Lanes { plan, slots, candidates, half, .. } = self;
                        locate_apart(candidates, simd, plan, *half, step.middle, slots);
                        advance_apart(self, simd, step, middle, end);
                    }
                }
                (i, start) = (i + 1, step.end);
            }
        }
    }

    /// Lists the blocks with a gap that can close, of chains that are not handed over.
    #[inline(always)]
    fn list_active<S: Simd>(&mut self, simd: S) {
        self.active.clear();
        for (slot, chain) in self.slots.iter().enumerate() {
            for number in 0..self.blocks_each {
                let place = slot * self.blocks_each + number;
                let over = chain.handed_over || chain.ended;
                let is_active = !over && chain.can_close(simd, WIDTH * number) != 0;
                self.blocks[place].is_active = is_active;
                if is_active {
                    self.active.push([place as u32, slot as u32]);
                }
            }
        }
        self.changed = false;
    }

    /// Flags the gaps whose width is below SAG at the end of the step, or was at its start.
    ///
    /// Of all others f lies above the chord less M₂ h²/8, that is, above zero throughout.
    #[inline(always)]
    fn scan<S: Simd>(&mut self, simd: S, end: Phases) {
        self.flagged.clear();
        for (number, &[place, _]) in self.active.iter().enumerate() {
            let block = &mut self.blocks[place as usize];
            let f = sum(amplitudes(simd, block), end) + (1.0 - MARGIN);
            let low = f.simd_lt(row(simd, block, SAG)).to_bitmask() as u8;
            let look = low | block.low;
            block.low = low;
            if look != 0 {
                self.flagged.push([number as u32, u32::from(look)]);
            }
        }
    }

    /// Makes candidates of the flagged gaps that are below zero at the end of the step, and decides
    /// about the others.
    ///
    /// A tame gap with a root has a minimum ≤ 0 within the step and is convex there (see
    /// [`Part::tame`]), so f' < 0 at the start and f' ≥ 0 at the end, and the tangents meet below
    /// zero.
    #[inline(always)]
    fn sift<S: Simd>(&mut self, simd: S, start: Phases, step: &Step) {
        let (ratio, length) = (self.plan.ratio, self.plan.step);
        for &[number, look] in &self.flagged {
            let [place, slot] = self.active[number as usize].map(|number| number as usize);
            let chain = &mut self.slots[slot];
            let block = &self.blocks[place];
            let column = WIDTH * (place - slot * self.blocks_each);
            let parts = amplitudes(simd, block);
            let f = sum(parts, step.end) + 1.0;
            let below = f.simd_lt(0.0).to_bitmask() as u8;
            let mut dips = look as u8 & !below;
            let tame = block.tame;
            if dips != 0 {
                let f0 = sum(parts, start) + 1.0;
                let (rate0, rate1) = (slope(parts, start, ratio), slope(parts, step.end, ratio));
                let meet = ((f - MARGIN) * rate0 - (f0 - MARGIN) * rate1) - rate1 * rate0 * length;
                let dip = rate1.simd_ge(0.0) & rate0.simd_lt(0.0) & meet.simd_ge(0.0);
                dips &= dip.to_bitmask() as u8 | !tame;
                if dips != 0 {
                    dips &= chain.can_close(simd, column);
                }
            }
            if below | dips == 0 {
                continue;
            }
            if !chain.in_turn {
                chain.in_turn = true;
                self.todo.push(slot);
            }
            for lane in places(below) {
                let (gap, tame) = (column + lane - 1, tame >> lane & 1 == 1);
                let who = Candidate { slot, gap, after: -self.half, just_hit: false, tame };
                let amplitudes = [A, B, C, D].map(|row| block.rows[row][lane]);
                self.candidates.push(amplitudes, -self.half, who);
            }
            for lane in places(dips) {
                let tame = tame >> lane & 1 == 1;
                let [start, end] = [-self.half, self.half];
                let part = Part { start, end, after: start, just_hit: false, tame };
                chain.decide(self.plan, step.middle, column + lane - 1, part);
            }
        }
    }

    /// Lets each chain that has a root go to its next impact.
    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, step: &Step, middle: f64, end: f64) {
        let mut left = 0;
        for place in 0..self.todo.len() {
            let slot = self.todo[place];
            if self.impact(simd, slot, step, middle, end) {
                self.todo[left] = slot;
                left += 1;
            } else {
                self.slots[slot].in_turn = false;
                self.changed |= self.slots[slot].handed_over || self.slots[slot].ended;
            }
        }
        self.todo.truncate(left);
    }

    /// Lets the gap with the earliest root be hit; returns whether there is one until the end.
    #[inline(always)]
    fn impact<S: Simd>(
        &mut self,
        simd: S,
        slot: usize,
        step: &Step,
        middle: f64,
        end: f64,
    ) -> bool {
        let plan = self.plan;
        let chain = &mut self.slots[slot];
        let Some(mut now) = chain.roots.first().copied() else { return false };
        for root in &chain.roots[1..] {
            if root.s < now.s {
                now = *root;
            }
        }
        let time = middle + now.s / plan.omega;
        if time > end {
            chain.roots.clear();
            return false;
        }
        let closing_speed = now.speed * plan.speed;
        chain.watch.count(Impact { time, gap: now.gap + plan.first, closing_speed });
        if time > plan.enough {
            chain.ended = true;
            chain.roots.clear();
            return false;
        }
        // Roots of the three gaps are outdated. The impact pushes masses into the gaps beside it:
        // one of these that had a root at nearly this time has it even sooner, and is a tie there.
        let [left, right] = plan.neighbours[now.gap];
        let mut kept = 0;
        for place in 0..chain.roots.len() {
            let root = chain.roots[place];
            let near = root.gap == left || root.gap == right;
            chain.roots[kept] = root;
            kept += usize::from(!near & (root.gap != now.gap));
        }
        chain.roots.truncate(kept);
        // The three columns of the gap and its neighbours, and a fourth that does not change.
        let column = now.gap;
        let weights = f64x4::from_slice(simd, &plan.weights[now.gap]);
        let a = chain.four(simd, A, column) + weights * now.jump[0];
        let b = chain.four(simd, B, column) - weights * now.jump[1];
        let parts = [a, b, chain.four(simd, C, column), chain.four(simd, D, column)];
        let free = a * a + b * b;
        let sag = (free.sqrt() + chain.four(simd, FORCED, column)) * plan.eighth;
        for (row, new) in [(A, a), (B, b), (SAG, sag)] {
            new.store_slice(&mut chain.rows[row][column..column + WIDTH]);
        }
        let large = sag.simd_gt(LARGEST * plan.eighth).any_true();
        let on = free.simd_gt(chain.four(simd, REACH, column)).to_bitmask() as u8;
        let f = sum(parts, step.end) + 1.0;
        let rate = slope(parts, step.end, plan.ratio);
        let low = (f - MARGIN).simd_lt(sag).to_bitmask() as u8;
        let below = f.simd_lt(0.0).to_bitmask() as u8 & 0b111;
        // Neighbours are above the tangent at the end; the gap itself opens. Where that proves
        // nothing, by itself.
        let tangent = f - rate.max(f64x4::splat(simd, 0.0)) * (self.half - now.s);
        let tangent = tangent.simd_le(MARGIN).to_bitmask() as u8 & 0b101;
        let tame = sag.simd_lt(chain.four(simd, TAME, column)).to_bitmask() as u8;
        let dips = (tangent | !tame) & on & 0b111 & !below;
        if large {
            chain.hand_over();
            return true;
        }
        if plan.ring && (column < 2 || column + 3 > plan.weights.len()) {
            self.copy_ring(slot, column);
        }
        let [a, b, c, d] = [a.as_slice(), b.as_slice(), parts[2].as_slice(), parts[3].as_slice()];
        let sag = sag.as_slice();
        let first = slot * self.blocks_each;
        for lane in 0..3 {
            let column = plan.own_column(column + lane);
            let (place, bit) = (first + column / WIDTH, column % WIDTH);
            let block = &mut self.blocks[place];
            let rows = &mut block.rows;
            (rows[A][bit], rows[B][bit], rows[SAG][bit]) = (a[lane], b[lane], sag[lane]);
            let bits = |word: u8, new: u8| word & !(1 << bit) | (new >> lane & 1) << bit;
            (block.low, block.tame) = (bits(block.low, low), bits(block.tame, tame));
            if on >> lane & 1 == 1 && !block.is_active {
                block.is_active = true;
                self.active.push([place as u32, slot as u32]);
            }
        }
        let after = now.s + blur(now.speed);
        for lane in places(below) {
            let gap = plan.own_column(column + lane) - 1;
            let (just_hit, tame) = (lane == 1, tame >> lane & 1 == 1);
            let who = Candidate { slot, gap, after, just_hit, tame };
            self.candidates.push([a[lane], b[lane], c[lane], d[lane]], now.s, who);
        }
        for lane in places(dips) {
            let (just_hit, tame) = (lane == 1, tame >> lane & 1 == 1);
            let part = Part { start: now.s, end: self.half, after, just_hit, tame };
            let gap = plan.own_column(column + lane) - 1;
            self.slots[slot].decide(plan, step.middle, gap, part);
        }
        true
    }

    /// Copies columns of a ring near its ends, after those from `column` on have changed.
    #[cold]
    fn copy_ring(&mut self, slot: usize, column: usize) {
        (column..column + 3).for_each(|column| self.slots[slot].copy_ends(column));
    }
}

#[inline(never)]
fn scan_apart<S: Simd>(lanes: &mut Lanes<'_>, simd: S, end: Phases) {
    simd.vectorize(
        #[inline(always)]
        || lanes.scan(simd, end),
    );
}

#[inline(never)]
fn sift_apart<S: Simd>(lanes: &mut Lanes<'_>, simd: S, start: Phases, step: &Step) {
    simd.vectorize(
        #[inline(always)]
        || lanes.sift(simd, start, step),
    );
}

#[inline(never)]
fn locate_apart<S: Simd>(
    candidates: &mut Candidates,
    simd: S,
    plan: &Plan,
    half: f64,
    middle: Phases,
    slots: &mut [Slot],
) {
    simd.vectorize(
        #[inline(always)]
        || candidates.locate(simd, plan, half, middle, slots),
    );
}

#[inline(never)]
fn advance_apart<S: Simd>(lanes: &mut Lanes<'_>, simd: S, step: &Step, middle: f64, end: f64) {
    simd.vectorize(
        #[inline(always)]
        || lanes.advance(simd, step, middle, end),
    );
}

//! Finds the certified first root of a sum of sinusoids and a constant, in its local frame.

use super::local_frame::{Frame, Frequencies};
use super::nodes::Nodes;
use super::outcome::{Counters, Next};
use super::screen::{Eighths, Piece};
use super::stepping::first_root_by_steps;
use std::any::Any;
use std::cell::RefCell;
use std::sync::Arc;

/// How often the reach is halved: pieces of 1, 1/2, … 2^-LEVELS of it.
const LEVELS: usize = 2;

#[derive(Clone, Debug)]
pub struct Search<const M: usize> {
    pub frequencies: Frequencies<M>,
    /// The whole reach, its halves, its quarters, …: piece k is halved into 2k + 1 and 2k + 2.
    pieces: [Piece<M>; (1 << (LEVELS + 1)) - 1],
    eighths: Eighths<M>,
    nodes: Nodes<M>,
    /// M₂ ≥ |f''| of a frame is this times its M₄: 1 over the square of the slowest frequency.
    curvature: f64,
}

impl<const M: usize> Search<M> {
    /// Returns the search of these frequencies. Its tables are those of the last one that was asked
    /// for on this thread, if that had the same frequencies.
    pub fn shared(frequencies: Frequencies<M>) -> Arc<Search<M>> {
        thread_local!(static LAST: RefCell<Option<Arc<dyn Any + Send + Sync>>> = const { RefCell::new(None) });
        LAST.with_borrow_mut(|last| {
            let before = last.clone().and_then(|last| last.downcast::<Search<M>>().ok());
            before.filter(|last| last.frequencies == frequencies).unwrap_or_else(|| {
                let search = Arc::new(Search::new(frequencies));
                *last = Some(search.clone());
                search
            })
        })
    }

    fn new(frequencies: Frequencies<M>) -> Self {
        let pieces = std::array::from_fn(|k| {
            let level = (k + 1).ilog2();
            let width = frequencies.reach / f64::from(1u32 << level);
            let index = k + 1 - (1 << level);
            Piece::new(index as f64 * width, width, &frequencies)
        });
        let slowest = frequencies.big_omegas.iter().fold(frequencies.omega, |a, &b| a.min(b));
        Search {
            frequencies,
            pieces,
            eighths: Eighths::new(&frequencies),
            nodes: Nodes::new(&frequencies),
            curvature: 1.0 / (slowest * slowest),
        }
    }

    /// Finds the first root after s = 0, or proves that there is none up to the reach.
    ///
    /// f₀ > 0: the first root. f₀ = 0: the first root after s = 0 if f leaves zero upwards, and
    /// s = 0 itself if it moves down. f₀ < 0 is a root at s = 0.
    #[inline(always)]
    pub fn first_root(&self, frame: &Frame<M>, work: &mut Counters) -> Next {
        work.searches += 1;
        if frame.f0 < 0.0 || (frame.f0 == 0.0 && frame.g0 < 0.0) {
            return Next::Root { s: 0.0, speed: -frame.g0 };
        }
        work.pieces += 1;
        let whole = self.pieces[0].coefficients(frame);
        if whole.are_positive() {
            return Next::Clear { s: self.frequencies.reach };
        }
        if whole.change_sign_once()
            && let Some((s, speed)) = self.nodes.root(frame, self.eighths.guess(frame), work)
            && s > 0.0
            && s < self.frequencies.reach
            && self.is_first(frame, speed)
        {
            return Next::Root { s, speed };
        }
        self.by_pieces(frame, work)
    }

    /// Returns whether a root at s > 0 where f falls with `speed` is the first, given that the
    /// coefficients of the whole reach change their sign once.
    /// Their polynomial q lies below f and is above zero before its one root (Descartes). With M₂
    /// ≥ |f''|, f ≥ speed h − M₂ h²/2 at s − h, so there is no root within speed/M₂
    /// before s. Where that stretch begins (if it is before 0, nothing is left to show) f is at
    /// least speed²/2M₂. If that is more than f − q can be, then q is above zero there, hence
    /// before it, and so is f. Twice as much is required, since s and its speed are rounded.
    #[inline(always)]
    fn is_first(&self, frame: &Frame<M>, speed: f64) -> bool {
        let bound = self.curvature * frame.bound;
        speed > 0.0 && speed * speed > 4.0 * bound * self.pieces[0].largest_difference(frame)
    }

    /// Finds the first root by repeated halves of the reach, or by certified steps.
    #[inline(always)]
    fn by_pieces(&self, frame: &Frame<M>, work: &mut Counters) -> Next {
        let reach = self.frequencies.reach;
        let mut first = frame.f0;
        let mut k = 1;
        let clear = loop {
            let piece = &self.pieces[k];
            let coefficients = piece.coefficients(frame);
            work.pieces += 1;
            if coefficients.are_positive() {
                first = coefficients.last();
                // On to the next piece, the widest that begins here.
                while k > 0 && k % 2 == 0 {
                    k = (k - 2) / 2;
                }
                if k == 0 {
                    return Next::Clear { s: reach };
                }
                k += 1;
                continue;
            }
            if first > 0.0
                && let Some(guess) = piece.only_root(frame, first, &coefficients)
            {
                let (clear, end) = (piece.start, piece.start + piece.width);
                match self.nodes.root(frame, guess, work) {
                    // In the piece there is no other.
                    Some((s, speed)) if s > clear && s <= end => return Next::Root { s, speed },
                    _ => break clear,
                }
            }
            if 2 * k + 1 >= self.pieces.len() {
                break piece.start;
            }
            k = 2 * k + 1;
        };
        first_root_by_steps(frame, clear, reach, &self.frequencies, work)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::truth::{derivative, frame};
    use impact_numerics::random::{NormalPairs, Seed};

    #[test]
    fn a_gap_at_zero_or_below_is_hit_at_once_unless_it_opens() {
        let search = Search::new(Frequencies::new(1.0, [1.5]));
        for quadrature in [-0.4, 0.4] {
            let parts = [[0.1, quadrature], [0.1, quadrature]];
            let level = frame(1.0, parts, &search.frequencies);
            for f0 in [-1e-3, 0.0] {
                let next = search.first_root(&Frame { f0, ..level }, &mut Counters::default());
                let is_hit = matches!(next, Next::Root { s: 0.0, speed } if speed == -level.g0);
                assert_eq!(is_hit, f0 < 0.0 || level.g0 < 0.0, "{f0}, {}", level.g0);
            }
        }
    }

    /// A dip is no root above the band, one below it, and either within, where a miss is counted.
    /// The band is up to three times as wide where the curvature changes within it.
    #[test]
    fn dips_that_touch_zero_are_roots_below_the_band_alone() {
        let search = Search::new(Frequencies::new(1.0, [1.5]));
        let frequencies = &search.frequencies;
        let (mut tried, mut counted) = ([0; 3], 0);
        for i in 0..4000 {
            let mut normals = NormalPairs::new("dips", Seed(1), i);
            let ([q, v], [x, y]) = (normals.pair(), normals.pair());
            let s = 0.05 + 0.9 * frequencies.reach * (0.5 + y.atan2(x) / std::f64::consts::TAU);
            // At s the slope is zero, and the curvature 1e-4 to 1.
            let bend = 10f64.powi(-(i as i32 % 5));
            let back = |[value, quadrature]: [f64; 2], angle: f64| {
                let (sin, cos) = angle.sin_cos();
                [value * cos - quadrature * sin, quadrature * cos + value * sin]
            };
            let parts = [back([-bend - 2.25 * v, -1.5 * q], s), back([v, q], 1.5 * s)];
            let level = frame(bend + 1.25 * v, parts, frequencies);
            let margin = level.at(s, frequencies).margin.max(2.0 * f64::EPSILON * level.size);
            if (0..500).any(|k| level.at(s * f64::from(k) / 500.0, frequencies).f <= 0.0) {
                continue;
            }
            for depth in [1.5 * margin, 4.0 * margin, 1e-13, 1e-10, 1e-7, 1e-5, 1e-4, 1e-3] {
                for f0 in [level.f0 - depth, level.f0 + depth].into_iter().filter(|f0| *f0 > 0.0) {
                    let dip = Frame { f0, ..level };
                    let lowest = derivative(&dip, frequencies, 0, s) / margin;
                    let mut work = Counters::default();
                    let next = search.first_root(&dip, &mut work);
                    let (Next::Root { s: end, .. } | Next::Clear { s: end }) = next;
                    let is_root = matches!(next, Next::Root { .. });
                    let case = if lowest < -2.5 { 0 } else { 1 + usize::from(lowest < 2.5) };
                    tried[case] += 1;
                    counted += work.undecided * u64::from(lowest > 0.0);
                    let is_right = match case {
                        0 => is_root && end < s || lowest > -6.0 && work.undecided > 0,
                        1 => end > s,
                        _ => work.undecided > 0 || (end < s) == (lowest < 0.0),
                    };
                    let f = derivative(&dip, frequencies, 0, end).abs() / margin;
                    let is_zero = !is_root || f < 2.0;
                    assert!(is_right && is_zero, "{i}: {lowest:e} at {s}: {next:?}, {f}");
                }
            }
        }
        // Of the dips 1.5 margins above zero many are within the band.
        assert!(counted > 200 && tried.iter().all(|number| *number > 1000), "{tried:?}");
    }

    /// M₂ is that of the slowest part, and a speed counts from v² = 4 M₂ (f − q) on.
    #[test]
    fn a_root_is_the_first_beyond_the_doubt_of_the_screen() {
        let search = Search::new(Frequencies::new(1.5, [1.0]));
        let frame = frame(1.0, [[0.0; 2], [2.0, 0.0]], &search.frequencies);
        let bend = derivative(&frame, &search.frequencies, 2, 0.0).abs();
        let square = 4.0 * bend * search.pieces[0].largest_difference(&frame);
        assert!(search.is_first(&frame, (1.001 * square).sqrt()));
        assert!(!search.is_first(&frame, (0.999 * square).sqrt()));
    }
}

//! Finds the certified first root of a sum of sinusoids and a constant, in its local frame.

use super::local_frame::{Frame, Frequencies};
use super::nodes::Nodes;
use super::outcome::{Counters, Next};
use super::screen::{Eighths, Piece};
use super::stepping::first_root_by_steps;

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
    pub fn new(frequencies: Frequencies<M>) -> Self {
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

    /// Decides whether a root at s > 0 where f falls with `speed` is the first, given that the
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

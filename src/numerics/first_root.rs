//! The certified first root of a sum of sinusoids and a constant, in its local frame.

use super::local_frame::{Frame, Frequencies};
use super::polish::refine;
use super::screen::Piece;
use super::stepping::first_root_by_steps;

/// What a search found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// The first root, at `s`, where f falls with `speed` = −f'(s) ≥ 0.
    Root {
        /// Time since the frame's instant.
        s: f64,
        /// −f' at the root.
        speed: f64,
    },
    /// No root in (0, s].
    Clear {
        /// Certified up to here.
        s: f64,
    },
}

/// Counted work of searches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Searches started.
    pub searches: u64,
    /// Pieces screened: one polynomial certificate each, without a sine.
    pub pieces: u64,
    /// Evaluations of f with its sines (the start costs none).
    pub evaluations: u64,
    /// Searches that the screen could not decide.
    pub stepped: u64,
    /// Decisions taken inside the undecidable band.
    pub undecided: u64,
}

/// How often the reach is halved: pieces of 1, 1/2, … 2^-LEVELS of it.
const LEVELS: usize = 2;

/// The search for first roots at given frequencies.
#[derive(Clone, Debug)]
pub struct Search<const M: usize> {
    /// The frequencies.
    pub frequencies: Frequencies<M>,
    /// The whole reach, its halves, its quarters, …: piece k is halved into 2k + 1 and 2k + 2.
    pieces: [Piece<M>; (1 << (LEVELS + 1)) - 1],
}

impl<const M: usize> Search<M> {
    /// For the given frequencies.
    pub fn new(frequencies: Frequencies<M>) -> Self {
        let pieces = std::array::from_fn(|k| {
            let level = (k + 1).ilog2();
            let width = frequencies.reach / f64::from(1u32 << level);
            let index = k + 1 - (1 << level);
            Piece::new(index as f64 * width, width, &frequencies)
        });
        Search { frequencies, pieces }
    }

    /// The first root of the frame's function after s = 0, or the proof that there is none up to
    /// the reach.
    ///
    /// f₀ > 0: the first root. f₀ = 0: the first root after s = 0 if f leaves zero upwards, and
    /// s = 0 itself if it moves down. f₀ < 0 is a root at s = 0.
    #[inline(always)]
    pub fn first_root(&self, frame: &Frame<M>, work: &mut Work) -> Next {
        if let Some(next) = self.glance(frame, work) {
            return next;
        }
        let sight = self.look_closer(frame, work);
        self.settle(frame, sight, work)
    }

    /// The first step of a search, which ends most of them: the whole reach at one look.
    #[inline(always)]
    pub fn glance(&self, frame: &Frame<M>, work: &mut Work) -> Option<Next> {
        work.searches += 1;
        if frame.f0 < 0.0 || (frame.f0 == 0.0 && frame.g0 < 0.0) {
            return Some(Next::Root { s: 0.0, speed: -frame.g0 });
        }
        work.pieces += 1;
        let open = self.pieces[0].coefficients(frame).open();
        open.then_some(Next::Clear { s: self.frequencies.reach })
    }

    /// The second step: the halves of the reach, and the halves of what they leave open.
    #[inline(always)]
    pub fn look_closer(&self, frame: &Frame<M>, work: &mut Work) -> Sight {
        let mut first = frame.f0;
        let mut k = 1;
        loop {
            let piece = &self.pieces[k];
            let coefficients = piece.coefficients(frame);
            work.pieces += 1;
            if coefficients.open() {
                first = coefficients.last();
                // On to the next piece, the widest that begins here.
                while k > 0 && k % 2 == 0 {
                    k = (k - 2) / 2;
                }
                if k == 0 {
                    return Sight::Clear;
                }
                k += 1;
                continue;
            }
            if first > 0.0
                && let Some(guess) = piece.only_root(frame, first, &coefficients)
            {
                return Sight::Root { guess, clear: piece.start };
            }
            if 2 * k + 1 >= self.pieces.len() {
                return Sight::Blurred { clear: piece.start };
            }
            k = 2 * k + 1;
        }
    }

    /// The last step: a root in sight to full accuracy, and certified steps where nothing else
    /// decides.
    #[inline(always)]
    pub fn settle(&self, frame: &Frame<M>, sight: Sight, work: &mut Work) -> Next {
        let reach = self.frequencies.reach;
        let clear = match sight {
            Sight::Clear => return Next::Clear { s: reach },
            Sight::Root { guess, clear } => match self.close_in(frame, guess, work) {
                Some((s, speed)) => return Next::Root { s, speed },
                None => clear,
            },
            Sight::Blurred { clear } => clear,
        };
        work.stepped += 1;
        first_root_by_steps(frame, clear, reach, &self.frequencies, work)
    }

    /// The root near a guess, to full accuracy.
    #[inline(always)]
    fn close_in(&self, frame: &Frame<M>, guess: f64, work: &mut Work) -> Option<(f64, f64)> {
        let mut s = guess;
        for _ in 0..4 {
            work.evaluations += 1;
            let p = frame.at(s, &self.frequencies);
            match refine(s, &p, &self.frequencies) {
                Ok(found) => return Some(found),
                Err(h) => s += h,
            }
            if !(s > 0.0 && s < self.frequencies.reach) {
                return None;
            }
        }
        None
    }
}

/// What the screen shows of a frame that it could not clear at a glance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sight {
    /// No root in the whole reach.
    Clear,
    /// The first root lies in a piece over which f falls, near `guess`; no root before `clear`.
    Root {
        /// A guess of the root.
        guess: f64,
        /// Certified up to here.
        clear: f64,
    },
    /// No root before `clear`; beyond it the pieces are too coarse.
    Blurred {
        /// Certified up to here.
        clear: f64,
    },
}

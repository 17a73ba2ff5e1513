//! The gap between neighbours, seen from one instant.

use super::flight::{Motion, Phases};
use crate::numerics::lane::Lane;
use crate::numerics::local_frame::{Frame, Frequencies};

/// What bounds a gap for ever, as long as neither neighbour is hit.
#[derive(Clone, Copy, Debug)]
pub struct Reach<L> {
    /// The mean of the gap, d + the difference of the offsets.
    pub mean: L,
    /// R₁ + R₂, the largest excursion from the mean.
    pub excursion: L,
}

/// The local frame of a gap at an instant, and its reach.
///
/// **Eq. (19)**: Δ(t) = d + A cos ωt + B sin ωt + C cos Ωt + D sin Ωt, where the capitals are the
/// differences of the amplitudes of the two neighbours (`gap`). R₁ = |(A, B)| and R₂ = |(C, D)|.
#[inline(always)]
pub fn frame<L: Lane>(
    spacing: f64,
    gap: &Motion<L>,
    phases: &Phases<L>,
    frequencies: &Frequencies,
) -> (Frame<L>, Reach<L>) {
    let w = L::splat(frequencies.omega);
    let big_w = L::splat(frequencies.big_omega);
    let mean = L::splat(spacing) + gap.offset;
    let seen = gap.seen(phases);
    let r1 = (gap.a * gap.a + gap.b * gap.b).sqrt();
    let r2 = (gap.c * gap.c + gap.s * gap.s).sqrt();
    let (w2, big_w2) = (w * w, big_w * big_w);
    let frame = Frame {
        f0: mean + (seen.u + seen.v),
        g0: w * seen.u_quadrature + big_w * seen.v_quadrature,
        alpha: seen.u,
        gamma: seen.v,
        delta: seen.v_quadrature,
        bound: (w2 * w2 * r1 + big_w2 * big_w2 * r2) * L::splat(INFLATION),
    };
    (frame, Reach { mean, excursion: (r1 + r2) * L::splat(INFLATION) })
}

/// Bounds are rounded outwards by more than the rounding of amplitudes and frames.
const INFLATION: f64 = 1.0 + 1e-12;

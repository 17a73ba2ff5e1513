//! The gap between neighbours, seen from one instant.

use super::flight::{Motion, Phases};
use crate::search::local_frame::{Frame, Frequencies};

/// The local frame of a gap at an instant.
///
/// **Eq. (19)**: Δ(t) = d + A cos ωt + B sin ωt + C cos Ωt + D sin Ωt, where the capitals are the
/// differences of the amplitudes of the two neighbours (`gap`). The bounds take |u| + |u̇/ω| for the
/// amplitude R of a part: at most √2 too much, and no square root.
#[inline(always)]
pub fn frame<const M: usize>(
    spacing: f64,
    gap: &Motion<M>,
    phases: &Phases<M>,
    frequencies: &Frequencies<M>,
) -> Frame<M> {
    let mean = spacing + gap.offset;
    let seen = gap.seen(phases);
    let w2 = frequencies.omega * frequencies.omega;
    let r1 = seen.u.abs() + seen.u_quadrature.abs();
    let mut bound = w2 * w2 * r1;
    let mut size = mean.abs() + r1;
    for m in 0..M {
        let [v, v_quadrature] = seen.forced[m];
        let r2 = v.abs() + v_quadrature.abs();
        let big_w2 = frequencies.big_omegas[m] * frequencies.big_omegas[m];
        bound += big_w2 * big_w2 * r2;
        size += frequencies.weights[m] * r2;
    }
    Frame {
        f0: mean + seen.place(),
        g0: seen.velocity(frequencies),
        alpha: seen.u,
        forced: seen.forced,
        bound: bound * INFLATION,
        size,
    }
}

/// Bounds are rounded outwards by more than the rounding of amplitudes and frames.
const INFLATION: f64 = 1.0 + 1e-12;

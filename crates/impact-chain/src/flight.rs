//! Computes flight, the motion of a mass between its impacts, in closed form.

use crate::search::clock::Instant;
use crate::search::local_frame::{Frame, Frequencies};

/// Returns the response (c, s) to a component of Eq. (3), with ω² − Ω² as (ω − Ω)(ω + Ω).
pub fn response(w: f64, big_w: f64, amplitudes: [f64; 2]) -> [f64; 2] {
    let factor = (w - big_w) * (w + big_w);
    amplitudes.map(|amplitude| amplitude / factor)
}

pub fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

/// Sine and cosine of the phases ωt and Ωt of each component of the forcing at one instant.
#[derive(Clone, Copy, Debug)]
pub struct Phases<const M: usize> {
    pub sin: f64,
    pub cos: f64,
    pub forced: [[f64; 2]; M],
}

impl<const M: usize> Phases<M> {
    #[inline(always)]
    pub fn at(frequencies: &Frequencies<M>, instant: Instant) -> Self {
        let (sin, cos) = frequencies.rate.sin_cos(instant);
        let forced = std::array::from_fn(|m| frequencies.rates[m].sin_cos(instant).into());
        Phases { sin, cos, forced }
    }

    /// Evaluates each c cos Ωt + s sin Ωt: its value and its quadrature.
    #[inline(always)]
    pub fn evaluate(&self, forced: &[[f64; 2]; M]) -> [[f64; 2]; M] {
        std::array::from_fn(|m| {
            let ([c, s], [sin, cos]) = (forced[m], self.forced[m]);
            [c * cos + s * sin, s * cos - c * sin]
        })
    }
}

/// The motion of one mass (or of a rigid cluster of masses in contact).
///
/// **Eq. (2)** solved: x_j(t) = j d + offset + a cos ωt + b sin ωt + Σ (c cos Ωt + s sin Ωt).
/// The whole state is the free part (a, b), which only impacts of this mass change.
#[derive(Clone, Copy, Debug)]
pub struct Motion<const M: usize> {
    pub a: f64,
    pub b: f64,
    /// Forced responses: c = α/(ω² − Ω²) along cos Ωt, s = β/(ω² − Ω²) along sin Ωt.
    pub forced: [[f64; 2]; M],
    /// Distance of the centre of motion from j d: 0, except in a cluster.
    pub offset: f64,
}

/// The parts of a motion at one instant, each with its quadrature.
#[derive(Clone, Copy, Debug)]
pub struct Parts<const M: usize> {
    pub u: f64,
    pub u_quadrature: f64,
    /// Forced responses v, and their velocities over Ω.
    pub forced: [[f64; 2]; M],
}

impl<const M: usize> Motion<M> {
    /// A wall, or a mass without forcing at rest at its centre.
    pub const STILL: Motion<M> = Motion { a: 0.0, b: 0.0, forced: [[0.0; 2]; M], offset: 0.0 };

    /// Returns `self` − `other`: the motion of the gap between two neighbours, without d.
    #[inline(always)]
    pub fn minus(&self, other: &Motion<M>) -> Motion<M> {
        Motion {
            a: self.a - other.a,
            b: self.b - other.b,
            forced: std::array::from_fn(|m| {
                let ([c, s], [other_c, other_s]) = (self.forced[m], other.forced[m]);
                [c - other_c, s - other_s]
            }),
            offset: self.offset - other.offset,
        }
    }

    #[inline(always)]
    pub fn parts(&self, p: &Phases<M>) -> Parts<M> {
        Parts {
            u: self.a * p.cos + self.b * p.sin,
            u_quadrature: self.b * p.cos - self.a * p.sin,
            forced: p.evaluate(&self.forced),
        }
    }

    // listing: kick
    /// Lets the velocity jump by ω `kick` at an instant, which only rotates into the free part.
    #[inline(always)]
    pub fn kick(&mut self, kick: f64, p: &Phases<M>) {
        self.a -= kick * p.sin;
        self.b += kick * p.cos;
    }
    // end

    /// Computes the local frame of a gap at an instant.
    ///
    /// **Eq. (19)**: Δ(t) = d + A cos ωt + B sin ωt + C cos Ωt + D sin Ωt, where the capitals
    /// are the differences of the amplitudes of the two neighbours (`self`). The bounds take
    /// |u| + |u̇/ω| for the amplitude R of a part: at most √2 too much, and no square root.
    #[inline(always)]
    pub fn frame(
        &self,
        spacing: f64,
        phases: &Phases<M>,
        frequencies: &Frequencies<M>,
    ) -> Frame<M> {
        let mean = spacing + self.offset;
        let parts = self.parts(phases);
        let w2 = frequencies.omega * frequencies.omega;
        let r1 = parts.u.abs() + parts.u_quadrature.abs();
        let mut bound = w2 * w2 * r1;
        let mut size = mean.abs() + r1;
        for m in 0..M {
            let [v, v_quadrature] = parts.forced[m];
            let r2 = v.abs() + v_quadrature.abs();
            let big_w2 = frequencies.big_omegas[m] * frequencies.big_omegas[m];
            bound += big_w2 * big_w2 * r2;
            size += frequencies.weights[m] * r2;
        }
        Frame {
            f0: mean + parts.displacement(),
            g0: parts.velocity(frequencies),
            alpha: parts.u,
            forced: parts.forced,
            bound: bound * INFLATION,
            size,
        }
    }
}

/// Bounds are rounded outwards by more than the rounding of amplitudes and frames.
pub const INFLATION: f64 = 1.0 + 1e-12;

impl<const M: usize> Parts<M> {
    #[inline(always)]
    pub fn displacement(&self) -> f64 {
        self.forced.iter().fold(self.u, |sum, part| sum + part[0])
    }

    #[inline(always)]
    pub fn velocity(&self, frequencies: &Frequencies<M>) -> f64 {
        let mut sum = frequencies.omega * self.u_quadrature;
        for m in 0..M {
            sum += frequencies.big_omegas[m] * self.forced[m][1];
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::truth::derivative;
    use impact_numerics::random::{NormalPairs, Seed};

    /// In the first case both parts are at their highest, and f'''' reaches its bound.
    #[test]
    fn bounds_of_a_frame_are_those_of_its_function() {
        let frequencies = Frequencies::new(1.0, [1.5]);
        for i in 0..200 {
            let mut normals = NormalPairs::new("bounds", Seed(1), i);
            let ([a, b], [c, s]) = (normals.pair(), normals.pair());
            let (a, b, forced) = if i == 0 { (1.0, 0.0, [1.0, 0.0]) } else { (a, b, [c, s]) };
            let motion = Motion { a, b, forced: [forced], offset: 0.0 };
            let phases = Phases::at(&frequencies, Instant::at(i as f64));
            let frame = motion.frame(1.0, &phases, &frequencies);
            for k in 0..40 {
                let fourth = derivative(&frame, &frequencies, 4, 0.1 * f64::from(k));
                assert!(fourth.abs() <= frame.bound, "{i}: {fourth} > {}", frame.bound);
            }
            let terms = 1.0 + a.hypot(b) + 4.0 * forced[0].hypot(forced[1]);
            assert!(frame.size >= terms * (1.0 - 1e-12), "{i}: {} < {terms}", frame.size);
        }
    }
}

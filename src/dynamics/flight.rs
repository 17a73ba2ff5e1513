//! Flight: the motion of a mass between its impacts, in closed form.

use crate::numerics::clock::{Instant, Rate};
use crate::numerics::lane::Lane;

/// Sine and cosine of the phases ωt and Ωt at one instant.
#[derive(Clone, Copy, Debug)]
pub struct Phases<L> {
    /// sin ωt.
    pub sin: L,
    /// cos ωt.
    pub cos: L,
    /// sin Ωt.
    pub big_sin: L,
    /// cos Ωt.
    pub big_cos: L,
}

impl Phases<f64> {
    /// The phases of rates ω and Ω at an instant.
    #[inline]
    pub fn at(rates: &[Rate; 2], instant: Instant) -> Self {
        let (sin, cos) = rates[0].sin_cos(instant);
        let (big_sin, big_cos) = rates[1].sin_cos(instant);
        Phases { sin, cos, big_sin, big_cos }
    }
}

/// The motion of one mass (or of a rigid cluster of masses in contact).
///
/// **Eq. (2)** solved: x_j(t) = j d + offset + a cos ωt + b sin ωt + c cos Ωt + s sin Ωt.
/// The whole state is the free part (a, b), which only impacts of this mass change.
#[derive(Clone, Copy, Debug)]
pub struct Motion<L> {
    /// a, free part along cos ωt.
    pub a: L,
    /// b, free part along sin ωt.
    pub b: L,
    /// c = α/(ω² − Ω²), forced response along cos Ωt.
    pub c: L,
    /// s = β/(ω² − Ω²), forced response along sin Ωt.
    pub s: L,
    /// Distance of the centre of motion from j d: 0, except in a cluster.
    pub offset: L,
}

/// A motion seen at one instant, each part with its quadrature: u, u̇/ω, v, v̇/Ω.
#[derive(Clone, Copy, Debug)]
pub struct Seen<L> {
    /// Free part u.
    pub u: L,
    /// Its velocity over ω.
    pub u_quadrature: L,
    /// Forced response v.
    pub v: L,
    /// Its velocity over Ω.
    pub v_quadrature: L,
}

impl<L: Lane> Motion<L> {
    /// A wall, or a mass without forcing at rest at its centre.
    pub fn still() -> Self {
        let zero = L::splat(0.0);
        Motion { a: zero, b: zero, c: zero, s: zero, offset: zero }
    }

    /// `self` − `other`: the motion of the gap between two neighbours, without d.
    #[inline(always)]
    pub fn minus(&self, other: &Motion<L>) -> Motion<L> {
        Motion {
            a: self.a - other.a,
            b: self.b - other.b,
            c: self.c - other.c,
            s: self.s - other.s,
            offset: self.offset - other.offset,
        }
    }

    /// The motion at an instant.
    #[inline(always)]
    pub fn seen(&self, p: &Phases<L>) -> Seen<L> {
        Seen {
            u: self.a * p.cos + self.b * p.sin,
            u_quadrature: self.b * p.cos - self.a * p.sin,
            v: self.c * p.big_cos + self.s * p.big_sin,
            v_quadrature: self.s * p.big_cos - self.c * p.big_sin,
        }
    }

    /// Sets the free part from its value and quadrature at an instant.
    #[inline(always)]
    pub fn set_free(&mut self, u: L, u_quadrature: L, p: &Phases<L>) {
        self.a = u * p.cos - u_quadrature * p.sin;
        self.b = u * p.sin + u_quadrature * p.cos;
    }

    /// A jump of the velocity by ω `kick` at an instant: it only rotates into the free part.
    #[inline(always)]
    pub fn kick(&mut self, kick: L, p: &Phases<L>) {
        self.a = self.a - kick * p.sin;
        self.b = self.b + kick * p.cos;
    }
}

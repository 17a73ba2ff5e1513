//! Double-double numbers: an unevaluated sum of two doubles, 106 bits (Dekker 1971, Knuth).

use super::real::Real;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// hi + lo with |lo| ≤ ulp(hi)/2.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Dd {
    hi: f64,
    lo: f64,
}

/// π/2 to 106 bits; `traces.rs` holds it against dashu's.
pub const HALF_PI: Dd = Dd { hi: std::f64::consts::FRAC_PI_2, lo: 6.123233995736766e-17 };

impl Dd {
    /// The sum of two doubles, exactly.
    pub fn sum(a: f64, b: f64) -> Dd {
        let s = a + b;
        let t = s - a;
        Dd { hi: s, lo: (a - (s - t)) + (b - t) }
    }

    /// The two parts.
    pub fn parts(self) -> [f64; 2] {
        [self.hi, self.lo]
    }

    fn product(a: f64, b: f64) -> Dd {
        let p = a * b;
        Dd { hi: p, lo: a.mul_add(b, -p) }
    }

    fn scale(self, k: f64) -> Dd {
        self * Dd { hi: k, lo: 0.0 }
    }

    /// Σ (±1)^i x^(2i + first) / (2i + first)! for |x| ≤ π/4.
    fn series(self, first: u32) -> Dd {
        let square = -(self * self);
        let mut term = if first == 0 { Dd::of(1.0) } else { self };
        let mut sum = term;
        let mut i = first;
        while term.hi.abs() > 1e-36 {
            term = term * square / Dd::of(f64::from((i + 1) * (i + 2)));
            sum = sum + term;
            i += 2;
        }
        sum
    }
}

impl Add for Dd {
    type Output = Dd;
    fn add(self, b: Dd) -> Dd {
        let s = Dd::sum(self.hi, b.hi);
        let t = Dd::sum(self.lo, b.lo);
        let u = Dd::sum(s.hi, s.lo + t.hi);
        Dd::sum(u.hi, u.lo + t.lo)
    }
}

impl Neg for Dd {
    type Output = Dd;
    fn neg(self) -> Dd {
        Dd { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Dd {
    type Output = Dd;
    fn sub(self, b: Dd) -> Dd {
        self + -b
    }
}

impl Mul for Dd {
    type Output = Dd;
    fn mul(self, b: Dd) -> Dd {
        let p = Dd::product(self.hi, b.hi);
        Dd::sum(p.hi, p.lo + (self.hi * b.lo + self.lo * b.hi))
    }
}

impl Div for Dd {
    type Output = Dd;
    fn div(self, b: Dd) -> Dd {
        let q = self.hi / b.hi;
        let rest = self - b.scale(q);
        let q2 = rest.hi / b.hi;
        let rest = rest - b.scale(q2);
        Dd::sum(q, q2) + Dd::of(rest.hi / b.hi)
    }
}

impl Real for Dd {
    const EPS: f64 = 1e-31;

    fn of(x: f64) -> Dd {
        Dd { hi: x, lo: 0.0 }
    }

    fn near(&self) -> f64 {
        self.hi
    }

    fn sin_cos(&self) -> (Dd, Dd) {
        let quarter = (self.hi / HALF_PI.hi).round();
        let x = *self - HALF_PI.scale(quarter);
        let (s, c) = (x.series(1), x.series(0));
        match quarter.rem_euclid(4.0) as u8 {
            0 => (s, c),
            1 => (c, -s),
            2 => (-s, -c),
            _ => (-c, s),
        }
    }
}

//! Describes a contact force or acceleration: a constant plus sinusoids of the forcing.

use super::flight::Phases;
use crate::search::local_frame::{Frequencies, ROUNDING};

/// L + Σ (C cos Ωt + S sin Ωt), with one pair (C, S) for each component of the forcing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Force<const M: usize> {
    pub constant: f64,
    pub forced: [[f64; 2]; M],
}

/// Derivatives that [`Force::falls`] examines, the value included: more than symmetry makes zero.
const ORDERS: usize = 6;

impl<const M: usize> Force<M> {
    pub const ZERO: Force<M> = Force { constant: 0.0, forced: [[0.0; 2]; M] };

    pub fn zip(self, other: Self, combine: impl Fn(f64, f64) -> f64) -> Self {
        Force {
            constant: combine(self.constant, other.constant),
            forced: std::array::from_fn(|m| {
                [0, 1].map(|i| combine(self.forced[m][i], other.forced[m][i]))
            }),
        }
    }

    pub fn value(&self, p: &Phases<M>) -> f64 {
        p.evaluate(&self.forced).iter().fold(self.constant, |sum, part| sum + part[0])
    }

    pub fn size(&self) -> f64 {
        self.forced.iter().fold(self.constant.abs(), |sum, [c, s]| sum + c.abs() + s.abs())
    }

    /// Whether an acceleration is or falls below zero: its first derivative above rounding.
    pub fn falls(&self, size: f64, p: &Phases<M>, frequencies: &Frequencies<M>) -> bool {
        let parts = p.evaluate(&self.forced);
        let (mut powers, mut rounding) = ([1.0; M], ROUNDING * size);
        for order in 0..ORDERS {
            let mut derivative = if order == 0 { self.constant } else { 0.0 };
            for ([value, quadrature], power) in parts.into_iter().zip(powers) {
                derivative += match order % 4 {
                    0 => power * value,
                    1 => power * quadrature,
                    2 => power * -value,
                    _ => power * -quadrature,
                };
            }
            if derivative.abs() > rounding {
                return derivative < 0.0;
            }
            powers = std::array::from_fn(|m| powers[m] * frequencies.big_omegas[m]);
            rounding *= frequencies.fastest;
        }
        false
    }
}

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

    /// Returns whether an acceleration is or falls below zero: its first derivative above rounding.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::clock::Instant;

    /// At t = 0 the parts are c and 3 s, and the rounding of each order is 3 times the last.
    #[test]
    fn an_acceleration_falls_by_its_first_derivative_above_rounding() {
        let frequencies = Frequencies::new(1.0, [3.0]);
        let p = Phases::at(&frequencies, Instant::ZERO);
        for (constant, c, s, expected) in [
            (-1.5 * ROUNDING, 0.0, 0.0, true),
            (-0.5 * ROUNDING, 0.0, 0.0, false),
            (1.5 * ROUNDING, 0.0, -1.0, false),
            (0.0, 0.0, -1.5 * ROUNDING, true),
            (0.0, 0.0, -0.5 * ROUNDING, false),
            (-1.0, 1.0, 0.0, true),
            (1.0, -1.0, 0.0, false),
        ] {
            let force = Force { constant, forced: [[c, s]] };
            assert_eq!(force.falls(1.0, &p, &frequencies), expected, "{constant}, {c}, {s}");
        }
    }
}

//! Complex numbers, as far as linear response needs them.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// x + iy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Complex {
    pub re: f64,
    pub im: f64,
}

impl Complex {
    pub const fn new(re: f64, im: f64) -> Self {
        Complex { re, im }
    }

    pub fn square(self) -> f64 {
        self.re * self.re + self.im * self.im
    }

    pub fn conjugate(self) -> Self {
        Complex::new(self.re, -self.im)
    }

    pub fn scaled(self, by: f64) -> Self {
        Complex::new(by * self.re, by * self.im)
    }

    /// The root with a real part ≥ 0. The larger part is found first, so that none cancels.
    pub fn sqrt(self) -> Self {
        let size = self.square().sqrt();
        let larger = (0.5 * (size + self.re.abs())).sqrt();
        if larger == 0.0 {
            return Complex::default();
        }
        let other = 0.5 * self.im / larger;
        if self.re >= 0.0 {
            Complex::new(larger, other)
        } else {
            Complex::new(other.abs(), larger.copysign(self.im))
        }
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Complex::new(self.re + other.re, self.im + other.im)
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Complex::new(self.re - other.re, self.im - other.im)
    }
}

impl Neg for Complex {
    type Output = Self;
    fn neg(self) -> Self {
        Complex::new(-self.re, -self.im)
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Complex::new(
            self.re * other.re - self.im * other.im,
            self.re * other.im + self.im * other.re,
        )
    }
}

impl Div for Complex {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        (self * other.conjugate()).scaled(1.0 / other.square())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_and_quotients_multiply_back() {
        for z in [(3.0, 4.0), (-3.0, 4.0), (-3.0, -4.0), (-1.0, 0.0), (0.0, 0.0), (2.0, -1e-9)] {
            let z = Complex::new(z.0, z.1);
            let root = z.sqrt();
            assert!(root.re >= 0.0 && (root * root - z).square() < 1e-28, "{z:?} {root:?}");
            let w = Complex::new(0.3, -1.7);
            assert!((z / w * w - z).square() < 1e-28);
        }
    }
}

//! The operations on numbers that the reference needs.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number of more than double precision.
pub trait Real:
    Clone
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Relative rounding error of one operation (a generous bound).
    const EPS: f64;

    /// The same number, exactly.
    fn of(x: f64) -> Self;

    /// The nearest double.
    fn near(&self) -> f64;

    /// Sine and cosine, with an absolute error of a few [`Real::EPS`] times max(1, |x|).
    fn sin_cos(&self) -> (Self, Self);
}

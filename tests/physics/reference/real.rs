//! The numbers of the reference: double-doubles of 106 bits, which `traces.rs` compares with floats
//! of 256 bits from dashu.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use impact_numerics::double_double::{DoubleDouble, sin_cos};
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number: a double where bounds are enough, else of more precision.
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

impl Real for f64 {
    const EPS: f64 = f64::EPSILON;

    fn of(x: f64) -> f64 {
        x
    }

    fn near(&self) -> f64 {
        *self
    }

    fn sin_cos(&self) -> (f64, f64) {
        f64::sin_cos(*self)
    }
}

pub type Dd = DoubleDouble;

impl Real for Dd {
    const EPS: f64 = 1e-31;

    fn of(x: f64) -> Dd {
        x.into()
    }

    fn near(&self) -> f64 {
        self.hi
    }

    fn sin_cos(&self) -> (Dd, Dd) {
        sin_cos(*self).into()
    }
}

const BITS: usize = 256;

/// A dashu float, which keeps its precision.
pub type Big = FBig<HalfEven, 2>;

impl Real for Big {
    const EPS: f64 = 1e-75;

    fn of(x: f64) -> Big {
        Big::try_from(x).expect("a finite double").with_precision(BITS).value()
    }

    fn near(&self) -> f64 {
        self.to_f64().value()
    }

    fn sin_cos(&self) -> (Big, Big) {
        if *self == Big::ZERO {
            return (Big::of(0.0), Big::of(1.0));
        }
        self.sin_cos()
    }
}

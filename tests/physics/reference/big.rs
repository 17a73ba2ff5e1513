//! Floats of 256 bits (77 digits) from dashu.

use super::real::Real;
use dashu::float::FBig;
use dashu::float::round::mode::HalfEven;

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

//! Double-doubles of 106 bits; `traces.rs` holds them against dashu's floats.

use super::real::Real;
use impact_numerics::double_double::{DoubleDouble, sin_cos};

/// An unevaluated sum of two doubles.
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

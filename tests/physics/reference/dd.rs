//! Double-doubles of 106 bits; `traces.rs` compares them with dashu's floats.

use super::real::Real;
use impact_numerics::double_double::{DoubleDouble, sin_cos};

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

//! Floats of 256 bits (77 digits) from dashu.

use super::real::Real;
use dashu::float::FBig;
use dashu::float::round::mode::HalfEven;
use std::ops::{Add, Div, Mul, Neg, Sub};

const BITS: usize = 256;

/// A dashu float that keeps its precision.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub struct Big(FBig<HalfEven, 2>);

macro_rules! operator {
    ($($operator:ident $method:ident)*) => {$(
        impl $operator for Big {
            type Output = Big;
            fn $method(self, b: Big) -> Big {
                Big($operator::$method(self.0, b.0))
            }
        }
    )*};
}

operator! { Add add Sub sub Mul mul Div div }

impl Neg for Big {
    type Output = Big;
    fn neg(self) -> Big {
        Big(-self.0)
    }
}

impl Real for Big {
    const EPS: f64 = 1e-75;

    fn of(x: f64) -> Big {
        let exact = FBig::<HalfEven, 2>::try_from(x).expect("a finite double");
        Big(exact.with_precision(BITS).value())
    }

    fn near(&self) -> f64 {
        self.0.to_f64().value()
    }

    fn sin_cos(&self) -> (Big, Big) {
        if self.0 == FBig::<HalfEven, 2>::ZERO {
            return (Big::of(0.0), Big::of(1.0));
        }
        let (s, c) = self.0.sin_cos();
        (Big(s), Big(c))
    }
}

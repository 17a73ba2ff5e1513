//! Compares the arithmetic of 106 bits with one of 57 digits.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use impact_numerics::double_double::{DoubleDouble, sin_cos};

/// A float of 192 bits.
type Big = FBig<HalfEven, 2>;

fn big(x: f64) -> Big {
    Big::try_from(x).expect("a finite double").with_precision(192).value()
}

/// The numbers in which the second simulator and the truth compute, on both sides of each multiple
/// of a quarter turn and far from zero.
#[test]
fn double_doubles_have_their_106_bits() {
    let exact = |x: DoubleDouble| big(x.hi) + big(x.lo);
    let off = |ours: DoubleDouble, exact: Big| {
        (big(ours.hi) - exact + big(ours.lo)).to_f64().value().abs()
    };
    let shift = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
    let shifted = exact(shift);
    for step in 1..400 {
        for size in [0.1, 1e3, 1e12] {
            let x = DoubleDouble::from(f64::from(step) * size) / DoubleDouble::from(7.0);
            let large = exact(x);
            let error = 1e-31 * x.hi.max(1.0);
            assert!(off(x + shift, large.clone() + &shifted) < error, "{x:?}");
            assert!(off(x - shift, large.clone() - &shifted) < error, "{x:?}");
            assert!(off(x * shift, large.clone() * &shifted) < error, "{x:?}");
            assert!(off(x / shift, large.clone() / &shifted) < 10.0 * error, "{x:?}");
            let ([s, c], (sin, cos)) = (sin_cos(x), large.sin_cos());
            assert!(off(s, sin).max(off(c, cos)) < error, "{x:?}");
        }
    }
}

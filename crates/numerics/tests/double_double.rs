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

#[test]
fn roots_products_and_conversions_keep_all_digits() {
    let exact = |x: DoubleDouble| big(x.hi) + big(x.lo);
    let share =
        |ours: DoubleDouble, wanted: Big| ((exact(ours) - &wanted) / wanted).to_f64().value();
    for step in 1..100 {
        let x = DoubleDouble::from(f64::from(step)) / DoubleDouble::from(7.0);
        assert!(share(x.sqrt(), exact(x).sqrt()).abs() < 1e-31, "{x:?}");
        assert!(share(x * 0.3, exact(x) * big(0.3)).abs() < 1e-31, "{x:?}");
        // What is in `lo` shows in the exponential where it is large.
        let large = DoubleDouble { hi: 7.0 * x.hi, lo: 3e-15 };
        let power = DoubleDouble::from(large.exp());
        assert!(share(power, exact(large).exp()).abs() < 3e-16, "{large:?}");
    }
    assert_eq!(DoubleDouble::from(-1.0).sqrt(), DoubleDouble::ZERO);
    let ends = [-1e4, 1e4].map(|hi| DoubleDouble { hi, lo: f64::NAN }.exp());
    assert_eq!(ends, [0.0, f64::INFINITY]);
    let [whole, large] = [(1 << 60) + 1, (1 << 100) + 3].map(|n: u128| DoubleDouble::from(n));
    assert_eq!(DoubleDouble::from((1_usize << 60) + 1), whole);
    assert_eq!(DoubleDouble::from(12_usize), DoubleDouble::from(12.0));
    assert_eq!([whole.hi, whole.lo], [2f64.powi(60), 1.0]);
    assert_eq!([large.hi, large.lo], [2f64.powi(100), 3.0]);
}

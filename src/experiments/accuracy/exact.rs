//! Elementary functions of numbers with 106 bits: what the references of this experiment need, and
//! nothing else. Each is a series of falling terms after a reduction of the argument; they are slow
//! and good to about 1e−30.

use crate::numerics::double_double::DoubleDouble;

/// π/2 to 106 bits.
const HALF_PI: DoubleDouble =
    DoubleDouble { hi: std::f64::consts::FRAC_PI_2, lo: 6.123_233_995_736_766e-17 };

/// Terms below this part of the sum change no bit of 106.
const NEGLIGIBLE: f64 = 1e-33;

fn dd(x: f64) -> DoubleDouble {
    DoubleDouble::from(x)
}

/// Σ term_k with term_{k+1} = term_k · `ratio`(k), from `first` on, until the terms are negligible.
fn series(first: DoubleDouble, ratio: impl Fn(f64) -> DoubleDouble) -> DoubleDouble {
    let (mut term, mut sum, mut k) = (first, first, 0.0);
    while term.hi.abs() > NEGLIGIBLE * sum.hi.abs() {
        term = term * ratio(k);
        sum = sum + term;
        k += 1.0;
    }
    sum
}

/// sin x and cos x; the absolute error grows as 1e−32 |x|.
pub fn sin_cos(x: DoubleDouble) -> [DoubleDouble; 2] {
    let turns = (x / HALF_PI).hi.round();
    let r = x - HALF_PI * turns;
    let square = -(r * r);
    let part = |k: f64| square / dd((k + 1.0) * (k + 2.0));
    let sin = if r.hi == 0.0 { r } else { series(r, |k| part(2.0 * k + 1.0)) };
    let cos = series(DoubleDouble::ONE, |k| part(2.0 * k));
    match turns.rem_euclid(4.0) as u8 {
        0 => [sin, cos],
        1 => [cos, -sin],
        2 => [-sin, -cos],
        _ => [-cos, sin],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: DoubleDouble, b: DoubleDouble, bound: f64) {
        assert!((a - b).to_f64().abs() < bound, "{a:?} {b:?}");
    }

    /// Addition theorems join different octants and arguments of different size.
    #[test]
    fn sines_obey_their_addition_theorem() {
        for (a, b) in [(0.3, 0.9), (2.0, 40.7), (-5.5, 100.25), (1e3, 0.125)] {
            let [sa, ca] = sin_cos(dd(a));
            let [sb, cb] = sin_cos(dd(b));
            let [s, c] = sin_cos(dd(a) + dd(b));
            close(s, sa * cb + ca * sb, 1e-28);
            close(c, ca * cb - sa * sb, 1e-28);
            assert!((s.to_f64() - pxfm::f_sin(a + b)).abs() < 2e-16);
        }
    }
}

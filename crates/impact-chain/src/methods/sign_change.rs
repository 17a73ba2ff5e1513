//! Locates a change of sign between two samples by bisection.

use impact_numerics::roots::bracket;

/// Halvings of the time after an impact until a width above zero is found.
const HALVINGS: u32 = 64;

/// Width, in units of d, above which an opening gap that has just been hit may be below zero.
const ROUNDING: f64 = 1e-12;

/// Returns whether a gap of this width and rate is not below zero, or by rounding only, as one just
/// hit.
#[inline]
pub fn is_open(width: f64, rate: f64, spacing: f64) -> bool {
    width >= 0.0 || rate >= 0.0 && width >= -ROUNDING * spacing
}

/// Returns the last time in [0, end] before `width` becomes negative, given its value `first` ≥ 0
/// at 0 and a negative one at the end. At most 128 evaluations.
///
/// A gap that has just been hit has the width 0; first a time at which it is open is found by
/// halving. If there is none, the gap is shut from 0 on.
pub fn closing_time(end: f64, first: f64, mut width: impl FnMut(f64) -> f64) -> f64 {
    let (mut open, mut shut) = (0.0, end);
    if first <= 0.0 {
        for _ in 0..HALVINGS {
            let middle = 0.5 * shut;
            if width(middle) > 0.0 {
                open = middle;
                break;
            }
            shut = middle;
        }
        if open == 0.0 {
            return 0.0;
        }
    }
    bracket(open, shut, |s| width(s) < 0.0)[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_is_open_down_to_rounding_if_it_opens() {
        for (width, rate, spacing, expected) in [
            (0.0, -1.0, 1.0, true),
            (-0.9e-12, 0.0, 1.0, true),
            (-0.9e-12, -1e-3, 1.0, false),
            (-1.1e-12, 1.0, 1.0, false),
            (-1.1e-12, 1.0, 2.0, true),
        ] {
            assert_eq!(is_open(width, rate, spacing), expected, "{width}, {rate}, {spacing}");
        }
    }
}

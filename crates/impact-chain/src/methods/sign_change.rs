//! Locates a change of sign between two samples by bisection.

use impact_numerics::roots::bracket;

/// Halvings of the time after an impact until a width above zero is found.
const HALVINGS: u32 = 64;

/// Width, in units of d, above which an opening gap that has just been hit may be below zero.
const ROUNDING: f64 = 1e-12;

/// Whether a gap of this width and rate is below zero by rounding only, as one just hit.
#[inline]
pub fn is_rounding(width: f64, rate: f64, spacing: f64) -> bool {
    width < 0.0 && rate >= 0.0 && width >= -ROUNDING * spacing
}

/// Returns the last time in [low, high] before `width` becomes negative, given its value `first` at
/// `low` ≥ 0 and a negative one at `high`. At most 128 evaluations.
///
/// A gap that has just been hit has the width 0 at `low`; first a time at which it is open is found
/// by halving. If there is none, the gap is shut from `low` on.
pub fn closing_time(low: f64, high: f64, first: f64, mut width: impl FnMut(f64) -> f64) -> f64 {
    let (mut open, mut shut) = (low, high);
    if first <= 0.0 {
        let mut wait = high - low;
        for _ in 0..HALVINGS {
            wait *= 0.5;
            if width(low + wait) > 0.0 {
                open = low + wait;
                break;
            }
            shut = low + wait;
        }
        if open == low {
            return low;
        }
    }
    if open >= shut {
        return low;
    }
    bracket(open, shut, |s| width(s) < 0.0)[0]
}

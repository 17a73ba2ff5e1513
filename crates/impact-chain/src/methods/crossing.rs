//! A change of sign between two samples, located by bisection.

use impact_numerics::roots::bracket;

/// Halvings of the time after an impact in search of a width above zero.
const HALVINGS: u32 = 64;

/// Width, in units of d, above which an opening gap that has just been hit may be below zero.
const ROUNDING: f64 = 1e-12;

/// Whether a gap of this width and rate is below zero by rounding only, as one that has just been hit.
#[inline]
pub fn is_rounding(width: f64, rate: f64, spacing: f64) -> bool {
    width < 0.0 && rate >= 0.0 && width >= -ROUNDING * spacing
}

/// The last time in [low, high] before a change of sign of `width` to the negative, given its value
/// `first` at `low` ≥ 0 and a negative one at `high`. At most 128 evaluations.
///
/// A gap that has just been hit has the width 0 at `low`; a time at which it is open is looked for
/// by halving first. If there is none, it is shut from `low` on.
pub fn crossing(low: f64, high: f64, first: f64, mut width: impl FnMut(f64) -> f64) -> f64 {
    let (mut open, mut shut) = (low, high);
    if first <= 0.0 {
        let mut wait = high - low;
        let mut halve = || {
            wait *= 0.5;
            low + wait
        };
        let found = (0..HALVINGS).find_map(|_| {
            let s = halve();
            let is_open = width(s) > 0.0;
            if !is_open {
                shut = s;
            }
            is_open.then_some(s)
        });
        match found {
            Some(s) => open = s,
            None => return low,
        }
    }
    if open >= shut {
        return low;
    }
    bracket(open, shut, |s| width(s) < 0.0)[0]
}

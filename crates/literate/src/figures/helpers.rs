//! Helps figures with what many of them need: columns over integers, round ends of axes, letters,
//! short numbers.

use super::axis::{Axis, decimal, number};

/// Returns the points (k, value) of a series whose first value belongs to k = 1.
pub fn over_k(values: &[f64]) -> Vec<(f64, f64)> {
    values.iter().enumerate().map(|(i, &v)| ((i + 1) as f64, v)).collect()
}

/// Makes an axis from zero to a round number at or above `largest`, with about four labelled steps.
pub fn upwards_from_zero(largest: f64, label: &str) -> Axis {
    let unit = decimal(1, power(largest));
    for step in [0.2, 0.25, 0.5, 1.0, 2.0, 2.5] {
        let step = step * unit;
        let steps = (largest / step - 1e-9).ceil();
        if steps <= 5.0 {
            return Axis::linear(0.0, steps * step, step, 1, label);
        }
    }
    Axis::linear(0.0, 10.0 * unit, 5.0 * unit, 1, label)
}

/// Returns the largest of a series, zero if it is empty.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// The letters of panels.
pub const LETTERS: [&str; 6] = ["(a)", "(b)", "(c)", "(d)", "(e)", "(f)"];

/// Formats a number with about `digits` significant digits, for notes and descriptions; a tiny one
/// as a multiple of a power of ten.
pub fn short(value: f64, digits: usize) -> String {
    if value != 0.0 && value.abs() < 1e-3 {
        let shown = format!("{:.*e}", digits.saturating_sub(1), value);
        return shown.replace('-', "−").replace('e', "·10^");
    }
    let decimals = (digits as i32 - 1 - power(value)).max(0) as usize;
    let shown = number(value, decimals);
    if shown.contains('.') {
        shown.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        shown
    }
}

/// Returns the power of ten of the first digit of a number, zero for zero.
fn power(number: f64) -> i32 {
    let shown = format!("{number:e}");
    shown.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or_default()
}

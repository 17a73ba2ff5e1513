//! How wrong a number is made: by more than its tolerance, which follows from what the number is.

use impact_paper::claims::Level;
use impact_paper::report::values::{Digits, Kind, Number, Value, place, ten_to};

/// A real number is moved by so many tolerances to either side (ours).
const BEYOND: f64 = 2.0;

/// By how much a number is moved; None for words.
///
/// - An integer is exact: by one.
/// - A standard error allows as many of itself as the claims of the table do; where all realisations
///   agree and the error is zero, one of them is the unit.
/// - Other real numbers are right to a unit of their last printed digit.
/// - An interval is moved as a whole, by its width.
pub fn step(value: &Value, level: Level) -> Option<f64> {
    Some(match value.number {
        Number::Text(_) => return None,
        Number::Integer(_) => 1.0,
        Number::Real { value: x, digits } => {
            BEYOND
                * match (digits, &value.kind) {
                    (Digits::Error(error), _) if error > 0.0 => level.quantile * error,
                    (Digits::Error(_), Kind::Ensemble { realisations, .. }) => {
                        1.0 / (*realisations).max(1) as f64
                    }
                    (Digits::Error(_), _) => ten_to(place(x, 1)),
                    (Digits::Significant(digits), _) => ten_to(place(x, digits)),
                    (Digits::Decimals(decimals), _) => ten_to(-(decimals as i32)),
                }
        }
        Number::Interval { low, high } if high > low => high - low,
        Number::Interval { low, .. } => BEYOND * ten_to(place(low, 1)),
    })
}

/// The number moved by this much.
pub fn moved(number: &Number, by: f64) -> Number {
    match number {
        Number::Integer(n) => Number::Integer(n + by as i64),
        Number::Real { value, digits } => Number::Real { value: value + by, digits: *digits },
        Number::Interval { low, high } => Number::Interval { low: low + by, high: high + by },
        Number::Text(text) => Number::Text(text.clone()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_moved_by_what_it_allows() {
        let level = Level::of(1);
        let step = |value: Value| step(&value, level);
        assert_eq!(step(Value::integer("x", 16)), Some(1.0));
        assert_eq!(step(Value::real("x", 0.014285, 4)), Some(2e-5));
        assert_eq!(step(Value::real("x", 9.999, 2)), Some(2.0), "it prints as 10");
        assert_eq!(step(Value::printed("x", "0.12", "Sec. 2")), Some(0.02));
        assert_eq!(step(Value::ensemble("x", 0.1165, 4e-4, 100)), Some(2.0 * 2.58 * 4e-4));
        assert_eq!(step(Value::ensemble("x", 1.0, 0.0, 50)), Some(0.04));
        assert_eq!(step(Value::interval("x", [0.25, 0.5])), Some(0.25));
        assert_eq!(step(Value::text("x", "none")), None);
    }
}

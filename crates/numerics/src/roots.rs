//! Finds roots: by bisection down to two neighbouring doubles, and by false position.

/// Returns the neighbouring positive doubles between which `holds` turns from false to true.
///
/// `holds` must be monotone on [low, high], false at `low` and true at `high` (neither is tried);
/// 0 ≤ low < high, both finite. At most 64 evaluations, whatever the interval.
pub fn bracket(low: f64, high: f64, mut holds: impl FnMut(f64) -> bool) -> [f64; 2] {
    // The order of positive doubles is the order of their bit patterns.
    let (mut below, mut above) = (low.to_bits(), high.to_bits());
    while above - below > 1 {
        let middle = below + (above - below) / 2;
        if holds(f64::from_bits(middle)) {
            above = middle;
        } else {
            below = middle;
        }
    }
    [f64::from_bits(below), f64::from_bits(above)]
}

/// The largest number of evaluations; a few are enough where the function is smooth.
const MAX_EVALUATIONS: usize = 100;

/// Finds where a continuous function crosses zero from below: false position, in which an end that
/// stays for a second time counts with half its value, so that both ends move (the Illinois method;
/// Dowell and Jarratt 1971). It ends when two estimates in a row differ by no more than
/// `tolerance`, which is not a bound of the error.
///
/// `f` must be negative at `low` and positive at `high`; it is evaluated there too.
pub fn crossing([low, high]: [f64; 2], tolerance: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    let ((mut low, mut below), (mut high, mut above)) = ((low, f(low)), (high, f(high)));
    debug_assert!(below < 0.0 && above > 0.0, "no crossing between {low} and {high}");
    let (mut last, mut rose) = (f64::INFINITY, None);
    for _ in 0..MAX_EVALUATIONS {
        let middle = (low * above - high * below) / (above - below);
        if (middle - last).abs() <= tolerance {
            return middle;
        }
        last = middle;
        let value = f(middle);
        let again = rose.replace(value < 0.0) == Some(value < 0.0);
        let other = if again { 0.5 } else { 1.0 };
        if value < 0.0 {
            (low, below, above) = (middle, value, other * above);
        } else {
            (high, above, below) = (middle, value, other * below);
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_bounded() {
        for threshold in [5e-324, 1.0, 1e300] {
            let mut count = 0;
            let [_, above] = bracket(0.0, f64::MAX, |x| {
                count += 1;
                x >= threshold
            });
            assert_eq!(above, threshold);
            assert!(count <= 64, "{count} evaluations to find {threshold:e}");
        }
    }

    #[test]
    fn few_evaluations_find_the_root_of_two() {
        let mut count = 0;
        let root = crossing([0.0, 100.0], 1e-9, |x| {
            count += 1;
            x * x - 2.0
        });
        assert!((root - 2.0_f64.sqrt()).abs() < 1e-9, "{root}");
        assert!(count < 25, "{count}");
    }
}

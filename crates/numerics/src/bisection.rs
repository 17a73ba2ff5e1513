//! Bisection down to two neighbouring doubles.

/// The neighbouring positive doubles between which `holds` turns from false to true.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn root_of_two_is_bracketed_by_neighbours() {
        let [below, above] = bracket(0.0, 1e300, |x| x * x > 2.0);
        assert_eq!(below.next_up(), above);
        assert!(below * below <= 2.0 && above * above > 2.0);
    }

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
}

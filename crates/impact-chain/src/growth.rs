//! How fast the difference between two runs grows.

use impact_numerics::statistics::slope;

/// Differences that follow the growth: above the rounding of the times, below saturation.
const GROWING: std::ops::Range<f64> = 1e-13..1e-4;

/// Units of time in which the largest difference is one point of the growth.
const STRIDE: f64 = 5.0;

/// Fewer points than this are no growth.
const LEAST_POINTS: usize = 3;

/// The largest differences of a run from its twins, stride by stride.
#[derive(Clone, Debug, Default)]
pub struct Growth {
    /// (stride, largest difference), for strides with an impact.
    largest: Vec<(u64, f64)>,
}

impl Growth {
    /// Takes note of a difference at a time, which must not be in an earlier stride than the last.
    pub fn see(&mut self, time: f64, difference: f64) {
        let stride = (time / STRIDE) as u64;
        match self.largest.last_mut() {
            Some((last, largest)) if *last == stride => *largest = largest.max(difference),
            _ => self.largest.push((stride, difference)),
        }
    }

    /// The rate λ of the growth e^λt, by a straight line through the logarithms; nothing if too
    /// few differences lie where growth can be seen.
    pub fn rate(&self) -> Option<f64> {
        let points: Vec<(f64, f64)> = self
            .largest
            .iter()
            .filter(|(_, largest)| GROWING.contains(largest))
            .map(|&(stride, largest)| ((stride as f64 + 0.5) * STRIDE, pxfm::f_log(largest)))
            .collect();
        (points.len() >= LEAST_POINTS).then(|| slope(&points)).flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_lies_between_rounding_and_saturation_counts() {
        let mut growth = Growth::default();
        for i in 0..200 {
            let time = 0.5 * f64::from(i);
            // e^(t/4), hidden by rounding before and by saturation after.
            growth.see(time, (1e-15 * pxfm::f_exp(0.25 * time)).clamp(1e-14, 1e-3));
        }
        assert!((growth.rate().unwrap() - 0.25).abs() < 1e-3, "{:?}", growth.rate());
        let mut still = Growth::default();
        (0..200).for_each(|i| still.see(f64::from(i), 1e-15));
        assert_eq!(still.rate(), None);
    }
}

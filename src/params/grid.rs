//! Makes axes of σ from stretches of equal steps.

/// A σ axis made of stretches of equal steps; values are quotients, so 0.12 is the nearest double.
#[derive(Clone, Debug, Default)]
pub struct Grid(Vec<f64>);

impl Grid {
    /// Appends i / `denominator` for each numerator i.
    pub fn and(mut self, numerators: impl IntoIterator<Item = u32>, denominator: u32) -> Self {
        self.0.extend(numerators.into_iter().map(|i| f64::from(i) / f64::from(denominator)));
        self
    }

    pub fn values(self) -> Vec<f64> {
        debug_assert!(self.0.windows(2).all(|w| w[0] < w[1]));
        self.0
    }
}

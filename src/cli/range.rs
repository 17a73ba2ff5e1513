//! Reads numbers of the command line that must lie in a range.

/// Returns a parser of numbers from `low` to `high`, both included.
pub fn within(
    low: f64,
    high: f64,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| {
        let range = || format!("give a number from {low:?} to {high:?}");
        let number = text.trim().parse::<f64>().map_err(|_| range())?;
        // A negative zero would be printed as one.
        (low..=high).contains(&number).then_some(number + 0.0).ok_or_else(range)
    }
}

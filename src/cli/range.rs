//! Reads numbers of the command line that must lie in a range.

use std::sync::Arc;

/// A parser of one value of the command line.
pub trait Parse<T>: Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static {}
impl<T, F: Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static> Parse<T> for F {}

/// Returns a parser of numbers from `low` to `high`, both included.
pub fn number(low: f64, high: f64) -> impl Parse<f64> {
    move |text: &str| {
        let remedy = || format!("give a number from {low:?} to {high:?}");
        let number = text.trim().parse::<f64>().map_err(|_| remedy())?;
        // A negative zero would be printed as one.
        (low..=high).contains(&number).then_some(number + 0.0).ok_or_else(remedy)
    }
}

/// Several numbers, which are one value of the command line.
pub type Values = Arc<[f64]>;

/// A range with more numbers is taken for a mistake, where they are not times of output.
pub const MOST_VALUES: f64 = 1e5;

/// Returns a parser of a list of numbers from `low` to `high`, both included, or of a range of them
/// with at most `most`.
///
/// A range A..B:STEP is A + i·STEP, rounded to the decimals of A and STEP, so that 0.1..0.2:0.02
/// holds the same double 0.12 as a list does; B belongs to it when it is hit within STEP/1000.
pub fn numbers(low: f64, high: f64, most: f64) -> impl Parse<Values> {
    let parser = number(low, high);
    move |text: &str| {
        let number = |text: &str| parser(text).map_err(|error| format!("{text:?}: {error}"));
        let Some((from, rest)) = text.split_once("..") else {
            return text.split(',').map(number).collect();
        };
        let (to, step) = rest.split_once(':').ok_or("the range has no step; write A..B:STEP")?;
        let [a, b, h] = [number(from)?, number(to)?, number(step)?];
        let steps = ((b - a) / h + 1e-3).floor();
        // The range has one number more than steps.
        if !(0.0..most).contains(&steps) {
            return Err(format!(
                "write a range of 1 to {most} values, the smaller end first: A..B:STEP"
            ));
        }
        let decimals = |text: &str| match text.trim().split_once('.') {
            _ if text.contains(['e', 'E']) => 17,
            Some((_, decimals)) => decimals.len(),
            None => 0,
        };
        let places = decimals(from).max(decimals(step));
        let value = |i: u64| number(&format!("{:.places$}", a + i as f64 * h));
        (0..=steps as u64).map(value).collect()
    }
}

#[derive(Clone, Debug)]
pub enum Times {
    OncePerPeriod,
    Values(Values),
}

/// Returns a parser of times up to `latest` that rise or stay, as many as memory holds, or of
/// `period`.
pub fn times(latest: f64) -> impl Parse<Times> {
    move |text: &str| {
        if text == "period" {
            return Ok(Times::OncePerPeriod);
        }
        let times = numbers(0.0, latest, 1e15)(text)?;
        let is_rising = times.is_sorted();
        is_rising.then_some(Times::Values(times)).ok_or("the times fall; give rising ones".into())
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_VALUES, numbers};

    #[test]
    fn lists_and_ranges() {
        let sigmas = numbers(0.0, 1e6, MOST_VALUES);
        let read = |text: &str| sigmas(text).unwrap().to_vec();
        assert_eq!(read("0.1,0.12"), [0.1, 0.12]);
        assert_eq!(read(" 0.3 "), [0.3]);
        // 0.1 + 0.02 is 0.12000000000000001 in binary; in decimals it is 0.12.
        assert_eq!(read("0.1..0.14:0.02"), [0.1, 0.12, 0.14]);
        assert_eq!(read("0.1..0.15:0.02"), [0.1, 0.12, 0.14]);
        assert_eq!(read("0..0.001:5e-4"), [0.0, 5e-4, 1e-3]);
        assert_eq!(read("0.12..0.12:1"), [0.12]);
        // Three steps of 0.033333 end 1e−6 below 0.1: not short by STEP/1000.
        assert_eq!(read("0..0.1:0.033333").len(), 4);
        assert_eq!(read("0..0.1:0.03334").len(), 4);
        assert_eq!(read("0..0.1:0.0334").len(), 3);
    }
}

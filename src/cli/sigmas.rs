//! The σ axis on the command line: `0.1,0.12` or `0.08..0.18:0.0025`.

use super::within;
use std::sync::Arc;

/// More values than this are taken for a slip.
const MOST: f64 = 1e5;

/// Reads a list or a range of standard deviations, in units of d ω².
///
/// A range is A + i·STEP, rounded to the decimals of A and STEP, so that 0.1..0.2:0.02 holds the same double
/// 0.12 as a list does; B belongs to it when it is hit within STEP/1000.
///
/// # Errors
/// One line with what is wrong and what to write.
pub fn parse(text: &str) -> Result<Arc<[f64]>, String> {
    // With larger ones rounding would hide the spacing of 1 (see `impact_chain::rounding`).
    let number = |text: &str| within(0.0, 1e6)(text).map_err(|what| format!("{text:?}: {what}"));
    let Some((from, rest)) = text.split_once("..") else {
        return text.split(',').map(number).collect();
    };
    let (to, step) = rest.split_once(':').ok_or("the range has no step; write A..B:STEP")?;
    let [a, b, h] = [number(from)?, number(to)?, number(step)?];
    let steps = ((b - a) / h + 1e-3).floor();
    if !(0.0..MOST).contains(&steps) {
        return Err("write a range of 1 to 100000 values, the smaller end first: A..B:STEP".into());
    }
    let decimals = |text: &str| match text.trim().split_once('.') {
        _ if text.contains(['e', 'E']) => 17,
        Some((_, decimals)) => decimals.len(),
        None => 0,
    };
    let places = decimals(from).max(decimals(step));
    let value = |i: u32| number(&format!("{:.places$}", a + f64::from(i) * h));
    (0..=steps as u32).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn lists_and_ranges() {
        let read = |text: &str| parse(text).unwrap().to_vec();
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
        for wrong in ["0.2..0.1:0.01", "0.1..0.2:0", "0.1..0.2", "x", "0..1e6:1", "-0.1", "NaN"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}

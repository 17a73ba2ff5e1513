//! The σ axis on the command line: `0.1,0.12` or `0.08..0.18:0.0025`.

use super::number;

/// More values than this are taken for a slip.
const MOST: usize = 100_000;

/// With larger ones rounding would hide the spacing of 1 (see `impact_chain::rounding`).
pub const LARGEST: f64 = 1e6;

/// Reads a list or a range of standard deviations.
///
/// A range is A + i·STEP, computed in decimals, so that 0.1..0.2:0.02 holds the same double
/// 0.12 as a list does; B belongs to it when it is hit within STEP/1000.
///
/// # Errors
/// One line with what is wrong and what to write.
pub fn parse(text: &str) -> Result<Vec<f64>, String> {
    let values = match text.split_once("..") {
        Some((from, rest)) => {
            let (to, step) = rest.split_once(':').ok_or_else(|| {
                format!("--sigma: the range {text:?} has no step; write A..B:STEP")
            })?;
            range(text, from, to, step)?
        }
        None => text.split(',').map(number).collect::<Result<_, _>>()?,
    };
    match values.iter().find(|sigma| !(0.0..=LARGEST).contains(*sigma)) {
        Some(sigma) if *sigma < 0.0 => {
            Err(format!("--sigma: {sigma:?} is negative; give values of 0 or more"))
        }
        Some(sigma) => {
            Err(format!("--sigma: {sigma:?} is too large; give values up to {LARGEST:?}"))
        }
        None => Ok(values),
    }
}

fn number(text: &str) -> Result<f64, String> {
    let finite = |x: f64| if x.is_finite() { Ok(x) } else { Err("it is not finite".to_string()) };
    number::parse(text).and_then(finite).map_err(|what| {
        format!(
            "--sigma: {text:?}: {what}; a list is like 0.1,0.12, a range like 0.08..0.18:0.0025"
        )
    })
}

fn range(text: &str, from: &str, to: &str, step: &str) -> Result<Vec<f64>, String> {
    let [a, b, h] = [number(from)?, number(to)?, number(step)?];
    if h <= 0.0 {
        return Err(format!("--sigma: the step {h:?} is not positive; give one above 0"));
    }
    let steps = ((b - a) / h + 1e-3).floor();
    if b < a || steps < 0.0 {
        return Err(format!("--sigma: the range {text:?} is empty; put the smaller value first"));
    }
    if steps >= MOST as f64 {
        let message = "--sigma: the range has too many values; take a larger step";
        return Err(message.into());
    }
    let decimals = Decimal::parse(from).zip(Decimal::parse(step));
    (0..=steps as u32)
        .map(|i| {
            decimals
                .and_then(|(a, h)| a.plus(i, h))
                .map_or(Ok(a + f64::from(i) * h), |sum| number(&sum))
        })
        .collect()
}

/// digits · 10^−places.
#[derive(Clone, Copy)]
struct Decimal {
    digits: i128,
    places: u32,
}

impl Decimal {
    /// A number written without exponent and with at most 30 digits.
    fn parse(text: &str) -> Option<Decimal> {
        let text = text.trim();
        let (whole, part) = text.split_once('.').unwrap_or((text, ""));
        let places = u32::try_from(part.len()).ok()?;
        let digits = format!("{whole}{part}");
        if digits.len() > 30 {
            return None;
        }
        Some(Decimal { digits: digits.parse().ok()?, places })
    }

    /// self + i·step, written out.
    fn plus(self, i: u32, step: Decimal) -> Option<String> {
        let places = self.places.max(step.places);
        let digits = |x: Decimal| x.digits.checked_mul(10_i128.checked_pow(places - x.places)?);
        let sum = digits(self)?.checked_add(digits(step)?.checked_mul(i128::from(i))?)?;
        Some(format!("{sum}e-{places}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_ranges() {
        assert_eq!(parse("0.1,0.12").unwrap(), [0.1, 0.12]);
        assert_eq!(parse(" 0.3 ").unwrap(), [0.3]);
        // 0.1 + 0.02 is 0.12000000000000001 in binary; in decimals it is 0.12.
        assert_eq!(parse("0.1..0.14:0.02").unwrap(), [0.1, 0.12, 0.14]);
        assert_eq!(parse("0.1..0.15:0.02").unwrap(), [0.1, 0.12, 0.14]);
        assert_eq!(parse("0..0.001:5e-4").unwrap(), [0.0, 5e-4, 1e-3]);
        assert_eq!(parse("0.12..0.12:1").unwrap(), [0.12]);
        // Three steps of 0.033333 end 1e−6 below 0.1: not short by STEP/1000.
        assert_eq!(parse("0..0.1:0.033333").unwrap().len(), 4);
        assert_eq!(parse("0..0.1:0.03334").unwrap().len(), 4);
        assert_eq!(parse("0..0.1:0.0334").unwrap().len(), 3);
    }
}

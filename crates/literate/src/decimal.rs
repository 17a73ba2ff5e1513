//! Rounds numbers to decimal digits, once, from their exact values.

/// The largest number of digits that can be asked for: a double ends at its 1074th decimal.
pub(crate) const MAX_DIGITS: usize = 1100;

/// A decimal number without its sign: an integer, divided by a power of ten.
pub(crate) struct Decimal {
    /// The digits of the integer, without zeros at the beginning; empty for zero.
    pub digits: String,
    /// The power of ten: the number of decimals, if it is not negative.
    pub places: i32,
}

impl Decimal {
    /// Reads a number such as 1.5e-4.
    fn read(text: &str) -> Decimal {
        let (mantissa, exponent) = scientific(text);
        let decimals = mantissa.split_once('.').map_or(0, |(_, after)| after.len());
        let digits = mantissa.replace('.', "").trim_start_matches('0').into();
        Decimal { digits, places: decimals as i32 - exponent }
    }

    /// Multiplies by a power of ten.
    pub fn times_ten(self, power: i32) -> Decimal {
        Decimal { places: self.places - power, ..self }
    }

    /// Writes it without a power of ten.
    pub fn written(&self) -> String {
        let Decimal { digits, places } = self;
        match usize::try_from(*places) {
            Ok(0) | Err(_) if digits.is_empty() => "0".into(),
            Ok(0) => digits.clone(),
            Ok(places) => {
                let digits = format!("{digits:0>0$}", places + 1);
                let (whole, decimals) = digits.split_at(digits.len() - places);
                format!("{whole}.{decimals}")
            }
            Err(_) => digits.clone() + &"0".repeat(places.unsigned_abs() as usize),
        }
    }
}

/// Returns the shortest decimal that reads back to the same double as |x|.
pub(crate) fn shortest(x: f64) -> Decimal {
    let decimal = Decimal::read(&format!("{:e}", x.abs()));
    if x == 0.0 { Decimal { places: 0, ..decimal } } else { decimal }
}

/// Rounds |x| to so many significant digits.
pub(crate) fn significant(x: f64, digits: usize) -> Decimal {
    let after = digits.clamp(1, MAX_DIGITS) - 1;
    if x == 0.0 { shortest(x) } else { Decimal::read(&format!("{:.after$e}", x.abs())) }
}

/// Rounds |x| to a decimal place; a negative one rounds to tens, hundreds, …
pub(crate) fn rounded(x: f64, places: i32) -> Decimal {
    let digits = leading(x, EXACT) + 1 + places;
    let digits = match digits {
        1.. if x != 0.0 => {
            let found = significant(x, digits as usize);
            // 9.96 rounds to 10.0, which has a digit more.
            if found.places < places { found.digits + "0" } else { found.digits }
        }
        0 if is_above_half(x) => "1".into(),
        _ => String::new(),
    };
    Decimal { digits, places }
}

/// So many digits tell every double from a power of ten that it is not.
const EXACT: usize = 25;

/// Returns whether the digits of x are above 5, 50, 500, …
fn is_above_half(x: f64) -> bool {
    let (mantissa, _) = scientific(&format!("{:.*e}", MAX_DIGITS, x.abs()));
    mantissa.trim_end_matches(['0', '.']) > "5"
}

/// Rounds an integer to significant digits, a half to an even digit.
pub(crate) fn rounded_integer(n: i128, digits: usize) -> Decimal {
    let n = n.unsigned_abs();
    let rest = n.to_string().len().saturating_sub(digits.max(1)) as u32;
    let unit = 10_u128.pow(rest);
    let (whole, part) = (n / unit, 2 * (n % unit));
    let up = part > unit || part == unit && whole % 2 == 1;
    let digits = (whole + u128::from(up)).to_string();
    Decimal { digits: digits.trim_start_matches('0').into(), places: -(rest as i32) }
}

/// Returns the exponent of the leading digit of x, rounded to so many significant digits; 0 for 0.
pub(crate) fn leading(x: f64, digits: usize) -> i32 {
    scientific(&format!("{:.*e}", digits - 1, x)).1
}

/// Splits "1.5e-4" into "1.5" and −4.
fn scientific(text: &str) -> (String, i32) {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    (mantissa.to_string(), exponent.parse().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tens_are_rounded_from_the_exact_number() {
        for (value, places, text) in
            [(5.0, -1, "0"), (5.1, -1, "10"), (15.0, -1, "20"), (96.0, -1, "100"), (1e23, -22, "1")]
        {
            assert!(rounded(value, places).written().starts_with(text), "{value}");
        }
    }
}

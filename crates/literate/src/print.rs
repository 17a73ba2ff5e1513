//! Chooses how many digits of a value are printed, the same in every format.
//!
//! [`print()`] returns the digits as data, [`Printed`]; each format writes them in its markup. Only
//! the decimal conversion of Rust is used, which rounds exactly and alike on every platform.

use crate::decimal::Decimal;
use crate::value::{Digits, Number, Value};

/// What filters of a template change of a value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Style {
    pub in_percent: bool,
    pub digits: Option<Digits>,
}

/// A value as readers see it, before any markup.
#[derive(Clone, Debug, PartialEq)]
pub enum Printed {
    Words(String),
    Number(Numeral),
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Numeral {
    pub is_negative: bool,
    /// Digits with at most one decimal point; long integers have narrow spaces between groups.
    pub digits: String,
    /// The standard error in units of the last digit, which is printed in brackets.
    pub error: Option<String>,
    pub exponent: Option<i32>,
    pub in_percent: bool,
}

/// Chooses the digits of a number, which is rounded once, from the decimal that it is meant to be.
pub fn print(number: &Number, style: Style) -> Printed {
    let power = if style.in_percent { 2 } else { 0 };
    let (negative, numeral) = match *number {
        Number::None => return Printed::Words("–".into()),
        Number::Text(ref words) => return Printed::Words(words.clone()),
        // No table has such a number, but a message may.
        Number::Real { value, .. } if !value.is_finite() => {
            return Printed::Words(value.to_string());
        }
        Number::Integer(n) => {
            let integer = Decimal::integer(n);
            let numeral = match style.digits {
                Some(Digits::Significant(n)) => numeral(integer.significant(n).times_ten(power)),
                _ if style.in_percent => numeral(integer.times_ten(power)),
                _ => of_digits(grouped(integer.written())),
            };
            (n < 0, numeral)
        }
        Number::Real { value, digits } => {
            let decimal = |from_double: fn(f64) -> Decimal| match digits {
                Digits::Text(text) => Decimal::read(text),
                _ => from_double(value),
            };
            let numeral = match style.digits.unwrap_or(digits) {
                Digits::Error(error) => with_error(value, error, power),
                Digits::Significant(n) => {
                    numeral(decimal(Decimal::meant).significant(n).times_ten(power))
                }
                Digits::Decimals(n) => {
                    let rounded = decimal(Decimal::meant).rounded((n as i32).max(power));
                    of_digits(rounded.times_ten(power).written())
                }
                Digits::Full | Digits::Text(_) => match (decimal(Decimal::shortest), digits) {
                    (zero, Digits::Text(_)) if zero.digits.is_empty() => of_digits(zero.written()),
                    (whole, Digits::Text(_)) if whole.places == power => {
                        of_digits(grouped(whole.times_ten(power).written()))
                    }
                    (full, _) => numeral(full.times_ten(power)),
                },
            };
            (value < 0.0, numeral)
        }
    };
    // What rounds to zero has no sign.
    let is_negative = negative && numeral.digits.contains(|c: char| ('1'..='9').contains(&c));
    Printed::Number(Numeral { is_negative, in_percent: style.in_percent, ..numeral })
}

impl Printed {
    /// Writes it as TeX for a formula: `0.1165(4)`, `1.2\times10^{-5}`.
    pub fn to_tex(&self) -> String {
        match self {
            Printed::Words(words) => format!(r"\text{{{words}}}"),
            Printed::Number(numeral) => {
                let percent = if numeral.in_percent { r"\,\%" } else { "" };
                let power = numeral.power_to_tex();
                format!("{}{percent}", power.unwrap_or_else(|| numeral.digits_to_tex()))
            }
        }
    }

    /// Writes it for terminals and data files: `0.1165(4)`, `1.2e-5`, `94.5 %`.
    pub fn to_plain_text(&self) -> String {
        let numeral = match self {
            Printed::Words(words) => return words.replace(NARROW_SPACE, ""),
            Printed::Number(numeral) => numeral,
        };
        let power = numeral.exponent.map(|e| format!("e{e}")).unwrap_or_default();
        let percent = if numeral.in_percent { " %" } else { "" };
        format!("{}{power}{percent}", numeral.signed("-")).replace(NARROW_SPACE, "")
    }
}

impl Numeral {
    /// Returns sign, digits and error, without the power of ten and the sign of per cent.
    pub fn signed(&self, minus: &str) -> String {
        let minus = if self.is_negative { minus } else { "" };
        let error = self.error.as_ref().map(|e| format!("({e})")).unwrap_or_default();
        format!("{minus}{}{error}", self.digits)
    }

    /// Returns whether only the power of ten is written: 10^−9 and not 1 × 10^−9.
    pub fn is_power_alone(&self) -> bool {
        self.exponent.is_some() && self.digits == "1" && !self.is_negative && self.error.is_none()
    }

    pub fn power_to_tex(&self) -> Option<String> {
        let exponent = self.exponent?;
        if self.is_power_alone() {
            return Some(format!("10^{{{exponent}}}"));
        }
        Some(format!(r"{}\times10^{{{exponent}}}", self.digits_to_tex()))
    }

    fn digits_to_tex(&self) -> String {
        self.signed("-").replace(NARROW_SPACE, r"\,")
    }
}

const NARROW_SPACE: char = '\u{202f}';

/// Writes a number with a power of ten below 10^−3 and from 10^6 on.
fn numeral(number: Decimal) -> Numeral {
    match number.exponent() {
        -3..6 => of_digits(number.written()),
        power => Numeral { exponent: Some(power), ..of_digits(number.times_ten(-power).written()) },
    }
}

fn of_digits(digits: String) -> Numeral {
    Numeral { digits, ..Numeral::default() }
}

/// Prints a number with one digit of its error in brackets, or two after a leading 1.
fn with_error(x: f64, error: f64, power: i32) -> Numeral {
    if error == 0.0 {
        // Rounding may have spoilt more digits than these.
        return numeral(Decimal::meant(x).significant(15).trimmed().times_ten(power));
    }
    let shortest = || numeral(Decimal::shortest(x).times_ten(power));
    if error < 0.0 || !error.is_finite() {
        return Numeral { error: Some(error.to_string()), ..shortest() };
    }
    let error = Decimal::meant(error);
    let one = error.significant(1);
    let two = one.digits == "1" || error.significant(2).digits.starts_with('1');
    let places = i32::from(two) - one.exponent();
    if x != 0.0 && places + Decimal::meant(x).exponent() > 16 {
        return shortest();
    }
    let number = numeral(Decimal::meant(x).rounded(places).times_ten(power));
    let error = error.rounded(places).times_ten(power - number.exponent.unwrap_or(0));
    // In units of the last digit, unless it reaches over the point: 0.1165(4), but 16.0(1.2).
    let reaches_over = error.digits.len() as i32 > error.places;
    let error = if reaches_over { error.written() } else { error.digits };
    Numeral { error: Some(error), ..number }
}

/// Groups the digits of an integer by threes with a narrow space if there are five or more.
fn grouped(digits: String) -> String {
    if digits.len() < 5 {
        return digits;
    }
    let (first, rest) = digits.split_at((digits.len() - 1) % 3 + 1);
    let mut grouped = first.to_string();
    for start in (0..rest.len()).step_by(3) {
        grouped.push(NARROW_SPACE);
        grouped += &rest[start..start + 3];
    }
    grouped
}

impl Value {
    pub(crate) fn to_plain_text(&self) -> String {
        print(&self.number, Style::default()).to_plain_text()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::estimates::with_error;

    fn error(value: f64, error: f64) -> Printed {
        print(&with_error(value, error).into(), Style::default())
    }

    fn real(value: f64, digits: usize) -> Printed {
        print(&Value::real("x", value, digits).number, Style::default())
    }

    #[test]
    fn digits_follow_from_the_error() {
        for (value, e, text) in [
            (0.116_527, 0.000_43, "0.1165(4)"),
            (0.116_527, 0.001_43, "0.1165(14)"),
            (0.116_527, 0.001_67, "0.1165(17)"),
            (0.116_527, 0.001_94, "0.1165(19)"),
            (0.116_527, 0.001_96, "0.117(2)"),
            (0.116_527, 0.009_6, "0.117(10)"),
            (16.04, 1.23, "16.0(1.2)"),
            (16.04, 3.4, "16(3)"),
            (4123.0, 34.0, "4120(30)"),
            (4123.0, 134.0, "4120(130)"),
            (4125.0, 34.0, "4120(30)"),
            (4125.1, 34.0, "4130(30)"),
            (4135.0, 34.0, "4140(30)"),
            (9996.0, 34.0, "10000(30)"),
            (-3.16, 0.2, "-3.2(2)"),
            (0.0, 0.03, "0.00(3)"),
            (101.0, 0.0, "101"),
            (0.1 + 0.2, 0.0, "0.3"),
            (0.1, 1e-30, "0.1"),
            (0.1, 3e-17, "0.10000000000000000(3)"),
            (0.1, -0.02, "0.1(-0.02)"),
            (3.14e-8, 2e-9, "3.1(2)e-8"),
            (2.5e9, 3e7, "2.50(3)e9"),
            (9.996, 0.02, "10.00(2)"),
            (0.95, 0.35, "1.0(4)"),
            (10.0, 0.95, "10.0(1.0)"),
        ] {
            assert_eq!(error(value, e).to_plain_text(), text, "{value} ± {e}");
        }
    }

    #[test]
    fn each_markup_has_its_minus_power_and_percent() {
        let big = print(&Number::Integer(1_234_567), Style::default());
        let number = with_error(0.9453, 0.0081).into();
        let percent = print(&number, Style { in_percent: true, ..Style::default() });
        for (printed, [tex, plain]) in [
            (real(-3.25, 3), ["-3.25", "-3.25"]),
            (real(1.2e-5, 2), [r"1.2\times10^{-5}", "1.2e-5"]),
            (real(1e-9, 1), ["10^{-9}", "1e-9"]),
            (real(-2e-9, 1), [r"-2\times10^{-9}", "-2e-9"]),
            (big, [r"1\,234\,567", "1234567"]),
            (percent, [r"94.5(8)\,\%", "94.5(8) %"]),
        ] {
            assert_eq!([printed.to_tex(), printed.to_plain_text()], [tex, plain]);
        }
    }

    /// Fewer digits of a double are those of the decimal conversion of Rust, which rounds exactly.
    #[test]
    fn numbers_are_rounded_once_and_read_back_the_same() {
        let plain = |number| print(&number, Style::default()).to_plain_text();
        let mut bits = 1_u64;
        for round in 0..500_000_usize {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(12_345);
            let mixed = bits ^ (bits >> 31);
            assert_eq!(plain(Number::from(mixed)).parse(), Ok(mixed));
            let x = f64::from_bits(mixed);
            if !x.is_finite() {
                continue;
            }
            let real = |value, digits| plain(Number::Real { value, digits });
            assert_eq!(real(x, Digits::Full).parse(), Ok(x));
            if round % 50 == 0 && Decimal::shortest(x).digits.len() > 15 {
                let (digits, places) = (1 + round / 50 % 17, round / 50 % 9);
                let once: f64 = format!("{:.*e}", digits - 1, x).parse().unwrap();
                assert_eq!(real(x, Digits::Significant(digits)).parse(), Ok(once), "{x:e}");
                let x = ((bits >> 40) as f64).sqrt();
                assert_eq!(real(x, Digits::Decimals(places)), format!("{x:.places$}"));
            }
        }
    }

    #[test]
    fn no_digit_is_lost_or_rounded_twice() {
        let full = |value| Number::Real { value, digits: Digits::Full };
        let two = Some(Digits::Significant(2));
        for (number, digits, percent, text) in [
            (full(9.112_847_118_503_352e-5), None, false, "9.112847118503352e-5"),
            (full(0.012_209_975_124), Some(Digits::Significant(6)), false, "0.0122100"),
            (full(8.5e-301), two, false, "8.5e-301"),
            (full(99.96), Some(Digits::Significant(3)), false, "100"),
            (full(9.996e-4), Some(Digits::Significant(3)), false, "0.00100"),
            (full(1234.5), two, false, "1200"),
            (full(0.0), two, false, "0"),
            // As a double it is halfway.
            (1_250_000_000_000_000_001_i64.into(), two, false, "1.3e18"),
            (Number::Integer(12), two, true, "1200 %"),
            // As a double it is a little less.
            (full(2.675), Some(Digits::Significant(3)), false, "2.68"),
            (full(9.995), Some(Digits::Significant(3)), false, "10.0"),
        ] {
            assert_eq!(print(&number, Style { in_percent: percent, digits }).to_plain_text(), text);
        }
    }
}

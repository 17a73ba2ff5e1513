//! Chooses how many digits of a value are printed, the same in every format.
//!
//! [`print()`] returns the digits as data, [`Shown`]; each format writes them in its markup. Only
//! the decimal conversion of Rust is used, which rounds exactly and alike on every platform.

use crate::value::{Digits, Number, Value};

/// The largest number of digits that can be asked for: a double ends at its 1074th decimal.
pub const MAX_DIGITS: usize = 1100;

/// What filters of a template change of a value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Style {
    /// Times one hundred, with a percent sign.
    pub percent: bool,
    /// Other digits than those of the value.
    pub digits: Option<Digits>,
}

/// A value as readers see it, before any markup.
#[derive(Clone, Debug, PartialEq)]
pub enum Shown {
    Words(String),
    Number(Numeral),
}

/// The pieces of a printed number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Numeral {
    pub negative: bool,
    /// Digits with at most one decimal point; long integers have narrow spaces between groups.
    pub digits: String,
    /// The standard error in units of the last digit, which is printed in brackets.
    pub error: Option<String>,
    /// The power of ten that multiplies it.
    pub exponent: Option<i32>,
    pub percent: bool,
}

/// Chooses the digits of a number, which is rounded once, from its exact value.
pub fn print(number: &Number, style: Style) -> Shown {
    let Style { percent, digits: asked } = style;
    let (negative, numeral) = match *number {
        Number::None => return Shown::Words("–".into()),
        Number::Text(ref words) => return Shown::Words(words.clone()),
        Number::Integer(n) => {
            let numeral = match asked {
                Some(Digits::Significant(digits)) => rounded_integer(n, digits).numeral(percent),
                _ if percent => rounded_integer(n, usize::MAX).numeral(true),
                _ => Numeral { digits: grouped(n), ..Numeral::default() },
            };
            (n < 0, numeral)
        }
        // No table has such a number, but a message may.
        Number::Real { value, .. } if !value.is_finite() => return Shown::Words(value.to_string()),
        Number::Real { value, digits } => {
            let numeral = match asked.unwrap_or(digits) {
                Digits::Error(error) => with_error(value, error, percent),
                Digits::Significant(n) => significant(value, n).numeral(percent),
                Digits::Decimals(n) => with_decimals(value, n, percent),
                Digits::Full => shortest(value).numeral(percent),
            };
            (value < 0.0, numeral)
        }
    };
    // What rounds to zero has no sign.
    let negative = negative && numeral.digits.contains(|c: char| ('1'..='9').contains(&c));
    Shown::Number(Numeral { negative, percent, ..numeral })
}

impl Shown {
    /// Writes it as Markdown: `0.1165(4)`, `$1.2\times10^{-5}$`, `−3`, `94.5 %`.
    pub fn markdown(&self) -> String {
        let numeral = match self {
            Shown::Words(words) => return words.clone(),
            Shown::Number(numeral) => numeral,
        };
        let percent = if numeral.percent { "\u{a0}%" } else { "" };
        match numeral.tex_power() {
            Some(power) => format!("${power}${percent}"),
            None => format!("{}{percent}", numeral.signed("−")),
        }
    }

    /// Writes it as TeX inside a formula: `0.1165(4)`, `1.2\times10^{-5}`.
    pub fn tex(&self) -> String {
        match self {
            Shown::Words(words) => format!(r"\text{{{words}}}"),
            Shown::Number(numeral) => {
                let percent = if numeral.percent { r"\,\%" } else { "" };
                let power = numeral.tex_power();
                format!("{}{percent}", power.unwrap_or_else(|| numeral.tex_digits()))
            }
        }
    }

    /// Writes it for terminals and data files: `0.1165(4)`, `1.2e-5`, `94.5 %`.
    pub fn plain(&self) -> String {
        let numeral = match self {
            Shown::Words(words) => return words.replace(NARROW_SPACE, ""),
            Shown::Number(numeral) => numeral,
        };
        let power = numeral.exponent.map(|e| format!("e{e}")).unwrap_or_default();
        let percent = if numeral.percent { " %" } else { "" };
        format!("{}{power}{percent}", numeral.signed("-")).replace(NARROW_SPACE, "")
    }
}

impl Numeral {
    /// Returns sign, digits and error, without power and percent sign.
    pub fn signed(&self, minus: &str) -> String {
        let minus = if self.negative { minus } else { "" };
        let error = self.error.as_ref().map(|e| format!("({e})")).unwrap_or_default();
        format!("{minus}{}{error}", self.digits)
    }

    /// Whether only the power of ten is written: 10^−9 and not 1 × 10^−9.
    pub fn is_power_alone(&self) -> bool {
        self.exponent.is_some() && self.digits == "1" && !self.negative && self.error.is_none()
    }

    /// The number as TeX if it has a power of ten.
    pub fn tex_power(&self) -> Option<String> {
        let exponent = self.exponent?;
        if self.is_power_alone() {
            return Some(format!("10^{{{exponent}}}"));
        }
        Some(format!(r"{}\times10^{{{exponent}}}", self.tex_digits()))
    }

    fn tex_digits(&self) -> String {
        self.signed("-").replace(NARROW_SPACE, r"\,")
    }
}

const NARROW_SPACE: char = '\u{202f}';

/// Below 10^−3 and from 10^6 on, a real number is written with a power of ten.
fn shows_power(exponent: i32) -> bool {
    !(-3..6).contains(&exponent)
}

/// A decimal number without its sign: an integer, divided by a power of ten.
struct Decimal {
    /// The digits of the integer, without zeros at the beginning; empty for zero.
    digits: String,
    /// The power of ten: the number of decimals, if it is not negative.
    places: i32,
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
    fn shifted(self, power: i32) -> Decimal {
        Decimal { places: self.places - power, ..self }
    }

    /// Chooses whether it is written with a power of ten, and in per cent.
    fn numeral(self, percent: bool) -> Numeral {
        let number = self.shifted(if percent { 2 } else { 0 });
        let exponent = match number.digits.len() {
            0 => -number.places,
            length => length as i32 - 1 - number.places,
        };
        if shows_power(exponent) {
            let digits = number.shifted(-exponent).written();
            return Numeral { exponent: Some(exponent), digits, ..Numeral::default() };
        }
        Numeral { digits: number.written(), ..Numeral::default() }
    }

    fn written(&self) -> String {
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

/// |x| as the shortest decimal that reads back to the same double.
fn shortest(x: f64) -> Decimal {
    let decimal = Decimal::read(&format!("{:e}", x.abs()));
    if x == 0.0 { Decimal { places: 0, ..decimal } } else { decimal }
}

/// |x| rounded to so many significant digits.
fn significant(x: f64, digits: usize) -> Decimal {
    let after = digits.clamp(1, MAX_DIGITS) - 1;
    if x == 0.0 { shortest(x) } else { Decimal::read(&format!("{:.after$e}", x.abs())) }
}

/// |x| rounded to a decimal place; a negative one rounds to tens, hundreds, …
fn rounded(x: f64, places: i32) -> Decimal {
    let wanted = leading(x, EXACT) + 1 + places;
    let mut found = match usize::try_from(wanted) {
        Ok(0) if x != 0.0 && is_above_half(x) => Decimal { digits: "1".into(), places },
        Err(_) | Ok(0) => Decimal { digits: String::new(), places },
        Ok(digits) if x != 0.0 => significant(x, digits),
        Ok(_) => Decimal { digits: String::new(), places },
    };
    // 9.96 rounds to 10.0, which has a digit more.
    if found.places < places {
        found.digits.push('0');
    }
    Decimal { places, ..found }
}

/// So many digits tell every double from a power of ten that it is not.
const EXACT: usize = 25;

/// Whether the digits of x are above 5, 50, 500, …
fn is_above_half(x: f64) -> bool {
    let (mantissa, _) = scientific(&format!("{:.*e}", MAX_DIGITS, x.abs()));
    mantissa.trim_end_matches(['0', '.']) > "5"
}

/// A number with so many decimals, in per cent two fewer, and never with a power of ten.
fn with_decimals(x: f64, decimals: usize, percent: bool) -> Numeral {
    let shift = if percent { 2 } else { 0 };
    let places = (decimals.min(MAX_DIGITS) as i32).max(shift);
    let digits = rounded(x, places).shifted(shift).written();
    Numeral { digits, ..Numeral::default() }
}

/// The number with its error in brackets: one digit of it, or two after a leading 1.
fn with_error(x: f64, error: f64, percent: bool) -> Numeral {
    if error <= 0.0 {
        return shortest(x).numeral(percent);
    }
    let starts_with_1 = |text: String| text.starts_with('1');
    let two = starts_with_1(format!("{error:.1e}")) || starts_with_1(format!("{error:.0e}"));
    let places = i32::from(two) - leading(error, 1);
    let numeral = rounded(x, places).numeral(percent);
    let shift = if percent { 2 } else { 0 } - numeral.exponent.unwrap_or(0);
    let error = rounded(error, places).shifted(shift);
    // In units of the last digit, unless it reaches over the point: 0.1165(4), but 16.0(1.2).
    let reaches_over = error.digits.len() as i32 > error.places;
    let error = if reaches_over { error.written() } else { error.digits };
    Numeral { error: Some(error), ..numeral }
}

/// An integer rounded to significant digits, a half to an even digit.
fn rounded_integer(n: i128, digits: usize) -> Decimal {
    let n = n.unsigned_abs();
    let rest = n.to_string().len().saturating_sub(digits.max(1)) as u32;
    let unit = 10_u128.pow(rest);
    let (whole, part) = (n / unit, 2 * (n % unit));
    let up = part > unit || part == unit && whole % 2 == 1;
    let text = (whole + u128::from(up)).to_string();
    // 99.6 rounds to 100, which has a digit more.
    let carried = text.len().saturating_sub(digits.max(1));
    let text = text[..text.len() - carried].trim_start_matches('0');
    Decimal { digits: text.into(), places: -(rest as i32) - carried as i32 }
}

/// Exponent of the leading digit of x after rounding to so many significant digits; 0 for 0.
fn leading(x: f64, digits: usize) -> i32 {
    scientific(&format!("{:.*e}", digits - 1, x)).1
}

/// "1.5e-4" → ("1.5", −4).
fn scientific(text: &str) -> (String, i32) {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    (mantissa.to_string(), exponent.parse().unwrap_or(0))
}

/// Digits in groups of three from five digits on, with a narrow space that does not break.
fn grouped(n: i128) -> String {
    let digits = n.unsigned_abs().to_string();
    if digits.len() < 5 {
        return digits;
    }
    let mut out = String::new();
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(NARROW_SPACE);
        }
        out.push(c);
    }
    out
}

impl Value {
    /// The value in its digits, for terminals and data: `0.1165(4)`.
    pub fn plain(&self) -> String {
        print(&self.number, Style::default()).plain()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(value: f64, error: f64) -> Shown {
        print(&Value::ensemble("x", value, error, 9).number, Style::default())
    }

    fn real(value: f64, digits: usize) -> Shown {
        print(&Value::real("x", value, digits).number, Style::default())
    }

    #[test]
    fn digits_follow_from_the_error() {
        for (value, e, text) in [
            (0.116_527, 0.000_43, "0.1165(4)"),
            (0.116_527, 0.001_43, "0.1165(14)"),
            (0.116_527, 0.009_6, "0.117(10)"),
            (16.04, 1.23, "16.0(1.2)"),
            (16.04, 3.4, "16(3)"),
            (4123.0, 34.0, "4120(30)"),
            (4123.0, 134.0, "4120(130)"),
            (-3.16, 0.2, "-3.2(2)"),
            (0.0, 0.03, "0.00(3)"),
            (101.0, 0.0, "101"),
            (3.14e-8, 2e-9, "3.1(2)e-8"),
            (2.5e9, 3e7, "2.50(3)e9"),
            (9.996, 0.02, "10.00(2)"),
        ] {
            assert_eq!(error(value, e).plain(), text, "{value} ± {e}");
        }
    }

    #[test]
    fn declared_digits_and_powers() {
        for (value, digits, text) in [
            (0.012_209_975_124, 6, "0.0122100"),
            (8.870_17e-4, 3, "8.87e-4"),
            (8.5e-301, 2, "8.5e-301"),
            (99.96, 3, "100"),
            (9.996e-4, 3, "0.00100"),
            (1234.5, 2, "1200"),
            (0.0, 4, "0"),
        ] {
            assert_eq!(real(value, digits).plain(), text, "{value}");
        }
    }

    #[test]
    fn each_markup_has_its_minus_and_power() {
        assert_eq!(real(-3.25, 3).markdown(), "−3.25");
        assert_eq!(real(-3.25, 3).tex(), "-3.25");
        assert_eq!(real(1.2e-5, 2).markdown(), r"$1.2\times10^{-5}$");
        assert_eq!(real(1e-9, 1).tex(), "10^{-9}");
        assert_eq!(real(-2e-9, 1).tex(), r"-2\times10^{-9}");
        let big = print(&Number::Integer(1_234_567), Style::default());
        assert_eq!(big.markdown(), "1\u{202f}234\u{202f}567");
        assert_eq!(big.tex(), r"1\,234\,567");
        assert_eq!(big.plain(), "1234567");
    }

    #[test]
    fn styles() {
        let number = Value::ensemble("x", 0.9453, 0.0081, 400).number;
        let percent = Style { percent: true, ..Style::default() };
        assert_eq!(print(&number, percent).plain(), "94.5(8) %");
        assert_eq!(print(&number, percent).tex(), r"94.5(8)\,\%");
        let full = Style { digits: Some(Digits::Full), ..Style::default() };
        assert_eq!(print(&number, full).plain(), "0.9453");
        assert_eq!(
            print(&Number::Real { value: 0.1 + 0.2, digits: Digits::Decimals(1) }, full).plain(),
            "0.30000000000000004"
        );
    }

    /// A million doubles of any bits and as many integers: all digits read back the same. In some
    /// of them fewer digits are those of the decimal conversion of Rust, which rounds exactly.
    #[test]
    fn numbers_are_rounded_once_and_read_back_the_same() {
        let full = Style { digits: Some(Digits::Full), ..Style::default() };
        let mut bits = 1_u64;
        for round in 0..1_000_000_usize {
            bits = bits
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let integer = Number::from(bits ^ (bits >> 33));
            assert_eq!(Number::Integer(print(&integer, full).plain().parse().unwrap()), integer);
            let x = f64::from_bits(bits ^ (bits >> 31));
            if !x.is_finite() {
                continue;
            }
            let digits = 1 + round / 16 % 17;
            let chosen = Number::Real { value: x, digits: Digits::Full };
            assert_eq!(print(&chosen, full).plain().parse::<f64>(), Ok(x));
            if round % 16 > 0 {
                continue;
            }
            let once: f64 = format!("{:.*e}", digits - 1, x).parse().unwrap();
            assert_eq!(real(x, digits).plain().parse::<f64>(), Ok(once), "{x:e}, {digits}");
            let (x, places) = ((bits >> 20) as f64 / 1e9, round / 16 % 9);
            let digits = Digits::Decimals(places);
            let shown = print(&Number::Real { value: x, digits }, Style::default()).plain();
            assert_eq!(shown, format!("{x:.places$}"));
        }
    }

    #[test]
    fn no_digit_is_lost_or_rounded_twice() {
        let full = |value| Number::Real { value, digits: Digits::Full };
        let plain = |number: Number| print(&number, Style::default()).plain();
        assert_eq!(plain(full(9.112_847_118_503_352e-5)), "9.112847118503352e-5");
        assert_eq!(plain(u64::MAX.into()), "18446744073709551615");
        assert_eq!(plain(9_007_199_254_740_993_i64.into()), "9007199254740993");
        // 0.145 is a little less, and its product with 100 is not 14.5 in doubles either.
        let style = |percent, digits| Style { percent, digits: Some(Digits::Significant(digits)) };
        let shown = |number, style| print(&number, style).plain();
        assert_eq!(shown(full(0.145), style(true, 2)), "14 %");
        assert_eq!(
            shown(Number::Integer(-9_999_999_999_999_999_995), style(false, 18)),
            "-1.00000000000000000e19"
        );
        assert_eq!(shown(Number::Integer(12), style(true, 9)), "1200 %");
        for (value, places, text) in
            [(5.0, -1, "0"), (5.1, -1, "10"), (15.0, -1, "20"), (96.0, -1, "100"), (1e23, -22, "1")]
        {
            assert!(rounded(value, places).written().starts_with(text), "{value}");
        }
    }
}

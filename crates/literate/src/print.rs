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

/// Chooses the digits of a number.
pub fn print(number: &Number, style: Style) -> Shown {
    let (value, declared) = match *number {
        Number::Text(ref words) => return Shown::Words(words.clone()),
        Number::Integer(n) if style == Style::default() => {
            return Shown::Number(Numeral { negative: n < 0, ..bare(1.0, grouped(n)) });
        }
        Number::Integer(n) => (n as f64, Digits::Decimals(0)),
        Number::Real { value, digits } => (value, digits),
    };
    let percent = if style.percent { 2 } else { 0 };
    let x = times_ten(value, percent);
    let numeral = match style.digits.unwrap_or(declared) {
        Digits::Error(error) => with_error(x, times_ten(error, percent)),
        Digits::Significant(n) => significant(x, n.min(MAX_DIGITS)),
        Digits::Decimals(n) => bare(x, rounded(x, (n.min(MAX_DIGITS) as i32 - percent).max(0))),
        Digits::Full => shortest(x),
    };
    Shown::Number(Numeral { percent: style.percent, ..numeral })
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

/// A number with these digits and nothing else; one that rounds to zero has no sign.
fn bare(x: f64, digits: String) -> Numeral {
    let negative = x < 0.0 && digits.contains(|c: char| ('1'..='9').contains(&c));
    Numeral { negative, digits, ..Numeral::default() }
}

fn shortest(x: f64) -> Numeral {
    let exponent = leading(x, 17);
    if x != 0.0 && shows_power(exponent) {
        let (mantissa, exponent) = scientific(&format!("{:e}", x.abs()));
        return Numeral { exponent: Some(exponent), ..bare(x, mantissa) };
    }
    bare(x, format!("{}", x.abs()))
}

fn significant(x: f64, digits: usize) -> Numeral {
    if x == 0.0 {
        return bare(x, "0".into());
    }
    to_place(x, digits.max(1) as i32 - 1 - leading(x, digits))
}

/// The number with its error in brackets: one digit of it, or two after a leading 1.
fn with_error(x: f64, error: f64) -> Numeral {
    if error <= 0.0 {
        return shortest(x);
    }
    let starts_with_1 = |text: String| text.starts_with('1');
    let two = starts_with_1(format!("{error:.1e}")) || starts_with_1(format!("{error:.0e}"));
    let places = i32::from(two) - leading(error, 1);
    let decimal = to_place(x, places);
    let exponent = decimal.exponent.unwrap_or(0);
    let error = rounded(times_ten(error, -exponent), places + exponent);
    // In units of the last digit, unless it reaches over the point: 0.1165(4), but 16.0(1.2).
    let error = match error.strip_prefix("0.") {
        Some(after) => after.trim_start_matches('0').to_string(),
        None => error,
    };
    Numeral { error: Some(error), ..decimal }
}

/// Rounded to a decimal place (negative: tens, hundreds), with a power of ten where one is due.
fn to_place(x: f64, places: i32) -> Numeral {
    // The leading digit after rounding; that of the last place for what rounds to nothing.
    let digits = if x == 0.0 { 0 } else { leading(x, 17) + places + 1 };
    let exponent = if digits < 1 { -places } else { leading(x, digits as usize) };
    if shows_power(exponent) {
        let mantissa = rounded(times_ten(x, -exponent), places + exponent);
        return Numeral { exponent: Some(exponent), ..bare(x, mantissa) };
    }
    bare(x, rounded(x, places))
}

/// |x| rounded to `places` decimals; a negative number of places rounds to tens, hundreds, …
fn rounded(x: f64, places: i32) -> String {
    match usize::try_from(places) {
        Ok(places) => format!("{:.*}", places, x.abs()),
        Err(_) => {
            let units = format!("{:.0}", times_ten(x.abs(), places));
            if units == "0" { units } else { units + &"0".repeat(places.unsigned_abs() as usize) }
        }
    }
}

/// Exponent of the leading digit of x after rounding to so many significant digits; 0 for 0.
fn leading(x: f64, digits: usize) -> i32 {
    scientific(&format!("{:.*e}", digits.max(1) - 1, x)).1
}

/// x · 10^power, by moving the point of its shortest decimal: one rounding, of the exact product.
fn times_ten(x: f64, power: i32) -> f64 {
    if power == 0 {
        return x;
    }
    let (mantissa, exponent) = scientific(&format!("{x:e}"));
    format!("{mantissa}e{}", exponent + power).parse().unwrap_or(x)
}

/// "1.5e-4" → ("1.5", −4).
fn scientific(text: &str) -> (String, i32) {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    (mantissa.to_string(), exponent.parse().unwrap_or(0))
}

/// Digits in groups of three from five digits on, with a narrow space that does not break.
fn grouped(n: i64) -> String {
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

    /// Every printed number reads back to within half a unit of its last digit.
    #[test]
    fn no_digit_is_invented() {
        let mut x = 1.234_567_890_123e-7_f64;
        while x < 1e9 {
            for digits in 1..8 {
                let back: f64 = real(x, digits).plain().parse().unwrap();
                let unit = format!("1e{}", leading(x, digits) - digits as i32 + 1);
                let half = 0.5 * unit.parse::<f64>().unwrap();
                assert!((back - x).abs() <= half * (1.0 + 1e-9), "{x} printed as {back}");
            }
            x *= 1.37;
        }
    }
}

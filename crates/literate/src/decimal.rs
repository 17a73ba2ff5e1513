//! Rounds numbers to decimal digits, once, from their exact values.

/// More digits than a double has, which ends at its 1074th decimal; no more can be asked for.
const MAX_DIGITS: usize = 1100;

/// A decimal number without its sign: an integer, divided by a power of ten.
#[derive(Debug, PartialEq)]
pub(crate) struct Decimal {
    /// The digits of the integer, without zeros at the beginning; empty for zero.
    pub digits: String,
    /// The power of ten: the number of decimals, if it is not negative.
    pub places: i32,
}

impl Decimal {
    /// Reads a number such as 1.5e-4 with all its digits; zero keeps its decimals.
    pub fn read(written: &str) -> Decimal {
        let written = written.trim_start_matches('-').to_lowercase();
        let (mantissa, exponent) = written.split_once('e').unwrap_or((&written, "0"));
        let decimals = mantissa.split_once('.').map_or(0, |(_, after)| after.len()) as i32;
        let digits: String = mantissa.replace('.', "").trim_start_matches('0').into();
        let exponent = exponent.parse().map_or(-1_000_000, i16::into);
        let exponent: i32 = if digits.is_empty() { 0 } else { exponent };
        Decimal { digits, places: decimals - exponent }
    }

    /// Returns the decimal number that a double stands for: the shortest one if it has few digits,
    /// as in data files, and else the exact value.
    pub fn meant(x: f64) -> Decimal {
        let shortest = Decimal::shortest(x);
        if shortest.digits.len() <= 15 { shortest } else { Decimal::exact(x) }
    }

    pub fn exact(x: f64) -> Decimal {
        // No double has more decimals than bits behind its point.
        let decimals = 1075 - (x.to_bits() >> 52 & 0x7ff).clamp(1, 1075) as usize;
        Decimal::read(&format!("{:.decimals$}", x.abs()))
    }

    /// Returns the shortest decimal that reads back to the same double as |x|.
    pub fn shortest(x: f64) -> Decimal {
        Decimal::read(&format!("{:e}", x.abs()))
    }

    /// Returns the same number without zeros at the end of its digits; zero has no decimals.
    pub fn trimmed(mut self) -> Decimal {
        let length = self.digits.trim_end_matches('0').len();
        self.places -= (self.digits.len() - length) as i32;
        self.digits.truncate(length);
        if length == 0 { Decimal { places: 0, ..self } } else { self }
    }

    pub fn integer(n: i128) -> Decimal {
        Decimal::read(&n.unsigned_abs().to_string())
    }

    /// Returns the exponent of the leading digit, or that of the last decimal of zero.
    pub fn exponent(&self) -> i32 {
        self.digits.len().saturating_sub(1) as i32 - self.places
    }

    pub fn times_ten(self, power: i32) -> Decimal {
        Decimal { places: self.places - power, ..self }
    }

    /// Rounds to a decimal place, a half to an even digit; −1 rounds to tens, −2 to hundreds.
    pub fn rounded(&self, places: i32) -> Decimal {
        let more = (places - self.places).clamp(0, MAX_DIGITS as i32) as usize;
        let less = (self.places - places).max(0) as usize;
        let digits = match self.digits.len().checked_sub(less) {
            _ if self.digits.is_empty() => String::new(),
            Some(whole) if less > 0 => {
                let (whole, rest) = self.digits.split_at(whole);
                let half = rest.trim_end_matches('0').cmp("5");
                let is_odd = whole.ends_with(['1', '3', '5', '7', '9']);
                if half.is_gt() || half.is_eq() && is_odd { next(whole) } else { whole.into() }
            }
            Some(_) => self.digits.clone() + &"0".repeat(more),
            None => String::new(),
        };
        Decimal { digits, places }
    }

    /// Rounds to this many significant digits; zero stays as it is.
    pub fn significant(&self, digits: usize) -> Decimal {
        if self.digits.is_empty() {
            return self.rounded(0);
        }
        let digits = digits.clamp(1, MAX_DIGITS) as i32;
        let rounded = self.rounded(digits - 1 - self.exponent());
        // 9.96 rounds to 10.0, which has a digit more.
        let is_longer = rounded.digits.len() as i32 > digits;
        if is_longer { rounded.rounded(rounded.places - 1) } else { rounded }
    }

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

/// Adds one to the last of some digits.
fn next(digits: &str) -> String {
    let before = digits.trim_end_matches('9');
    let (head, last) = before.split_at(before.len().saturating_sub(1));
    let last = last.parse().unwrap_or(0) + 1;
    format!("{head}{last}{}", "0".repeat(digits.len() - before.len()))
}

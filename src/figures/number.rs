//! The number of a figure: one of the paper's, or one of our own.

use std::fmt;
use std::str::FromStr;

/// A figure of the paper (3), or of this edition (s1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Number {
    /// A figure of the paper.
    Paper(u8),
    /// A figure of this edition.
    Own(u8),
}

impl Number {
    /// How many figures the paper has.
    pub const PAPER: u8 = super::PAPER.len() as u8;

    /// How many figures are our own.
    pub const OWN: u8 = super::OWN.len() as u8;

    /// `fig03` or `s01`: the file name of the picture without its ending.
    pub fn id(self) -> String {
        match self {
            Number::Paper(n) => format!("fig{n:02}"),
            Number::Own(n) => format!("s{n:02}"),
        }
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Number::Paper(n) => write!(f, "{n}"),
            Number::Own(n) => write!(f, "s{n}"),
        }
    }
}

impl FromStr for Number {
    type Err = String;

    /// Reads `3` or `s1`, as the command line has them.
    fn from_str(text: &str) -> Result<Self, String> {
        let (own, digits) = match text.strip_prefix(['s', 'S']) {
            Some(digits) => (true, digits),
            None => (false, text),
        };
        let most = if own { Number::OWN } else { Number::PAPER };
        match digits.parse::<u8>() {
            Ok(n) if (1..=most).contains(&n) && own => Ok(Number::Own(n)),
            Ok(n) if (1..=most).contains(&n) => Ok(Number::Paper(n)),
            _ => Err(format!(
                "there is no figure \"{text}\"; give a number from 1 to {}, or s1 to s{}",
                Number::PAPER,
                Number::OWN
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back() {
        for number in super::super::all() {
            assert_eq!(number.to_string().parse(), Ok(number));
        }
        assert_eq!("s1".parse::<Number>().unwrap().id(), "s01");
        for bad in ["", "0", "16", "s0", "s", "s99", "x1", "1.5"] {
            assert!(bad.parse::<Number>().is_err(), "{bad}");
        }
    }
}

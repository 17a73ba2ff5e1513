//! Sentences of a claim: words, and numbers that the report prints with the digits they deserve.

use crate::value::{Digits, Number};
use serde::Serialize;

/// A short text with numbers in it; its words are numbers of the kind [`Number::Text`].
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Text(pub Vec<Number>);

impl Text {
    /// A text of words alone.
    pub fn words(words: impl Into<String>) -> Text {
        Text::default().say(words)
    }

    /// Goes on with words.
    pub fn say(mut self, words: impl Into<String>) -> Text {
        self.0.push(Number::Text(words.into()));
        self
    }

    fn number(mut self, value: f64, digits: Digits) -> Text {
        self.0.push(Number::Real { value, digits });
        self
    }

    /// Goes on with a number and its error.
    pub fn with_error(self, value: f64, error: f64) -> Text {
        self.number(value, Digits::Error(error))
    }

    /// Goes on with a number of so many decimals.
    pub fn decimals(self, value: f64, decimals: usize) -> Text {
        self.number(value, Digits::Decimals(decimals))
    }

    /// Goes on with a number of so many significant digits.
    pub fn significant(self, value: f64, digits: usize) -> Text {
        self.number(value, Digits::Significant(digits))
    }

    /// Goes on with a number that was chosen, with all its digits.
    pub fn chosen(self, value: f64) -> Text {
        self.number(value, Digits::of(value))
    }

    /// Goes on with an integer.
    pub fn integer(mut self, value: usize) -> Text {
        self.0.push(Number::Integer(value as i64));
        self
    }

    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chosen_number_keeps_its_digits_and_gets_no_others() {
        for (value, digits) in [(0.08, 1), (0.1175, 4), (4000.0, 1), (1e-9, 1), (0.0, 1)] {
            assert_eq!(Digits::of(value), Digits::Significant(digits), "{value}");
        }
    }
}

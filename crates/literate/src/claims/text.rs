//! Keeps the sentences of a check as words and numbers, which a report prints with the digits they
//! deserve.

use crate::print::{Style, print};
use crate::value::{Digits, Number};
use serde::{Deserialize, Serialize};
use std::fmt;

/// A short text with numbers in it; its words are [`Number::Text`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", from = "String")]
pub struct Text(pub Vec<Number>);

impl Text {
    /// Makes a sentence in which each `{}` stands for the next of the numbers.
    pub fn of(sentence: &str, numbers: impl IntoIterator<Item = Number>) -> Text {
        let mut words = sentence.split("{}");
        let mut text = Text::from(words.next().unwrap_or_default());
        for (number, words) in numbers.into_iter().zip(words) {
            text.0.push(number);
            text = text.then(words);
        }
        text
    }

    /// Appends another text.
    pub fn then(mut self, more: impl Into<Text>) -> Text {
        self.0.extend(more.into().0);
        self
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// Makes a number with its standard error.
pub fn with_error(value: f64, error: f64) -> Number {
    Number::Real { value, digits: Digits::Error(error) }
}

/// Makes a number of so many decimals.
pub fn decimals(value: f64, decimals: usize) -> Number {
    Number::Real { value, digits: Digits::Decimals(decimals) }
}

/// Makes a number of so many significant digits.
pub fn significant(value: f64, digits: usize) -> Number {
    Number::Real { value, digits: Digits::Significant(digits) }
}

/// Makes a number that was chosen, with all its digits.
pub fn chosen(value: f64) -> Number {
    Number::Real { value, digits: Digits::Full }
}

pub fn integer(value: usize) -> Number {
    Number::Integer(value as i128)
}

impl From<Number> for Text {
    fn from(number: Number) -> Text {
        Text(vec![number])
    }
}

impl From<&str> for Text {
    fn from(words: &str) -> Text {
        words.to_string().into()
    }
}

impl From<String> for Text {
    fn from(words: String) -> Text {
        if words.is_empty() { Text::default() } else { Number::Text(words).into() }
    }
}

impl From<Text> for String {
    fn from(text: Text) -> String {
        text.to_string()
    }
}

/// Writes it as terminals and data have it.
impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for piece in &self.0 {
            f.write_str(&print(piece, Style::default()).plain())?;
        }
        Ok(())
    }
}

//! Keeps the sentences of a check as words and numbers, so that a report chooses the digits.

use crate::print::{Style, print};
use crate::value::Number;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Makes a [`Text`] of a sentence with `{}` for each number, and `{:3}` for three digits of it.
macro_rules! text {
    ($sentence:expr $(, $number:expr)* $(,)?) => {
        $crate::claims::Text::from_sentence($sentence, [$($crate::value::Number::from($number)),*])
    };
}

pub(crate) use text;

/// A short text with numbers in it; its words are [`Number::Text`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", from = "String")]
pub struct Text(pub(crate) Vec<Number>);

impl Text {
    /// Fills the marks of a sentence, `{share}`, or `{share:2}` for two digits, with the numbers
    /// that `number_of` returns for their names; the error is a mark without a number.
    pub(super) fn fill(
        sentence: &str,
        mut number_of: impl FnMut(&str) -> Option<Number>,
    ) -> Result<Text, &str> {
        let mut pieces = sentence.split('{');
        let mut text = Text::from(pieces.next().unwrap_or_default());
        for piece in pieces {
            let (mark, words) = piece.split_once('}').unwrap_or((piece, ""));
            let (name, digits) = mark.split_once(':').unwrap_or((mark, ""));
            let mut number = number_of(name).ok_or(mark)?;
            if !digits.is_empty() {
                number = number.significant(digits.parse().map_err(|_| mark)?);
            }
            text = text.then(number).then(words);
        }
        Ok(text)
    }

    pub(crate) fn from_sentence(sentence: &str, numbers: impl IntoIterator<Item = Number>) -> Text {
        let mut numbers = numbers.into_iter();
        Text::fill(sentence, |_| numbers.next()).unwrap_or_default()
    }

    /// Returns the text with more at its end.
    pub fn then(mut self, more: impl Into<Text>) -> Text {
        self.0.extend(more.into().0);
        self
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
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

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for piece in &self.0 {
            f.write_str(&print(piece, Style::default()).to_plain_text())?;
        }
        Ok(())
    }
}

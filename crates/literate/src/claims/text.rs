//! Keeps the sentences of a check as words and numbers, so that a report chooses the digits.

use crate::print::{Style, print};
use crate::value::Number;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Makes a [`Text`] of a sentence with `{}` for each number, and `{:3}` for three digits of it.
#[macro_export]
macro_rules! text {
    ($sentence:expr $(, $number:expr)* $(,)?) => {
        $crate::claims::Text::from_sentence($sentence, [$($crate::value::Number::from($number)),*])
    };
}

/// A short text with numbers in it; its words are [`Number::Text`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", from = "String")]
pub struct Text(pub Vec<Number>);

impl Text {
    pub fn from_sentence(sentence: &str, numbers: impl IntoIterator<Item = Number>) -> Text {
        let mut pieces = sentence.split('{');
        let mut text = Text::from(pieces.next().unwrap_or_default());
        for (number, piece) in numbers.into_iter().zip(pieces) {
            let (digits, words) = piece.split_once('}').unwrap_or(("", piece));
            let digits = digits.strip_prefix(':').and_then(|digits| digits.parse().ok());
            text.0.push(digits.map_or(number.clone(), |digits| number.significant(digits)));
            text = text.then(words);
        }
        text
    }

    pub fn then(mut self, more: impl Into<Text>) -> Text {
        self.0.extend(more.into().0);
        self
    }

    pub fn is_empty(&self) -> bool {
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

//! Holds a finished figure: the picture, its description and its data.

use super::drawing::Drawing;
use super::record::DataFile;

/// A figure: the picture, what it shows in words, and its data.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// The id in the list of the paper, with which the names of its files begin.
    pub id: String,
    pub title: String,
    /// What readers see, for those who do not see it.
    pub description: Description,
    pub drawing: Drawing,
    pub data: Vec<DataFile>,
    /// Path of the item that draws it.
    pub source: String,
    /// Names of the experiments whose results it shows.
    pub experiments: Vec<&'static str>,
}

impl Figure {
    /// Returns the picture as an SVG file.
    pub fn svg(&self) -> String {
        self.drawing.svg(&self.id, &self.title, &self.description.text)
    }
}

/// What readers see in a figure: with its numbers, and as its author typed it, so that a typed
/// numeral is found. [`describe!`](crate::describe) makes both.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Description {
    pub text: String,
    pub typed: &'static str,
}

/// Describes a figure; the arguments are those of `format!`.
#[macro_export]
macro_rules! describe {
    ($words:literal $(, $value:expr)* $(,)?) => {
        $crate::figures::Description { text: format!($words $(, $value)*), typed: $words }
    };
}

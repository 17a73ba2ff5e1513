//! Defines a value: a number of the report with its unit, kind and origin.
//!
//! A number in prose is never typed. An experiment's table ([`crate::table`]) or a section computes
//! it, it becomes a [`Value`] with an id, and a template names that id: `«v.version»`. The
//! printed digits follow from the value itself, so that prose, tables and `values.json` agree.

use crate::sample::Sample;
use impact_numerics::statistics::Estimate;
use serde::{Deserialize, Deserializer, Serialize};

/// A number as it is shown, or words.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Number {
    /// No number: nothing was found. Tables show a dash; prose must say what stands there.
    #[default]
    None,
    /// An exact integer of at most 64 bits, with a sign or without.
    Integer(i128),
    /// A real number.
    Real {
        /// The number.
        value: f64,
        /// What decides its printed digits.
        digits: Digits,
    },
    /// Words, for the few values that are not numbers (a version, a profile, a list).
    Text(String),
}

impl Number {
    /// Returns whether neither number nor error is infinite or NaN, and no error is negative.
    pub(crate) fn is_finite(&self) -> bool {
        let Number::Real { value, digits } = *self else { return true };
        let error = if let Digits::Error(error) = digits { error } else { 0.0 };
        value.is_finite() && error.is_finite() && error >= 0.0
    }

    /// Returns the number with this many significant digits; words as they are.
    pub(crate) fn significant(self, digits: usize) -> Number {
        let digits = Digits::Significant(digits);
        match self {
            Number::Integer(n) => Number::Real { value: n as f64, digits },
            Number::Real { value, .. } => Number::Real { value, digits },
            other => other,
        }
    }
}

/// A number that was chosen, with all its digits: an integer where it is one.
impl From<f64> for Number {
    fn from(value: f64) -> Number {
        if value.fract() == 0.0 && value.abs() < 1e15 {
            Number::Integer(value as i128)
        } else {
            Number::Real { value, digits: Digits::Full }
        }
    }
}

macro_rules! from_integers {
    ($($integer:ty)*) => {
        $(impl From<$integer> for Number {
            fn from(number: $integer) -> Number {
                Number::Integer(number as i128)
            }
        })*
    };
}

from_integers!(i32 i64 u32 u64 usize);

impl From<String> for Number {
    fn from(words: String) -> Number {
        Number::Text(words)
    }
}

impl From<Estimate> for Number {
    fn from(found: Estimate) -> Number {
        Number::Real { value: found.value, digits: Digits::Error(found.error) }
    }
}

impl<T: Into<Number>> From<Option<T>> for Number {
    fn from(number: Option<T>) -> Number {
        number.map_or(Number::None, T::into)
    }
}

/// What decides how many digits of a real number are printed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Digits {
    /// A standard error: the number is printed as 0.1165(4).
    Error(f64),
    /// A number of significant digits (deterministic reals).
    Significant(usize),
    /// A number of decimals (numbers that somebody printed so).
    Decimals(usize),
    /// All: the shortest decimal that reads back to the same double.
    Full,
    /// Those of a text, which may be more than a double holds: 0.50.
    Text(#[serde(deserialize_with = "read_leaked")] Leaked),
}

/// A text that is kept as long as the program runs.
pub type Leaked = &'static str;

fn read_leaked<'de, D: Deserializer<'de>>(reader: D) -> Result<Leaked, D::Error> {
    Ok(String::deserialize(reader)?.leak())
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Provenance {
    /// An integer or a text that follows without rounding, or a parameter that was chosen.
    #[default]
    Exact,
    /// Computed without chance: a closed form, a root, a sum.
    Deterministic,
    Ensemble {
        realisations: u64,
        standard_error: f64,
        #[serde(default, skip_serializing_if = "Sample::is_unknown")]
        sample: Sample,
    },
    /// Printed in the paper, at this section, figure or equation.
    Printed { place: String },
    /// Measured once on a machine (times), and an input since then.
    Measured,
}

/// A number with its unit, kind and origin.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Value {
    /// The name: `version` is `«v.version»`, and `printed.threshold` is `«printed.threshold»`.
    pub id: String,
    pub(crate) number: Number,
    /// Its unit as Markdown, as `$1/\omega$`; empty for a pure number.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(crate) unit: String,
    pub(crate) kind: Provenance,
    /// Path of the item that computed it, as the compiler writes it: `my_paper::jump::p_jump`.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub source: String,
    /// The experiment whose results it was read from; empty for parameters.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(crate) experiment: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(crate) note: String,
}

impl Value {
    pub(crate) fn new(id: impl Into<String>, number: Number, kind: Provenance) -> Self {
        Value { id: id.into(), number, kind, ..Value::default() }
    }

    /// Makes an exact number, printed with all its digits.
    pub fn integer(id: impl Into<String>, n: impl Into<Number>) -> Self {
        Value::new(id, n.into(), Provenance::Exact)
    }

    /// Makes a real number that was computed without chance, printed with `significant` digits.
    pub fn real(id: impl Into<String>, value: f64, significant: usize) -> Self {
        let digits = Digits::Significant(significant);
        Value::new(id, Number::Real { value, digits }, Provenance::Deterministic)
    }

    /// Makes a value that is words.
    pub fn words(id: impl Into<String>, words: impl Into<String>) -> Self {
        Value::new(id, Number::Text(words.into()), Provenance::Exact)
    }

    /// Makes a number as somebody printed it, with its decimals, at a place of a paper.
    pub(crate) fn printed(id: String, value: f64, decimals: usize, place: &str) -> Self {
        let number = match decimals {
            0 if value.fract() == 0.0 => Number::Integer(value as i128),
            _ => Number::Real { value, digits: Digits::Decimals(decimals) },
        };
        Value::new(id, number, Provenance::Printed { place: place.into() })
    }

    /// Sets the item that computed it.
    pub fn source(mut self, item: Origin) -> Self {
        self.source = item.0;
        self
    }

    /// Returns its number as a double, or `None` if it has no number.
    pub(crate) fn as_f64(&self) -> Option<f64> {
        match self.number {
            Number::Integer(n) => Some(n as f64),
            Number::Real { value, .. } => Some(value),
            Number::None | Number::Text(_) => None,
        }
    }

    /// Returns its number with the standard error, or `None` if it has no number.
    pub(crate) fn estimate(&self) -> Option<Estimate> {
        let (value, error) = (self.as_f64()?, self.standard_error());
        Some(Estimate { value, error, interval: [value - error, value + error] })
    }

    /// Returns its standard error, which is zero if it has no error.
    pub(crate) fn standard_error(&self) -> f64 {
        match self.kind {
            Provenance::Ensemble { standard_error, .. } => standard_error,
            _ => 0.0,
        }
    }
}

/// The path of the item that computed a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin(pub(crate) String);

/// Returns the origin of what a function computes. The compiler knows the function, so its path is
/// never typed: it follows a function that moves, and one that is gone is an error.
pub fn origin<F>(_: F) -> Origin {
    origin_of::<F>()
}

/// Returns the [`origin`] of what a function computes that is given by its type.
pub(crate) fn origin_of<F>() -> Origin {
    // A closure counts as the function in which it stands.
    let path = std::any::type_name::<F>().replace("::{{closure}}", "");
    let (Some(from), Some(to)) = (path.find('<'), path.rfind('>')) else { return Origin(path) };
    // A method that stands in another module than its type is `module::<impl other::Type>::method`;
    // of one of a generic type the parameters go.
    let other = path[from..to].strip_prefix("<impl ").and_then(|path| path.rsplit("::").next());
    Origin(format!("{}{}{}", &path[..from], other.unwrap_or_default(), &path[to + 1..]))
}

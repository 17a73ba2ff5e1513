//! Holds the ledger: every claim, figure and numbered equation of the paper, and its status.

use crate::claims::Check;
use crate::figures::Figure;
use serde::{Deserialize, Serialize};

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    pub(crate) claims: Vec<Check>,
    pub(crate) figures: Vec<FigureEntry>,
    pub(crate) equations: Vec<EquationEntry>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FigureEntry {
    pub(crate) id: String,
    /// What the prose refers to it by, as `fig:3`.
    pub(crate) label: String,
    pub(crate) number: String,
    pub(crate) title: String,
    pub(crate) description: String,
    pub(crate) picture: String,
    pub(crate) data: Vec<String>,
    pub(crate) source: String,
    pub(crate) experiments: Vec<String>,
}

/// A numbered equation, and where the source has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EquationEntry {
    /// Its number.
    pub number: u32,
    /// The number of its section.
    pub section: u32,
    /// All digits of its formula, which the prose must have too.
    #[serde(skip)]
    pub digits: Option<&'static str>,
    /// What it gives, in words.
    pub what: String,
    /// Path of the item that computes it.
    pub home: String,
    /// The equation that the home leads to, where coding this one would be pointless.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step_towards: Option<String>,
}

pub fn figures(figures: &[Figure]) -> Vec<FigureEntry> {
    let figure = |figure: &Figure| FigureEntry {
        id: figure.id.clone(),
        title: figure.title.clone(),
        description: figure.description.text.clone(),
        picture: format!("figures/{}", figure.names()[0]),
        data: figure.data.iter().map(|data| format!("data/{}", data.name)).collect(),
        source: figure.source.clone(),
        experiments: figure.experiments.iter().copied().map(String::from).collect(),
        ..FigureEntry::default()
    };
    figures.iter().map(figure).collect()
}

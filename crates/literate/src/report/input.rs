//! Holds all that a report is made of.

use super::edition::Edition;
use super::lint::Declared;
use super::values::ValueRegistry;
use crate::claims::Check;
use crate::experiments::AnyExperiment;
use crate::figures::Figure;
use crate::project::Project;
use crate::prose::Templates;
use std::collections::BTreeMap;

#[derive(Clone, Copy)]
pub struct Input<'a> {
    pub templates: &'a Templates,
    pub values: &'a ValueRegistry,
    /// Phrases that may have numbers.
    pub declared: &'a Declared,
    /// Rows of tables that are not values or claims, by the name that templates use.
    pub rows: &'a BTreeMap<&'static str, serde_json::Value>,
    /// Statements and relations.
    pub claims: &'a [Check],
    pub figures: &'a [Figure],
    /// What a page loads when a reader asks it to compute: lab.js.
    pub lab: Option<&'a str>,
    /// The path from the report's folder to the project, `../`, or `None` if it lies elsewhere.
    pub top: Option<&'a str>,
    pub edition: &'a Edition,
    pub project: &'a Project,
    pub experiments: &'a [&'static dyn AnyExperiment],
    /// Tells what is wrong and stops no report.
    pub warn: &'a (dyn Fn(&str) + Sync),
}

impl<'a> Input<'a> {
    pub(super) fn figure(&self, name: &str) -> Option<&'a Figure> {
        self.figures.iter().find(|figure| figure.id == name)
    }
}

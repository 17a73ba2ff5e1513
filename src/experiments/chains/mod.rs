//! Chains that differ from the paper's in length, start or ends.
//!
//! One kind of run serves all: a chain goes through several windows, and the different gaps with an
//! impact in each are counted, those of a long chain piece by piece.

pub(crate) mod joining;
mod run;
pub mod tables;

use super::ensembles::{Begun, Ensembles, joined_by};
use super::{Progress, weights};
use crate::params::{Chain, ChainCurve, ChainKind, ChainsParams};
use impact_numerics::statistics::Estimate;
use literate::experiments::cutting::{Cutting, Row};
use serde::{Deserialize, Serialize};

/// All curves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chains {
    /// What was run.
    pub parameters: ChainsParams,
    /// In the order of the parameters.
    pub curves: Vec<Curve>,
}

/// One kind of chain at several σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// As in the parameters.
    pub name: String,
    /// One for each σ, rising.
    pub rows: Vec<Ensemble>,
    /// For each transient, where the mean share of the gaps with an impact is a half ...
    pub half_heights: Vec<Option<Estimate>>,
    /// ... and how far the σ lie apart at which it is a tenth and nine tenths.
    pub widths: Vec<Option<Estimate>>,
}

/// Chains of one kind at one σ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ensemble {
    /// Standard deviation σ of the amplitudes.
    pub sigma: f64,
    /// What each realisation showed.
    pub runs: Vec<Run>,
    /// For each transient the mean share of the gaps with an impact in the window.
    pub shares: Vec<Option<Estimate>>,
    /// Realisations that the engine ended early.
    pub failed: u64,
}

/// What one realisation showed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Different gaps with an impact in the window after each transient, of each piece of the chain.
    pub counts: Vec<Vec<u32>>,
}

/// Some realisations of one row; none where the engine gave up.
pub type Part = Vec<Option<Run>>;

/// The experiment in units of work.
pub const CUTTING: Cutting<ChainsParams, Part, Chains> = joined_by(joining::join);

impl Chains {
    /// The curve of a name, and its parameters.
    pub fn curve(&self, name: &str) -> Option<(&ChainCurve, &Curve)> {
        self.all().find(|(_, curve)| curve.name == name)
    }

    /// All curves with their parameters.
    pub fn all(&self) -> impl Iterator<Item = (&ChainCurve, &Curve)> {
        self.parameters.curves.iter().zip(&self.curves)
    }

    /// The curves that differ from the paper's chain in this.
    pub fn of(&self, kind: ChainKind) -> impl Iterator<Item = (&ChainCurve, &Curve)> {
        self.all().filter(move |(own, _)| own.kind == kind)
    }
}

/// The chain of a curve.
pub fn chain(parameters: &ChainsParams, curve: &ChainCurve) -> Chain {
    Chain {
        masses: curve.masses,
        start: curve.start,
        boundary: curve.boundary,
        ..parameters.chain.clone()
    }
}

/// The sizes of the pieces of a chain with so many gaps: as many as are no smaller than `piece`, of about
/// equal size.
pub fn pieces(gaps: usize, piece: usize) -> Vec<usize> {
    let number = (gaps / piece.max(1)).max(1);
    let at = |i: usize| i * gaps / number;
    (0..number).map(|i| at(i + 1) - at(i)).collect()
}

/// Each curve with each of its σ.
fn cases(parameters: &ChainsParams) -> impl Iterator<Item = (&ChainCurve, f64)> {
    parameters.curves.iter().flat_map(|curve| curve.sigmas.iter().map(move |&s| (curve, s)))
}

fn weight(parameters: &ChainsParams, curve: &ChainCurve, sigma: f64) -> u64 {
    let until = curve.transients.last().copied().unwrap_or(0.0) + parameters.window;
    weights::run(&chain(parameters, curve), sigma, until)
}

impl Ensembles for ChainsParams {
    type One = Option<Run>;

    fn rows(&self) -> Vec<Row> {
        let row = |(curve, sigma): (&ChainCurve, f64)| Row {
            covers: format!("{}, sigma = {sigma}", curve.name),
            realisations: curve.realisations,
            weight: weight(self, curve, sigma),
        };
        cases(self).map(row).collect()
    }

    fn row<'a>(&'a self, row: usize, progress: &'a Progress) -> Begun<'a, Option<Run>> {
        let Some((curve, sigma)) = cases(self).nth(row) else { return Ok(Box::new(|_| Ok(None))) };
        Ok(Box::new(move |index| run::realisation(self, curve, sigma, index, progress)))
    }

    fn fits(&self, row: usize, run: &Option<Run>) -> bool {
        let Some((curve, _)) = cases(self).nth(row) else { return false };
        let sizes = pieces(chain(self, curve).gaps(), self.piece);
        let window = |own: &Vec<u32>| {
            own.len() == sizes.len() && own.iter().zip(&sizes).all(|(&k, &size)| k as usize <= size)
        };
        run.as_ref().is_none_or(|run| {
            run.counts.len() == curve.transients.len() && run.counts.iter().all(window)
        })
    }
}

#[cfg(test)]
mod tests;

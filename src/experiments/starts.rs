//! What the choices that the paper leaves open change: the start, walls or ring, r and Ω.

use super::rise::Rise;
use super::sweep::{self, SweepRow};
use super::tally::Tally;
use super::{Error, Progress};
use crate::params::{Chain, StartVariant, StartsParams, SweepParams};
use literate::experiments::cutting::{Cutting, Row, Unit};
use literate::experiments::progress::Stage;
use serde::{Deserialize, Serialize};

/// The variants, the paper's chain first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Starts {
    /// What was run.
    pub parameters: StartsParams,
    /// One for each variant, in the order of the parameters.
    pub variants: Vec<Variant>,
}

/// One chain that differs from the paper's in one respect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Variant {
    /// `rest`, `zero`, `random`, `ring`, `restitution-0.6`, …
    pub name: String,
    /// The chain.
    pub chain: Chain,
    /// The ensemble; a row with too many rejected starts says `comparable: false`.
    pub rows: Vec<SweepRow>,
    /// Where the rise is, over the comparable rows only.
    pub rise: Rise,
}

impl Starts {
    /// The variant of a name.
    pub fn variant(&self, name: &str) -> Option<&Variant> {
        self.variants.iter().find(|variant| variant.name == name)
    }
}

/// The variants in units of work: the rows of each variant's ensemble, one variant after another.
pub const CUTTING: Cutting<StartsParams, Tally, Starts> = Cutting { rows, part, fits, join };

/// The ensemble of a variant.
fn ensemble(parameters: &StartsParams, variant: &StartVariant) -> SweepParams {
    SweepParams {
        chain: variant.chain.clone(),
        protocol: parameters.protocol,
        sigmas: variant.sigmas.clone(),
        realisations: parameters.realisations,
        level: None,
        stream: parameters.stream.clone(),
        seed: parameters.seed,
    }
}

fn rows(parameters: &StartsParams) -> Vec<Row> {
    let of = |variant: &StartVariant| {
        let name = variant.name.clone();
        let rows = sweep::rows(&ensemble(parameters, variant)).into_iter();
        rows.map(move |row| Row { covers: format!("{name}, {}", row.covers), ..row })
    };
    parameters.variants.iter().flat_map(of).collect()
}

/// The ensemble to which a unit belongs, and its unit there.
fn within(parameters: &StartsParams, unit: &Unit) -> Option<(SweepParams, Unit)> {
    let (place, unit) = unit.within(parameters.variants.iter().map(|own| own.sigmas.len()))?;
    Some((ensemble(parameters, &parameters.variants[place]), unit))
}

fn part(
    parameters: &StartsParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Tally, Error> {
    match within(parameters, unit) {
        Some((ensemble, unit)) => sweep::part(&ensemble, &unit, stage, progress),
        None => Ok(Tally::default()),
    }
}

fn fits(parameters: &StartsParams, unit: &Unit, tally: &Tally) -> bool {
    within(parameters, unit).is_some_and(|(ensemble, unit)| sweep::fits(&ensemble, &unit, tally))
}

fn join(
    parameters: &StartsParams,
    tallies: Vec<Vec<Tally>>,
    progress: &Progress,
) -> Result<Starts, Error> {
    let mut tallies = tallies.into_iter();
    let variants = parameters
        .variants
        .iter()
        .map(|variant| {
            let own = tallies.by_ref().take(variant.sigmas.len()).collect();
            let sweep = sweep::join(&ensemble(parameters, variant), own, progress)?;
            Ok(Variant {
                name: variant.name.clone(),
                chain: variant.chain.clone(),
                rows: sweep.rows,
                rise: sweep.rise,
            })
        })
        .collect::<Result<_, Error>>()?;
    Ok(Starts { parameters: parameters.clone(), variants })
}

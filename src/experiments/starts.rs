//! What the choices that the paper leaves open change: the start, walls or ring, r and Ω.

use super::rise::Rise;
use super::sweep::{self, SweepRow};
use super::{Error, Progress};
use crate::params::{Chain, StartsParams, SweepParams};
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

/// Runs all variants.
///
/// # Errors
/// [`Error::Interrupted`]; [`Error::Dynamics`] if a chain is not allowed.
pub fn run(parameters: &StartsParams, progress: &Progress) -> Result<Starts, Error> {
    let variants = parameters
        .variants
        .iter()
        .map(|variant| {
            let ensemble = SweepParams {
                chain: variant.chain.clone(),
                protocol: parameters.protocol,
                sigmas: variant.sigmas.clone(),
                realisations: parameters.realisations,
                stream: parameters.stream.clone(),
                seed: parameters.seed,
            };
            let name = format!("variant {}", variant.name);
            let sweep = sweep::run(&ensemble, &name, progress)?;
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

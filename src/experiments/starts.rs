//! What the choices that the paper leaves open change: the start, walls or ring, r and Ω.

use super::rise::Rise;
use super::sweep::SweepRow;
use crate::params::{Chain, StartsParams};
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

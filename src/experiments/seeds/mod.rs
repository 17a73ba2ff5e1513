//! Measures how impacts spread from one gap that closes by itself, and predicts the mean count by
//! nucleation and growth.
//!
//! - [`run`](mod@run): chains with exactly one such gap, and where impacts get from there.
//! - [`counting`]: their impacts by distance, and how far they spread.
//! - [`fronts`]: how long fronts stand.
//! - [`growth`]: the mean count of a chain with a random number of them.
//! - [`tables`], [`compared`]: the numbers of all this, and the map of the protocol against them.

pub mod compared;
pub mod counting;
pub mod fronts;
pub mod growth;
pub mod run;
pub mod tables;

pub use counting::ByDistance;
pub use run::{Part, Seeds, Trace, run};

use crate::experiments::prelude::*;
use crate::params::SeedsParams;

/// How impacts spread from one gap that closes by itself.
pub const SEEDS: Experiment<SeedsParams, Seeds> = Experiment {
    name: "seeds",
    code: &["src/experiments/seeds"],
    parameters: SeedsParams::new,
    how: Whole(run, |parameters| {
        (parameters.sigmas.len() * parameters.realisations) as u64 * SECOND / 600
    }),
    tables: tables::tables,
};

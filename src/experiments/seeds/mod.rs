//! Measures how impacts spread from one gap, and predicts the mean count by growth.

pub mod compared;
pub mod counting;
pub mod fronts;
pub mod growth;
pub mod run;
pub mod tables;

pub use counting::{ByDistance, Part, Trace};
pub use run::{Seeds, run};

use crate::experiments::prelude::*;

pub const SEEDS: Experiment<SeedsParams, Seeds> = Experiment {
    own: &["src/experiments/seeds"],
    how: Whole(run, |parameters| {
        (parameters.sigmas.len() * parameters.realisations) as u64 * WORK_PER_SECOND / 600
    }),
    ..Experiment::new("seeds", SeedsParams::new, run, tables::make)
};

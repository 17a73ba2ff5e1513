//! Measures whether and where the most likely number of gaps with an impact jumps (Sec. 2, Fig. 2):
//! [`impact_chain::mode_jump`] has the criterion, which was fixed before the run, as were the
//! windows and the values of σ ([`params::jump`]).

mod run;
mod tables;

pub use run::Jumps;

use crate::experiments::ensembles::{run_unit, unit_rows};
use crate::experiments::prelude::*;

pub const MODE_JUMP: Experiment<Vec<Ensemble>, Jumps, Counts> = Experiment {
    name: "jump",
    own: &["src/experiments/jump", "src/experiments/ensembles.rs"],
    reads: &[],
    parameters: params::jump,
    how: Cut("jump of the mode", Cutting { rows: unit_rows, run_unit, join: run::join }),
    tables: tables::make,
};

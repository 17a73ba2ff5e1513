//! Gathers what most experiments use, and the units and words that several tables have.

pub use crate::experiments::ensembles::{Counted, Ensembles, ensembles, find_ensemble, run_each};
pub use crate::params::{self, *};
pub use impact_chain::rise::{Curve, RisePoint};
pub use impact_chain::{Counts, Engine, Impact, Scenario, State};
pub use impact_numerics::estimates::{average, difference, jackknife, ratio, share, with_error};
pub use impact_numerics::random::{NormalPairs, Seed};
pub use impact_numerics::statistics::{
    Estimate, last_rise, mean, quantile, slope, standard_error, student_quantile, wilson,
};
pub use literate::experiments::cutting::{Cutting, WORK_PER_SECOND};
pub use literate::experiments::experiment::How::{Cut, Read, Whole};
pub use literate::experiments::{Error, Experiment, Progress, Results, Session};
pub use literate::input::one_line;
pub use literate::table::Table;
pub use literate::value::origin;
pub use rayon::prelude::*;
pub use serde::{Deserialize, Serialize};

pub const SIGMA: &str = "d omega^2";
pub const TIME: &str = "1/omega";

/// The half height of the mean of all realisations.
pub const HALF_HEIGHT: &str = "σ where the mean of all passes half of all gaps";
/// The half height of the mean of active realisations: those with an impact.
pub const OF_ACTIVE: &str =
    "σ where the mean of realisations with an impact passes half of all gaps";
/// The half height of the share of active realisations.
pub const HALF_OF_CHAINS: &str = "σ where half of the realisations have an impact";

/// Returns the half height of the mean of all realisations in the first window.
pub fn half_height_all(ensemble: &Counted) -> Option<Estimate> {
    ensemble.first_curve().rise.half_height_all
}

//! What one gap that closes by itself sets off: spreading, and the mean count that
//! nucleation and growth let expect.
//!
//! - [`run`](mod@run): chains with exactly one such gap, and where impacts get from there.
//! - [`counting`]: their impacts by distance, and how far they spread.
//! - [`fronts`]: how long fronts stand.
//! - [`growth`]: what follows for a chain with as many of them as chance gives it.
//! - [`tables`]: the numbers of all this, and [`compared`]: beside the main sweep and the map of the protocol.

pub mod compared;
pub mod counting;
pub mod fronts;
pub mod growth;
pub mod run;
pub mod tables;

pub use counting::ByDistance;
pub use run::{Part, Trace, run};

use crate::experiments::prelude::*;
use crate::params::SeedsParams;

/// Chains with one gap that closes by itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seeds {
    /// What was run.
    pub parameters: SeedsParams,
    /// For each σ its runs.
    pub rows: Vec<Part>,
}

//! What one gap that closes by itself sets off: survival, spreading, and the mean count that
//! nucleation and growth let expect.
//!
//! - [`run`](mod@run): chains with exactly one such gap, and where impacts get from there.
//! - [`counting`]: their impacts by distance, and how far they spread.
//! - [`course`]: what is active, reached and alive as time goes on.
//! - [`fronts`]: how long fronts stand, and which gaps hold them.
//! - [`growth`]: what follows for a chain with as many of them as chance gives it.

pub mod counting;
pub mod course;
pub mod fronts;
pub mod growth;
pub mod run;

pub use counting::{ByDistance, Spread};
pub use course::Moment;
pub use fronts::{Fronts, Waits};
pub use growth::Prediction;
pub use run::{CUTTING, Part, Trace};

use crate::params::SeedsParams;
use serde::{Deserialize, Serialize};

/// Chains with one gap that closes by itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seeds {
    /// What was run.
    pub parameters: SeedsParams,
    /// For each σ the chances that a gap at a wall, and any other, closes by itself in each bin.
    pub closing: Vec<[Vec<f64>; 2]>,
    /// The raw counts, for each σ.
    pub seen: Vec<ByDistance>,
    /// What they say, for each σ.
    pub rows: Vec<Spread>,
    /// The waits of fronts and the obstacles that they met, for each σ.
    pub waits: Vec<Waits>,
    /// What these say, for each σ.
    pub fronts: Vec<Fronts>,
    /// The mean counts that follow, for each transient T.
    pub predictions: Vec<Prediction>,
}

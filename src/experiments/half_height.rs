//! Names the heights of the rise that several tables give.

use impact_chain::rise::Counted;
use impact_numerics::statistics::Estimate;

/// The half height of the mean of all realisations.
pub const HALF_HEIGHT: &str = "σ where the mean of all passes half of all gaps";

/// The half height of the mean of realisations with an impact.
pub const OF_ACTIVE: &str =
    "σ where the mean of realisations with an impact passes half of all gaps";

/// The half height of the share of realisations with an impact.
pub const ANY_IMPACT: &str = "σ where half of the realisations have an impact";

/// Returns the half height of the mean of all realisations in the first window.
pub fn half_height_all(of: &Counted) -> Option<Estimate> {
    of.first().rise.half_height_all
}

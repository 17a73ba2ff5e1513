//! Gathers what most figures are drawn with.

pub(super) use super::encoding::{self, HALF_HEIGHT_LABEL, Look, SIGMA_LABEL, gaps_axis};
pub use super::simulated::*;
pub use crate::experiments::Results;
pub(super) use crate::experiments::theory::comparison::interpolate;
pub use crate::params::{VERTICES as N, *};
pub use impact_numerics::statistics::Estimate;
pub use literate::figures::prelude::Outside::{Cut, Edge};
pub use literate::figures::prelude::*;
pub use literate::table::Table;

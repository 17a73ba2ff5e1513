//! A literate, reproducible edition of M. Homer and S. J. Hogan (2007), *Impact Dynamics of
//! Large Dimensional Systems*: every experiment, calculation, figure and published number of
//! that paper, computed and checked by one binary.
//!
//! The tour follows the paper.
//!
//! - Sections 1 and 2, the chain of forced masses and its impacts: [`dynamics`].
//! - Sections 3 to 9, circuits of the impact graph, their probability, the jump: [`circuits`].
//! - What is run, with which parameters: [`experiments`] and [`params`].
//! - What is shown: [`figures`], [`claims`] and [`report`].
//! - Mathematics that knows no physics: [`numerics`].
//!
//! Imports flow one way: `numerics` → `dynamics`, `circuits` → `experiments` → `figures`,
//! `claims` → `report`; `params` may be read by all.

pub mod circuits;
pub mod claims;
pub mod dynamics;
pub mod experiments;
pub mod figures;
pub mod numerics;
pub mod params;
pub mod report;

//! Every number that the paper or this edition chose: meaning, unit, default, section.
//!
//! A default is the paper's value wherever the paper gives one. A [`Profile`] is a set of values
//! of the sample sizes, and of nothing else: it never changes the model.

mod accuracy;
mod chosen;
mod ensembles;
mod nucleation;
mod sizes;

pub use accuracy::{BENCH, BiasParams, MethodName, RaceParams, ScaleParams, Setting, TrialParams};
pub use chosen::*;
pub use ensembles::*;
pub use impact_chain::{Boundary, Chain, Protocol, Start};
pub use impact_numerics::estimates::LEVEL;
pub use literate::experiments::Profile;
pub use nucleation::{NucleationParams, SeedsParams};
pub use sizes::{Grid, Runs, TwoMassesParams};

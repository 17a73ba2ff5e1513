//! Every number that the paper or this edition chose: meaning, unit, default, section.
//!
//! A default is the paper's value wherever the paper gives one. A [`Profile`] is a set of values
//! of the sample sizes, and of nothing else: it never changes the model.

mod accuracy;
mod bias;
mod chains;
mod chosen;
mod history;
mod nucleation;
mod protocol;
mod restitution;
mod sizes;
mod spacetime;

pub use accuracy::{MethodName, RaceParams, ScaleParams, Setting, TrialParams};
pub use bias::BiasParams;
pub use chains::{ChainCurve, ChainKind, ChainsParams};
pub use chosen::*;
pub use history::HistoryParams;
pub use impact_chain::{Boundary, Chain, Start};
pub use impact_numerics::estimates::LEVEL;
pub use literate::experiments::Profile;
pub use nucleation::{NucleationParams, SeedsParams};
pub use protocol::ProtocolParams;
pub use restitution::RestitutionParams;
pub use sizes::{
    Grid, HorizonParams, Level, StartVariant, StartsParams, SweepParams, TwoMassesParams,
};
pub use spacetime::SpaceTimeParams;

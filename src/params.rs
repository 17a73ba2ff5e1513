//! Holds parameters in each profile, the paper's wherever it gives one, and chosen numbers. A
//! [`Profile`] decides the sizes of samples and nothing else: it never changes the model.

mod accuracy;
mod chosen;
mod ensemble;
mod ensembles;
mod methods;
mod runs;

pub use accuracy::{
    BENCH_SEED, BENCH_STREAM, BiasParams, Means, RaceParams, ScaleParams, trial_settings,
};
pub use chosen::*;
pub use ensemble::{Beyond, Ensemble, Heating, lowered};
pub use ensembles::*;
pub use impact_chain::{Boundary, Chain, Protocol, Start};
pub use impact_numerics::estimates::LEVEL;
pub use literate::experiments::Profile;
pub use methods::{MethodName, Setting};
pub use runs::{NucleationParams, Runs, SeedsParams, TwoMassesParams};

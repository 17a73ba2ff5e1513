//! Holds parameters in each profile, the paper's wherever it gives one, and chosen numbers. A
//! [`Profile`] decides the sizes of samples and nothing else: it never changes the model.

mod accuracy;
mod chosen;
mod ensemble;
mod ensembles;
mod methods;
mod runs;

pub use accuracy::*;
pub use chosen::*;
pub use ensemble::*;
pub use ensembles::*;
pub use impact_chain::{Boundary, Chain, Protocol, Start};
pub use impact_numerics::estimates::LEVEL;
pub use literate::experiments::Profile;
pub use methods::*;
pub use runs::*;

//! Forced masses in a row that hit one another, simulated without time steps.
//!
//! Each mass hangs on a spring of its own and is forced by sinusoids; neighbours that meet rebound with a coefficient of
//! restitution. The motion between impacts is known in closed form, so the next impact is a root, and
//! [`Engine`] finds the first one by a search that proves that it has missed none.
//!
//! - [`Chain`] is the model, [`Scenario`] one chain with its forcing and its start, drawn at random or read from JSON.
//! - [`Engine::run`] hands out each [`Impact`]; masses that stay together are in contact, with a contact force
//!   ([`Engine::contacts`]), and of gaps that close at the same instant the lowest comes first.
//! - [`rounding`] bounds what rounding does to one impact; [`Growth`] tells how fast two runs part where they are chaotic.
//! - [`Ensemble`] is many chains at several σ, counted in windows of time ([`Counts`]); [`rise`] says where the number of
//!   impacts rises.
//! - [`replay`] is a run that is repeated, and proved by a digest of its impacts.
//! - [`methods`] are other ways to simulate the same chain, to compare with.
//!
//! ```
//! use impact_chain::{Chain, Engine, Scenario};
//! use impact_numerics::random::NormalPairs;
//!
//! let chain = Chain { masses: 10, ..Chain::default() };
//! let scenario = Scenario::draw(&chain, 0.3, &mut NormalPairs::new("doc", 1, 0));
//! let mut impacts = 0;
//! Engine::new(&scenario)?.run(100.0, |impact| {
//!     impacts += 1;
//!     impact.closing_speed >= 0.0
//! })?;
//! assert!(impacts > 0);
//! # Ok::<(), impact_chain::Error>(())
//! ```
//!
//! `examples/` has a run and a sweep to begin with. Equal input gives equal bits on every machine.
//!
//! Numbers of equations are those of M. Homer and S. J. Hogan (2007), *Impact Dynamics of Large Dimensional
//! Systems*. The chain is a piecewise smooth system: smooth in flight, with a jump of velocities at impacts.
//!
//! **Eq. (1)** (step towards (2)): its general form has no code of its own.

mod chain;
mod contact;
pub mod counts;
mod elastic;
mod engine;
mod ensemble;
mod error;
mod flight;
mod force;
mod gap;
mod growth;
mod impact;
mod linear;
pub mod methods;
pub mod replay;
pub mod rise;
pub mod rounding;
mod scenario;
mod simulation;
mod simultaneous;
mod topology;

pub use chain::{Boundary, Chain, Start};
pub use counts::Counts;
pub use engine::{Counters, Engine, Impact};
pub use ensemble::{Beyond, Ensemble, Heating, Protocol, work};
pub use error::Error;
pub use growth::Growth;
pub use scenario::{Initial, Overtone, Scenario};

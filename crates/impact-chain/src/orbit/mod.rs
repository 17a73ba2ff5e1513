//! Section 3: the periodic orbit that belongs to a circuit, if there is one.
//!
//! Given the order of the impacts and a period, everything is linear but the times of the impacts: a
//! free part that is hit periodically is a sum of periodic responses ([`PeriodicKick`]), restitution
//! gives the impulses, and that each gap is shut at its times is left to solve ([`Solver`]). What was
//! found is run through the certified engine ([`replay()`]), which knows nothing of circuits, and
//! the product of the derivatives of all impacts says whether neighbours come nearer ([`Stability`]).

mod kick;
mod replay;
mod single;
mod solver;
mod stability;

pub use kick::PeriodicKick;
pub use replay::{Replay, TOLERANCE, replay};
pub use single::least_amplitude;
pub use solver::{Orbit, Solver};
pub use stability::Stability;

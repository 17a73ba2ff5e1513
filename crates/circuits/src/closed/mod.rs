//! A running chain without a simulation: how hot it is, how fast impacts spread, and how many gaps impact (ours).
//!
//! Three steps, each of which takes nothing but the chain, σ and r, and what the step before gave.
//!
//! - [`ordered`]: how often neighbours touch that keep their order, at a given mean square velocity.
//! - [`heat`]: the mean square velocity at which impacts take what the forces give, for all masses alike.
//! - [`masses`]: the same for each mass at its own force, and for a mass at the edge of the part that moves.
//! - [`front`]: how soon such a mass reaches a neighbour that was never hit.
//! - [`spread`]: the mean count, from gaps that close by themselves and fronts that wait at every gap.
//!
//! What is assumed: velocities are normal and independent of positions; neighbours know of each other only by their order
//! and by the motion that the forces keep up; an impact leaves nothing of the random motion before it. The last
//! fails where restitution is small or few masses move: see [`spread`].

mod complex;
pub mod front;
pub mod heat;
pub mod masses;
pub mod ordered;
pub mod spread;

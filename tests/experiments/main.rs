//! Tests ensembles, scenes, saved motions and the numbers of the theory.

mod ensembles;
mod judge;
#[path = "../../crates/impact-chain/tests/physics/reference/mod.rs"]
mod reference;
mod scenes;
mod theory;

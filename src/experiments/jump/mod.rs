//! Measures whether and where the most likely number of gaps with an impact jumps (Sec. 2, Fig. 2):
//! [`impact_chain::mode_jump`] has the criterion, which was fixed before the run, as were the
//! windows and the values of σ ([`params::jump`]).

mod run;
mod tables;

pub use run::{JUMP, Jumps};

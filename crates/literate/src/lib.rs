//! A paper that computes its own numbers.

pub mod claims;
pub mod digest;
pub mod experiments;
pub mod figures;
pub mod input;
pub mod report;
pub mod source;
pub mod table;
pub mod value;

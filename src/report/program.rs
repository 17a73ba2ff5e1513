//! This program, as the documents speak of it.

use super::recipe::recipe;
use crate::committed;
use literate::source::Program;

/// This program.
pub const PROGRAM: Program = Program {
    sources: include!(concat!(env!("OUT_DIR"), "/sources.rs")),
    crates: &[
        ("impact_paper::", ""),
        ("impact_chain::", "dynamics::"),
        ("impact_circuits::", "circuits::"),
        ("impact_numerics::", "numerics::"),
    ],
    quoted: &["numerics::", "dynamics::", "circuits::"],
    recipe,
    judge: |claim| format!("claims::{}", claim.split('_').next().unwrap_or_default()),
    exists: committed::exists,
};

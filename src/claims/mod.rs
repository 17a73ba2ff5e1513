//! What the paper states, row by row, beside what this edition finds: [`Claim`].
//!
//! A statement stands in `templates/published.toml` ([`Published`]) with its place; the row here
//! with the same id computes our finding from the results of the experiments and judges it. Prose,
//! table, `impact-paper check` and its exit code read the same row.
//!
//! Each verdict is a function of numbers, and can fail: a number leaves its tolerance, or a
//! difference that we explain no longer has the size that the explanation predicts.

mod basis;
mod ledger;
mod level;
mod published;
mod row;
pub(crate) mod sec10;
pub(crate) mod sec2;
mod sec2_rare;
mod sec3;
pub(crate) mod sec5;
pub(crate) mod sec6;
mod sec7;
pub(crate) mod sec8;
pub(crate) mod sec8_chains;
pub(crate) mod sec9;
pub mod targets;
mod text;
mod verdict;

pub use basis::{Basis, split};
pub use ledger::{all, level, needs, one, rows, scorecard};
pub use level::{FAMILY_LEVEL, Level};
pub use published::{Parameter, Published, PublishedError, Statement};
pub use row::{Error, Evidence, Finding, Row};
pub use text::{Digits, Number, Piece, Text, digits_of};
pub use verdict::{Judgement, Verdict};

use serde::Serialize;

/// One statement of the paper with our finding and the verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Claim {
    /// The id of the statement, as in `templates/published.toml`.
    pub id: String,
    /// Where it stands in the paper.
    pub place: String,
    /// The statement, in our words.
    pub statement: String,
    /// What can be read there, in its shortest form.
    pub printed: String,
    /// What we find, with its error.
    pub ours: Text,
    /// How far from the printed value a finding may lie.
    pub tolerance: Text,
    /// Why the tolerance has this size.
    pub reason: String,
    /// What the verdict rests on.
    pub basis: Basis,
    /// The verdict.
    pub verdict: Verdict,
    /// What explains a difference, or what should be known besides.
    pub note: Text,
}

impl Claim {
    /// Whether this row makes `impact-paper check` fail: a difference that nothing explains, or
    /// whose explanation no longer holds.
    pub fn fails(&self) -> bool {
        self.verdict == Verdict::Differs
    }
}

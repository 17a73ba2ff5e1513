//! Statements of a paper beside what is found, and verdicts on them: [`Claim`].

mod basis;
mod finding;
mod level;
mod published;
mod text;
mod verdict;

pub use basis::{Basis, split};
pub use finding::{Finding, all_cases, open, rounding};
pub use level::{FAMILY_LEVEL, Level};
pub use published::{Parameter, Published, PublishedError, Statement};
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
    /// Whether this row makes a check fail: a difference that nothing explains, or
    /// whose explanation no longer holds.
    pub fn fails(&self) -> bool {
        self.verdict == Verdict::Differs
    }
}

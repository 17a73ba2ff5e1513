//! Statements of a paper, targets and relations beside what is found, and verdicts on them: [`Check`].

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
pub use text::Text;
pub use verdict::{Judgement, Verdict};

use serde::Serialize;

/// What is held against something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A statement that was printed.
    Statement,
    /// What an edition promises of itself.
    Target,
    /// A relation between numbers that must hold.
    Relation,
}

/// One thing that is held against what is found, with the verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// What it is.
    pub kind: Kind,
    /// Its id; that of a statement as in `published.toml`.
    pub id: String,
    /// Where it was printed; empty for what was not.
    pub place: String,
    /// What is said, in our words.
    pub statement: String,
    /// What can be read there, in its shortest form.
    pub printed: String,
    /// What we find, with its error.
    pub ours: Text,
    /// How far from the printed value a finding may lie; the bound of a target.
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

impl Check {
    /// Whether a report is to be refused for it: a difference that nothing explains, or whose explanation no
    /// longer holds. Times of the clock decide nothing.
    pub fn fails(&self) -> bool {
        self.verdict == Verdict::Differs && self.basis != Basis::Clock
    }

    /// The verdict in words.
    pub fn words(&self) -> &'static str {
        match (self.kind, self.verdict) {
            (Kind::Statement, verdict) => verdict.words(),
            (Kind::Target, Verdict::Reproduced) => "met",
            (Kind::Target, Verdict::CannotBeJudged) => "not measured",
            (Kind::Target, _) => "missed",
            (Kind::Relation, Verdict::Reproduced) => "holds",
            (Kind::Relation, _) => "does not hold",
        }
    }
}

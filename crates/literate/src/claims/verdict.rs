//! Verdicts, as functions of what was compared.

use serde::Serialize;

/// The verdict on a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Our finding lies within the tolerance.
    Reproduced,
    /// It does not, and the difference has the size that our explanation predicts.
    DiffersAndExplained,
    /// It does not, or our explanation of a difference fails.
    Differs,
    /// The results at hand do not decide.
    CannotBeJudged,
}

impl Verdict {
    /// Every verdict, in the order of a scorecard.
    pub const ALL: [Verdict; 4] = [
        Verdict::Reproduced,
        Verdict::DiffersAndExplained,
        Verdict::Differs,
        Verdict::CannotBeJudged,
    ];

    /// The verdict in words.
    pub fn words(self) -> &'static str {
        match self {
            Verdict::Reproduced => "reproduced",
            Verdict::DiffersAndExplained => "differs and explained",
            Verdict::Differs => "differs",
            Verdict::CannotBeJudged => "cannot be judged",
        }
    }

    /// The verdict as a sign, which needs no colour.
    pub fn sign(self) -> char {
        match self {
            Verdict::Reproduced => '✓',
            Verdict::DiffersAndExplained => '≠',
            Verdict::Differs => '✗',
            Verdict::CannotBeJudged => '?',
        }
    }
}

/// What was compared, before it is a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judgement {
    /// The finding against the tolerance.
    Plain {
        /// Whether the finding lies within it.
        agrees: bool,
    },
    /// The finding against the tolerance, and the explanation of a difference against its own
    /// prediction. An explanation that fails makes the row fail whatever the finding.
    Explained {
        /// Whether the finding lies within the tolerance.
        agrees: bool,
        /// Whether the explanation predicts what is found.
        holds: bool,
    },
    /// The results at hand do not decide.
    Open,
}

impl Judgement {
    /// The verdict.
    pub fn verdict(self) -> Verdict {
        match self {
            Judgement::Plain { agrees: true } => Verdict::Reproduced,
            Judgement::Plain { agrees: false } => Verdict::Differs,
            Judgement::Explained { holds: false, .. } => Verdict::Differs,
            Judgement::Explained { agrees: true, holds: true } => Verdict::Reproduced,
            Judgement::Explained { agrees: false, holds: true } => Verdict::DiffersAndExplained,
            Judgement::Open => Verdict::CannotBeJudged,
        }
    }
}

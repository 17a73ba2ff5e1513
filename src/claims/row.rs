//! How a row of the ledger is made: evidence in, finding out.

use super::{Basis, Claim, Judgement, Level, Published, PublishedError, Statement, Text};
use crate::experiments::{self, Need, Results};

/// What a claim may look at.
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a> {
    /// Results of the experiments.
    pub results: &'a Results,
    /// What the paper printed.
    pub published: &'a Published,
    /// The level of a statistical claim.
    pub level: Level,
}

/// What was found, and what it is held against.
#[derive(Clone, Debug)]
pub struct Finding {
    /// Our number, in words and digits.
    pub ours: Text,
    /// How far from the printed value it may lie.
    pub tolerance: Text,
    /// Why the tolerance has this size.
    pub reason: &'static str,
    /// The comparison.
    pub judgement: Judgement,
    /// What explains a difference, or what should be known besides.
    pub note: Text,
}

/// Why a claim could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file of statements and the claims do not fit together.
    #[error(transparent)]
    Published(#[from] PublishedError),
    /// A result is missing.
    #[error(transparent)]
    Experiment(#[from] experiments::Error),
}

/// A claim before it is computed.
pub struct Row {
    /// Id of the statement that it judges.
    pub id: &'static str,
    /// What its verdict rests on.
    pub basis: Basis,
    /// Whether it compares random numbers within their standard errors.
    pub statistical: bool,
    /// The experiments that it needs, the theory apart.
    pub needs: &'static [Need],
    /// Computes the finding.
    pub find: Find,
}

type Find = fn(&Evidence, &Statement) -> Result<Finding, Error>;

/// A claim about the theory, without a run.
pub const fn theory(id: &'static str, basis: Basis, find: Find) -> Row {
    Row { id, basis, statistical: false, needs: &[], find }
}

/// A claim about runs that compares no errors.
pub const fn measured(id: &'static str, basis: Basis, needs: &'static [Need], find: Find) -> Row {
    Row { id, basis, statistical: false, needs, find }
}

/// A claim about runs whose tolerance has room for standard errors.
pub const fn statistical(
    id: &'static str,
    basis: Basis,
    needs: &'static [Need],
    find: Find,
) -> Row {
    Row { id, basis, statistical: true, needs, find }
}

impl Row {
    /// Computes the claim.
    ///
    /// # Errors
    /// If the statement or a result is missing.
    pub fn claim(&self, evidence: &Evidence) -> Result<Claim, Error> {
        let statement = evidence.published.statement(self.id)?;
        let finding = (self.find)(evidence, statement)?;
        Ok(Claim {
            id: statement.id.clone(),
            place: statement.place.clone(),
            statement: statement.statement.clone(),
            printed: statement.printed.clone(),
            ours: finding.ours,
            tolerance: finding.tolerance,
            reason: finding.reason.into(),
            basis: self.basis,
            verdict: finding.judgement.verdict(),
            note: finding.note,
        })
    }
}

/// A finding that the results at hand do not decide.
pub fn open(ours: Text, note: &str) -> Finding {
    Finding {
        ours,
        tolerance: Text::default(),
        reason: "",
        judgement: Judgement::Open,
        note: Text::words(note),
    }
}

/// A finding of whole cases that must all agree.
pub fn all_cases(cases: u64, failures: u64, note: &str) -> Finding {
    let ours = Text::default()
        .integer((cases - failures) as usize)
        .say(" of ")
        .integer(cases as usize)
        .say(" cases agree");
    Finding {
        ours,
        tolerance: Text::words("none"),
        reason: "integers are exact",
        judgement: Judgement::Plain { agrees: failures == 0 && cases > 0 },
        note: Text::words(note),
    }
}

/// A finding of a largest relative deviation that rounding must explain.
pub fn rounding(largest: f64, allowed: f64, note: &str) -> Finding {
    Finding {
        ours: Text::words("largest relative deviation ").significant(largest, 1),
        tolerance: Text::default().significant(allowed, 1),
        reason: "rounding in double precision, with room for the length of the sums",
        judgement: Judgement::Plain { agrees: largest <= allowed },
        note: Text::words(note),
    }
}

//! How a row of the ledger is made: evidence in, finding out.

use super::{
    Basis, Check, Finding, Level, Published, PublishedError, Statement, all_cases, rounding,
};
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

impl Evidence<'_> {
    /// The number with this address.
    #[track_caller]
    pub fn number(&self, address: &str) -> Result<f64, Error> {
        Ok(self.results.number(address)?)
    }
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
    /// The words or formula that it judges, where a number alone does not say: others that are printed would be judged by
    /// nothing. `{}` stands for the number.
    pub reads: Option<&'static str>,
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
    Row { id, basis, reads: None, statistical: false, needs: &[], find }
}

/// A claim about runs that compares no errors.
pub const fn measured(id: &'static str, basis: Basis, needs: &'static [Need], find: Find) -> Row {
    Row { id, basis, reads: None, statistical: false, needs, find }
}

/// A claim about runs whose tolerance has room for standard errors.
pub const fn statistical(
    id: &'static str,
    basis: Basis,
    needs: &'static [Need],
    find: Find,
) -> Row {
    Row { id, basis, reads: None, statistical: true, needs, find }
}

/// A finding of whole cases that must all agree: those of the statement in `theory.cases`.
pub fn cases(e: &Evidence, s: &Statement, note: &str) -> Result<Finding, Error> {
    let of = |column: &str| e.number(&format!("theory.cases[statement={}].{column}", s.id));
    Ok(all_cases(of("compared")? as u64, of("failed")? as u64, note))
}

/// A finding that rounding must explain: the largest difference of the statement in `theory.differences`.
pub fn difference(e: &Evidence, s: &Statement, allowed: f64, note: &str) -> Result<Finding, Error> {
    let largest = e.number(&format!("theory.differences[statement={}].largest", s.id))?;
    Ok(rounding(largest, allowed, note))
}

impl Row {
    /// Says which words or formula it judges.
    pub const fn of(self, reads: &'static str) -> Self {
        Row { reads: Some(reads), ..self }
    }

    /// Computes the claim.
    pub fn claim(&self, evidence: &Evidence) -> Result<Check, Error> {
        let statement = evidence.published.statement(self.id)?;
        let number = statement.value.map(|x| format!("{x:.*}", usize::from(statement.decimals)));
        let reads = self.reads.map(|reads| reads.replace("{}", &number.unwrap_or_default()));
        if let Some(reads) = reads.filter(|reads| *reads != statement.printed) {
            return Err(evidence.published.unread(self.id, &reads).into());
        }
        let finding = (self.find)(evidence, statement)?;
        Ok(finding.claim(statement, self.basis))
    }
}

//! What is held against something else: claims, targets, and the numbers of the report.

use super::Failure;
use crate::claims::targets;
use crate::claims::{Basis, Check, Kind, Published, Verdict, scorecard, split};
use crate::experiments::Results;
use crate::report::guards::{self, Look};

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Judged {
    /// The statements of the paper.
    pub claims: Vec<Check>,
    /// What this edition promises of itself; none if they were not asked.
    pub targets: Vec<Check>,
    /// Relations between numbers of the report; none if they were not asked.
    pub relations: Vec<Check>,
}

impl Judged {
    /// Everything that can be asked of results.
    pub fn all(
        results: &Results,
        published: &Published,
        claims: Vec<Check>,
    ) -> Result<Self, Failure> {
        let relations = guards::checks(Look { results, published });
        Ok(Judged { targets: targets::targets(results)?, relations, claims })
    }

    /// All of them, list by list.
    pub fn checks(&self) -> impl Iterator<Item = &Check> {
        self.claims.iter().chain(&self.targets).chain(&self.relations)
    }

    /// The scores: of the paper's statements, and of our own checks where they were asked.
    pub fn scores(&self) -> Vec<String> {
        let claims = &self.claims;
        let counts = Verdict::ALL.iter().zip(scorecard(claims));
        let counts: Vec<String> =
            counts.map(|(verdict, count)| format!("{} {count}", verdict.words())).collect();
        let noun = if claims.len() == 1 { "statement" } else { "statements" };
        let bases = Basis::ALL.iter().zip(split(claims));
        let bases = bases.map(|(basis, counts)| (basis.words(), counts[0], counts.iter().sum()));
        let bases: Vec<String> = bases
            .filter(|(_, _, all): &(_, _, usize)| *all > 0)
            .map(|(basis, reproduced, all)| format!("{reproduced} of {all} {basis}"))
            .collect();
        let mut lines = Vec::new();
        if !claims.is_empty() {
            lines.push(format!("{} {noun} of the paper: {}", claims.len(), counts.join(", ")));
            lines.push(format!("reproduced, by what the verdict rests on: {}", bases.join(", ")));
        }
        let all = self.relations.len();
        if all > 0 {
            let held = all - self.relations.iter().filter(|check| check.fails()).count();
            lines.push(format!("our own checks: {held} of {all} relations between numbers hold"));
        }
        lines
    }

    /// Exit code 1, with names, for what does not hold. Times of the clock decide nothing.
    pub fn verdict(&self) -> Result<(), Failure> {
        let failing = |kind| {
            let of = |check: &&Check| check.kind == kind && check.fails();
            self.checks().filter(of).map(|check| check.id.as_str()).collect::<Vec<_>>()
        };
        let differ = failing(Kind::Statement);
        let (number, all) = (differ.len(), self.claims.len());
        let differing =
            format!("{number} of {all} claims differ without an explanation that holds");
        let faults = [
            (differing.as_str(), differ),
            ("targets of accuracy or counted work are missed", failing(Kind::Target)),
            ("relations between numbers of the report do not hold", failing(Kind::Relation)),
        ];
        let told = faults.into_iter().filter(|(_, names)| !names.is_empty());
        let told: Vec<String> =
            told.map(|(what, names)| format!("{what}: {}", names.join(", "))).collect();
        if told.is_empty() { Ok(()) } else { Err(Failure::check(told.join("; "))) }
    }
}

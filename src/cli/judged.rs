//! What is held against something else: claims, targets, and the numbers of the report.

use super::Failure;
use impact_paper::claims::targets::{self, Standing, Target};
use impact_paper::claims::{Basis, Claim, Published, Verdict, scorecard, split};
use impact_paper::experiments::Results;
use impact_paper::report::guards::{self, Failing, Look};
use impact_paper::report::{self, Registry};

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Judged {
    /// The statements of the paper.
    pub claims: Vec<Claim>,
    /// What this edition promises of itself.
    pub targets: Vec<Target>,
    /// How many relations between numbers of the report were looked at, if they were.
    pub checks: Option<usize>,
    /// Those that fail.
    pub failing: Vec<Failing>,
}

impl Judged {
    /// Everything that can be asked of results, whose `values` are known.
    ///
    /// # Errors
    /// A result that is missing.
    pub fn all(
        results: &Results,
        published: &Published,
        mut values: Registry,
        claims: Vec<Claim>,
    ) -> Result<Self, Failure> {
        values.extend(report::claims::scorecard(&claims))?;
        let look = Look { results, published, values: &values, claims: &claims };
        let failing = guards::failing(look).collect();
        let checks = Some(guards::all().count());
        Ok(Judged { targets: targets::targets(results)?, checks, failing, claims })
    }

    /// The scores: of the paper's statements, and of our own checks where they were asked.
    pub fn scores(&self) -> Vec<String> {
        let claims = &self.claims;
        let counts = Verdict::ALL.iter().zip(scorecard(claims));
        let counts: Vec<String> =
            counts.map(|(verdict, count)| format!("{count} {}", verdict.words())).collect();
        let noun = if claims.len() == 1 { "statement" } else { "statements" };
        let bases = Basis::ALL.iter().zip(split(claims));
        let bases = bases.map(|(basis, counts)| (basis.words(), counts[0], counts.iter().sum()));
        let bases: Vec<String> = bases
            .filter(|(_, _, all): &(_, _, usize)| *all > 0)
            .map(|(basis, reproduced, all)| format!("{reproduced} of {all} {basis}"))
            .collect();
        let mut lines = vec![
            format!("{} {noun} of the paper: {}", claims.len(), counts.join(", ")),
            format!("reproduced, by what the verdict rests on: {}", bases.join(", ")),
        ];
        if let Some(all) = self.checks {
            let held = all - self.failing.len();
            lines.push(format!("our own checks: {held} of {all} relations between numbers hold"));
        }
        lines
    }

    /// Exit code 1, with names, for what does not hold. Times of the clock decide nothing.
    pub fn verdict(&self) -> Result<(), Failure> {
        let Judged { claims, targets, failing, .. } = self;
        let differ: Vec<&str> =
            claims.iter().filter(|claim| claim.fails()).map(|claim| claim.id.as_str()).collect();
        let missed = |target: &&Target| target.standing == Standing::Missed && !target.timed;
        let missed: Vec<&str> = targets.iter().filter(missed).map(|target| target.id).collect();
        let broken: Vec<&str> = failing.iter().map(|failing| failing.name).collect();
        let (number, all) = (differ.len(), claims.len());
        let differing =
            format!("{number} of {all} claims differ without an explanation that holds");
        let faults = [
            (differing.as_str(), differ),
            ("targets of accuracy or counted work are missed", missed),
            ("relations between numbers of the report do not hold", broken),
        ];
        let told = faults.into_iter().filter(|(_, names)| !names.is_empty());
        let told: Vec<String> =
            told.map(|(what, names)| format!("{what}: {}", names.join(", "))).collect();
        if told.is_empty() { Ok(()) } else { Err(Failure::check(told.join("; "))) }
    }
}

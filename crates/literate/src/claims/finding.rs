//! What is found, before it is a claim.

use super::{Basis, Check, Judgement, Kind, Statement, Text};

/// What was found, and what it is held against.
#[derive(Clone, Debug)]
#[expect(missing_docs, reason = "the fields are documented at Check")]
pub struct Finding {
    pub ours: Text,
    pub tolerance: Text,
    pub reason: &'static str,
    pub judgement: Judgement,
    pub note: Text,
}

impl Finding {
    /// The claim about a statement, with what its verdict rests on.
    pub fn claim(self, statement: &Statement, basis: Basis) -> Check {
        Check {
            kind: Kind::Statement,
            id: statement.id.clone(),
            place: statement.place.clone(),
            statement: statement.statement.clone(),
            printed: statement.printed.clone(),
            ours: self.ours,
            tolerance: self.tolerance,
            reason: self.reason.into(),
            basis,
            verdict: self.judgement.verdict(),
            note: self.note,
        }
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

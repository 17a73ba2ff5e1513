//! Statements of a paper, and relations between its numbers, each held against what is found: [`Check`].

mod judge;
mod published;
mod text;

pub use judge::{Case, Error, FAMILY_LEVEL, Judged, Level, Rule, judge_all};
pub use published::{Parameter, Published, PublishedError, Statement};
pub use text::{Text, chosen, decimals, integer, significant, with_error};

use serde::{Deserialize, Serialize};

/// What is held against something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A statement that was printed.
    #[default]
    Statement,
    /// A definition of words or symbols that was printed: it is judged, and no score counts it.
    Definition,
    /// A relation between numbers that must hold.
    Relation,
}

impl Kind {
    /// Whether it was printed.
    pub fn is_printed(self) -> bool {
        matches!(self, Kind::Statement | Kind::Definition)
    }
}

/// What a verdict rests on; where several things decide, the weakest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Basis {
    /// Whole numbers, orders and inequalities, which agree or do not.
    #[default]
    #[serde(rename = "exact")]
    Exact,
    /// Agreement within the rounding of double precision.
    #[serde(rename = "rounding")]
    Rounding,
    /// Half a unit of the last digit that the paper printed.
    #[serde(rename = "printed digit")]
    PrintedDigit,
    /// Standard errors at the level of the table.
    #[serde(rename = "statistics")]
    Statistics,
    /// A measure that we chose, for a statement in words.
    #[serde(rename = "our measure")]
    OurMeasure,
}

impl Basis {
    /// Every basis of a statement, the strongest first.
    pub const ALL: [Basis; 5] =
        [Basis::Exact, Basis::Rounding, Basis::PrintedDigit, Basis::Statistics, Basis::OurMeasure];

    /// The basis in words.
    pub fn words(self) -> &'static str {
        ["exact", "rounding", "printed digit", "statistics", "our measure"][self as usize]
    }
}

/// The verdict on a statement or a relation, in the order of a scorecard.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    /// What is found lies within the tolerance.
    #[serde(rename = "reproduced")]
    Reproduced,
    /// It does not, and the difference has the size that our explanation predicts.
    #[serde(rename = "differs and explained")]
    DiffersAndExplained,
    /// It does not, or our explanation of a difference fails.
    #[serde(rename = "differs")]
    Differs,
    /// The results at hand do not decide.
    #[default]
    #[serde(rename = "cannot be judged")]
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
        ["reproduced", "differs and explained", "differs", "cannot be judged"][self as usize]
    }

    /// The verdict as a sign, which needs no colour.
    pub fn sign(self) -> char {
        ['✓', '≠', '✗', '?'][self as usize]
    }
}

/// One thing that is held against what is found, with the verdict; texts are saved as they are printed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// What it is.
    pub kind: Kind,
    /// The author's word for a difference that is explained, such as `misprint`.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub why: String,
    /// Its id; that of a statement as in `published.toml`.
    pub id: String,
    /// Where it was printed; empty for what was not.
    pub place: String,
    /// What is said, in our words.
    pub statement: String,
    /// What can be read there, in its shortest form.
    pub expected: String,
    /// What we find, with its error.
    pub found: Text,
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
    /// What a rule may still hold it against.
    #[serde(skip)]
    held: judge::Held,
}

impl Check {
    /// A check that is not of a printed statement, with what was found; `None` where the results do not decide.
    pub fn new(kind: Kind, id: &str, statement: &str, found: impl Into<Text>) -> Check {
        let (id, statement, found) = (id.into(), statement.into(), found.into());
        Check { kind, id, statement, found, ..Check::default() }
    }

    /// Judged by whether the finding lies within the tolerance.
    pub fn judged(self, agrees: bool) -> Check {
        let verdict = if agrees { Verdict::Reproduced } else { Verdict::Differs };
        Check { verdict, ..self }
    }

    /// With an explanation, which predicts what is found or does not: one that fails makes the check fail whatever the
    /// finding.
    pub fn explained(self, why: impl Into<Text>, holds: bool) -> Check {
        let verdict = match (self.verdict, holds) {
            (_, false) => Verdict::Differs,
            (Verdict::Differs, true) => Verdict::DiffersAndExplained,
            (verdict, true) => verdict,
        };
        Check { verdict, ..self }.note(why)
    }

    /// With its tolerance and why it has this size.
    pub fn within(self, tolerance: impl Into<Text>, reason: &str) -> Check {
        Check { tolerance: tolerance.into(), reason: reason.into(), ..self }
    }

    /// With what explains a difference, or what should be known besides.
    pub fn note(self, note: impl Into<Text>) -> Check {
        Check { note: note.into(), ..self }
    }

    /// With what the verdict rests on.
    pub fn on(self, basis: Basis) -> Check {
        Check { basis, ..self }
    }

    /// Whether a report is to be refused for it: a difference that nothing explains, or whose explanation no
    /// longer holds, and a statement that is open without a reason.
    pub fn fails(&self) -> bool {
        let open = self.verdict == Verdict::CannotBeJudged && self.note.is_empty();
        self.verdict == Verdict::Differs || open && self.kind.is_printed()
    }

    /// The author's word for the difference, if there is one and it is explained.
    pub fn difference(&self) -> Option<&str> {
        let explained = self.verdict == Verdict::DiffersAndExplained;
        (explained && !self.why.is_empty()).then_some(&self.why)
    }

    /// The verdict in words.
    pub fn words(&self) -> &'static str {
        match (self.kind, self.verdict) {
            (Kind::Statement | Kind::Definition, verdict) => verdict.words(),
            (Kind::Relation, Verdict::Reproduced) => "holds",
            (Kind::Relation, Verdict::CannotBeJudged) => "not measured",
            (Kind::Relation, _) => "does not hold",
        }
    }
}

impl Statement {
    /// A check of it that the results do not decide.
    pub fn open(&self, found: impl Into<Text>) -> Check {
        Check {
            why: self.why.clone(),
            place: self.place.clone(),
            expected: self.printed.clone(),
            ..Check::new(self.kind, &self.id, &self.statement, found)
        }
    }

    /// A check of it by what was found.
    pub fn found(&self, found: impl Into<Text>, agrees: bool) -> Check {
        self.open(found).judged(agrees)
    }

    /// A check of it in whole cases that must all agree.
    pub fn all_cases(&self, cases: usize, failures: usize) -> Check {
        let found = Text::of("{} of {} cases agree", [integer(cases - failures), integer(cases)]);
        self.found(found, failures == 0 && cases > 0).within("none", "integers are exact")
    }

    /// A check of it by a largest relative deviation that rounding must explain.
    pub fn rounding(&self, largest: f64, allowed: f64) -> Check {
        let found = Text::of("largest relative deviation {}", [significant(largest, 1)]);
        let reason = "rounding in double precision, with room for the length of the sums";
        self.found(found, largest <= allowed).within(significant(allowed, 1), reason)
    }
}

/// How many checks have each verdict, in the order of [`Verdict::ALL`].
pub fn score<'a>(checks: impl Iterator<Item = &'a Check> + Clone) -> [usize; 4] {
    Verdict::ALL.map(|verdict| checks.clone().filter(|check| check.verdict == verdict).count())
}

//! Defines a check: a statement or relation with what was found, the tolerance and the verdict.

use super::texts::Text;
use serde::{Deserialize, Serialize};

/// What a check judges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Something that was printed.
    #[default]
    Statement,
    /// A definition of words or symbols that was printed: it is judged, and no score counts it.
    Definition,
    /// A relation between numbers of the paper itself.
    Relation,
}

impl Kind {
    pub(crate) fn is_printed(self) -> bool {
        matches!(self, Kind::Statement | Kind::Definition)
    }
}

/// Defines an enum whose variants are saved and printed as their texts.
macro_rules! words {
    ($(#[$about:meta])* $name:ident: $($(#[$what:meta])* $variant:ident = $text:literal,)*) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        pub enum $name {
            $($(#[$what])* #[serde(rename = $text)] $variant,)*
        }

        impl $name {
            /// All of them, in this order.
            pub const ALL: [$name; [$($text),*].len()] = [$($name::$variant),*];

            /// Returns it as words that readers see.
            pub fn words(self) -> &'static str {
                match self {
                    $($name::$variant => $text,)*
                }
            }
        }
    };
}

words! {
    /// What a verdict rests on, the strongest first; where several things decide, the weakest.
    Basis:
    /// Whole numbers, orders and inequalities, which agree or do not.
    #[default]
    Exact = "exact",
    /// Agreement within the rounding of double precision.
    Rounding = "rounding",
    /// Some of the cases that are meant, each exact or to rounding; also random ones.
    FiniteCases = "finite cases",
    /// Half a unit of the last digit that the paper printed.
    PrintedDigit = "printed digit",
    /// Standard errors at the [level](super::CheckLevel) of all statistical checks.
    Statistics = "statistics",
    /// A measure that we chose, for a statement in words.
    OurMeasure = "our measure",
}

words! {
    /// The verdict on a statement or a relation, in the order of a scorecard.
    Verdict:
    /// What is found lies within the tolerance.
    Reproduced = "reproduced",
    /// It does not, and the difference has the size that our explanation predicts.
    DiffersAndExplained = "differs and explained",
    /// It does not, or our explanation of a difference fails.
    Differs = "differs",
    /// The results do not decide it.
    #[default]
    CannotBeJudged = "cannot be judged",
}

impl Verdict {
    /// Returns the verdict as a sign, which needs no colour.
    pub(crate) fn sign(self) -> char {
        match self {
            Verdict::Reproduced => '✓',
            Verdict::DiffersAndExplained => '≠',
            Verdict::Differs => '✗',
            Verdict::CannotBeJudged => '?',
        }
    }
}

/// A [`Statement`](super::Statement) or relation, judged; texts are saved as they are printed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// What it judges.
    pub kind: Kind,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(crate) why: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(crate) sentence: String,
    /// The id of its statement or relation.
    pub id: String,
    /// Where it was printed; empty for a relation.
    pub(crate) place: String,
    pub(crate) statement: String,
    /// What can be read there, in its shortest form.
    pub(crate) expected: String,
    pub(crate) found: Text,
    /// How far from the printed value a result may lie.
    pub(crate) tolerance: Text,
    pub(crate) reason: String,
    /// What the verdict rests on.
    pub basis: Basis,
    /// What the numbers say.
    pub verdict: Verdict,
    /// What explains a difference, or what else a reader should know.
    pub note: Text,
}

impl Check {
    pub(crate) fn new(kind: Kind, id: &str, statement: &str, found: impl Into<Text>) -> Check {
        let (id, statement, found) = (id.into(), statement.into(), found.into());
        Check { kind, id, statement, found, ..Check::default() }
    }

    pub(crate) fn judged(self, agrees: bool) -> Check {
        let verdict = if agrees { Verdict::Reproduced } else { Verdict::Differs };
        Check { verdict, ..self }
    }

    /// Adds an explanation; unless it predicts what is found (`holds`), the check fails.
    pub fn explained(self, why: impl Into<Text>, holds: bool) -> Check {
        self.note(why).explained_if(holds)
    }

    /// Takes its note for an explanation: unless this predicts what is found, the check fails.
    pub fn explained_if(self, holds: bool) -> Check {
        let verdict = match (self.verdict, holds) {
            (_, false) => Verdict::Differs,
            (Verdict::Differs, true) => Verdict::DiffersAndExplained,
            (verdict, true) => verdict,
        };
        Check { verdict, ..self }
    }

    pub(crate) fn with_tolerance(self, tolerance: impl Into<Text>, reason: &str) -> Check {
        Check { tolerance: tolerance.into(), reason: reason.into(), ..self }
    }

    /// Sets the note, a sentence that readers see beside the verdict.
    pub fn note(self, note: impl Into<Text>) -> Check {
        Check { note: note.into(), ..self }
    }

    /// Returns whether a report is to be refused for it: a difference without an explanation that
    /// holds, or a statement that is open without a reason.
    pub fn fails(&self) -> bool {
        let is_open = self.verdict == Verdict::CannotBeJudged && self.note.is_empty();
        self.verdict == Verdict::Differs || is_open
    }

    /// Returns the author's word for the difference, if there is one and it is explained.
    pub(crate) fn difference(&self) -> Option<&str> {
        let is_explained = self.verdict == Verdict::DiffersAndExplained;
        (is_explained && !self.why.is_empty()).then_some(&self.why)
    }

    pub(crate) fn words(&self) -> &'static str {
        match (self.kind, self.verdict) {
            (Kind::Statement | Kind::Definition, verdict) => verdict.words(),
            (Kind::Relation, Verdict::Reproduced) => "holds",
            (Kind::Relation, Verdict::CannotBeJudged) => "not measured",
            (Kind::Relation, _) => "does not hold",
        }
    }
}

/// Counts the checks with each verdict, in the order of [`Verdict::ALL`].
pub fn score<'a>(checks: impl Iterator<Item = &'a Check> + Clone) -> [usize; 4] {
    Verdict::ALL.map(|verdict| checks.clone().filter(|check| check.verdict == verdict).count())
}

//! Defines the errors of the dynamics, and the range checks that raise them.

use std::fmt::{self, Debug};

#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// A field has a value that the model does not allow: what is wrong, and what to write instead.
    Input { field: String, problem: String, remedy: String },
    /// The start has masses in reversed order, first at this gap, overlapped by this length.
    Overlap { gap: usize, depth: f64 },
    /// More events than the bound within one unit of time, the last at this gap and time.
    Work { gap: usize, time: f64, bound: u64 },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Input { field, problem, remedy } => write!(f, "{field}: {problem}; {remedy}"),
            Error::Overlap { gap, depth } => write!(
                f,
                "initial: gap {gap} starts overlapped by {depth:e}; give places, walls and displacements \
                 that leave all gaps ≥ 0"
            ),
            Error::Work { gap, time, bound } => write!(
                f,
                "the chain has more than {bound} events within one unit of time, the last at gap \
                 {gap}; the run was stopped at t = {time}; give an earlier end or weaker forces"
            ),
        }
    }
}

impl std::error::Error for Error {}

impl Error {
    pub fn input(
        field: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Error::Input { field: field.into(), problem: problem.into(), remedy: remedy.into() }
    }
}

pub fn within<T: PartialOrd + Debug>(field: &str, x: T, low: T, high: T) -> Result<(), Error> {
    if low <= x && x <= high {
        return Ok(());
    }
    let remedy = format!("give a number from {low:?} to {high:?}");
    Err(Error::input(field, format!("{x:?} is out of range"), remedy))
}

/// Refuses a list that is not one pair of numbers for each mass.
pub fn pairs_within(field: &str, pairs: &[[f64; 2]], masses: usize) -> Result<(), Error> {
    if pairs.len() != masses || masses == 0 {
        let problem = format!("it has {} pairs for {masses} masses", pairs.len());
        return Err(Error::input(field, problem, "give one pair for each mass, at least one"));
    }
    for (j, pair) in pairs.iter().enumerate() {
        for &x in pair {
            // The name is formatted for a number that is refused, not for each.
            if !(-1e9..=1e9).contains(&x) {
                within(&format!("{field}[{j}]"), x, -1e9, 1e9)?;
            }
        }
    }
    Ok(())
}

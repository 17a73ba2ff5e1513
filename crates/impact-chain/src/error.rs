//! What can go wrong in a simulation, with the numbers that explain it.

/// An error of the dynamics.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A field of the scenario has a value that the model does not allow.
    #[error("{field}: {problem}; {remedy}")]
    Input {
        /// Name of the field, as in the scenario file.
        field: String,
        /// What is wrong, with the value.
        problem: String,
        /// What to write instead.
        remedy: String,
    },
    /// The start has masses in reversed order; ensembles count it as rejected.
    #[error("initial: gap {gap} starts overlapped by {depth:e}; give a start with all gaps ≥ 0")]
    Overlap {
        /// The first overlapped gap.
        gap: usize,
        /// How deep, in units of length.
        depth: f64,
    },
    /// The bound on work was exceeded.
    #[error(
        "the chain has more than {bound} events within one unit of time, the last at gap {gap}; the run was stopped \
         at t = {time}; give an earlier end or weaker forces"
    )]
    Work {
        /// The gap of the last event.
        gap: usize,
        /// Time of the last event.
        time: f64,
        /// The bound.
        bound: u64,
    },
}

impl Error {
    /// An [`Error::Input`] from its three parts.
    pub fn input(
        field: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Error::Input { field: field.into(), problem: problem.into(), remedy: remedy.into() }
    }
}

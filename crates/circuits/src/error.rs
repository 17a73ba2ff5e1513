//! What can go wrong in the theory, with the numbers that explain it.

/// An error of the graph theory or of the relation between p and σ.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A value that the model does not allow.
    #[error("{field}: {problem}; {remedy}")]
    Input {
        /// The field: `vertices`, `p`, `k`, `sigma`, `omega`, `forcing-frequency` or `spacing`.
        field: &'static str,
        /// What is wrong, with the value.
        problem: String,
        /// What to give instead.
        remedy: String,
    },
    /// k* stays at 1 for every p in [0, 1].
    #[error(
        "vertices: with N = {vertices} the most likely number of impacts is 1 for every p, so \
         there is no jump; give N ≥ {least}"
    )]
    NoJump {
        /// The N that was asked for.
        vertices: usize,
        /// The smallest N with a jump.
        least: usize,
    },
    /// A positive value below the range of doubles.
    #[error("sigma: {what} is below the range of double precision at σ = {sigma:e}; {remedy}")]
    Underflow {
        /// The quantity.
        what: &'static str,
        /// The σ that was asked for.
        sigma: f64,
        /// What to ask for instead.
        remedy: &'static str,
    },
}

impl Error {
    /// An [`Error::Input`] from its three parts.
    pub fn input(
        field: &'static str,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Error::Input { field, problem: problem.into(), remedy: remedy.into() }
    }
}

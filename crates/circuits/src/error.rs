//! Defines the error of the theory, and the range checks that raise it.

use std::fmt::{self, Debug};

/// An argument outside the theory, or a value outside the range of doubles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The field: `vertices`, `p`, `k`, `sigma`, `omega`, `forcing-frequency` or `spacing`.
    pub field: &'static str,
    pub problem: String,
    pub remedy: String,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}; {}", self.field, self.problem, self.remedy)
    }
}

impl std::error::Error for Error {}

impl Error {
    pub(crate) fn new(field: &'static str, problem: String, remedy: impl Into<String>) -> Self {
        Error { field, problem, remedy: remedy.into() }
    }

    /// Creates the error of a positive quantity that is below the range of doubles at a σ.
    pub(crate) fn underflow(what: &str, sigma: f64, remedy: &str) -> Self {
        let problem = format!("{what} is below the range of double precision at σ = {sigma:e}");
        Error::new("sigma", problem, remedy)
    }
}

/// The largest number of vertices N for which a quantity is computed: its time grows at most in
/// proportion to N, and is some seconds at this bound.
pub const LARGEST_N: usize = 10_000_000;

pub(crate) fn within<T: PartialOrd + Debug>(
    field: &'static str,
    x: T,
    low: T,
    high: T,
) -> Result<(), Error> {
    if (&low..=&high).contains(&&x) {
        return Ok(());
    }
    let remedy = format!("give a number from {low:?} to {high:?}");
    Err(Error::new(field, format!("{x:?} is out of range"), remedy))
}

pub(crate) fn check_vertices(big_n: usize) -> Result<(), Error> {
    within("vertices", big_n, 1, LARGEST_N)
}

//! Lists single numbers that the paper or this edition chose, and the printed threshold.

use literate::claims::{Published, PublishedError, Statement};
use std::sync::LazyLock;

/// Master seed of all random streams (ours: the year of the paper).
pub const SEED: u64 = 2007;

/// Seed of the repetition of the headline numbers (ours).
pub const SECOND_SEED: u64 = 7002;

/// Number of vertices N of the theory's main curves (Figs. 7 to 9: 100).
pub const VERTICES: usize = 100;

/// Masses of the graph of Fig. 4.
pub const GRAPH_MASSES: usize = 3;

/// Edge probabilities of Fig. 8 (a) to (d).
pub const DISTRIBUTION_P: [f64; 4] = [0.01, 0.02, 0.05, 0.1];

/// Edge probabilities of Fig. 13: panels (a) and (b) share the first, then (c) and (d).
pub const HIGHER_P: [f64; 3] = [0.005, 0.01, 0.05];

/// Edge probabilities of Fig. 14 (a) and (b).
pub const CONVERGENCE_P: [f64; 2] = [0.015, 0.04];

/// Edge probabilities of the remarks on Sec. 9 (ours, from the rise of the theory outwards).
pub const REMARK_P: [f64; 7] = [0.001, 0.005, 0.01, 0.015, 0.02, 0.04, 0.05];

/// Numbers of vertices at which the jump is followed to large N (ours: two to a decade).
pub const LARGE_VERTICES: [usize; 11] =
    [10, 30, 100, 300, 1000, 3000, 10_000, 30_000, 100_000, 300_000, 1_000_000];

/// Those of them whose k* is drawn against p N (ours).
pub const DRAWN_VERTICES: [usize; 3] = [100, 10_000, 1_000_000];

/// Two impacts of adjacent gaps closer in time than this count as near-simultaneous (ours, 1/ω).
pub const NEAR_SIMULTANEOUS: f64 = 1e-9;

/// An impact with a closing speed below this counts as slow (ours, d ω).
pub const SLOW: f64 = 1e-8;

/// The threshold of Sec. 2 in `templates/published.toml`, as the program was built with it.
static THRESHOLD: LazyLock<Statement> = LazyLock::new(|| {
    let read = || -> Result<Statement, PublishedError> {
        let published = Published::parse(include_str!("../../templates/published.toml"))?;
        let statement = published.statement("sec2_half_height")?;
        statement.number()?;
        Ok(statement.clone())
    };
    read().unwrap_or_else(|error| panic!("templates/{error}; mend it and build again"))
});

pub fn printed_threshold() -> f64 {
    THRESHOLD.value.unwrap_or(f64::NAN)
}

/// Returns the ends of the σ that round to the printed threshold.
pub fn printed_interval() -> [f64; 2] {
    THRESHOLD.interval().unwrap_or([f64::NAN; 2])
}

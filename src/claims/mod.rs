//! What the paper states, row by row, beside what this edition finds: [`Check`].
//!
//! A statement stands in `templates/published.toml` ([`Published`]) with its place; the row here
//! with the same id computes our finding from the results of the experiments and judges it. Prose,
//! table, `impact-paper check` and its exit code read the same row.
//!
//! Each verdict is a function of numbers, and can fail: a number leaves its tolerance, or a
//! difference that we explain no longer has the size that the explanation predicts.

mod ledger;
mod row;
pub(crate) mod sec10;
pub(crate) mod sec2;
mod sec2_rare;
mod sec3;
pub(crate) mod sec5;
pub(crate) mod sec6;
mod sec7;
pub(crate) mod sec8;
pub(crate) mod sec8_chains;
pub(crate) mod sec9;
pub mod targets;

use crate::committed;

pub use literate::claims::*;

pub use ledger::{all, level, needs, one, rows, scorecard};
pub use row::{Error, Evidence, Row};

/// What the paper printed, as it is committed.
///
/// # Errors
/// As [`Published::parse`]; and if the file cannot be read.
pub fn published() -> Result<Published, PublishedError> {
    let text = committed::text("templates/published.toml");
    Published::parse(&text.map_err(PublishedError::Unread)?)
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_committed_file_reads() {
        let published = super::published().unwrap();
        assert_eq!(published.parameter("restitution").unwrap(), 0.8);
        let [low, high] = published.statement("sec2_half_height").unwrap().rounding().unwrap();
        assert!((low - 0.115).abs() < 1e-15 && (high - 0.125).abs() < 1e-15);
    }
}

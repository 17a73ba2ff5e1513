//! Takes the threshold that the paper printed (Sec. 2) from `templates/published.toml`, as the
//! program was built with it.

use literate::claims::{Published, PublishedError, Statement};
use std::sync::LazyLock;

static THRESHOLD: LazyLock<Statement> = LazyLock::new(|| {
    let read = || -> Result<Statement, PublishedError> {
        let published = Published::parse(include_str!("../../templates/published.toml"))?;
        let statement = published.statement("sec2_half_height")?;
        statement.number()?;
        Ok(statement.clone())
    };
    read().unwrap_or_else(|error| panic!("templates/{error}; mend it and build again"))
});

/// Returns the printed σ of the threshold.
pub fn printed_threshold() -> f64 {
    THRESHOLD.value.unwrap_or(f64::NAN)
}

/// Returns the ends of the σ that round to the printed threshold.
pub fn printed_interval() -> [f64; 2] {
    THRESHOLD.interval().unwrap_or([f64::NAN; 2])
}

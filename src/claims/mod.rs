//! What the paper states, row by row, compared with what this edition finds: [`Check`].
//!
//! A statement stands in `templates/published.toml` ([`Published`]) with its place; the row here with the same id
//! judges it by the results of the experiments. Prose, table, `check` and its exit code read the same row.
//!
//! Each verdict is a function of numbers, and can fail: a number leaves its tolerance, or a difference no longer has the
//! size that its explanation predicts. [`relations`] compare numbers of this edition with one another.

mod judge;
pub mod relations;
pub(crate) mod sec2;
mod sec3;
pub(crate) mod sec5;
pub(crate) mod sec6;
mod sec7;
pub(crate) mod sec8;
pub(crate) mod sec9;

pub use literate::claims::*;

pub use judge::{Evidence, Judge};

/// The rows of all sections, in the order of the paper.
pub fn rows() -> impl Iterator<Item = &'static Judge> {
    let sections =
        [sec2::ROWS, sec3::ROWS, sec5::ROWS, sec6::ROWS, sec7::ROWS, sec8::ROWS, sec9::ROWS];
    sections.into_iter().flatten()
}

/// The level of each statistical check of the table.
pub fn level() -> Level {
    Level::of(rows().filter(|row| row.statistical).count())
}

/// How each statement is judged.
pub fn rules() -> Vec<(&'static str, Box<Rule<'static>>)> {
    let rule = |row: &'static Judge| -> (&'static str, Box<Rule<'static>>) {
        let check = move |case: &Case<'_>| {
            let level = if row.statistical { case.level() } else { level() };
            row.check(&Evidence { results: case.results, published: case.published, level })
        };
        (row.id, Box::new(check))
    };
    rows().map(rule).collect()
}

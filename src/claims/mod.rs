//! Judges what the paper states, row by row, by what this edition finds: [`Check`].
//!
//! A statement stands in `templates/published.toml` ([`Published`]) with its place; the [`Rule`]
//! here with the same id judges it by the results of the experiments. The texts of its check
//! stand in `templates/claims`.
//!
//! Each verdict is a function of numbers, and can fail: a number leaves its tolerance, or a
//! difference no longer has the size that its explanation predicts. Relations compare numbers
//! of this edition with one another.

mod relations;
mod sec2;
mod sec3;
mod sec5;
mod sec6;
mod sec7;
mod sec8;
mod sec9;
mod shared;

pub use literate::claims::*;

/// Returns the rules of all statements, in the order of the paper, and then those of relations.
pub fn rules() -> Vec<Rule> {
    let sections = [
        sec2::rules(),
        sec3::rules(),
        sec5::rules(),
        sec6::rules(),
        sec7::rules(),
        sec8::rules(),
        sec9::rules(),
        relations::rules(),
    ];
    sections.into_iter().flatten().collect()
}

pub fn level() -> CheckLevel {
    level_of(&rules())
}

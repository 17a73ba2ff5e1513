//! What the paper states, row by row, beside what this edition finds: [`Check`].
//!
//! A statement stands in `templates/published.toml` ([`Published`]) with its place; the row here
//! with the same id computes our finding from the results of the experiments and judges it. Prose,
//! table, `check` and its exit code read the same row.
//!
//! Each verdict is a function of numbers, and can fail: a number leaves its tolerance, or a
//! difference that we explain no longer has the size that the explanation predicts. [`relations`]
//! hold numbers of this edition against one another.

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::{THEORY, quick};

    fn published() -> Published {
        Published::parse(include_str!("../../templates/published.toml")).unwrap()
    }

    /// Every check that needs no run, on the paper's own numbers.
    #[test]
    fn exact_checks_hold_or_are_explained() {
        let published = published();
        let printed: Vec<&str> = published.statements.iter().map(|s| s.id.as_str()).collect();
        assert_eq!(printed, rows().map(|row| row.id).collect::<Vec<_>>());
        let results = quick(&[&THEORY]);
        let e = Evidence { results: &results, published: &published, level: level() };
        let checks = rows().filter_map(|row| row.check(&e).ok());
        let is_judged = |check: &Check| check.verdict != Verdict::CannotBeJudged;
        let checks: Vec<Check> = checks.filter(is_judged).collect();
        assert!(checks.len() > 30);
        for check in &checks {
            assert!(!check.fails(), "{}: {:?} {:?}", check.id, check.found, check.note);
        }
    }

    /// Changing what the paper is said to have printed changes verdicts: none is fixed.
    #[test]
    fn a_wrong_printed_number_is_noticed() {
        let results = quick(&[&THEORY]);
        let mut published = published();
        let one = |id: &str, published: &Published| {
            let row = rows().find(|row| row.id == id).unwrap();
            row.check(&Evidence { results: &results, published, level: level() })
        };
        for (id, value, printed) in
            [("sec3_edges", 12.0, "12"), ("sec9_eq35", 2.0, "valid for k > 2")]
        {
            assert_eq!(one(id, &published).unwrap().verdict, Verdict::Reproduced);
            let at = published.statements.iter().position(|own| own.id == id).unwrap();
            published.statements[at].printed = printed.into();
            let other = one(id, &published);
            assert!(other.is_err() || other.unwrap().fails(), "{id}: other digits are judged");
            published.statements[at].value = Some(value);
            assert!(one(id, &published).unwrap().fails());
        }
        assert!(matches!(one("sec2_onset", &published), Err(Error::Experiment(_))));
    }
}

//! All rows, in the order of the paper, and the claims that they make.

use super::row::{Error, Evidence, Row};
use super::{Check, Level, Published, PublishedError, Verdict};
use super::{sec2, sec3, sec5, sec6, sec7, sec8, sec9, sec10};
use crate::experiments::{Need, Results};

/// The rows of all sections.
const SECTIONS: [&[Row]; 8] = [
    sec2::ROWS,
    sec3::ROWS,
    sec5::ROWS,
    sec6::ROWS,
    sec7::ROWS,
    sec8::ROWS,
    sec9::ROWS,
    sec10::ROWS,
];

/// All rows, in the order of the paper.
pub fn rows() -> impl Iterator<Item = &'static Row> {
    SECTIONS.into_iter().flatten()
}

/// The level of each statistical claim of the table.
pub fn level() -> Level {
    Level::of(rows().filter(|row| row.statistical).count())
}

/// The experiments that a claim needs (an empty list also for an id that no row has).
pub fn needs(id: &str) -> &'static [Need] {
    rows().find(|row| row.id == id).map_or(&[], |row| row.needs)
}

/// Computes the claims of all statements of `published`, in its order.
///
/// # Errors
/// If a statement has no row or a row no statement, or if a result was not run.
pub fn all(results: &Results, published: &Published) -> Result<Vec<Check>, Error> {
    // An id that was changed is told by its new name, which has a line.
    let own = published.statements.iter().map(|s| row(&s.id, published));
    let own = own.collect::<Result<Vec<&Row>, _>>()?;
    for row in rows() {
        published.statement(row.id)?;
    }
    let evidence = Evidence { results, published, level: level() };
    own.into_iter().map(|row| row.claim(&evidence)).collect()
}

/// Computes one claim.
///
/// # Errors
/// If there is no statement or no row of that id, or if a result was not run.
pub fn one(id: &str, results: &Results, published: &Published) -> Result<Check, Error> {
    published.statement(id)?;
    row(id, published)?.claim(&Evidence { results, published, level: level() })
}

fn row(id: &str, published: &Published) -> Result<&'static Row, PublishedError> {
    rows().find(|row| row.id == id).ok_or_else(|| published.unjudged(id))
}

/// How many claims have each verdict, in the order of [`Verdict::ALL`].
pub fn scorecard(claims: &[Check]) -> [usize; 4] {
    Verdict::ALL.map(|verdict| claims.iter().filter(|claim| claim.verdict == verdict).count())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Profile;

    #[test]
    fn every_statement_has_its_row_and_every_row_its_statement() {
        let published = crate::claims::published().unwrap();
        let printed: Vec<&str> = published.statements.iter().map(|s| s.id.as_str()).collect();
        let judged: Vec<&str> = rows().map(|row| row.id).collect();
        assert_eq!(printed, judged);
    }

    /// Every claim that needs no run, on the paper's own numbers.
    #[test]
    fn exact_claims_hold_or_are_explained() {
        let published = crate::claims::published().unwrap();
        let results = Results::empty(Profile::Quick);
        let exact = rows().filter(|row| row.needs.is_empty());
        let claims: Vec<Check> =
            exact.map(|row| one(row.id, &results, &published).unwrap()).collect();
        assert!(claims.len() > 30);
        for claim in &claims {
            assert!(!claim.fails(), "{}: {:?} {:?}", claim.id, claim.ours, claim.note);
            assert_ne!(claim.verdict, Verdict::CannotBeJudged, "{}", claim.id);
        }
    }

    /// Changing what the paper is said to have printed changes verdicts: none is fixed.
    #[test]
    fn a_wrong_printed_number_is_noticed() {
        let results = Results::empty(Profile::Quick);
        let mut published = crate::claims::published().unwrap();
        let before = one("sec3_edges", &results, &published).unwrap();
        assert_eq!(before.verdict, Verdict::Reproduced);
        let edges = published.statements.iter_mut().find(|s| s.id == "sec3_edges").unwrap();
        edges.value = Some(12.0);
        assert!(one("sec3_edges", &results, &published).unwrap().fails());
        // A printed range that is too wide is one that the enumeration refutes.
        let eq35 = published.statements.iter_mut().find(|s| s.id == "sec9_eq35").unwrap();
        (eq35.value, eq35.printed) = (Some(2.0), "valid for k > 2".into());
        assert!(one("sec9_eq35", &results, &published).unwrap().fails());
    }

    #[test]
    fn what_is_missing_is_an_error() {
        let published = crate::claims::published().unwrap();
        let results = Results::empty(Profile::Quick);
        assert!(matches!(one("sec2_onset", &results, &published), Err(Error::Experiment(_))));
        assert!(matches!(one("sec99", &results, &published), Err(Error::Published(_))));
    }
}

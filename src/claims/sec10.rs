//! Section 10: conclusions.

use super::Basis::OurMeasure;
use super::row::{Error, Evidence, Row, measured};
use super::{Finding, open};
use super::{Judgement, Statement, Text};
use crate::experiments::SWEEP;
use crate::experiments::theory::beside::LARGE_SIGMA;

pub const ROWS: &[Row] = &[measured("sec10_improves", OurMeasure, &[&SWEEP], improves)];

fn improves(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let of = |column| e.number(&format!("sweep.beside_theory.{column}"));
    let (Ok(simple), Ok(higher)) = (of("simple"), of("higher")) else {
        return Ok(open(Text::words("no row"), "The sweep has no row at small σ."));
    };
    Ok(Finding {
        ours: Text::words("distance to the simulated means below σ = ")
            .significant(LARGE_SIGMA, 1)
            .say(": ")
            .significant(simple, 3)
            .say(" gaps without, ")
            .significant(higher, 3)
            .say(" with higher orders"),
        tolerance: Text::words("a decrease by at most a fifth"),
        reason: "ours: “slightly”; the distance is the root of the mean square over all rows",
        judgement: Judgement::Plain { agrees: higher < simple && higher >= 0.8 * simple },
        note: Text::default(),
    })
}

//! What the report says of the run.

use super::{SpaceTime, run};
use literate::table::Table;
use literate::value::origin;

/// The table of the run.
pub fn tables(own: &SpaceTime) -> Vec<Table> {
    let time = "1/omega";
    let none = f64::NAN;
    let (until, advances) = (own.parameters.until, own.advances());
    let (median, longest) = (advances.get(advances.len() / 2), advances.last());
    let reached = own.reached();
    vec![
        Table::of("spacetime.run", &[()], |()| 1)
            .chosen("sigma", "d omega^2", "standard deviation σ", |()| Some(own.parameters.sigma))
            .chosen("until", time, "length of the run", |()| Some(until))
            .chosen("last", time, "in which it has impacts", |()| Some(own.parameters.last))
            .chosen("quarter", time, "of the run", |()| Some(until / 4.0))
            .chosen("half", time, "of the run", |()| Some(until / 2.0))
            .computed_by(origin(run))
            .count("passed_over", "realisations without late impacts", |()| own.realisation)
            .count("impacts", "impacts", |()| own.times.len() as u64)
            .real("first", time, 3, "the first impact", |()| {
                own.times.first().copied().unwrap_or(none)
            })
            .computed_by(origin(SpaceTime::reached))
            .count("reached", "gaps with an impact", |()| reached as u64)
            .computed_by(origin(SpaceTime::reached_by))
            .count("reached_by_quarter", "gaps with an impact", |()| {
                own.reached_by(until / 4.0) as u64
            })
            .count("reached_by_half", "gaps with an impact", |()| {
                own.reached_by(until / 2.0) as u64
            })
            .computed_by(origin(SpaceTime::starts))
            .count("starts", "gaps hit when neither neighbour was", |()| own.starts().len() as u64)
            .computed_by(origin(SpaceTime::advances))
            .real("advance_median", time, 3, "median step of a front", |()| {
                median.map_or(none, |step| step.delay)
            })
            .real("advance_longest", time, 3, "longest step of a front", |()| {
                longest.map_or(none, |step| step.delay)
            })
            .count("advance_gap", "gap that it reaches", |()| {
                longest.map_or(0, |step| step.gap as u64)
            })
            .real("advance_time", time, 3, "when it does", |()| {
                longest.map_or(none, |step| step.time)
            })
            .done(),
    ]
}

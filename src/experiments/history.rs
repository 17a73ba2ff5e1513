//! Whether the count depends on the past: chains that run under a large force, which is then lowered.

use super::protocol::address;
use super::{HISTORY, PROTOCOL, Results, SWEEP};
use impact_chain::rise::{Counted, Curve, Row};
use literate::table::Table;
use literate::value::origin;

const COUNT: &str = "different gaps with an impact, mean of all";
const HALF_HEIGHT: &str = "the mean of all passes half of all gaps";

/// All tables.
pub fn tables(found: &Vec<Counted>) -> Vec<Table> {
    let history = &found[0];
    let mut rows: Vec<(&Curve, &Row)> = Vec::new();
    for at in 0..history.ensemble.sigmas.len() {
        rows.extend(history.curves.iter().map(|curve| (curve, &curve.rows[at])));
    }
    let lowered = Table::of("history.lowered", &rows, |(_, row)| row.ran)
        .key("sigma", "d omega^2", |(_, row)| row.sigma)
        .key("transient", "1/omega", |(curve, _)| curve.protocol.transient)
        .computed_by(origin(Row::new))
        .estimate("mean_count", "1", COUNT, |(_, row)| row.mean_all?.estimate())
        .done();
    let rise = Table::of("history.rise", &history.curves, |_| history.ensemble.realisations)
        .key("transient", "1/omega", |curve| curve.protocol.transient)
        .computed_by(origin(Curve::new))
        .estimate("half_height", "d omega^2", HALF_HEIGHT, |curve| curve.rise.half_height_all)
        .done();
    let run = Table::of("history.run", &[&history.ensemble], |own| own.realisations)
        .chosen("hot", "d omega^2", "σ of the force at first", |own| {
            own.heating.map(|heating| heating.sigma)
        })
        .chosen("heating", "1/omega", "for so long", |own| own.heating.map(|heating| heating.time))
        .chosen("window", "1/omega", "", |own| own.protocols.first().map(|own| own.window))
        .count("realisations", "chains at each σ", |own| own.realisations as u64)
        .done();
    vec![lowered, rise, run]
}

/// Chains from rest: counts of the main sweep at each σ, and half heights of the map after each transient.
pub fn beside(results: &Results, _: &[Table]) -> Option<Vec<Table>> {
    let history = &results.of(&HISTORY).ok()?[0];
    let (sweep, map) = (&results.of(&SWEEP).ok()?[0], &results.of(&PROTOCOL).ok()?[0]);
    let found = |sigma: &f64| {
        let row = sweep.first().rows.iter().find(|row| row.sigma == *sigma)?;
        row.mean_all?.estimate()
    };
    let counts = Table::of("history.from_rest", &history.ensemble.sigmas, |_| 0)
        .key("sigma", "d omega^2", |sigma| *sigma)
        .estimate("mean_count", "1", COUNT, found)
        .same("mean_count", |sigma| {
            found(sigma).map(|_| format!("sweep.rows[sigma={sigma}].mean_all"))
        })
        .done();
    let cell = |own: &Curve| map.curve(own.protocol.transient, own.protocol.window);
    let half = |own: &Curve| cell(own)?.rise.half_height_all;
    let rise = Table::of("history.rise_from_rest", &history.curves, |_| 0)
        .key("transient", "1/omega", |own| own.protocol.transient)
        .estimate("half_height", "d omega^2", HALF_HEIGHT, half)
        .same("half_height", |own| {
            half(own).and_then(|_| Some(address("protocol", cell(own)?, "half_height_all")))
        })
        .done();
    Some(vec![counts, rise])
}

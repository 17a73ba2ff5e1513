//! Section 15: every relation of p and σ against the simulation, for several transients.

use super::{Error, chosen, from, mark};
use crate::experiments::Results;
use crate::experiments::protocol::ProtocolMap;
use crate::experiments::seeds::{Prediction, Seeds};
use crate::report::values::{Value, origin};
use serde::Serialize;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    transient: String,
    cells: Vec<String>,
}

/// What predicts the count, by column of the table.
const COLUMNS: [&str; 5] = ["p", "rest", "within", "balanced", "grown"];

fn id(own: &Prediction, column: &str) -> String {
    format!("scores.t{}_{column}", own.transient as u64)
}

/// The transients that the map has too.
fn tabled<'a>(
    seeds: &'a Seeds,
    map: &'a ProtocolMap,
) -> impl Iterator<Item = (&'a Prediction, Vec<(f64, f64)>)> {
    seeds.predictions.iter().filter_map(|own| Some((own, map.curve(own.transient, own.window)?)))
}

/// The values of σ that seeds and map have in common after every transient.
fn common(seeds: &Seeds, map: &ProtocolMap) -> Vec<f64> {
    let everywhere = |sigma: &f64| {
        tabled(seeds, map).all(|(_, found)| found.iter().any(|(own, _)| own == sigma))
    };
    seeds.parameters.sigmas.iter().copied().filter(everywhere).collect()
}

/// For each of these σ the simulated mean, and what each column predicts.
fn compared<'a>(
    seeds: &'a Seeds,
    own: &'a Prediction,
    found: &'a [(f64, f64)],
    sigmas: &'a [f64],
) -> impl Iterator<Item = (f64, [f64; 5])> + 'a {
    let rows = seeds.rows.iter().zip(&own.means).zip(&own.graph);
    rows.filter_map(|((row, grown), within)| {
        sigmas.iter().find(|sigma| **sigma == row.sigma)?;
        let (_, mean) = found.iter().find(|(sigma, _)| *sigma == row.sigma)?;
        let [p, rest, balanced] = row.graph;
        Some((*mean, [p, rest, *within, balanced, grown.value]))
    })
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let (seeds, map) = (results.seeds()?, results.protocol()?);
    let sigmas = common(seeds, map);
    let (Some(first), Some(last)) = (sigmas.first(), sigmas.last()) else {
        return Err(Error::Missing("seeds at a sigma of the protocol map"));
    };
    let mut all = vec![
        Value::integer("scores_compared", sigmas.len()),
        chosen("scores_low", *first),
        chosen("scores_high", *last),
    ];
    for (own, found) in tabled(seeds, map) {
        let rows: Vec<_> = compared(seeds, own, &found, &sigmas).collect();
        all.push(Value::integer(id(own, "transient"), own.transient as u64));
        for (i, column) in COLUMNS.iter().enumerate() {
            let off = rows.iter().map(|(mean, predicted)| predicted[i] - mean);
            let square = off.map(|off| off * off).sum::<f64>() / rows.len() as f64;
            all.push(Value::real(id(own, column), square.sqrt(), 2));
        }
    }
    Ok(from(all, origin(values), "seeds"))
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |(own, _): (&Prediction, _)| Line {
        transient: mark(id(own, "transient")),
        cells: COLUMNS.iter().map(|name| mark(id(own, name))).collect(),
    };
    Ok(tabled(results.seeds()?, results.protocol()?).map(line).collect())
}

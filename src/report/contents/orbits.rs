//! Periodic orbits from circuits.

use super::{Error, chosen, count, estimate, from, mark, share};
use crate::experiments::orbits::{Hunt, Orbits, Row};
use crate::experiments::{Results, orbits};
use crate::report::values::{Value, cell, origin};
use serde::Serialize;

/// The σ of which the text speaks, beside the lowest.
const SIGMA: f64 = 0.3;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    sigma: String,
    lengths: Vec<String>,
    stable: String,
    ends: Vec<String>,
}

fn id(row: &Row, column: &str) -> String {
    cell("orbits", row.sigma, column)
}

/// Where runs end, by column of the table.
const ENDS: [&str; 3] = ["silent", "periodic", "neither"];

fn ends(row: &Row) -> [u64; 3] {
    [row.ended.silent, row.ended.periodic, row.ended.neither]
}

/// How much farther than to its impact a body swings back on the orbit of one gap: 1/|cos(ωP/2)|.
fn swing(orbits: &Orbits) -> f64 {
    let chain = &orbits.parameters.chain;
    let half = std::f64::consts::PI * chain.natural_frequency / chain.forcing_frequency;
    1.0 / pxfm::f_cos(half).abs()
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let orbits = results.orbits()?;
    let parameters = &orbits.parameters;
    let n = parameters.forcings;
    let total = |of: &dyn Fn(&Row) -> u64| orbits.rows.iter().map(of).sum::<u64>();
    let orbits_found = total(&|row| row.orbits[0]);
    let mut values = vec![
        Value::integer("orbits_circuits", orbits.circuits.len()),
        Value::integer("orbits_forcings", n),
        Value::integer("orbits_starts", parameters.starts),
        Value::integer("orbits_periods", parameters.periods),
        Value::integer("orbits_until", parameters.until),
        count("orbits_total", orbits_found),
        count("orbits_one_period", total(&|row| row.by_periods.first().copied().unwrap_or(0))),
        count("orbits_last_period", total(&|row| row.by_periods.last().copied().unwrap_or(0))),
        count("orbits_stable", total(&|row| row.orbits[1])),
        count("orbits_came_back", total(&|row| row.confirmed[0])),
        count("orbits_unstable", orbits_found.saturating_sub(total(&|row| row.orbits[1]))),
        count("orbits_went", total(&|row| row.confirmed[1])),
        share("orbits_half", total(&|row| row.by_half) as usize, orbits_found as usize),
        Value::real("orbits_swing", swing(orbits), 2),
        count("orbits_runs_periodic", total(&|row| row.ended.periodic)),
        count("orbits_runs_solved", total(&|row| row.ended.solved)),
        count("orbits_runs_simple", total(&|row| row.ended.simple)),
        count("orbits_runs_sought", total(&|row| row.ended.sought)),
        count("orbits_runs_listed", total(&|row| row.ended.listed)),
    ];
    for row in &orbits.rows {
        values.push(chosen(&id(row, "sigma"), row.sigma));
        for length in &row.lengths {
            values.push(estimate(id(row, &format!("k{}", length.k)), Some(length.admissible), n));
        }
        values.push(estimate(id(row, "stable"), Some(row.any_stable), n));
        let ended = ENDS.iter().zip(ends(row));
        values.extend(ended.map(|(name, ended)| count(&id(row, name), ended)));
    }
    let lowest = orbits.rows.first().ok_or(Error::Missing("periodic orbits"))?;
    let pairs = n * lowest.seen.iter().take(parameters.chain.gaps()).count();
    values.push(chosen("orbits_low_sigma", lowest.sigma));
    values.push(estimate("orbits_low_stable", Some(lowest.any_stable), n));
    values.push(count("orbits_low_silent", lowest.ended.silent));
    values.push(share("orbits_single", lowest.single as usize, pairs));
    values.push(Value::real("orbits_single_expected", lowest.single_expected, 2));
    values.extend(at_sigma(orbits)?);
    values.extend(figures(orbits)?);
    Ok(from(values, origin(orbits::row), "orbits"))
}

/// What the text says of the circuits at one σ.
fn at_sigma(orbits: &Orbits) -> Result<Vec<Value>, Error> {
    let row = orbits.rows.iter().find(|row| row.sigma == SIGMA);
    let row = row.ok_or(Error::Missing("periodic orbits at the sigma of the text"))?;
    let gaps = orbits.parameters.chain.gaps();
    let seen = |k: usize| {
        let own = orbits.circuits.iter().zip(&row.seen).filter(move |(c, _)| c.len() == k);
        own.map(|(circuit, seen)| (circuit, seen[0]))
    };
    let single = |wall: bool| {
        let at_wall = move |gap: usize| gap == 0 || gap + 1 == gaps;
        seen(1).filter(move |(c, _)| at_wall(c[0]) == wall).map(|(_, n)| n).sum::<u64>()
    };
    Ok(vec![
        chosen("orbits_sigma", SIGMA),
        count("orbits_never", row.seen.iter().filter(|seen| seen[0] == 0).count() as u64),
        count("orbits_pair_most", seen(2).map(|(_, n)| n).max().unwrap_or(0)),
        count("orbits_pair_least", seen(2).map(|(_, n)| n).min().unwrap_or(0)),
        count("orbits_wall", single(true)),
        count("orbits_inner", single(false)),
    ])
}

/// The hunts for the circuits of Figs. 5 and 6.
fn figures(orbits: &Orbits) -> Result<Vec<Value>, Error> {
    let [fig5, fig6] = &orbits.hunts[..] else {
        return Err(Error::Missing("the circuits of Figs. 5 and 6"));
    };
    let mut values = vec![count("orbits_fig_pairs", fig5.each.len() as u64)];
    for (name, hunt) in [("fig5", fig5), ("fig6", fig6)] {
        let named = |what: &str| format!("orbits_{name}_{what}");
        values.push(count(&named("starts"), hunt.starts));
        values.push(count(&named("returns"), hunt.returns));
        values.push(count(&named("admissible"), hunt.admissible));
        values.push(match &hunt.best {
            Some(best) => Value::real(named("radius"), best.radius, 2),
            None => Value::text(named("radius"), "none"),
        });
    }
    values.push(count("orbits_fig5_stable", fig5.stable));
    Ok(values)
}

/// Whether the circuit of Fig. 6 has an orbit.
pub fn fig6(results: &Results) -> Result<bool, Error> {
    let found = |hunt: &Hunt| hunt.admissible > 0;
    Ok(results.orbits()?.hunts.get(1).is_some_and(found))
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |row: &Row| Line {
        sigma: mark(id(row, "sigma")),
        lengths: row.lengths.iter().map(|own| mark(id(row, &format!("k{}", own.k)))).collect(),
        stable: mark(id(row, "stable")),
        ends: ENDS.iter().map(|name| mark(id(row, name))).collect(),
    };
    Ok(results.orbits()?.rows.iter().map(line).collect())
}

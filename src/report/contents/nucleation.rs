//! Section 12, first half: gaps that close by themselves.

use super::{Error, chosen, from, mark, share};
use crate::experiments::nucleation::{Chains, Nucleation};
use crate::experiments::{Results, nucleation};
use crate::report::values::{Value, cell, origin};
use serde::Serialize;

/// The σ of which the text speaks: at the rise.
const SIGMA: f64 = 0.12;

/// The number of masses of the table, that of the paper.
const MASSES: usize = 100;

/// Times at which the text says what is missing.
const TIMES: [f64; 2] = [20.0, 200.0];

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    cells: Vec<String>,
}

const COLUMNS: [&str; 7] = ["sigma", "p", "independent", "clumps", "bound", "found", "kept"];

fn id(row: &Chains, column: &str) -> String {
    cell("nucleation", row.sigma, column)
}

/// The chains of the table.
fn tabled(found: &Nucleation) -> impl Iterator<Item = &Chains> {
    found.chains.iter().filter(|row| row.masses == MASSES)
}

/// By how much the share of chains with an impact differs from what is expected, at the end, most.
pub fn farthest<'a>(rows: impl Iterator<Item = &'a Chains>) -> f64 {
    let off = |row: &Chains| {
        let share = *row.hit.last()? as f64 / row.realisations as f64;
        Some((share - row.expected.last()?.value).abs())
    };
    rows.filter_map(off).fold(0.0, f64::max)
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let found = results.nucleation()?;
    let parameters = &found.parameters;
    let row = found.gaps.iter().find(|row| row.sigma == SIGMA);
    let row = row.ok_or(Error::Missing("gaps that close by themselves at the rise"))?;
    let lengths = || parameters.lengths.iter().map(|(masses, _)| *masses);
    let lowest = lengths().min().unwrap_or(0);
    let mut values = vec![
        chosen("nucleation_sigma", SIGMA),
        Value::real("nucleation_half", found.half, 4),
        Value::same("nucleation_p", cell("nucleation", SIGMA, "p")),
        Value::real("nucleation_wall", row.ever.wall, 2),
        Value::same("nucleation_random", "p_012"),
        Value::real("nucleation_zero", row.zero, 2),
        Value::real("nucleation_neighbour", row.ever.pair / row.ever.p, 2),
        Value::integer("nucleation_shortest", lowest),
        Value::integer("nucleation_longest", lengths().max().unwrap_or(0)),
        Value::integer("nucleation_until", parameters.times.last().copied().unwrap_or(0.0) as u64),
        Value::real("nucleation_off", farthest(tabled(found)), 1),
        Value::real(
            "nucleation_off_short",
            farthest(found.chains.iter().filter(|row| row.masses == lowest)),
            1,
        ),
    ];
    for (letter, time) in ["a", "b"].into_iter().zip(TIMES) {
        let place = parameters.times.iter().position(|own| *own == time);
        let within = place.and_then(|place| row.within.get(place));
        let within = within.ok_or(Error::Missing("gaps that close by themselves in time"))?;
        let missing = 1.0 - within.p / row.ever.p;
        values.push(Value::integer(format!("nucleation_time_{letter}"), time as u64));
        values.push(Value::real(format!("nucleation_missing_{letter}"), missing, 2));
    }
    let sweep = results.sweep()?;
    for (row, gaps) in tabled(found).zip(&found.gaps) {
        let last = row.expected.last().ok_or(Error::Missing("times of first impacts"))?;
        let hit = row.hit.last().copied().unwrap_or(0) as usize;
        values.push(chosen(&id(row, "sigma"), row.sigma));
        values.push(Value::real(id(row, "p"), gaps.ever.p, 2));
        values.push(Value::real(id(row, "independent"), last.independent, 3));
        values.push(Value::real(id(row, "clumps"), last.value, 3));
        values.push(Value::real(id(row, "bound"), last.bound, 1));
        values.push(share(id(row, "found"), hit, row.realisations as usize));
        let kept = sweep.rows.iter().find(|own| own.sigma == row.sigma);
        values.push(match kept {
            Some(own) => super::kept(&id(row, "kept"), own),
            None => Value::text(id(row, "kept"), "none"),
        });
    }
    Ok(from(values, origin(nucleation::join), "nucleation"))
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |row: &Chains| Line { cells: COLUMNS.map(|name| mark(id(row, name))).to_vec() };
    Ok(tabled(results.nucleation()?).map(line).collect())
}

//! What restitution does to a chain.

use super::{Error, chosen, count, estimate, from, mark};
use crate::experiments::restitution::{Curve, Ensemble, Restitution, steady};
use crate::experiments::{Results, restitution};
use crate::params::Chain;
use crate::report::values::{Value, cell, origin};
use serde::Serialize;

/// The σ of which the table and the text speak: at the rise of the paper's chain, far above, and where
/// contact is frequent.
const SIGMAS: [f64; 3] = [0.15, 0.3, 0.6];

/// Columns of the table after r.
const COLUMNS: [&str; 8] =
    ["half", "ratio_a", "ratio_b", "balanced", "balance", "rate", "phases", "touched"];

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    cells: Vec<String>,
}

fn id(curve: &Curve, column: &str) -> String {
    cell("restitution", curve.restitution, column)
}

fn at(curve: &Curve, sigma: f64) -> Result<&Ensemble, Error> {
    let row = curve.rows.iter().find(|row| row.sigma == sigma);
    row.ok_or(Error::Missing("restitutions at every sigma of the text"))
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let found = results.restitution()?;
    let parameters = &found.parameters;
    let missing = || Error::Missing("chains of several restitutions");
    let n = parameters.realisations;
    let mut values = vec![
        Value::integer("restitution_realisations", n),
        Value::integer("restitution_sigma_count", parameters.sigmas.len()),
        estimate("restitution_shift", found.shift, n),
    ];
    for (letter, sigma) in ["a", "b", "c"].into_iter().zip(SIGMAS) {
        values.push(chosen(&format!("restitution_sigma_{letter}"), sigma));
    }
    for curve in &found.curves {
        let [a, b, c] = SIGMAS.map(|sigma| at(curve, sigma));
        let (a, b, c) = (a?, b?, c?);
        values.push(chosen(&id(curve, "r"), curve.restitution));
        values.push(estimate(id(curve, "half"), curve.half_height, n));
        values.push(estimate(id(curve, "ratio_a"), a.ratios.last().copied().flatten(), n));
        values.push(estimate(id(curve, "ratio_b"), b.ratios.last().copied().flatten(), n));
        values.push(match super::heat::expected(curve.restitution) {
            Some(same) => Value::same(id(curve, "balanced"), same),
            None => Value::real(id(curve, "balanced"), curve.balanced, 2),
        });
        values.push(estimate(id(curve, "balance"), b.balance, n));
        values.push(estimate(id(curve, "rate"), c.rates.last().copied().flatten(), n));
        let phases = c.runs.iter().map(|run| run.phases).sum();
        values.push(count(&id(curve, "phases"), phases));
        values.push(count(&id(curve, "touched"), c.able_touched + c.others_touched));
    }
    let (first, last) = found.curves.first().zip(found.curves.last()).ok_or_else(missing)?;
    for (name, curve) in [("low", first), ("high", last)] {
        let named = |what: &str| format!("restitution_{what}_{name}");
        values.push(chosen(&named("r"), curve.restitution));
        values.push(Value::same(named("half"), id(curve, "half")));
    }
    values.push(Value::same("restitution_warm", id(last, "ratio_a")));
    values.push(Value::same("restitution_warm_balanced", id(last, "balanced")));
    values.extend(contact(found, first)?);
    values.extend(hot(found).ok_or_else(missing)?);
    Ok(from(values, origin(restitution::joining::curve), "restitution"))
}

/// Contact, most of it at the lowest restitution.
fn contact(found: &Restitution, first: &Curve) -> Result<Vec<Value>, Error> {
    let row = at(first, SIGMAS[2])?;
    let n = row.runs.len();
    let place = first.rows.iter().position(|own| own.sigma == row.sigma).unwrap_or(0);
    let rows = || found.curves.iter().flat_map(|curve| &curve.rows);
    let others: u64 = rows().map(|row| row.others_touched).sum();
    let all: u64 = rows().map(|row| row.able_touched).sum::<u64>() + others;
    let touched = |row: &&Ensemble| row.able_touched + row.others_touched > 0;
    let begins = first.rows.iter().find(touched).map(|row| row.sigma);
    let ends = rows().filter(touched).map(|row| row.restitution).next_back();
    let known = |id: &str, number: Option<f64>| match number {
        Some(number) => chosen(id, number),
        None => Value::text(id, "none"),
    };
    Ok(vec![
        Value::real("restitution_able_expected", found.able_expected[place], 3),
        count("restitution_gaps", (found.parameters.chain.gaps() * n) as u64),
        count("restitution_able", row.able),
        count("restitution_able_touched", row.able_touched),
        estimate("restitution_phases", row.phases, n),
        estimate("restitution_held", row.held, n),
        count("restitution_touched_all", all),
        count("restitution_touched_others", others),
        known("restitution_touched_from", begins),
        known("restitution_touched_to", ends),
    ])
}

/// Chains near and at r = 1.
fn hot(found: &Restitution) -> Option<Vec<Value>> {
    let parameters = &found.parameters;
    let n = parameters.heated_realisations;
    let one = found.heated.last()?;
    let near = found.heated.get(found.heated.len().checked_sub(2)?)?;
    let chain = Chain { restitution: near.restitution, ..parameters.chain.clone() };
    let expected = found.hot.last()?;
    let r = near.restitution;
    let exponent = |back: usize| found.exponents.iter().rev().nth(back).copied().flatten();
    let last =
        |list: &[Option<crate::numerics::statistics::Estimate>]| list.last().copied().flatten();
    Some(vec![
        Value::integer("restitution_heated_realisations", n),
        chosen("restitution_heated_sigma", parameters.heated_sigma),
        Value::integer("restitution_heated_until", *parameters.ends.last()? as u64),
        chosen("restitution_near_r", r),
        estimate("restitution_near_exponent", exponent(1), n),
        estimate("restitution_near_rate", last(&near.rates), n),
        estimate("restitution_near_ratio", last(&near.ratios), n),
        Value::real("restitution_near_hot", steady(&chain, parameters.heated_sigma), 2),
        Value::real("restitution_near_balanced", 2.0 * (1.0 + r) / (1.0 - r), 2),
        estimate("restitution_one_exponent", exponent(0), n),
        estimate("restitution_one_rate", last(&one.rates), n),
        estimate("restitution_one_ratio", last(&one.ratios), n),
        Value::real("restitution_one_rate_expected", expected.rate, 3),
        Value::real("restitution_one_ratio_expected", expected.ratio, 3),
    ])
}

/// The lines of the table: each restitution.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |curve: &Curve| Line {
        cells: std::iter::once("r").chain(COLUMNS).map(|column| mark(id(curve, column))).collect(),
    };
    Ok(results.restitution()?.curves.iter().map(line).collect())
}

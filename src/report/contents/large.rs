//! Sections 12 and 13, beyond the paper: the theory for many vertices, and circuits of all orders.

use super::{Error, chosen, from, mark};
use crate::experiments::theory::{AllOrders, Large, PoissonRow};
use crate::experiments::{Results, theory};
use crate::report::values::{Value, origin};
use serde::Serialize;

/// Columns of the table of distances, among the numbers of vertices that were computed.
const COLUMNS: [usize; 3] = [0, 2, 4];

/// The row whose mean the text quotes.
const MEAN: usize = 0;

/// One line of the table of distances.
#[derive(Debug, Serialize)]
pub struct DistanceLine {
    p_n: String,
    cells: Vec<String>,
    limit: String,
}

/// One line of the table of jumps.
#[derive(Debug, Serialize)]
pub struct OrderLine {
    most: String,
    p: String,
    k: String,
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let theory = &results.theory;
    let mut values = from(jump(&theory.large)?, origin(theory::large::large), "theory");
    values.extend(from(distances(&theory.large)?, origin(theory::large::large), "theory"));
    values.extend(from(orders(&theory.orders), origin(theory::orders::orders), "theory"));
    Ok(values)
}

fn jump(large: &Large) -> Result<Vec<Value>, Error> {
    let missing = || Error::Missing("the theory at large N");
    let last = large.jumps.last().ok_or_else(missing)?;
    let small = large
        .shares
        .first()
        .and_then(|first| large.jumps.iter().find(|jump| jump.vertices == first.vertices));
    let small = small.ok_or_else(missing)?;
    Ok(vec![
        chosen("large_n", last.vertices as f64),
        Value::integer("large_k_jump", last.k_after),
        Value::real("large_share", last.share, 2),
        Value::real("small_share", small.share, 2),
        Value::real("large_rule", last.rule.ok_or_else(missing)?, 4),
        Value::real("large_p_n", last.p_n, 5),
        Value::real("large_sigma_jump", large.sigma_jump, 3),
    ])
}

/// Rows and columns that were computed.
fn cells(
    row: &PoissonRow,
) -> impl Iterator<Item = (usize, &crate::experiments::theory::PoissonCell)> {
    COLUMNS.into_iter().filter_map(|column| Some((column, row.cells.get(column)?)))
}

fn distances(large: &Large) -> Result<Vec<Value>, Error> {
    let missing = || Error::Missing("distances from a Poisson variable");
    let first = large.poisson.first().ok_or_else(missing)?;
    let heads =
        cells(first).map(|(j, cell)| Value::integer(format!("poisson.n{j}"), cell.vertices));
    let mut values: Vec<Value> = heads.collect();
    for (i, row) in large.poisson.iter().enumerate() {
        values.push(chosen(&format!("poisson.c{i}"), row.p_n));
        values.push(Value::real(format!("poisson.l{i}"), row.limit, 3));
        let cell = |(j, cell): (usize, &crate::experiments::theory::PoissonCell)| {
            Value::real(format!("poisson.d{i}_{j}"), cell.variation, 3)
        };
        values.extend(cells(row).map(cell));
    }
    let quoted = large.poisson.get(MEAN).ok_or_else(missing)?;
    let gap = quoted.cells.last().ok_or_else(missing)?.mean_gap;
    values.extend([chosen("large_mean_at", quoted.p_n), Value::real("large_mean_gap", gap, 4)]);
    Ok(values)
}

fn orders(orders: &AllOrders) -> Vec<Value> {
    let mut values = Vec::new();
    for (i, jump) in orders.jumps.iter().enumerate() {
        values.push(Value::integer(format!("orders.e{i}"), jump.most.unwrap_or_default()));
        let (p, k) = (format!("orders.p{i}"), format!("orders.k{i}"));
        values.extend(match jump.most {
            Some(0) => [Value::same(p, "p_jump"), Value::same(k, "k_after_jump")],
            _ => [Value::real(p, jump.p, 5), Value::integer(k, jump.k_after)],
        });
    }
    let remarks = &orders.remarks;
    values.extend([
        chosen("orders_pole", orders.pole),
        Value::integer("diverges_at_jump", remarks.diverges_at_jump),
        Value::integer("diverges_at_large_p", remarks.diverges_at_large_p),
        Value::real("five_at_jump", remarks.five_at_jump, 2),
        Value::real("four_visits_of_third", remarks.four_visits_of_third, 2),
        Value::real("beyond_five", remarks.beyond_five, 2),
        Value::real("whole_at_jump", remarks.whole_at_jump, 2),
        Value::real("all_p_jump", orders.jump.p, 5),
        Value::integer("all_k_after", orders.jump.k_after),
        Value::real("all_before_pole", remarks.before_pole, 2),
        Value::real("all_ends", remarks.ends, 2),
    ]);
    values
}

/// Heads of the table of distances.
pub fn distance_heads(results: &Results) -> Vec<String> {
    let first = results.theory.large.poisson.first();
    first.into_iter().flat_map(cells).map(|(j, _)| mark(format!("poisson.n{j}"))).collect()
}

/// Lines of the table of distances.
pub fn distance_table(results: &Results) -> Vec<DistanceLine> {
    let rows = results.theory.large.poisson.iter().enumerate();
    rows.map(|(i, row)| DistanceLine {
        p_n: mark(format!("poisson.c{i}")),
        cells: cells(row).map(|(j, _)| mark(format!("poisson.d{i}_{j}"))).collect(),
        limit: mark(format!("poisson.l{i}")),
    })
    .collect()
}

/// Lines of the table of jumps, the last for all orders.
pub fn order_table(results: &Results) -> Vec<OrderLine> {
    let count = results.theory.orders.jumps.len();
    let line = |i: usize| OrderLine {
        most: mark(format!("orders.e{i}")),
        p: mark(format!("orders.p{i}")),
        k: mark(format!("orders.k{i}")),
    };
    let all = OrderLine { most: "all".into(), p: mark("all_p_jump"), k: mark("all_k_after") };
    (0..count).map(line).chain([all]).collect()
}

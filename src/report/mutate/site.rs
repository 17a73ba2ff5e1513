//! Where a number is made wrong.

use super::{Bench, part, same, size};
use crate::claims::Published;
use crate::report::values::{Number, Value};

/// A place where a number can be moved.
#[derive(Clone, Debug, PartialEq)]
pub enum Site {
    /// Leaves of results: for each part its index, and paths in it.
    Leaves(Vec<(usize, Vec<String>)>),
    /// What the paper printed.
    Printed,
    /// The value itself, on its way from results to the report.
    Report,
}

/// Most leaves with the same integer that are tried.
const TRIED: usize = 100;

impl Site {
    /// The first place that carries the number: the value follows when it is moved there.
    pub fn of(value: &Value, by: f64, bench: &Bench<'_>) -> Site {
        if value.id.starts_with("paper.") || value.id.starts_with("printed.") {
            return Site::Printed;
        }
        let numbers = match value.number {
            Number::Integer(n) => vec![n as f64],
            Number::Real { value, .. } => vec![value],
            Number::Interval { low, high } => vec![low, high],
            Number::Text(_) => vec![],
        };
        let own = |name: &str| name == value.experiment;
        // A comparison of theory and simulation belongs to the latter, and its theory to neither.
        let theory = |name: &str| name == "theory" && value.experiment != "theory";
        for belongs in [&own as &dyn Fn(&str) -> bool, &theory] {
            let parts: Vec<usize> = part::experiments()
                .enumerate()
                .filter(|(_, name)| belongs(name))
                .map(|p| p.0)
                .collect();
            if let Some(leaves) = carrying(value, by, &numbers, &parts, bench) {
                return Site::Leaves(leaves);
            }
        }
        Site::Report
    }
}

/// Leaves of these parts that carry the number.
fn carrying(
    value: &Value,
    by: f64,
    numbers: &[f64],
    parts: &[usize],
    bench: &Bench<'_>,
) -> Option<Vec<(usize, Vec<String>)>> {
    let found: Vec<(usize, Vec<String>)> = parts
        .iter()
        .map(|&index| {
            let leaves = |number: &f64| bench.whole.leaves(index, *number);
            (index, numbers.iter().flat_map(leaves).collect::<Vec<String>>())
        })
        .filter(|(_, paths)| !paths.is_empty())
        .collect();
    let wanted = size::moved(&value.number, by);
    let carries = |leaves: &Vec<(usize, Vec<String>)>| {
        let found = bench.carried(leaves, by, &value.id);
        found.is_some_and(|found| same(&found, &wanted, by))
    };
    // The same double is the same number, wherever it is kept; the same integer is so by chance.
    let whole = numbers.iter().all(|number| number.fract() == 0.0);
    if !whole && !found.is_empty() && carries(&found) {
        return Some(found);
    }
    if numbers.len() > 1 {
        return None;
    }
    let each =
        found.iter().flat_map(|(i, paths)| paths.iter().map(|p| vec![(*i, vec![p.clone()])]));
    each.take(TRIED).find(carries)
}

impl std::fmt::Display for Site {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Site::Printed => f.write_str("published.toml"),
            Site::Report => f.write_str("report"),
            Site::Leaves(leaves) => {
                let count: usize = leaves.iter().map(|(_, paths)| paths.len()).sum();
                let Some((index, paths)) = leaves.first() else { return Ok(()) };
                let name = part::experiments().nth(*index).unwrap_or_default();
                write!(f, "{name}{}", paths.first().map_or("", String::as_str))?;
                if count > 1 { write!(f, " and {} more", count - 1) } else { Ok(()) }
            }
        }
    }
}

/// Moves a number that the paper printed.
pub fn print(published: &mut Published, id: &str, by: f64) {
    let Some((group, id)) = id.split_once('.') else { return };
    if group == "paper" {
        published.parameters.iter_mut().filter(|p| p.id == id).for_each(|p| p.value += by);
    } else {
        let stated = published.statements.iter_mut().filter(|s| s.id == id);
        stated.for_each(|s| s.value = s.value.map(|value| value + by));
    }
}

//! Where a number is made wrong.

use super::{Bench, Leaf, moved, part, same, size};
use impact_paper::claims::Published;
use impact_paper::report::values::{Number, Value};

/// A place where a number can be moved.
#[derive(Clone, Debug, PartialEq)]
pub enum Site {
    /// Numbers in the results.
    Leaves(Vec<Leaf>),
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
) -> Option<Vec<Leaf>> {
    let leaves: Vec<Leaf> = parts
        .iter()
        .flat_map(|&index| {
            let paths = numbers.iter().flat_map(move |number| bench.whole.leaves(index, *number));
            paths.map(move |path| (index, path))
        })
        .collect();
    // The same double is the same number, wherever it is kept; the same integer is so by chance.
    let whole = numbers.iter().all(|number| number.fract() == 0.0);
    if !whole && !leaves.is_empty() && follows(value, &leaves, by, bench) {
        return Some(leaves);
    }
    let single = numbers.len() == 1;
    single.then(|| followed(value, &leaves[..leaves.len().min(TRIED)], by, bench))?
}

/// Whether a value moves by a step when these leaves do.
fn follows(value: &Value, leaves: &[Leaf], by: f64, bench: &Bench<'_>) -> bool {
    let followers = bench.followers(&moved(leaves, |_| by));
    let found = followers.as_ref().and_then(|followers| followers.get(&value.id));
    found.is_some_and(|found| same(found, &size::moved(&value.number, by), by))
}

/// A leaf that a value follows. All are moved at once, the first by one step, the next by two, and so on:
/// the value tells whom it followed, and moves by one step with that one alone. Where it followed several, and
/// where there is no report with so much moved, each half is asked.
fn followed(value: &Value, leaves: &[Leaf], by: f64, bench: &Bench<'_>) -> Option<Vec<Leaf>> {
    let alone = |i: usize| {
        let leaf = vec![leaves[i].clone()];
        follows(value, &leaf, by, bench).then_some(leaf)
    };
    if leaves.len() <= 1 {
        return leaves.first().and_then(|_| alone(0));
    }
    let steps = |i: usize| (i + 1) as f64 * by;
    if let Some(followers) = bench.followers(&moved(leaves, steps)) {
        let found = followers.get(&value.id)?;
        let at = |&i: &usize| same(found, &size::moved(&value.number, steps(i)), by);
        if let Some(leaf) = (0..leaves.len()).find(at).and_then(alone) {
            return Some(leaf);
        }
    }
    let (left, right) = leaves.split_at(leaves.len() / 2);
    followed(value, left, by, bench).or_else(|| followed(value, right, by, bench))
}

impl std::fmt::Display for Site {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Site::Printed => f.write_str("published.toml"),
            Site::Report => f.write_str("report"),
            Site::Leaves(leaves) => {
                let Some((index, path)) = leaves.first() else { return Ok(()) };
                let name = part::experiments().nth(*index).unwrap_or_default();
                write!(f, "{name}{path}")?;
                if leaves.len() > 1 { write!(f, " and {} more", leaves.len() - 1) } else { Ok(()) }
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

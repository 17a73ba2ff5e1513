//! The graph theory of Secs. 3 to 9 as tables, and beyond the paper many vertices and circuits up to the order of
//! distant impacts. Curves that only a figure draws are functions, as its data file has their values.
//!
//! Cheap: all tables take some tenths of a second, and nothing is saved.

pub(crate) mod beside;
pub(crate) mod counts;
pub(crate) mod higher;
pub mod large;
pub mod law;
pub(crate) mod relation;

use impact_circuits::Error;
use literate::table::{Building, Table};
use literate::value::Origin;

/// All tables but those that compare the theory with a simulation.
pub fn tables() -> Vec<Table> {
    let ((curve, relation), large) =
        rayon::join(|| rayon::join(relation::curve, relation::relation), large::tables);
    let mut tables = [counts::tables(), law::tables(), large].concat();
    tables.extend([higher::classes(), higher::higher(&curve, &relation)]);
    tables.extend([relation::gaps(), curve, relation]);
    tables
}

/// The value of a formula that exists for the numbers of the paper.
pub(crate) fn known<T>(found: Result<T, Error>) -> T {
    found.expect("the theory exists for the paper's N and p")
}

/// A table of one row.
fn one(name: &'static str, item: Origin) -> Building<'static, ()> {
    Table::of(name, &[()], |()| 0).computed_by(item)
}

/// Sum in order.
fn sum(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |sum, value| sum + value)
}

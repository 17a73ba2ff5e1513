//! Computes the graph theory of Secs. 3 to 9 as tables, and beyond the paper many vertices, in
//! some tenths of a second. Curves that only a figure draws are functions.

pub(crate) mod basics;
pub(crate) mod census;
pub(crate) mod comparison;
pub(crate) mod counts;
pub(crate) mod higher;
pub mod jump;
pub mod large;
pub mod law;
pub(crate) mod relation;

use literate::table::Table;

/// Makes all tables but those that compare the theory with a simulation.
pub fn tables() -> Vec<Table> {
    let ((curve, relation), large) =
        rayon::join(|| rayon::join(relation::curve, relation::relation), large::large);
    let higher = higher::higher(&curve, &relation);
    let mut tables = vec![counts::graph(), counts::lengths(), counts::commuting_circuits()];
    tables.extend([law::distributions(), law::mean(), jump::numbers(), jump::first_maximum()]);
    tables.extend([large, higher::classes(), higher, relation::gaps(), curve, relation]);
    tables
}

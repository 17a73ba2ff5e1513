//! Defines tables: rows that keys name, and columns that declare what each cell is.
//!
//! An experiment saves what its runs gave, and nothing that follows from it. What follows stands in
//! tables: [`Table::builder`] takes one thing for each row, keys are the parameters by which a row
//! is found, and each further column has a name, a unit, a meaning and the code that computes it. A
//! cell is a `Value` from then on, with its error, digits and origin, under its address:
//! `experiment.table[key=value,…].column`, and without brackets where a table has one row and no
//! keys. Prose, figures, data files, claims and cards take cells by their addresses or keys, so no
//! number is computed or named twice. Rows are found by equal keys, never by near ones.

mod building;
mod data;
mod missing;
mod rows;

pub use building::Building;
pub use data::{DataFile, shortest};
pub use missing::Missing;
pub(crate) use missing::{NO_NUMBER, nearest, no_such};
pub use rows::{Keys, Table};
pub(crate) use rows::{Tables, table_name};

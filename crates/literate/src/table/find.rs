//! Finds tables and cells by their names.

use super::missing::{Missing, no_such};
use super::rows::Table;
use crate::value::Value;
use std::collections::BTreeMap;
use std::sync::Arc;

pub type Tables = BTreeMap<&'static str, Arc<Table>>;

#[track_caller]
pub fn find_table<'a>(tables: &'a Tables, name: &str) -> Result<&'a Table, Missing> {
    match tables.get(name) {
        Some(table) => Ok(table),
        None => {
            let mut missing = Missing::new(name, no_such("table", name, tables.keys().copied()));
            missing.remedy = "add its experiment to `needs`";
            Err(missing)
        }
    }
}

/// Returns the cell with an address, `cascade.orbits[n=3].delta`.
#[track_caller]
pub fn find_cell<'a>(tables: &'a Tables, address: &str) -> Result<&'a Value, Missing> {
    let table = find_table(tables, table_name(address).unwrap_or(address))?;
    match table.cell(address) {
        Some(cell) => Ok(cell),
        None => Err(Missing::new(address, table.describe_missing(address))),
    }
}

/// Returns the name of the table, `experiment.table`, in the address of a cell, or `None` if it is
/// no address.
pub fn table_name(address: &str) -> Option<&str> {
    match address.split_once('[') {
        Some((table, rest)) => rest.contains("].").then_some(table),
        None => {
            address.rsplit_once('.').map(|(table, _)| table).filter(|table| table.contains('.'))
        }
    }
}

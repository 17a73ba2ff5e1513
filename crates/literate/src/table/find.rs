//! Finds tables and cells by their names, and says what is not there and what is nearest.

use super::rows::Table;
use crate::input::source_line;
use crate::value::Value;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::panic::Location;
use std::sync::Arc;

pub type Tables = BTreeMap<&'static str, Arc<Table>>;

#[track_caller]
pub fn find_table<'a>(tables: &'a Tables, name: &str) -> Result<&'a Table, Missing> {
    let Some(table) = tables.get(name) else {
        let missing = Missing::new(name, no_such("table", name, tables.keys().copied()));
        return Err(Missing { remedy: "add its experiment to `needs`", ..missing });
    };
    Ok(table)
}

#[track_caller]
pub fn find_cell<'a>(tables: &'a Tables, address: &str) -> Result<&'a Value, Missing> {
    let table = find_table(tables, table_name(address).unwrap_or(address))?;
    match table.cell(address) {
        Some(cell) => Ok(cell),
        None => Err(Missing::new(address, table.describe_missing(address))),
    }
}

/// Returns the table, `experiment.table`, in the address of a cell, or `None` if it is none.
pub fn table_name(address: &str) -> Option<&str> {
    match address.split_once('[') {
        Some((table, rest)) => rest.contains("].").then_some(table),
        None => {
            address.rsplit_once('.').map(|(table, _)| table).filter(|table| table.contains('.'))
        }
    }
}

/// There is no such table, row, column or cell, or the cell has no number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{address}: {what}; {remedy}, or correct it in {place}")]
pub struct Missing {
    address: String,
    what: String,
    remedy: &'static str,
    place: String,
}

impl Missing {
    #[track_caller]
    pub(crate) fn new(address: impl Into<String>, what: impl Into<String>) -> Missing {
        let (remedy, place) = ("run a fuller profile", source_line(Location::caller()));
        Missing { address: address.into(), what: what.into(), remedy, place }
    }
}

pub(crate) const NO_NUMBER: &str = "this cell has no number";

pub(crate) fn no_such<'a>(kind: &str, name: &str, names: impl Iterator<Item = &'a str>) -> String {
    let nearest = nearest(name, names);
    if nearest.is_empty() {
        return format!("there is no {kind} {name}, nor any other");
    }
    format!("there is no {kind} {name}; nearest: {}", nearest.join(", "))
}

/// Returns the three names that share most characters with this one at their beginnings and ends.
pub fn nearest<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let alike = |other: &&str| {
        let first = name.chars().zip(other.chars()).take_while(|(a, b)| a == b).count();
        let last = name.chars().rev().zip(other.chars().rev()).take_while(|(a, b)| a == b).count();
        Reverse(first + last)
    };
    let mut names: Vec<&str> = names.collect();
    names.sort_by_key(alike);
    names.truncate(3);
    names
}

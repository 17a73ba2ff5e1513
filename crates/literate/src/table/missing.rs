//! Says what is not there, where it is asked for, and what is nearest.

use crate::input::source_line;
use std::cmp::Reverse;
use std::panic::Location;

/// There is no such table, row, column or cell, or the cell has no number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{address}: {what}; {remedy}, or correct it in {place}")]
pub struct Missing {
    address: String,
    what: String,
    pub(crate) remedy: &'static str,
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

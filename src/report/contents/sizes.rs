//! Section 19: half heights by length and transient.

use super::{Error, difference, estimate, from, mark};
use crate::experiments::chains::{Chains, Curve};
use crate::experiments::{Results, chains};
use crate::numerics::statistics::Estimate;
use crate::params::ChainCurve;
use crate::report::values::{Value, origin};
use serde::Serialize;
use std::collections::BTreeSet;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    cells: Vec<String>,
}

/// Half height at one length after one transient.
struct Place<'a> {
    own: &'a ChainCurve,
    transient: u64,
    half: Option<Estimate>,
}

fn place<'a>((own, curve): (&'a ChainCurve, &'a Curve)) -> Place<'a> {
    let transient = own.transients.first().map_or(0, |time| *time as u64);
    Place { own, transient, half: curve.half_heights.first().copied().flatten() }
}

impl Place<'_> {
    fn id(&self) -> String {
        format!("sizes.t{}_n{}", self.transient, self.own.masses)
    }

    /// Of how much earlier the longest chains rise.
    fn lead(&self) -> String {
        format!("{}_lead", self.id())
    }
}

/// The lengths, rising.
fn lengths(found: &Chains) -> BTreeSet<usize> {
    found.all().map(|(own, _)| own.masses).collect()
}

fn transients(found: &Chains) -> BTreeSet<u64> {
    found.all().map(|own| place(own).transient).collect()
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let found = results.sizes()?;
    let head =
        |letter: &str, number: u64| Value::integer(format!("sizes.{letter}{number}"), number);
    let mut values: Vec<Value> = lengths(found).iter().map(|&n| head("n", n as u64)).collect();
    values.extend(transients(found).iter().map(|&time| head("t", time)));
    let longest = lengths(found).last().copied().unwrap_or(0);
    for own in found.all().map(place) {
        let n = own.own.realisations;
        values.push(estimate(own.id(), own.half, n));
        let mut same = found.all().map(place).filter(|other| other.transient == own.transient);
        let last = same.find(|other| other.own.masses == longest).and_then(|other| other.half);
        if own.own.masses < longest {
            values.push(difference(own.lead(), own.half, last, n));
        }
    }
    Ok(from(values, origin(chains::joining::curve), "sizes"))
}

/// The lengths, as heads of the table.
pub fn heads(results: &Results) -> Result<Vec<String>, Error> {
    Ok(lengths(results.sizes()?).iter().map(|n| mark(format!("sizes.n{n}"))).collect())
}

/// The lines of the table: each transient, with the half heights of all lengths and then how much
/// earlier the longest rise.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let found = results.sizes()?;
    let longest = lengths(found).last().copied();
    let line = |&time: &u64| {
        let places = || found.all().map(place).filter(move |own| own.transient == time);
        let leads = places().filter(|own| Some(own.own.masses) != longest).map(|own| own.lead());
        let cells = places().map(|own| own.id()).chain(leads);
        Line { cells: std::iter::once(format!("sizes.t{time}")).chain(cells).map(mark).collect() }
    };
    Ok(transients(found).iter().map(line).collect())
}

//! Long chains, and other forces.

use super::{Error, chosen, difference, estimate, from, mark};
use crate::experiments::chains::{Chains, Curve};
use crate::experiments::protocol::ProtocolMap;
use crate::experiments::protocol_tables::address;
use crate::experiments::{Results, chains};
use crate::params::{ChainCurve, ChainKind};
use crate::report::values::{Value, origin};
use serde::Serialize;

/// The σ of which the text speaks: at the rise.
const SIGMA: f64 = 0.12;

/// One line of a table.
#[derive(Debug, Serialize)]
pub struct Line {
    cells: Vec<String>,
}

/// The chains of several lengths.
fn lengths(found: &Chains) -> impl Iterator<Item = (&ChainCurve, &Curve)> {
    found.of(ChainKind::Length)
}

/// A number in an id.
fn part(value: f64) -> String {
    value.to_string().replace('.', "_")
}

fn length_id(own: &ChainCurve, transient: f64, column: &str) -> String {
    format!("chains.n{}_t{}_{column}", own.masses, transient as u64)
}

fn drift_id(own: &ChainCurve, transient: f64) -> String {
    let name = match own.name.strip_prefix("drift-") {
        Some(name) => name.to_string(),
        None => format!("d{}", part(own.damping)),
    };
    format!("chains.{name}_t{}", transient as u64)
}

/// A half height of the paper's chain, which the map has.
fn map_id(transient: f64) -> String {
    format!("chains.d0_t{}", transient as u64)
}

/// Chains whose half height is followed over the transients.
fn drifts(found: &Chains) -> impl Iterator<Item = (&ChainCurve, &Curve)> {
    found.of(ChainKind::Drift).chain(found.of(ChainKind::Damping))
}

/// The name of a force in ids and, in the table, to be read.
fn force(own: &ChainCurve) -> [String; 2] {
    if own.components > 1 {
        return [format!("m{}", own.components), format!("$M = {}$", own.components)];
    }
    let name = format!("f{}", part(own.forcing_frequency));
    [name, format!(r"$\Omega = {}$", own.forcing_frequency)]
}

fn force_id(own: &ChainCurve, column: &str) -> String {
    format!("chains.{}_{column}", force(own)[0])
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let (found, map) = (results.chains()?, results.protocol()?);
    let missing = || Error::Missing("long chains");
    let mut values = Vec::new();
    for (own, curve) in lengths(found) {
        let n = own.realisations;
        for (i, &transient) in own.transients.iter().enumerate() {
            let id = |column: &str| length_id(own, transient, column);
            values.push(Value::integer(id("n"), own.masses));
            values.push(Value::integer(id("t"), transient as u64));
            values.push(estimate(id("half"), curve.half_heights[i], n));
            values.push(estimate(id("width"), curve.widths[i], n));
        }
    }
    let ends = |of: fn(usize, usize) -> usize| lengths(found).map(|(own, _)| own.masses).reduce(of);
    values.push(Value::integer("chains_shortest", ends(usize::min).ok_or_else(missing)?));
    values.push(Value::integer("chains_longest", ends(usize::max).ok_or_else(missing)?));
    values.extend(open(found).ok_or_else(missing)?);
    values.extend(drift(found, map).ok_or_else(missing)?);
    values.extend(forces(found).ok_or_else(missing)?);
    Ok(from(values, origin(chains::joining::curve), "chains"))
}

/// Open gaps, and silence.
fn open(found: &Chains) -> Option<Vec<Value>> {
    let (own, curve) = found.curve("silence")?;
    let first = curve.rows.first()?;
    let chain = &found.parameters.chain;
    let square = |x: f64| x * x;
    let detuning = (square(chain.natural_frequency) - square(chain.forcing_frequency)).abs();
    let length = pxfm::f_exp(square(0.5 * chain.spacing * detuning / SIGMA));
    let total = |of: fn(&crate::experiments::chains::Ensemble) -> [u64; 2]| {
        found.curves.iter().flat_map(|curve| &curve.rows).map(|row| of(row)[0]).sum::<u64>()
    };
    Some(vec![
        chosen("chains_sigma", SIGMA),
        Value::real("chains_open_length", length, 2),
        Value::integer("chains_open", total(|row| row.chains)),
        Value::integer("chains_open_silent", total(|row| row.silent)),
        Value::integer("chains_silence_masses", own.masses),
        Value::integer("chains_silence_until", *own.transients.last()? as u64),
        chosen("chains_silence_sigma", first.sigma),
        Value::integer("chains_shut", first.chains[1]),
        Value::integer("chains_shut_silent", first.silent[1]),
    ])
}

/// Half heights over the transients, those of the paper's chain from the map.
fn drift(found: &Chains, map: &ProtocolMap) -> Option<Vec<Value>> {
    let window = found.parameters.window;
    let of_map = |time| map.cell(time, window)?.half_height_all;
    let (first, _) = found.of(ChainKind::Damping).next()?;
    let (last, strongest) = found.of(ChainKind::Damping).last()?;
    let mut values = Vec::new();
    for &time in &first.transients {
        values.push(Value::integer(format!("chains.t{}", time as u64), time as u64));
        values.push(match map.cell(time, window) {
            Some(own) => Value::same(map_id(time), address("protocol", own, "half_height_all")),
            None => Value::text(map_id(time), "none"),
        });
    }
    for (own, curve) in drifts(found) {
        for (time, half) in own.transients.iter().zip(&curve.half_heights) {
            values.push(estimate(drift_id(own, *time), *half, own.realisations));
        }
    }
    let (from, to) = (*first.transients.get(1)?, *first.transients.last()?);
    let late = |i: usize| strongest.half_heights.get(i).copied().flatten();
    values.extend([
        // Errors as if both were of different chains, which makes them too large.
        difference("chains_fall", of_map(from), of_map(to), map.parameters.realisations),
        difference(
            "chains_fall_damped",
            late(1),
            late(last.transients.len() - 1),
            last.realisations,
        ),
        chosen("chains_damping", last.damping),
        Value::integer("chains_fall_from", from as u64),
        Value::integer("chains_fall_to", to as u64),
        Value::integer("chains_stroke", found.parameters.stroke as u64),
    ]);
    Some(values)
}

/// Forces of several components, and of frequencies with a common period.
fn forces(found: &Chains) -> Option<Vec<Value>> {
    let mut values = Vec::new();
    for (own, curve) in all_forces(found) {
        let n = own.realisations;
        values.push(estimate(force_id(own, "half"), *curve.half_heights.last()?, n));
        values.push(estimate(force_id(own, "kept"), curve.kept_half, n));
        if let Some([ever, there]) = curve.kept_half_expected {
            values.push(Value::real(force_id(own, "ever"), ever, 3));
            values.push(Value::real(force_id(own, "there"), there, 3));
        }
    }
    let (paper, curve) = found.curve("length-100")?;
    let last = *paper.transients.last()?;
    values.push(Value::same("chains.m1_half", length_id(paper, last, "half")));
    values.push(estimate("chains.m1_kept", curve.kept_half, paper.realisations));
    values.push(Value::integer("chains_transient", last as u64));
    Some(values)
}

fn all_forces(found: &Chains) -> impl Iterator<Item = (&ChainCurve, &Curve)> {
    found.of(ChainKind::Components).chain(found.of(ChainKind::Frequency))
}

/// The lines of the table of lengths, by rising T and then by rising n.
pub fn lengths_table(results: &Results) -> Result<Vec<Line>, Error> {
    let found = results.chains()?;
    let mut all: Vec<(&ChainCurve, f64)> =
        lengths(found).flat_map(|(own, _)| own.transients.iter().map(move |&t| (own, t))).collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.masses.cmp(&b.0.masses)));
    let line = |(own, time): &(&ChainCurve, f64)| {
        let cell = |column| mark(length_id(own, *time, column));
        Line { cells: ["t", "n", "half", "width"].map(cell).into() }
    };
    Ok(all.iter().map(line).collect())
}

/// The transients, as heads of the table of drifts.
pub fn drift_times(results: &Results) -> Result<Vec<String>, Error> {
    let found = results.chains()?;
    let (own, _) =
        found.of(ChainKind::Damping).next().ok_or(Error::Missing("chains with friction"))?;
    Ok(own.transients.iter().map(|time| mark(format!("chains.t{}", *time as u64))).collect())
}

/// The lines of the table of drifts: the paper's chain by the map, other starts and ends, friction.
pub fn drift_table(results: &Results) -> Result<Vec<Line>, Error> {
    let found = results.chains()?;
    let line = |name: String, cells: Vec<String>| Line {
        cells: [name].into_iter().chain(cells.into_iter().map(mark)).collect(),
    };
    let times = found.of(ChainKind::Damping).next().map_or(&[][..], |(own, _)| &own.transients);
    let paper = line("from rest, between walls".into(), times.iter().map(|&t| map_id(t)).collect());
    let rest = drifts(found).map(|(own, _)| {
        let name = match own.name.as_str() {
            "drift-random" => "random free parts".into(),
            "drift-ring" => "ring".into(),
            _ => format!("$c = {}$", own.damping),
        };
        line(name, own.transients.iter().map(|&t| drift_id(own, t)).collect())
    });
    Ok([paper].into_iter().chain(rest).collect())
}

/// The lines of the table of forces, the paper's first.
pub fn forces_table(results: &Results) -> Result<Vec<Line>, Error> {
    let found = results.chains()?;
    let paper = Line {
        cells: [r"$M = 1$, $\Omega = \sqrt{2}$".to_string()]
            .into_iter()
            .chain(
                ["chains.m1_half", "chains.m1_kept", "theory.relation.sigma_kept_half"].map(mark),
            )
            .chain(["–".to_string()])
            .collect(),
    };
    let line = |(own, curve): (&ChainCurve, &Curve)| {
        let expected = |column: &str| match curve.kept_half_expected {
            Some(_) => mark(force_id(own, column)),
            None => "–".into(),
        };
        let name = force(own)[1].clone();
        let [half, kept] = ["half", "kept"].map(|column| mark(force_id(own, column)));
        Line { cells: vec![name, half, kept, expected("ever"), expected("there")] }
    };
    Ok([paper].into_iter().chain(all_forces(found).map(line)).collect())
}

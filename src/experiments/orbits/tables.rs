//! What the orbits of all forcings say together.

use super::{Hunt, Orbits, Row};
use crate::numerics::estimates::share;
use crate::numerics::statistics::Estimate;
use crate::table::Table;

/// All tables.
pub fn tables(orbits: &Orbits) -> Vec<Table> {
    let lengths: Vec<_> = orbits
        .rows
        .iter()
        .flat_map(|row| row.lengths.iter().map(move |own| (row.sigma, own)))
        .collect();
    let forcings = orbits.parameters.forcings;
    let lengths = Table::of("orbits.lengths", &lengths, |_| forcings)
        .key("sigma", "d omega^2", |(sigma, _)| *sigma)
        .key("k", "1", |(_, own)| own.k as f64)
        .estimate("admissible", "1", "share of the simple circuits with an orbit", |(_, own)| {
            Some(own.admissible)
        })
        .estimate("stable", "1", "share with a stable orbit", |(_, own)| Some(own.stable))
        .done();
    vec![rows(orbits), lengths, figures(orbits), all(orbits)]
}

/// Each σ.
fn rows(orbits: &Orbits) -> Table {
    let chain = &orbits.parameters.chain;
    let gaps = chain.gaps();
    let pairs = (orbits.parameters.forcings * gaps) as u64;
    // Forcings with an orbit, of each circuit of one length.
    let seen = |row: &Row, k: usize| -> Vec<(usize, u64)> {
        let own = orbits.circuits.iter().zip(&row.seen).filter(|(c, _)| c.len() == k);
        own.map(|(circuit, seen)| (circuit[0], seen[0])).collect()
    };
    let alone = |row: &Row, wall: bool| -> u64 {
        let at_wall = |gap: usize| gap == 0 || gap + 1 == gaps;
        seen(row, 1).iter().filter(|(gap, _)| at_wall(*gap) == wall).map(|(_, n)| n).sum()
    };
    let of_pairs = |row: &Row| seen(row, 2).into_iter().map(|(_, n)| n);
    Table::of("orbits.rows", &orbits.rows, |_| orbits.parameters.forcings)
        .key("sigma", "d omega^2", |row| row.sigma)
        .estimate("stable", "1", "share of the forcings with a stable orbit", |row| {
            Some(row.any_stable)
        })
        .count("silent", "runs from rest that end without impacts", |row| row.ended.silent)
        .count("periodic", "runs that end on a periodic orbit", |row| row.ended.periodic)
        .count("neither", "other runs", |row| row.ended.neither)
        .count("never", "circuits without an orbit under any forcing", |row| {
            row.seen.iter().filter(|seen| seen[0] == 0).count() as u64
        })
        .count("most", "forcings with an orbit, of the most favoured pair of gaps", |row| {
            of_pairs(row).max().unwrap_or(0)
        })
        .count("fewest", "the same of the least favoured pair", |row| {
            of_pairs(row).min().unwrap_or(0)
        })
        .count("at_walls", "orbits of a gap at a wall alone", |row| alone(row, true))
        .count("between_masses", "orbits of a gap between masses alone", |row| alone(row, false))
        .over(|_| pairs as usize)
        .done()
}

/// The circuits of Figs. 5 and 6.
fn figures(orbits: &Orbits) -> Table {
    let hunts: Vec<(f64, &Hunt)> = [5.0, 6.0].into_iter().zip(&orbits.hunts).collect();
    Table::of("orbits.figures", &hunts, |(_, hunt)| hunt.each.len())
        .key("figure", "1", |(figure, _)| *figure)
        .count("pairs", "pairs of σ and forcing", |(_, hunt)| hunt.each.len() as u64)
        .count("starts", "random starts", |(_, hunt)| hunt.starts)
        .count("admissible", "pairs with an orbit", |(_, hunt)| hunt.admissible)
        .count("stable", "pairs with a stable orbit", |(_, hunt)| hunt.stable)
        .real("radius", "1", 2, "least of the largest moduli of multipliers", |(_, hunt)| {
            hunt.best.as_ref().map_or(f64::NAN, |best| best.radius)
        })
        .done()
}

/// Numbers of all σ together.
fn all(orbits: &Orbits) -> Table {
    let total = |of: fn(&Row) -> u64| move |own: &&Orbits| own.rows.iter().map(of).sum::<u64>();
    Table::of("orbits.all", &[orbits], |own| {
        own.rows.iter().map(|row| row.orbits[0] as usize).sum()
    })
    .count("circuits", "simple circuits", |own| own.circuits.len() as u64)
    .count("forcings", "forcings at each σ", |own| own.parameters.forcings as u64)
    .count("starts", "random starts for each circuit", |own| own.parameters.starts as u64)
    .count("periods", "longest period, in those of the force", |own| own.parameters.periods as u64)
    .count("until", "periods of the force that runs are followed for", |own| {
        own.parameters.until as u64
    })
    .count("orbits", "orbits", total(|row| row.orbits[0]))
    .count("one_period", "with the period of the force", total(|row| row.by_periods[0]))
    .count(
        "last_period",
        "with the longest period",
        total(|row| row.by_periods.last().copied().unwrap_or(0)),
    )
    .count("stable", "stable orbits", total(|row| row.orbits[1]))
    .count("unstable", "unstable orbits", total(|row| row.orbits[0] - row.orbits[1]))
    .count(
        "came_back",
        "stable orbits to which a disturbed motion came back",
        total(|row| row.confirmed[0]),
    )
    .count("went", "unstable orbits that a disturbed motion left", total(|row| row.confirmed[1]))
    .estimate("by_half", "1", "share that the first half of the starts had found", half)
    .count("runs_periodic", "runs that end on a periodic orbit", total(|row| row.ended.periodic))
    .count(
        "runs_solved",
        "of these, stable solutions of the equations",
        total(|row| row.ended.solved),
    )
    .count("runs_simple", "of these, with simple circuits", total(|row| row.ended.simple))
    .done()
}

fn half(own: &&Orbits) -> Option<Estimate> {
    let sum = |of: fn(&Row) -> u64| own.rows.iter().map(of).sum();
    share(sum(|row| row.by_half), sum(|row| row.orbits[0]))
}

//! Makes the tables of the jump of the mode.

use super::run::{Jumps, WindowJump};
use crate::experiments::prelude::*;
use crate::params::Protocol;
use impact_chain::mode_jump::{Passing, mode_jump};

pub fn tables(jumps: &Jumps) -> Vec<Table> {
    vec![run(jumps), windows(jumps), widths(jumps)]
        .into_iter()
        .chain(
            jumps
                .window(Protocol::default())
                .into_iter()
                .flat_map(|ours| [rows(ours), distributions(ours)]),
        )
        .collect()
}

fn run(jumps: &Jumps) -> Table {
    let chains = |jumps: &Jumps| jumps.ensembles.iter().map(|one| one.realisations as u64).sum();
    let counted = |outcome: Option<bool>| {
        let same = |window: &&WindowJump| window.jump.all_gaps.is_jump() == outcome;
        jumps.windows.iter().filter(same).count() as u64
    };
    Table::of("jump.run", &[jumps], |_| 0)
        .count("chains", "chains of all σ", |jumps| chains(jumps))
        .count("sigmas", "values of σ", |jumps| jumps.ensembles.len() as u64)
        .count("windows", "windows", |jumps| jumps.windows.len() as u64)
        .computed_by(origin(Passing::is_jump))
        .count("jumps", "windows in which the mode surely jumps to all gaps", |_| {
            counted(Some(true))
        })
        .count("climbs", "windows in which it surely climbs there", |_| counted(Some(false)))
        .done()
}

fn windows(jumps: &Jumps) -> Table {
    let gaps = jumps.gaps() as f64;
    let outcome = |passing: &Passing| passing.is_jump().map(|jump| f64::from(u8::from(jump)));
    let place = |window: &WindowJump| window.jump.all_gaps.sigma;
    let step = |window: &WindowJump| {
        let peak = window.jump.all_gaps.peak?;
        let [low, high] = peak.interval;
        Some(Estimate { value: gaps - peak.value, interval: [gaps - high, gaps - low], ..peak })
    };
    Table::of("jump.windows", &jumps.windows, |_| 0)
        .key("transient", TIME, |window| window.protocol.transient)
        .key("window", TIME, |window| window.protocol.window)
        .computed_by(origin(mode_jump))
        .estimate("place", SIGMA, "σ where all gaps are as likely as the peak of the bulk", place)
        .estimate("below", "1", "number of gaps at that peak", |window| window.jump.all_gaps.peak)
        .estimate("step", "1", "from there to all gaps", step)
        .estimate("clearance", "1", "likeliest number between, below both by this part", |window| {
            window.jump.all_gaps.clearance
        })
        .computed_by(origin(Passing::is_jump))
        .chosen("jumps", "1", "1 if the mode surely jumps, 0 if it surely climbs", |window| {
            outcome(&window.jump.all_gaps)
        })
        .chosen("single_jumps", "1", "the same where a single gap is overtaken", |window| {
            outcome(&window.jump.single_gap)
        })
        .done()
}

fn widths(jumps: &Jumps) -> Table {
    Table::of("jump.widths", &jumps.widths, |_| 0)
        .key("half_width", "1", |row| row.0 as f64)
        .computed_by(origin(mode_jump))
        .estimate("place", SIGMA, "σ of the jump with our protocol, smoothed so", |row| row.1)
        .done()
}

/// Makes the table of the shares at each σ with our protocol.
fn rows(window: &WindowJump) -> Table {
    let rows: Vec<_> = window.jump.rows.iter().zip(&window.jump.peaks).collect();
    Table::of("jump.rows", &rows, |(row, _)| row.chains as usize)
        .key("sigma", SIGMA, |(row, _)| row.sigma)
        .computed_by(origin(mode_jump))
        .estimate("all", "1", "share of chains with all gaps, of those with any", |(row, _)| {
            share((row.end * row.chains).round() as u64, row.chains as u64)
        })
        .real("bulk", "1", 3, "share at the peak of the bulk", |(row, _)| row.bulk)
        .estimate("peak", "1", "number of gaps at that peak", |(_, peak)| **peak)
        .done()
}

/// How far from the jump the first and the last distribution of Fig. 2 are, in σ.
const BEFORE_AND_AFTER: f64 = 0.00625;

/// Makes the table of the distributions at the σ that are nearest to the jump with our protocol,
/// and to places before and after it.
fn distributions(window: &WindowJump) -> Table {
    let both: Vec<_> = window.jump.rows.iter().zip(&window.histograms).collect();
    let nearest = |sigma: f64| {
        let off = |at: &usize| (both[*at].0.sigma - sigma).abs();
        (0..both.len()).min_by(|a, b| off(a).total_cmp(&off(b)))
    };
    let places = window.jump.all_gaps.sigma.into_iter().flat_map(|jump| {
        [-BEFORE_AND_AFTER, 0.0, BEFORE_AND_AFTER].map(|distance| jump.value + distance)
    });
    let mut chosen: Vec<usize> = places.filter_map(nearest).collect();
    chosen.dedup();
    let mut rows = Vec::new();
    for (row, histogram) in chosen.into_iter().map(|at| both[at]) {
        let shares = histogram.iter().enumerate().skip(1);
        rows.extend(shares.map(|(k, count)| (row, k, f64::from(*count) / row.chains)));
    }
    Table::of("jump.distributions", &rows, |(row, ..)| row.chains as usize)
        .key("sigma", SIGMA, |(row, ..)| row.sigma)
        .key("gaps", "1", |(_, k, _)| *k as f64)
        .computed_by(origin(distributions))
        .real("share", "1", 3, "share of chains, of those with an impact", |(.., share)| *share)
        .done()
}

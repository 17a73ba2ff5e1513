//! Makes the tables of the jump of the mode.

use super::run::{Jumps, WindowJump};
use crate::experiments::prelude::*;
use impact_chain::mode_jump::{Passing, mode_jump};

pub fn make(jumps: &Jumps) -> Vec<Table> {
    let mut tables = vec![run(jumps), windows(jumps), ring(jumps), widths(jumps)];
    if let Some(ours) = jumps.window(Protocol::default()) {
        tables.extend([rows(ours), distributions(ours)]);
    }
    tables
}

fn run(jumps: &Jumps) -> Table {
    let count = |outcome: Option<bool>| {
        let same = |window: &&WindowJump| window.jump.all_gaps.is_jump() == outcome;
        jumps.windows.iter().filter(same).count() as u64
    };
    let first = jumps.windows.first();
    Table::builder("jump.run", &[jumps], |_| 0)
        .count("chains", "chains of all σ", |_| first.map_or(0, WindowJump::chains))
        .count("sigmas", "values of σ", |_| first.map_or(0, |one| one.histograms.len() as u64))
        .count("windows", "windows", |jumps| jumps.windows.len() as u64)
        .count("jumps", "windows in which the mode surely jumps to all gaps", |_| count(Some(true)))
        .count("climbs", "windows in which it surely climbs there", |_| count(Some(false)))
        .count("open", "windows in which the sample does not tell", |_| count(None))
        .computed_by(origin(Passing::is_jump), &["jumps", "climbs", "open"])
        .done()
}

fn outcome(passing: &Passing) -> Option<f64> {
    passing.is_jump().map(|jump| f64::from(u8::from(jump)))
}

const PLACE: &str = "σ where all gaps are as likely as the peak of the bulk";
const BELOW: &str = "number of gaps at that peak";
const CLEARANCE: &str = "likeliest number between, below both by this part";
const SINGLE: &str = "σ where a single gap is as likely as the peak of the bulk";
const JUMPS: &str = "1 if the mode surely jumps, 0 if it surely climbs";
const SINGLE_JUMPS: &str = "the same where a single gap is overtaken";

fn windows(jumps: &Jumps) -> Table {
    Table::builder("jump.windows", &jumps.windows, |_| 0)
        .table_computed_by(origin(mode_jump))
        .key("transient", TIME, |window| window.protocol.transient)
        .key("window", TIME, |window| window.protocol.window)
        .estimate("place", SIGMA, PLACE, |window| window.jump.all_gaps.sigma)
        .estimate("below", "1", BELOW, |window| window.jump.all_gaps.peak)
        .estimate("clearance", "1", CLEARANCE, |window| window.jump.all_gaps.clearance)
        .estimate("single_place", SIGMA, SINGLE, |window| window.jump.single_gap.sigma)
        .estimate("single_above", "1", BELOW, |window| window.jump.single_gap.peak)
        .estimate("single_clearance", "1", CLEARANCE, |window| window.jump.single_gap.clearance)
        .chosen("jumps", "1", JUMPS, |window| outcome(&window.jump.all_gaps))
        .chosen("single_jumps", "1", SINGLE_JUMPS, |window| outcome(&window.jump.single_gap))
        .computed_by(origin(Passing::is_jump), &["jumps", "single_jumps"])
        .done()
}

/// Makes the table of the jump on rings, with our protocol.
fn ring(jumps: &Jumps) -> Table {
    let (ring, walls) = (&jumps.ring.jump.all_gaps, jumps.window(Protocol::default()));
    let less = || Some(difference(ring.sigma?, walls?.jump.all_gaps.sigma?));
    Table::builder("jump.ring", &[ring], |_| 0)
        .count("chains", "chains of all σ", |_| jumps.ring.chains())
        .estimate("place", SIGMA, PLACE, |ring| ring.sigma)
        .estimate("difference", SIGMA, "place less that between walls", |_| less())
        .computed_by(origin(mode_jump), &["place", "difference"])
        .chosen("jumps", "1", JUMPS, |ring| outcome(ring))
        .computed_by(origin(Passing::is_jump), &["jumps"])
        .done()
}

fn widths(jumps: &Jumps) -> Table {
    Table::builder("jump.widths", &jumps.widths, |_| 0)
        .table_computed_by(origin(mode_jump))
        .key("half_width", "1", |row| row.0 as f64)
        .estimate("place", SIGMA, "σ of the jump with our protocol, smoothed so", |row| row.1)
        .done()
}

/// Makes the table of the shares at each σ with our protocol, and of the number that is the most
/// likely one by where the peak overtakes a single gap, and all gaps the peak.
fn rows(window: &WindowJump) -> Table {
    let rows: Vec<_> =
        window.jump.rows.iter().zip(&window.jump.peaks).zip(&window.histograms).collect();
    let [single, all] = [&window.jump.single_gap, &window.jump.all_gaps].map(|one| one.sigma);
    let mode = |sigma: f64, peak: f64, gaps: usize| match (single, all) {
        (Some(place), _) if sigma < place.value => 1.0,
        (_, Some(place)) if sigma > place.value => gaps as f64,
        _ => peak,
    };
    const ONE: &str = "share of chains with one gap, of those with any";
    const ALL: &str = "share of chains with all gaps, of those with any";
    Table::builder("jump.rows", &rows, |((row, _), _)| row.chains as usize)
        .table_computed_by(origin(mode_jump))
        .key("sigma", SIGMA, |((row, _), _)| row.sigma)
        .estimate("single", "1", ONE, |((row, _), own)| share(own[1].into(), row.chains as u64))
        .estimate("all", "1", ALL, |((row, _), _)| {
            share((row.end * row.chains).round() as u64, row.chains as u64)
        })
        .real("bulk", "1", 3, "share at the peak of the bulk", |((row, _), _)| row.bulk)
        .estimate("peak", "1", "number of gaps at that peak", |((_, peak), _)| **peak)
        .chosen("mode", "1", "most likely number of gaps", |((row, peak), own)| {
            Some(mode(row.sigma, peak.as_ref()?.value, own.len() - 1))
        })
        .done()
}

/// How far from the jump the first and the last distribution of Fig. 2 are, in σ.
const BEFORE_AND_AFTER: f64 = 0.00625;

/// Makes the table of the distributions at the σ that are nearest to the jump with our protocol,
/// and to places before and after it.
fn distributions(window: &WindowJump) -> Table {
    let both: Vec<_> = window.jump.rows.iter().zip(&window.histograms).collect();
    let nearest = |sigma: f64| {
        let off = |row: &usize| (both[*row].0.sigma - sigma).abs();
        (0..both.len()).min_by(|a, b| off(a).total_cmp(&off(b)))
    };
    let places = window.jump.all_gaps.sigma.into_iter().flat_map(|jump| {
        [-BEFORE_AND_AFTER, 0.0, BEFORE_AND_AFTER].map(|distance| jump.value + distance)
    });
    let mut chosen: Vec<usize> = places.filter_map(nearest).collect();
    chosen.dedup();
    let mut rows = Vec::new();
    for (row, histogram) in chosen.into_iter().map(|row| both[row]) {
        let shares = histogram.iter().enumerate().skip(1);
        rows.extend(shares.map(|(k, count)| (row, k, f64::from(*count) / row.chains)));
    }
    Table::builder("jump.distributions", &rows, |(row, ..)| row.chains as usize)
        .key("sigma", SIGMA, |(row, ..)| row.sigma)
        .key("gaps", "1", |(_, k, _)| *k as f64)
        .real("share", "1", 3, "share of chains, of those with an impact", |(.., share)| *share)
        .done()
}

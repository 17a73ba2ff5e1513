//! Chains with a gap that closes by itself: what chance must not break.

use super::{Guard, Look, unless};
use crate::experiments::NUCLEATION;

pub const GUARDS: &[Guard] = &[
    Guard { name: "first_impacts_as_expected", ids: &["nucleation.chains"], find: as_expected },
    Guard { name: "closed_theory_near_runs", ids: &["closed.rise"], find: derived },
    Guard { name: "closed_fronts_near_runs", ids: &["seeds.fronts"], find: fronts },
    Guard { name: "closed_growth_near_runs", ids: &["closed.drift"], find: growth },
    Guard { name: "impacts_never_end", ids: &["silence.*"], find: silence },
];

/// What the formula leaves out, times n: a clump keeps others out of the gaps beside it, which moves the share
/// by some gaps of n times λ²e^{−λ}/2.
const LEFT_OUT: f64 = 1.5;

/// As many chains have an impact as are expected to, but for what the formula leaves out and chance: five standard errors,
/// and five chains where hardly any is expected.
fn as_expected(look: Look<'_>) -> Option<String> {
    let chains = look.results.table("nucleation.chains").ok()?;
    let parameters = &look.results.of(&NUCLEATION).ok()?.parameters;
    parameters.lengths.iter().find_map(|(masses, n)| {
        let (keys, n) = ([("masses", *masses as f64)], *n as f64);
        chains.points(&keys, "clumps", "found").into_iter().find_map(|(p, found)| {
            let room = LEFT_OUT / *masses as f64 + 5.0 * (p * (1.0 - p) / n).sqrt() + 5.0 / n;
            unless((found - p).abs() <= room, || {
                format!("{found} of the chains, {p} expected at {masses} masses")
            })
        })
    })
}

/// How far the closed theory may put a half height from that of the runs, where its assumptions hold.
const ASSUMED: f64 = 0.006;

/// From r = 0.8 on the closed theory finds the half height, but for what it assumes and chance: five standard errors.
fn derived(look: Look<'_>) -> Option<String> {
    let rise = look.results.table("closed.rise").ok()?;
    let restitutions = rise.values("r").into_iter().filter(|r| *r >= 0.8);
    restitutions.into_iter().find_map(|r| {
        let apart = rise.estimates(&[("r", r)], "transient", "apart");
        apart.into_iter().find_map(|(transient, apart)| {
            let room = ASSUMED + 5.0 * apart.error;
            unless(apart.value.abs() <= room, || {
                format!("half heights differ by {} at r = {r} and T = {transient}", apart.value)
            })
        })
    })
}

/// How far a front of the closed theory may be from those of runs, relative to their speed.
const FRONT: f64 = 0.08;

/// Fronts are as fast as the closed theory says, but for what it assumes and chance: five standard errors of both.
fn fronts(look: Look<'_>) -> Option<String> {
    let table = look.results.table("seeds.fronts").ok()?;
    let of = |column| table.estimates(&[], "sigma", column);
    of("speed").into_iter().zip(of("speed_expected")).find_map(|((sigma, found), (_, own))| {
        let room = FRONT * found.value + 5.0 * (found.error + own.error);
        unless((own.value - found.value).abs() <= room, || {
            format!("fronts of the closed theory have the speed {} at {sigma}", own.value)
        })
    })
}

/// How far its exponent of growth may be from that of runs, and up to which σ regions do not meet everywhere.
const EXPONENT: f64 = 0.08;
const APART: f64 = 0.12;

/// Regions grow as the closed theory says, but for what it assumes and chance.
fn growth(look: Look<'_>) -> Option<String> {
    let apart = look.results.table("closed.drift").ok()?.estimates(&[], "sigma", "apart");
    apart.into_iter().filter(|(sigma, _)| *sigma <= APART).find_map(|(sigma, own)| {
        unless(own.value.abs() <= EXPONENT + 5.0 * own.error, || {
            format!("exponents of growth differ by {} at {sigma}", own.value)
        })
    })
}

/// A chain that was hit is hit again.
fn silence(look: Look<'_>) -> Option<String> {
    let all = look.results.table("silence.all").ok()?;
    let [silent, resumed] = ["silent", "resumed"].map(|column| all.number(&[], column));
    let left = silent.ok()? - resumed.ok()?;
    unless(left == 0.0, || format!("{left} chains were hit and never again"))
}

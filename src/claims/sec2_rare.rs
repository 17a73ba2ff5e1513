//! Section 2: what is rare, what never happens, and what does not matter.

use super::row::{Error, Evidence};
use super::sec2::LAST_DIGIT;
use super::{Finding, open};
use super::{Judgement, Statement, Text};
use crate::experiments::SLOW_DECADES;
use crate::experiments::branches::from_rest;
use crate::experiments::ensembles::named;
use crate::experiments::starts::half_height;
use crate::experiments::sweep::{self, laws};
use crate::experiments::{BRANCHES, STARTS, TWO_MASSES, two_masses};
use crate::params::{NEAR_SIMULTANEOUS, SLOW};

/// Share of impacts that may be called negligible (ours).
pub(super) const NEGLIGIBLE: f64 = 1e-3;

pub(super) fn three_way(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let totals = laws::run(&sweep::main(e.results)?.runs).totals;
    let Some(&seen) = totals.near_decades.last() else {
        return Ok(open(Text::words("no impacts"), "The sweep has no impacts."));
    };
    let expected = totals.expected_near_simultaneous;
    // Counts of rare events: Poisson, with one event of room where almost none are expected.
    let room = e.level.quantile * expected.sqrt() + 1.0 + e.level.quantile;
    let share = expected.max(seen as f64) / totals.impacts as f64;
    // Masses in contact pass a hit on to one another at once.
    let passed_on = totals.contact_phases as f64;
    let excess = seen as f64 - expected;
    Ok(Finding {
        ours: Text::default()
            .integer(seen as usize)
            .say(" of ")
            .significant(totals.impacts as f64, 2)
            .say(" impacts within ")
            .significant(NEAR_SIMULTANEOUS, 1)
            .say(" of one next to it"),
        tolerance: Text::words("a share of ").significant(NEGLIGIBLE, 1),
        reason: "ours: one in a thousand; and the count must be that of the fitted law, but for hits \
                 that masses in contact pass on to one another at once, one for each contact phase",
        judgement: Judgement::Plain {
            agrees: share <= NEGLIGIBLE && -room <= excess && excess <= room + passed_on,
        },
        note: Text::words("The share within δ falls in proportion to δ; the fitted law predicts ")
            .significant(expected, 2)
            .say(" such impacts, and none at δ = 0."),
    })
}

pub(super) fn sticking(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let sweep = sweep::main(e.results)?;
    let impacts: u64 = sweep.runs.iter().map(|own| own.total.impacts).sum();
    let contacts: u64 = sweep.runs.iter().map(|own| own.total.contact_phases).sum();
    let slow: u64 = sweep.runs.iter().map(|own| own.total.slow[SLOW_DECADES.len() - 1]).sum();
    if impacts == 0 {
        return Ok(open(Text::words("no impacts"), "The sweep has no impacts."));
    }
    let share = contacts as f64 / impacts as f64;
    Ok(Finding {
        ours: Text::default()
            .integer(contacts as usize)
            .say(" contact phases in ")
            .significant(impacts as f64, 2)
            .say(" impacts"),
        tolerance: Text::words("a share of ").significant(NEGLIGIBLE, 1),
        reason: "ours: one in a thousand",
        judgement: Judgement::Plain { agrees: share <= NEGLIGIBLE },
        note: Text::words(
            "Two masses on their own can stick only if their forces differ by more \
             than d ω². ",
        )
        .integer(slow as usize)
        .say(" impacts were slower than ")
        .significant(SLOW, 1)
        .say("."),
    })
}

pub(super) fn two_masses(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let found = e.results.of(&TWO_MASSES)?;
    let least = found.excess.iter().map(|own| own[0]).fold(f64::INFINITY, f64::min);
    let safe = two_masses::safe_force(&found.parameters.chain);
    if !least.is_finite() {
        return Ok(open(Text::words("no run"), "No direction of the forcing was tried."));
    }
    Ok(Finding {
        ours: Text::default()
            .integer(found.violations as usize)
            .say(
                " impacts below the force that the amplitudes allow; smallest force with an \
                 impact, over that bound: ",
            )
            .significant(least, 6),
        tolerance: Text::words("none below 1"),
        reason: "a gap whose amplitudes add up to less than d never closes; rounding of the \
                 bracket aside",
        judgement: Judgement::Plain {
            agrees: found.violations == 0 && least >= 1.0 - 1e-9 && safe > 0.0,
        },
        note: Text::words("No direction of the forces lets the masses meet below an amplitude of ")
            .significant(safe, 4)
            .say(" on each."),
    })
}

pub(super) fn walls_like_masses(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let starts = e.results.of(&STARTS)?;
    let half = |name| named(starts, name).and_then(half_height);
    let (Some(walls), Some(ring)) = (half("rest"), half("ring")) else {
        return Ok(open(Text::words("no rise"), "One of the two means does not pass one half."));
    };
    let [low, high] = e.published.statement("sec2_half_height")?.rounding()?;
    let error = (walls.error * walls.error + ring.error * ring.error).sqrt();
    let difference = ring.value - walls.value;
    Ok(Finding {
        ours: Text::words("σ½ differs by ").with_error(difference, error),
        tolerance: Text::words("± ").significant((high - low) / 2.0, 1),
        reason: LAST_DIGIT,
        judgement: Judgement::Plain {
            agrees: difference.abs() <= (high - low) / 2.0 + e.level.quantile * error,
        },
        note: Text::words(
            "A ring has N = n gaps, a chain between walls N = n + 1. After longer transients a ring rises somewhat \
             earlier.",
        ),
    })
}

/// The threshold of percolation sharpens with size. The paper names the likeness and no quantity.
pub(super) fn percolation(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let found = e.results.of(&BRANCHES)?;
    let transient = sweep::main(e.results)?.first().protocol.transient;
    let mut widths: Vec<_> = from_rest(found)
        .filter(|(own, curve)| {
            own.ensemble.chain.masses >= 100 && curve.protocol.transient == transient
        })
        .filter_map(|(own, curve)| Some((own.ensemble.chain.masses, curve.rise.width?)))
        .collect();
    widths.sort_by_key(|(masses, _)| *masses);
    let ours = match (widths.first(), widths.last()) {
        (Some((n, own)), Some((most, long))) if most > n => Text::words("width of the rise ")
            .with_error(own.value, own.error)
            .say(" for n = ")
            .integer(*n)
            .say(", ")
            .with_error(long.value, long.error)
            .say(" for n = ")
            .integer(*most),
        _ => Text::words("chains of one length only"),
    };
    Ok(open(
        ours,
        "A likeness in words, of which no number follows. The threshold of percolation becomes sharp in \
         a large system; this rise, after the same transient, does not.",
    ))
}

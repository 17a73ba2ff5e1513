//! Section 8: what the relation leaves out, held against chains that have it or not.

use super::row::{Error, Evidence};
use super::sec2_rare::NEGLIGIBLE;
use super::{Finding, open};
use super::{Judgement, Statement, Text};
use crate::experiments::ensembles::named;
use crate::experiments::protocol::range;
use crate::experiments::rise::Curve;
use crate::experiments::starts::{half_height, share_of_start};
use crate::experiments::sweep;
use crate::experiments::{BRANCHES, PROTOCOL, RESTITUTION, STARTS};
use crate::params::Protocol;
use impact_numerics::statistics::{Estimate, wilson};

/// Eq. (20) in the simulation: a chain with random free parts that overlaps at its start, or has an
/// impact later, has a gap with Y₀ + Y₁/|ω² − Ω²| ≥ d.
pub(super) fn no_impact(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let Some(random) = named(e.results.of(&STARTS)?, "random") else {
        return Ok(open(Text::words("no run"), "No chain has started with random free parts."));
    };
    let level = 1.0 - e.level.each;
    let mut seen = Vec::new();
    for (row, counted) in random.runs.iter().zip(&random.first().rows) {
        let ran = row.realisations - row.failed;
        let some = counted.kept + row.rejected;
        let Ok(bound) = e.number(&format!("theory.gap[sigma={}].any_random", row.sigma)) else {
            continue;
        };
        let Some(interval) = wilson(some as u64, ran as u64, level) else { continue };
        seen.push((row, some, some as f64 / ran as f64, bound, interval));
    }
    let telling = || seen.iter().filter(|(.., bound, _)| (0.05..0.95).contains(bound));
    let above = seen.iter().filter(|(.., bound, [low, _])| low > bound).count();
    let least =
        telling().map(|(_, _, share, bound, _)| share / bound).fold(f64::INFINITY, f64::min);
    let low = telling().filter(|(.., bound, [_, high])| *high < 2.0 / 3.0 * bound).count();
    if telling().count() < 3 {
        return Ok(open(
            Text::words("fewer than three σ where the bound tells"),
            "The bound lies between a twentieth and nineteen twentieths at too few σ.",
        ));
    }
    let text = telling().fold(Text::words("share of chains"), |text, (row, _, share, bound, _)| {
        let ran = (row.realisations - row.failed) as f64;
        let first = text.0.len() == 1;
        let text = text.say(if first { " " } else { "; " });
        text.with_error(*share, (share * (1.0 - share) / ran).sqrt())
            .say(" of ")
            .significant(*bound, 2)
            .say(" at σ = ")
            .chosen(row.sigma)
    });
    let overlaps: usize = telling().map(|(row, ..)| row.rejected).sum();
    let some: usize = telling().map(|(_, some, ..)| some).sum();
    Ok(Finding {
        ours: text,
        tolerance: Text::words("none above its bound, none below two thirds of it"),
        reason: "intervals at the level of the table; two thirds are ours, for gaps that share a mass \
                 and come near their infimum too late",
        judgement: Judgement::Plain { agrees: above == 0 && low == 0 },
        note: Text::words("Chains with random free parts, as Eq. (20) supposes. ")
            .integer(overlaps)
            .say(" of these ")
            .integer(some)
            .say(
                " chains overlap at the start, which Eq. (20) counts as impacts. The bound is \
                 1 − ∏ (1 − p) over all gaps with p of Eq. (25); chains come to at least ",
            )
            .significant(least, 2)
            .say(" of it."),
    })
}

/// Half heights of the mean of all, from rest and with random free parts, for each transient that
/// both were run to.
fn of_both_starts(e: &Evidence) -> Result<Vec<(f64, Estimate, Estimate)>, Error> {
    let (map, chains) = (&e.results.of(&PROTOCOL)?[0], e.results.of(&BRANCHES)?);
    let both = |own: &Curve| {
        let Protocol { transient, window } = own.protocol;
        let rest = map.curve(transient, window)?.rise.half_height_all?;
        Some((transient, rest, own.rise.half_height_all?))
    };
    let random = named(chains, "random").map_or(&[][..], |found| &found.curves);
    Ok(random.iter().filter_map(both).collect())
}

pub(super) fn threshold_shift(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let both = of_both_starts(e)?;
    let Some(half) =
        sweep::main(e.results)?.first().rise.half_height_all.filter(|_| both.len() > 1)
    else {
        return Ok(open(
            Text::words("no two transients"),
            "Chains of both starts did not rise after two transients or more.",
        ));
    };
    let theory = e.number("theory.relation.sigma_half")?;
    let [low, high] = e.published.statement("sec2_half_height")?.rounding()?;
    let room = e.level.among(both.len());
    let mut holds = true;
    let mut note = Text::words(
        "Means of all, in which no chain is left out. Eq. (25) assumes random free parts. In smaller samples the half height \
         from rest and with them is ",
    );
    for (i, (time, rest, random)) in both.iter().enumerate() {
        let share = share_of_start(rest.value, random.value, theory);
        let error =
            (random.error * random.error + rest.error * rest.error).sqrt() / (theory - rest.value);
        holds &= share > 0.5 - room * error;
        note = note
            .say(if i == 0 { "" } else { ", " })
            .with_error(rest.value, rest.error)
            .say(" and ")
            .with_error(random.value, random.error)
            .say(" at T = ")
            .integer(*time as usize);
    }
    Ok(Finding {
        ours: Text::words("half height of the theory at σ = ")
            .significant(theory, 4)
            .say(", of the simulation at ")
            .with_error(half.value, half.error),
        tolerance: Text::words("± ").significant((high - low) / 2.0, 1),
        reason: "ours: agreement over the whole range as half heights that agree within half a unit of the last digit \
                 in which the paper prints the threshold",
        judgement: Judgement::Explained {
            agrees: (theory - half.value).abs() <= (high - low) / 2.0,
            holds,
        },
        note: note.say(
            ". The explanation asks that the start make up more than half of the difference at each T. The \
             simulation goes on falling with T, and the theory knows no time.",
        ),
    })
}

pub(super) fn restitution_omitted(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let found = e.results.of(&RESTITUTION)?;
    let curves = e.results.table("restitution.curves")?;
    let starts = e.results.of(&STARTS)?;
    let of_start = |name| named(starts, name).and_then(half_height);
    let cells = &e.results.of(&PROTOCOL)?[0].curves;
    let ranges = (
        range(curves.estimates(&[], "r", "half_height").into_iter().map(|(_, own)| Some(own))),
        range(cells.iter().map(|cell| cell.rise.half_height_all)),
        range(["rest", "random"].into_iter().map(of_start)),
    );
    let (Some(restitution), Some(time), Some(start)) = ranges else {
        return Ok(open(Text::words("no rise"), "A mean does not pass half of all gaps."));
    };
    let rs: Vec<f64> = found.iter().map(|own| own.ensemble.chain.restitution).collect();
    let more = |other: &Estimate| {
        let error = (restitution.error * restitution.error + other.error * other.error).sqrt();
        restitution.value >= other.value - e.level.quantile * error
    };
    Ok(Finding {
        ours: Text::words("the half height moves by ")
            .with_error(restitution.value, restitution.error)
            .say(" with r, by ")
            .with_error(time.value, time.error)
            .say(" with the times of the protocol, by ")
            .with_error(start.value, start.error)
            .say(" with the start"),
        tolerance: Text::words("most with r"),
        reason: "ours: the ranges over which each was run; and the statistical error",
        judgement: Judgement::Plain { agrees: more(&time) && more(&start) },
        note: Text::words("Means of all; r from ")
            .chosen(rs.first().copied().unwrap_or(f64::NAN))
            .say(" to ")
            .chosen(rs.last().copied().unwrap_or(f64::NAN))
            .say(
                ". The whole range of r is compared with one change of start; at the r of the paper most of the distance \
                 from the theory is that of the start. The paper says “perhaps”.",
            ),
    })
}

pub(super) fn restitution_ensures(e: &Evidence, _: &Statement) -> Result<Finding, Error> {
    let found = e.results.of(&RESTITUTION)?;
    let rs: Vec<f64> = found.iter().map(|own| own.ensemble.chain.restitution).collect();
    let own = e.published.parameter("restitution")?;
    let largest = sweep::main(e.results)?.runs.last().map_or(0.0, |row| row.sigma);
    let sigmas = || found[0].ensemble.sigmas.iter().copied().filter(|&sigma| sigma <= largest);
    let Some(strongest) = sigmas().reduce(f64::max) else {
        return Ok(open(Text::words("no run"), "No chain was run at the σ of the paper."));
    };
    let rise = e.results.table("restitution.rise")?;
    // Without an impact there is no contact phase.
    let phases = |r: f64, sigma: f64| {
        let keys = [("r", r), ("sigma", sigma)];
        rise.cell(&keys, "phases").ok()?;
        Some(rise.number(&keys, "phases_per_impact").unwrap_or(0.0))
    };
    let lowest = rs.first().copied().unwrap_or(own);
    let (Some(ours), Some(without)) = (phases(own, strongest), phases(lowest, strongest)) else {
        return Ok(open(
            Text::words("no run"),
            "No chain was run with the restitution of the paper.",
        ));
    };
    // Up to this σ no restitution that was run has any contact.
    let free = |sigma: f64| rs.iter().all(|&r| phases(r, sigma).is_some_and(|x| x == 0.0));
    let without_contact = sigmas().take_while(|&sigma| free(sigma)).last();
    let note = Text::words("Contact phases over impacts.");
    Ok(Finding {
        ours: Text::words("at σ = ")
            .chosen(strongest)
            .say(" a share of ")
            .significant(ours, 1)
            .say(" at r = ")
            .chosen(own)
            .say(", ")
            .significant(without, 1)
            .say(" at r = ")
            .chosen(lowest),
        tolerance: Text::words("at most ")
            .significant(NEGLIGIBLE, 1)
            .say(" at the paper's r, more at another"),
        reason: "ours: one in a thousand, as for sticking in Section 2",
        judgement: Judgement::Plain { agrees: ours <= NEGLIGIBLE && without > NEGLIGIBLE },
        note: match without_contact {
            Some(sigma) => note.say(" Up to σ = ").chosen(sigma).say(
                " no r that was run has any: there the force is too weak to press two masses together, \
                 whatever r is.",
            ),
            None => note,
        },
    })
}

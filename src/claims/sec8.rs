//! Section 8: a relation between σ and p, and what it leaves out.

use super::judge::*;
use super::sec2::NEGLIGIBLE;
use crate::experiments::ensembles::named;
use crate::experiments::protocol::range;
use crate::experiments::starts::{half_height, share_of_start};
use crate::experiments::theory::beside::LARGE_SIGMA;
use crate::experiments::{BRANCHES, PROTOCOL, RESTITUTION, STARTS};
use crate::params::{Protocol, VERTICES};
use impact_chain::rise::RisePoint;
use impact_numerics::estimates::{difference as apart, share};
use impact_numerics::statistics::{Estimate, wilson};

pub const ROWS: &[Judge] = &[
    by("sec8_expected_jump", OurMeasure, expected_jump),
    difference(
        "sec8_separation",
        "Against the equations of motion solved by variation of constants, at five times.",
    )
    .of("Eq. (19)"),
    statistical("sec8_no_impact", OurMeasure, no_impact).of("1 − p = P(Y₀ + Y₁/|ω² − Ω²| < d)"),
    difference("sec8_amplitude", "Against √2 times the root mean square over a period.")
        .of("Eq. (21)"),
    by("sec8_densities", Rounding, |e, s| {
        Ok(s.rounding(e.difference(s)?, 1e-12).note(
            "The probability of Y ≤ x at five x and three σ, against the integral of the two normal \
             densities over a disc; the second also at |ω² − Ω²| = 1/2.",
        ))
    }),
    by("sec8_eq25", Rounding, |e, s| {
        Ok(s.rounding(e.number("theory.relation.difference")?, 1e-12).note(
            "Closed form against the double integral at five σ where the latter has digits left.",
        ))
    })
    .of("Eq. (25)"),
    by("sec8_p_small", OurMeasure, p_small).of("extremely small for σ < {}"),
    by("sec8_large_sigma", OurMeasure, large_sigma),
    statistical("sec8_threshold_shift", OurMeasure, threshold_shift),
    by("sec8_mean_is_easier", OurMeasure, mean_is_easier),
    statistical("sec8_restitution_omitted", OurMeasure, restitution_omitted),
    by("sec8_restitution_ensures", OurMeasure, restitution_ensures),
];

/// A jump stays in one step of the grid, however fine; a slope is shared by all. And weights in
/// proportion to p^k have a mean with the slope Var(X)/p.
fn expected_jump(e: &Evidence, s: &Statement) -> Judged {
    let columns = ["largest_increase", "increase_of_two", "increase_of_all"];
    let [one, two, all] = some(e.numbers("sweep.beside_theory", columns).ok())?;
    let [slope, variance] = e.numbers("theory.jump", ["slope", "variance_over_p"])?;
    let half = e.gaps()? / 2.0;
    let ratio = two / one;
    let found = Text::of(
        "largest step of the mean of the kept between neighbouring σ: {} gaps; in the theory dμ/dp = {} at p_jump",
        [significant(one, 2), significant(slope, 4)],
    );
    Ok(s.found(found, one >= half && !slope.is_finite())
        .within(
            Text::of("a step of at least {}; no finite slope", [significant(half, 3)]),
            "ours: a jump is a step of half the height or more, and has no slope",
        )
        .explained(Text::of(
            "Only the mode of the theory jumps. The simulated rise is steep but gradual: over two steps of the grid the \
             mean of the kept increases {} times as much as over one (a slope gives 2, a jump 1); the largest step of \
             the mean of all is {}. The slope of μ is the variance of X over p, finite for every finite N.",
            [significant(ratio, 2), significant(all, 2)],
        ), ratio > 1.5 && (slope / variance - 1.0).abs() < 1e-6))
}

/// Eq. (20) in the simulation: a chain with random free parts that overlaps at its start, or has an
/// impact later, has a gap with Y₀ + Y₁/|ω² − Ω²| ≥ d.
fn no_impact(e: &Evidence, s: &Statement) -> Judged {
    let random = some(named(e.results.of(&STARTS)?, "random"))?;
    let (mut above, mut telling, mut overlaps, mut chains) = (0, Vec::new(), 0, 0);
    let mut text = Text::default();
    for (row, counted) in random.runs.iter().zip(&random.first().rows) {
        let ran = row.realisations - row.failed;
        let begun = counted.kept + row.rejected;
        let bound = e.number(&format!("theory.gap[sigma={}].any_random", row.sigma));
        let interval = wilson(begun as u64, ran as u64, 1.0 - e.level.each);
        let Some((bound, [low, high])) = bound.ok().zip(interval) else { continue };
        above += usize::from(low > bound);
        let Some(found) = share(begun as u64, ran as u64) else { continue };
        if (0.05..0.95).contains(&bound) {
            text = text.then(Text::of(
                if telling.is_empty() {
                    "share of chains {} of {} at σ = {}"
                } else {
                    "; {} of {} at σ = {}"
                },
                [estimate(&found), significant(bound, 2), chosen(row.sigma)],
            ));
            telling.push((found.value / bound, high < 2.0 / 3.0 * bound));
            (overlaps, chains) = (overlaps + row.rejected, chains + begun);
        }
    }
    some((telling.len() >= 3).then_some(()))?;
    let least = telling.iter().map(|own| own.0).fold(f64::INFINITY, f64::min);
    Ok(s.found(text, above == 0 && !telling.iter().any(|own| own.1))
        .within(
            "none above its bound, none below two thirds of it",
            "intervals at the level of the table; two thirds are ours, for gaps that share a mass \
             and come near their infimum too late",
        )
        .note(Text::of(
            "Chains with random free parts, as Eq. (20) supposes. {} of these {} chains overlap at the start, which \
             Eq. (20) counts as impacts. The bound is 1 − ∏ (1 − p) over all gaps with p of Eq. (25); chains come to at \
             least {} of it.",
            [integer(overlaps), integer(chains), significant(least, 2)],
        )))
}

fn p_small(e: &Evidence, s: &Statement) -> Judged {
    let [crit, jump] = e.numbers("theory.relation", ["sigma_crit", "sigma_jump"])?;
    let printed = s.number()?;
    let p = e.number(&format!("theory.gap[sigma={printed}].p"))?;
    let found = Text::of("p = {} at σ = {}", [significant(p, 3), chosen(printed)]);
    Ok(s.found(found, crit >= s.interval()?[0])
        .within(
            Text::from("below p_crit up to the σ that is printed, ").then(plus_minus(s.half_unit())),
            "ours: “extremely small” as below the first change of k*; and half a unit of the printed digit",
        )
        .note(Text::of(
            "p reaches p_crit at σ = {} and p_jump at {}: within the rounding of the printed value, and below it.",
            [significant(crit, 4), significant(jump, 4)],
        )))
}

fn large_sigma(e: &Evidence, s: &Statement) -> Judged {
    let columns = ["large_distance", "large_distance_at", "large_mean", "large_theory"];
    let [distance, at, mean, theory] = some(e.numbers("sweep.beside_theory", columns).ok())?;
    let gaps = e.gaps()?;
    let limit = gaps / 10.0;
    let found = Text::of(
        "largest distance from σ = {} on: {} gaps",
        [chosen(LARGE_SIGMA), significant(distance, 2)],
    );
    Ok(s.found(found, distance <= limit)
        .within(Text::of("at most {}", [significant(limit, 3)]), "ours: a tenth of all gaps")
        .note(Text::of(
            "Reached at σ = {} (mean of the kept). The tolerance is generous: there the theory misses {} of its {} \
             vertices, the simulation {} of its {} gaps.",
            [
                chosen(at),
                significant(VERTICES as f64 - theory, 2),
                integer(VERTICES),
                significant(gaps - mean, 2),
                integer(gaps as usize),
            ],
        )))
}

fn threshold_shift(e: &Evidence, s: &Statement) -> Judged {
    let (map, chains) = (&e.results.of(&PROTOCOL)?[0], e.results.of(&BRANCHES)?);
    let random = named(chains, "random").map_or(&[][..], |found| &found.curves);
    // Half heights of the mean of all, from rest and with random free parts, for each transient of both.
    let both = random.iter().filter_map(|own| {
        let Protocol { transient, window } = own.protocol;
        let rest = map.curve(transient, window)?.rise.half_height_all?;
        Some((transient, rest, own.rise.half_height_all?))
    });
    let both: Vec<_> = both.collect();
    let half = some(e.sweep()?.first().rise.half_height_all.filter(|_| both.len() > 1))?;
    let theory = e.number("theory.relation.sigma_half")?;
    let allowed = e.half_unit()?;
    let room = e.level.among(both.len());
    let mut holds = true;
    let mut note = Text::from(
        "Means of all, in which no chain is left out. Eq. (25) assumes random free parts. In smaller samples the half \
         height from rest and with them is ",
    );
    for (i, (time, rest, random)) in both.iter().enumerate() {
        let share = share_of_start(rest.value, random.value, theory);
        let error = apart(*random, *rest).error / (theory - rest.value);
        holds &= share > 0.5 - room * error;
        note = note.then(Text::of(
            if i == 0 { "{} and {} at T = {}" } else { ", {} and {} at T = {}" },
            [estimate(rest), estimate(random), integer(*time as usize)],
        ));
    }
    let found = Text::of(
        "half height of the theory at σ = {}, of the simulation at {}",
        [significant(theory, 4), estimate(&half)],
    );
    Ok(s.found(found, (theory - half.value).abs() <= allowed)
        .within(
            plus_minus(allowed),
            "ours: agreement over the whole range as half heights that agree within half a unit of the last digit \
             in which the paper prints the threshold",
        )
        .explained(note.then(
            ". The explanation asks that the start make up more than half of the difference at each T. The \
             simulation goes on falling with T, and the theory knows no time.",
        ), holds))
}

fn mean_is_easier(e: &Evidence, s: &Statement) -> Judged {
    let curve = e.sweep()?.first();
    let [low, high] = [some(curve.rise.onset)?, some(curve.rise.half_height_all)?].map(|x| x.value);
    let rows = curve.rows.iter().filter(|row| low <= row.sigma && row.sigma <= high);
    // Width of the mode's bootstrap interval over that of the mean.
    let ratio = |row: &RisePoint| {
        let ([low, high], [from, to]) = (row.mode_interval?, row.mean?.interval?);
        (to > from).then(|| (high - low) as f64 / (to - from))
    };
    let mut ratios: Vec<f64> = rows.filter_map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    let ratio = *some(ratios.get(ratios.len() / 2))?;
    let found = Text::of(
        "the interval of the mode is {} times as wide as that of the mean",
        [significant(ratio, 2)],
    );
    Ok(s.found(found, ratio >= 2.0)
        .within("at least twice", "ours: “much easier” as at least four times fewer realisations")
        .note("Median over the rows from onset to half height."))
}

fn restitution_omitted(e: &Evidence, s: &Statement) -> Judged {
    let found = e.results.of(&RESTITUTION)?;
    let curves = e.results.table("restitution.curves")?;
    let starts = e.results.of(&STARTS)?;
    let cells = &e.results.of(&PROTOCOL)?[0].curves;
    let halves = curves.estimates(&[], "r", "half_height");
    let restitution = some(range(halves.into_iter().map(|(_, own)| Some(own))))?;
    let time = some(range(cells.iter().map(|cell| cell.rise.half_height_all)))?;
    let of_start = |name| named(starts, name).and_then(half_height);
    let start = some(range(["rest", "random"].into_iter().map(of_start)))?;
    let more = |other: &Estimate| {
        let ahead = apart(restitution, *other);
        ahead.value >= -e.level.quantile * ahead.error
    };
    let text = Text::of(
        "the half height moves by {} with r, by {} with the times of the protocol, by {} with the start",
        [estimate(&restitution), estimate(&time), estimate(&start)],
    );
    let ends = [found.first(), found.last()];
    let ends = ends.map(|own| own.map_or(f64::NAN, |own| own.ensemble.chain.restitution));
    Ok(s.found(text, more(&time) && more(&start))
        .within("most with r", "ours: the ranges over which each was run; and the statistical error")
        .note(Text::of(
            "Means of all; r from {} to {}. The whole range of r is compared with one change of start; at the r of the \
             paper most of the distance from the theory is that of the start. The paper says “perhaps”.",
            ends.map(chosen),
        )))
}

fn restitution_ensures(e: &Evidence, s: &Statement) -> Judged {
    let found = e.results.of(&RESTITUTION)?;
    let rs: Vec<f64> = found.iter().map(|own| own.ensemble.chain.restitution).collect();
    let own = e.published.parameter("restitution")?;
    let largest = e.sweep()?.runs.last().map_or(0.0, |row| row.sigma);
    let sigmas = || found[0].ensemble.sigmas.iter().copied().filter(|&sigma| sigma <= largest);
    let strongest = some(sigmas().reduce(f64::max))?;
    let rise = e.results.table("restitution.rise")?;
    // Without an impact there is no contact phase.
    let phases = |r: f64, sigma: f64| {
        let keys = [("r", r), ("sigma", sigma)];
        rise.number(&keys, "sigma").ok()?;
        Some(rise.number(&keys, "phases_per_impact").unwrap_or(0.0))
    };
    let lowest = rs.first().copied().unwrap_or(own);
    let (ours, without) = (some(phases(own, strongest))?, some(phases(lowest, strongest))?);
    // Up to this σ no restitution that was run has any contact.
    let free = |sigma: f64| rs.iter().all(|&r| phases(r, sigma).is_some_and(|x| x == 0.0));
    let without_contact = sigmas().take_while(|&sigma| free(sigma)).last().map(|sigma| {
        Text::of(
            " Up to σ = {} no r that was run has any: there the force is too weak to press two masses together, \
             whatever r is.",
            [chosen(sigma)],
        )
    });
    let text = Text::of(
        "at σ = {} a share of {} at r = {}, {} at r = {}",
        [
            chosen(strongest),
            significant(ours, 1),
            chosen(own),
            significant(without, 1),
            chosen(lowest),
        ],
    );
    Ok(s.found(text, ours <= NEGLIGIBLE && without > NEGLIGIBLE)
        .within(
            Text::of("at most {} at the paper's r, more at another", [significant(NEGLIGIBLE, 1)]),
            "ours: one in a thousand, as for sticking in Section 2",
        )
        .note(Text::from("Contact phases over impacts.").then(without_contact.unwrap_or_default())))
}

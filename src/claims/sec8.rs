//! Section 8: a relation between σ and p, and its omissions.

use super::judge::*;
use super::sec2::NEGLIGIBLE;
use super::sec6::{RISES, ends, rises};
use crate::experiments::ensembles::named;
use crate::experiments::half_height::half_height_all;
use crate::experiments::protocol::range;
use crate::experiments::starts::share_of_start;
use crate::experiments::theory::beside::{LARGE_SIGMA, largest_distance};
use crate::experiments::{LENGTHS, PROTOCOL, RESTITUTION, STARTS};
use crate::params::{NEAR_SIMULTANEOUS, Protocol, VERTICES};
use impact_chain::rise::{Counted, RisePoint};
use impact_numerics::estimates::share;
use impact_numerics::statistics::{Estimate, wilson};

pub const ROWS: &[Judge] = &[
    by("sec8_expected_jump", OurMeasure, expected_jump),
    difference(
        "sec8_separation",
        "Against the equations of motion solved by variation of constants, at five times.",
    )
    .of("Eq. (19)"),
    statistical("sec8_no_impact", OurMeasure, no_impact).of("1 − p = P(Y₀ + Y₁/|ω² − Ω²| < d)"),
    defined("sec8_amplitude").of("Eq. (21)"),
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
    by("sec8_threshold_shift", OurMeasure, threshold_shift),
    by("sec8_mean_is_easier", OurMeasure, mean_is_easier),
    by("sec8_restitution_omitted", OurMeasure, restitution_omitted),
    by("sec8_restitution_ensures", OurMeasure, restitution_ensures),
    by("sec8_restitution_multiple", OurMeasure, restitution_multiple),
];

/// A jump stays in one step of the grid, however fine; a slope is shared by all. And weights in
/// proportion to p^k have a mean with the slope Var(X)/p.
fn expected_jump(e: &Evidence, s: &Statement) -> Judged {
    let columns = ["step", "largest_increase", "increase_of_two", "increase_of_all"];
    let [step, one, two, all] = some(e.numbers("sweep.beside_theory", columns).ok())?;
    let [slope, variance] = e.numbers("theory.jump", ["slope", "variance_over_p"])?;
    let half = e.gaps()? / 2.0;
    let ratio = two / one;
    let found = Text::of(
        "largest step of the simulated mean, between σ that are {} apart: {} gaps; in the theory dμ/dp = {} at p_jump",
        [chosen(step), significant(one, 2), significant(slope, 4)],
    );
    Ok(s.found(found, one >= half && !slope.is_finite())
        .within(
            Text::of("a step of at least {}; no finite slope", [significant(half, 3)]),
            "ours: a jump is a step of half the height or more, and has no slope",
        )
        .explained(Text::of(
            "Only the mode of the theory jumps. The simulated rise is steep but gradual: over two steps of the grid the \
             mean of the realisations with an impact increases {} times as much as over one (a slope gives 2, a jump 1); the \
             largest step of the mean of all is {}. The slope of μ is the variance of X over p, finite for every finite N.",
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
    let least = telling.iter().map(|point| point.0).fold(f64::INFINITY, f64::min);
    Ok(s.found(text, above == 0 && !telling.iter().any(|point| point.1))
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

/// A shorter transient counts the first impacts of a chain that has just been released (ours).
pub(super) const RELEASED: f64 = 100.0;

/// The simulated means against σ in each window of the map of protocols that does not begin right after the release.
pub(super) fn windows(e: &Evidence) -> Result<Vec<Vec<(f64, f64)>>, Error> {
    let curves = e.results.of(&PROTOCOL)?[0].curves.iter();
    let late = curves.filter(|curve| curve.protocol.transient >= RELEASED);
    let mean = |row: &RisePoint| Some((row.sigma, row.mean?.value));
    Ok(late.map(|curve| curve.rows.iter().filter_map(mean).collect()).collect())
}

fn large_sigma(e: &Evidence, s: &Statement) -> Judged {
    let columns = ["large_distance", "large_distance_at", "large_mean", "large_theory"];
    let [distance, at, mean, theory] = some(e.numbers("sweep.beside_theory", columns).ok())?;
    let gaps = e.gaps()?;
    let limit = gaps / 10.0;
    let curve = e.results.table("theory.curve")?.points(&[], "sigma", "simple");
    let windows = windows(e)?;
    let far = windows.iter().filter_map(|means| Some(largest_distance(means, &curve)?[0]));
    let far = far.fold(distance, f64::max);
    let found = Text::of(
        "largest distance from σ = {} on: {} gaps",
        [chosen(LARGE_SIGMA), significant(distance, 2)],
    );
    Ok(s.found(found, far <= limit)
        .within(Text::of("at most {}", [significant(limit, 3)]), "ours: a tenth of all gaps")
        .note(Text::of(
            "Reached at σ = {}; in all windows of the map with T ≥ {} at most {}. The tolerance is generous: there the theory misses {} of its {} \
             vertices, the simulation {} of its {} gaps.",
            [
                chosen(at),
                chosen(RELEASED),
                significant(far, 2),
                significant(VERTICES as f64 - theory, 2),
                integer(VERTICES),
                significant(gaps - mean, 2),
                integer(gaps as usize),
            ],
        )))
}

/// Judged as the qualitative agreement in Section 6.
fn threshold_shift(e: &Evidence, s: &Statement) -> Judged {
    let both = ends(e)?;
    let half = some(e.sweep()?.first().rise.half_height_all)?;
    let theory = e.number("theory.relation.sigma_half")?;
    let shares = both.iter().flatten().map(|share| significant(*share, 2));
    let found = Text::of("simulated from {} to {} of N, theory from {} to {}", shares);
    Ok(s.found(found, both.into_iter().all(rises))
        .within(RISES, "ours: the least that a common rise must do")
        .note(Text::of(
            "The theory rises later: it passes half of its height at σ = {}, the mean of all realisations at {}. The \
             paper itself finds the agreement poor at small σ.",
            [significant(theory, 4), estimate(&half)],
        )))
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

/// The half heights from rest and with random free parts, of the mean of all, for each transient T that has both.
fn of_starts(e: &Evidence) -> Result<Vec<(f64, Estimate, Estimate)>, Error> {
    let (map, chains) = (&e.results.of(&PROTOCOL)?[0], e.results.of(&LENGTHS)?);
    let random = named(chains, "random").map_or(&[][..], |found| &found.curves);
    let both = random.iter().filter_map(|cell| {
        let Protocol { transient, window } = cell.protocol;
        let rest = map.curve(transient, window)?.rise.half_height_all?;
        Some((transient, rest, cell.rise.half_height_all?))
    });
    Ok(both.collect())
}

/// Part of the distance between theory and simulation is due to the start that the theory assumes, and not to r.
fn restitution_omitted(e: &Evidence, s: &Statement) -> Judged {
    let theory = e.number("theory.relation.sigma_half")?;
    let starts = e.results.of(&STARTS)?;
    let half = |name| some(named(starts, name).and_then(half_height_all));
    let share = share_of_start(half("rest")?, half("random")?, theory);
    let halves = e.results.table("restitution.curves")?.estimates(&[], "r", "half_height");
    let ends = [halves.first(), halves.last()].map(|end| end.map_or(f64::NAN, |end| end.0));
    let moved = some(range(halves.into_iter().map(|(_, own)| Some(own))))?;
    let mut note = Text::from(
        "The paper says “perhaps”, and does not print its start. In smaller samples the share is",
    );
    for (i, (time, rest, random)) in of_starts(e)?.iter().enumerate() {
        let share = share_of_start(*rest, *random, theory);
        note = note.then(Text::of(
            if i == 0 { " {} for T = {}" } else { ", {} for {}" },
            [estimate(&share), integer(*time as usize)],
        ));
    }
    let found = Text::of(
        "from rest the start makes up {} of the distance between theory and simulation",
        [estimate(&share)],
    );
    Ok(s.open(found).note(note.then(Text::of(
        ". The theory assumes random free parts, for which nothing of the distance is due to the start. From r = {} to {} \
         the half height moves by {}, more than with the start.",
        [chosen(ends[0]), chosen(ends[1]), estimate(&moved)],
    ))))
}

/// Shares of all impacts that are contact phases, and that come near another at once, at r and σ.
fn shares(found: &[Counted], r: f64, sigma: f64) -> Option<[f64; 2]> {
    let all = found.iter().find(|all| all.ensemble.chain.restitution == r)?;
    let total = &all.runs.iter().find(|row| row.sigma == sigma)?.total;
    let of = |count: u64| count as f64 / total.impacts.max(1) as f64;
    Some([of(total.contact_phases), of(*total.near.last()?)])
}

/// Chains of every r that was run; the paper's r and the lowest; the σ of the sweep that were run with each.
type Restitutions<'a> = (&'a [Counted], [f64; 2], Vec<f64>);

fn runs<'a>(e: &Evidence<'a>) -> Result<Restitutions<'a>, Error> {
    let found = e.results.of(&RESTITUTION)?;
    let largest = e.sweep()?.runs.last().map_or(0.0, |row| row.sigma);
    let sigmas = found[0].ensemble.sigmas.iter().copied().filter(|&sigma| sigma <= largest);
    let lowest = found[0].ensemble.chain.restitution;
    Ok((found, [e.published.parameter("restitution")?, lowest], sigmas.collect()))
}

/// At strong forces r decides: a share of impacts at the paper's r and at the lowest.
fn ensured(e: &Evidence, s: &Statement, which: usize, note: &str) -> Judged {
    let (found, [r, lowest], sigmas) = runs(e)?;
    let sigma = some(sigmas.last().copied())?;
    let [ours, without] = [r, lowest].map(|r| shares(found, r, sigma).map(|all| all[which]));
    let (ours, without) = (some(ours)?, some(without)?);
    let text = Text::of(
        "at σ = {} a share of {} at r = {}, {} at r = {}",
        [chosen(sigma), significant(ours, 1), chosen(r), significant(without, 1), chosen(lowest)],
    );
    Ok(s.found(text, ours <= NEGLIGIBLE && without > NEGLIGIBLE)
        .within(
            Text::of("at most {} at the paper's r, more at another", [significant(NEGLIGIBLE, 1)]),
            "ours: one in a thousand, as in Section 2",
        )
        .note(note))
}

fn restitution_ensures(e: &Evidence, s: &Statement) -> Judged {
    let (found, _, sigmas) = runs(e)?;
    let rs = || found.iter().map(|of| of.ensemble.chain.restitution);
    let free = |&sigma: &f64| {
        rs().all(|r| shares(found, r, sigma).is_some_and(|[phases, _]| phases == 0.0))
    };
    let check = ensured(e, s, 0, "")?;
    let Some(until) = sigmas.into_iter().take_while(free).last() else {
        return Ok(check.note("Contact phases over impacts."));
    };
    Ok(check.note(Text::of(
        "Contact phases over impacts. Up to σ = {} there are none at any r that was run: two masses alone can stick only \
         if their forces differ by more than d ω².",
        [chosen(until)],
    )))
}

fn restitution_multiple(e: &Evidence, s: &Statement) -> Judged {
    let note = Text::of(
        "Impacts within {} of one in a gap beside theirs, over all. Which the paper means by “multiple” it does not say.",
        [significant(NEAR_SIMULTANEOUS, 1)],
    );
    Ok(ensured(e, s, 1, "")?.note(note))
}

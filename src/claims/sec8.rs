//! Judges Section 8, a relation between σ and p and what it omits.

use super::sec2::NEGLIGIBLE;
use super::sec6::{RISES, ends, rises};
use super::shared::*;
use crate::experiments::protocol::range;
use crate::experiments::starts::share_of_start;
use crate::experiments::sweep;
use crate::experiments::theory::comparison::{LARGE_SIGMA, largest_distance};
use crate::experiments::{LENGTHS, PROTOCOL, RESTITUTION, STARTS};
use crate::params::{NEAR_SIMULTANEOUS, Protocol, VERTICES};
use impact_chain::counts::Total;
use impact_chain::rise::{Counted, RisePoint};
use impact_numerics::estimates::share;
use impact_numerics::statistics::{Estimate, wilson};

pub fn rules() -> Vec<Rule> {
    vec![
        Rule::new("sec8_expected_jump", expected_jump).on(OurMeasure),
        equality(
            "sec8_separation",
            1e-13,
            "Against the equations of motion solved by variation of constants, at five times.",
        )
        .reads("Eq. (19)"),
        Rule::new("sec8_no_impact", no_impact)
            .on(OurMeasure)
            .statistical()
            .reads("1 − p = P(Y₀ + Y₁/|ω² − Ω²| < d)"),
        defined("sec8_amplitude").reads("Eq. (21)"),
        equality(
            "sec8_densities",
            1e-12,
            "The probability of Y ≤ x at five x and three σ, against the integral of the two normal \
         densities over a disc; the second also at |ω² − Ω²| = 1/2.",
        ),
        Rule::new("sec8_eq25", eq25).on(Rounding).reads("Eq. (25)"),
        Rule::new("sec8_p_small", p_small).on(OurMeasure).reads("extremely small for σ < {}"),
        Rule::new("sec8_large_sigma", large_sigma).on(OurMeasure),
        Rule::new("sec8_threshold_shift", threshold_shift).on(OurMeasure),
        Rule::new("sec8_mean_is_easier", mean_is_easier).on(OurMeasure),
        Rule::new("sec8_restitution_omitted", restitution_omitted).on(OurMeasure),
        Rule::new("sec8_restitution_ensures", restitution_ensures).on(OurMeasure),
        Rule::new("sec8_restitution_multiple", restitution_multiple).on(OurMeasure),
    ]
}

fn eq25(e: &Evidence<'_>) -> Judged {
    let note =
        "Closed form against the double integral at five σ where the latter has digits left.";
    Ok(e.rounding(e.number("theory.relation.difference")?, 1e-12).note(note))
}

/// A jump stays in one step of the grid, however fine; a slope is shared by all. And weights in
/// proportion to p^k have a mean with the slope Var(X)/p.
fn expected_jump(e: &Evidence<'_>) -> Judged {
    let columns = ["step", "largest_increase", "increase_of_two", "increase_of_all"];
    let [step, one, two, all] = e.numbers("sweep.against_theory", columns)?;
    let [slope, variance] = e.numbers("theory.jump", ["slope", "variance_over_p"])?;
    let half = e.number("sweep.run.gaps")? / 2.0;
    let ratio = two / one;
    let found = Text::of(
        "largest step of the simulated mean, between σ that are {} apart: {} gaps; in the theory dμ/dp = {} at p_jump",
        [chosen(step), significant(one, 2), significant(slope, 4)],
    );
    Ok(e.found(found, one >= half && !slope.is_finite())
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
fn no_impact(e: &Evidence<'_>) -> Judged {
    let random = ensemble(e.results.of(&STARTS)?, "random")?;
    let (mut above, mut below) = (0, 0);
    let (mut overlaps, mut chains) = (0, 0);
    let mut shares_of_bound = Vec::new();
    let mut text = Text::default();
    for (row, counted) in random.runs.iter().zip(&random.first().rows) {
        let ran = row.realisations - row.failed;
        let begun = counted.kept + row.rejected;
        let bound = e.number(&format!("theory.gap[sigma={}].any_random", row.sigma));
        let interval = wilson(begun as u64, ran as u64, 1.0 - e.level()?.each);
        let Some((bound, [low, high])) = bound.ok().zip(interval) else { continue };
        above += usize::from(low > bound);
        let Some(found) = share(begun as u64, ran as u64) else { continue };
        if (0.05..0.95).contains(&bound) {
            text = text.then(Text::of(
                if shares_of_bound.is_empty() {
                    "share of chains {} of {} at σ = {}"
                } else {
                    "; {} of {} at σ = {}"
                },
                [estimate(&found), significant(bound, 2), chosen(row.sigma)],
            ));
            shares_of_bound.push(found.value / bound);
            below += usize::from(high < 2.0 / 3.0 * bound);
            overlaps += row.rejected;
            chains += begun;
        }
    }
    if shares_of_bound.len() < 3 {
        return Err(Undecided);
    }
    let least = shares_of_bound.into_iter().fold(f64::INFINITY, f64::min);
    Ok(e.found(text, above == 0 && below == 0)
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

fn p_small(e: &Evidence<'_>) -> Judged {
    let [crit, jump] = e.numbers("theory.relation", ["sigma_crit", "sigma_jump"])?;
    let printed = e.statement.number()?;
    let p = e.number(&format!("theory.gap[sigma={printed}].p"))?;
    let found = Text::of("p = {} at σ = {}", [significant(p, 3), chosen(printed)]);
    Ok(e.found(found, crit >= e.statement.interval()?[0])
        .within(
            Text::from("below p_crit up to the σ that is printed, ").then(plus_minus(e.statement.half_unit())),
            "ours: “extremely small” as below the first change of k*; and half a unit of the printed digit",
        )
        .note(Text::of(
            "p reaches p_crit at σ = {} and p_jump at {}: within the rounding of the printed value, and below it.",
            [significant(crit, 4), significant(jump, 4)],
        )))
}

/// A shorter transient counts the first impacts of a chain that has just been released (ours).
pub(super) const RELEASED: f64 = 100.0;

/// Returns the simulated means against σ in each window of the map of protocols that begins late
/// enough after the release.
pub(super) fn windows(e: &Evidence<'_>) -> Result<Vec<Vec<(f64, f64)>>, Error> {
    let curves = ensemble(e.results.of(&PROTOCOL)?, "protocol")?.curves.iter();
    let late = curves.filter(|curve| curve.protocol.transient >= RELEASED);
    let mean = |row: &RisePoint| Some((row.sigma, row.mean?.value));
    Ok(late.map(|curve| curve.rows.iter().filter_map(mean).collect()).collect())
}

fn large_sigma(e: &Evidence<'_>) -> Judged {
    let columns = ["large_distance", "large_distance_at", "large_mean", "large_theory"];
    let [distance, at, mean, theory] = e.numbers("sweep.against_theory", columns)?;
    let gaps = e.number("sweep.run.gaps")?;
    let limit = gaps / 10.0;
    let curve = e.results.table("theory.curve")?.points(&[], "sigma", "simple");
    let windows = windows(e)?;
    let mut far = distance;
    for means in &windows {
        far = largest_distance(means, &curve).map_or(far, |[distance, ..]| far.max(distance));
    }
    let found = Text::of(
        "largest distance from σ = {} on: {} gaps",
        [chosen(LARGE_SIGMA), significant(distance, 2)],
    );
    Ok(e.found(found, far <= limit)
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
fn threshold_shift(e: &Evidence<'_>) -> Judged {
    let both = ends(e)?;
    let half = e.estimate("sweep.rise.half_height_all")?;
    let theory = e.number("theory.relation.sigma_half")?;
    let shares = both.iter().flatten().map(|share| significant(*share, 2));
    let found = Text::of("simulated from {} to {} of N, theory from {} to {}", shares);
    Ok(e.found(found, both.into_iter().all(rises))
        .within(RISES, "ours: the least that a common rise must do")
        .note(Text::of(
            "The theory rises later: it passes half of its height at σ = {}, the mean of all realisations at {}. The \
             paper itself finds the agreement poor at small σ.",
            [significant(theory, 4), estimate(&half)],
        )))
}

fn mean_is_easier(e: &Evidence<'_>) -> Judged {
    let [low, high] = e.numbers("sweep.rise", ["onset", "half_height_all"])?;
    let rows = sweep::main(e.results)?.first().rows.iter();
    let rows = rows.filter(|row| low <= row.sigma && row.sigma <= high);
    // Width of the mode's bootstrap interval over that of the mean.
    let ratio = |row: &RisePoint| {
        let ([low, high], [from, to]) = (row.mode_interval?, row.mean?.interval?);
        (to > from).then(|| (high - low) as f64 / (to - from))
    };
    let mut ratios: Vec<f64> = rows.filter_map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    let ratio = *ratios.get(ratios.len() / 2).ok_or(Undecided)?;
    let found = Text::of(
        "the interval of the mode is {} times as wide as that of the mean",
        [significant(ratio, 2)],
    );
    Ok(e.found(found, ratio >= 2.0)
        .within("at least twice", "ours: “much easier” as at least four times fewer realisations")
        .note("Median over the rows from onset to half height."))
}

/// Returns the half heights from rest and with random free parts, of the mean of all, for each
/// transient T that has both.
fn half_heights_of_starts(e: &Evidence<'_>) -> Result<Vec<(f64, Estimate, Estimate)>, Error> {
    let map = ensemble(e.results.of(&PROTOCOL)?, "protocol")?;
    let mut both = Vec::new();
    for curve in &ensemble(e.results.of(&LENGTHS)?, "random")?.curves {
        let Protocol { transient, window } = curve.protocol;
        let rest = map.curve(transient, window).and_then(|curve| curve.rise.half_height_all);
        if let Some((rest, random)) = rest.zip(curve.rise.half_height_all) {
            both.push((transient, rest, random));
        }
    }
    Ok(both)
}

/// Part of the distance between theory and simulation is due to the start that the theory assumes,
/// and not to r.
fn restitution_omitted(e: &Evidence<'_>) -> Judged {
    let theory = e.number("theory.relation.sigma_half")?;
    let share = e.estimate("starts.against_theory.share")?;
    let halves = e.results.table("restitution.curves")?.estimates(&[], "r", "half_height");
    let [Some((lowest, _)), Some((highest, _))] = [halves.first(), halves.last()] else {
        return Err(Undecided);
    };
    let moved = range(halves.iter().map(|(_, half)| Some(*half))).ok_or(Undecided)?;
    let mut note = Text::from(
        "The paper says “perhaps”, and does not print its start. In smaller samples the share is",
    );
    for (i, (time, rest, random)) in half_heights_of_starts(e)?.iter().enumerate() {
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
    Ok(e.open(found).note(note.then(Text::of(
        ". The theory assumes random free parts, for which nothing of the distance is due to the start. From r = {} to {} \
         the half height moves by {}, more than with the start.",
        [chosen(*lowest), chosen(*highest), estimate(&moved)],
    ))))
}

/// Returns the share of all impacts that `pick` counts at r and σ; none where these were not run.
fn share_at(found: &[Counted], [r, sigma]: [f64; 2], pick: fn(&Total) -> u64) -> Option<f64> {
    let chains = found.iter().find(|chains| chains.ensemble.chain.restitution == r)?;
    let total = &chains.runs.iter().find(|row| row.sigma == sigma)?.total;
    Some(pick(total) as f64 / total.impacts.max(1) as f64)
}

/// Returns the restitutions that were run, from the lowest, and the σ of the sweep that were run
/// with each.
fn restitutions(e: &Evidence<'_>) -> Result<(Vec<f64>, Vec<f64>), Error> {
    let restitutions = e.results.table("restitution.curves")?.values("r");
    let lowest = restitutions.first().ok_or(Undecided)?;
    let lowest = ensemble(e.results.of(&RESTITUTION)?, &format!("r = {lowest}"))?;
    let swept = e.results.table("sweep.rows")?.values("sigma");
    let largest = swept.last().copied().unwrap_or(0.0);
    let sigmas = lowest.ensemble.sigmas.iter().copied().filter(|sigma| *sigma <= largest);
    Ok((restitutions, sigmas.collect()))
}

/// At strong forces r decides: a share of impacts at the paper's r and at the lowest.
fn ensured(e: &Evidence<'_>, pick: fn(&Total) -> u64) -> Judged {
    let (restitutions, sigmas) = restitutions(e)?;
    let [r, lowest] = [e.published.parameter("restitution")?, restitutions[0]];
    let sigma = sigmas.last().copied().ok_or(Undecided)?;
    let share = |r| share_at(e.results.of(&RESTITUTION)?, [r, sigma], pick).ok_or(Undecided);
    let (ours, without) = (share(r)?, share(lowest)?);
    let text = Text::of(
        "at σ = {} a share of {} at r = {}, {} at r = {}",
        [chosen(sigma), significant(ours, 1), chosen(r), significant(without, 1), chosen(lowest)],
    );
    Ok(e.found(text, ours <= NEGLIGIBLE && without > NEGLIGIBLE).within(
        Text::of("at most {} at the paper's r, more at another", [significant(NEGLIGIBLE, 1)]),
        "ours: one in a thousand, as in Section 2",
    ))
}

fn restitution_ensures(e: &Evidence<'_>) -> Judged {
    let (restitutions, sigmas) = restitutions(e)?;
    let found = e.results.of(&RESTITUTION)?;
    let phases = |total: &Total| total.contact_phases;
    let free = |sigma: &f64| {
        restitutions.iter().all(|r| share_at(found, [*r, *sigma], phases) == Some(0.0))
    };
    let check = ensured(e, phases)?;
    let Some(until) = sigmas.into_iter().take_while(free).last() else {
        return Ok(check.note("Contact phases over impacts."));
    };
    Ok(check.note(Text::of(
        "Contact phases over impacts. Up to σ = {} there are none at any r that was run: two masses alone can stick only \
         if their forces differ by more than d ω².",
        [chosen(until)],
    )))
}

fn restitution_multiple(e: &Evidence<'_>) -> Judged {
    let note = Text::of(
        "Impacts within {} of one in a gap beside theirs, over all. Which the paper means by “multiple” it does not say.",
        [significant(NEAR_SIMULTANEOUS, 1)],
    );
    Ok(ensured(e, |total| total.near.last().copied().unwrap_or(0))?.note(note))
}

//! Section 2: the simulation.

use super::judge::*;
use crate::experiments::ensembles::named;
use crate::experiments::half_height::half_height_all;
use crate::experiments::lengths::from_rest;
use crate::experiments::sweep::{expected, mode_half, total};
use crate::experiments::{LENGTHS, PROTOCOL, STARTS, TWO_MASSES, two_masses};
use crate::params::{NEAR_SIMULTANEOUS, Protocol, SLOW};
use impact_chain::rise::{self, Rise};
use impact_numerics::estimates::difference;
use impact_numerics::statistics::Estimate;

pub const ROWS: &[Judge] = &[
    by("sec2_parameters", Exact, parameters),
    by("sec2_few_below", OurMeasure, few_below),
    statistical("sec2_rise_exists", OurMeasure, rise_exists),
    by("sec2_repeated", OurMeasure, repeated),
    by("sec2_half_height", PrintedDigit, half_height).of("σ ≈ {}"),
    by("sec2_onset", PrintedDigit, onset).of("σ ≈ {}"),
    by("sec2_mode_rise", PrintedDigit, mode_rise).of("σ ≈ {}"),
    statistical("sec2_three_way", OurMeasure, three_way),
    by("sec2_sticking", OurMeasure, sticking),
    by("sec2_two_masses", Exact, without_impact),
    by("sec2_percolation", OurMeasure, percolation),
    statistical("sec2_walls_like_masses", PrintedDigit, walls_like_masses),
];

fn parameters(e: &Evidence, s: &Statement) -> Judged {
    let chain = &e.sweep()?.ensemble.chain;
    let (n, d, omega, r) =
        (chain.masses, chain.spacing, chain.natural_frequency, chain.restitution);
    let square = chain.forcing_frequency * chain.forcing_frequency;
    let printed = |id| e.published.parameter(id);
    let pairs = [
        (n as f64, printed("masses")?),
        (d, printed("spacing")?),
        (omega, printed("natural_frequency")?),
        (r, printed("restitution")?),
        (1.0, printed("mass")?),
    ];
    let same_square = (square - printed("forcing_frequency_squared")?).abs() <= 4.0 * f64::EPSILON;
    let reads = s.printed == format!("n = {n}, d = m = ω = {d}, Ω = √{}, r = {r}", square.round());
    let found = Text::of(
        "n = {}, d = {}, ω = {}, Ω² = {}, r = {}",
        [integer(n), chosen(d), chosen(omega), significant(square, 1), chosen(r)],
    );
    let same = pairs.iter().all(|(ours, printed)| ours == printed);
    Ok(s.found(found, reads && same_square && same).within("none", "the same numbers").note(
        "The paper prints neither initial condition nor transient nor window; for these it refers \
         to Homer (1999).",
    ))
}

/// The largest σ below about two thirds of the printed threshold (0.67, so that 0.08 is one).
pub(super) fn small<'a>(e: &Evidence<'a>) -> Result<&'a rise::RisePoint, Error> {
    let threshold = e.published.statement("sec2_half_height")?.number()?;
    some(e.sweep()?.first().rows.iter().rev().find(|row| row.sigma < 0.67 * threshold))
}

/// “Very few” is at most N over this (ours).
pub(super) const VERY_FEW: f64 = 20.0;

/// By the mean of the realisations with an impact, in each window of the map of protocols.
fn few_below(e: &Evidence, s: &Statement) -> Judged {
    let row = small(e)?;
    let mean = |mean: Option<rise::Mean>| some(mean.and_then(|mean| mean.estimate()));
    let limit = e.gaps()? / VERY_FEW;
    let found = Text::of(
        "at σ = {} the mean of realisations with an impact is {}, of all {}",
        [chosen(row.sigma), estimate(&mean(row.mean)?), estimate(&mean(row.mean_all)?)],
    );
    let windows = &e.results.of(&PROTOCOL)?[1].curves;
    let means: Vec<Estimate> =
        windows.iter().filter_map(|curve| mean(curve.rows.first()?.mean).ok()).collect();
    let few = means.iter().filter(|mean| mean.value <= limit).count();
    let [Some(first), Some(last)] = [means.first(), means.last()] else {
        return Err(Error::Undecided);
    };
    let check = if few == 0 || few == means.len() {
        let reason =
            "ours: “very few” as a twentieth of all gaps, at two thirds of the printed threshold";
        s.found(found, few > 0).within(Text::of("at most {}", [significant(limit, 2)]), reason)
    } else {
        s.open(found)
    };
    Ok(check.note(Text::of(
        "Of {} pairs of transient T and window W, which are not printed, {} give at most {}, a twentieth of all gaps: from {} \
         in the shortest window after the shortest transient to {} in the longest. Only {} of {} realisations have an impact, \
         but in these impacts spread.",
        [integer(means.len()), integer(few), significant(limit, 2), estimate(first), estimate(last), integer(row.kept), integer(row.ran)],
    )))
}

fn rise_exists(e: &Evidence, s: &Statement) -> Judged {
    let rise = &e.sweep()?.first().rise;
    let (width, half) = (some(rise.kept_width)?, some(rise.half_height)?);
    let share = width.value / half.value;
    let [a, b] = [&width, &half].map(|x| (x.error / x.value) * (x.error / x.value));
    let error = share * (a + b).sqrt();
    let found = Text::of(
        "a quarter to three quarters of all gaps within {} of σ½",
        [super::with_error(share, error)],
    );
    let reason =
        "ours: a response in proportion to σ would take all of σ½; and the statistical error";
    let more = rise.width.map(|width| {
        let more = " The mean of all rises from a tenth to nine tenths within Δσ = {}.";
        Text::of(more, [estimate(&width)])
    });
    let map = &e.results.of(&PROTOCOL)?[0].curves;
    let shares = map
        .iter()
        .filter_map(|curve| Some(curve.rise.kept_width?.value / curve.rise.half_height?.value));
    let shares: Vec<f64> = shares.collect();
    let [least, most] = [f64::min, f64::max].map(|end| shares.iter().copied().reduce(end));
    let windows = least.zip(most).map(|(least, most)| {
        let range = " In {} of the {} windows of the map of protocols the share is known, and lies from {} to {}.";
        let [known, all] = [shares.len(), map.len()].map(integer);
        Text::of(range, [known, all, significant(least, 2), significant(most, 2)])
    });
    Ok(s.found(found, share <= 0.5 + e.level.quantile * error).within("at most half", reason).note(
        Text::from(WITH_AN_IMPACT).then(more.unwrap_or_default()).then(windows.unwrap_or_default()),
    ))
}

const WITH_AN_IMPACT: &str = "Judged by the mean of the realisations with at least one impact.";

/// Impacts in the window for each gap that has any, at the printed threshold.
fn repeated(e: &Evidence, s: &Statement) -> Judged {
    let threshold = e.published.statement("sec2_half_height")?.number()?;
    let row = e.sweep()?.first().rows.iter().find(|row| row.sigma == threshold);
    let each = some(row.and_then(|row| Some(row.impacts?.value / row.mean?.value)))?;
    let found = Text::of(
        "{} impacts for each gap that has any, at σ = {}",
        [significant(each, 2), chosen(threshold)],
    );
    Ok(s.found(found, each >= 10.0)
        .within(Text::of("at least {}", [integer(10)]), "ours: a measure of “many repeated”")
        .note(
            "In the window of our protocol. Impacts go on: a longer window has more, and a short one cannot have many.",
        ))
}

const LAST_DIGIT: &str =
    "half a unit of the last printed digit, and the statistical error at the level of the table";

/// Why a place of the rise cannot be judged: in how many windows of the map it has the printed digits, and where it lies
/// after each transient.
fn undecided(
    e: &Evidence,
    s: &Statement,
    place: fn(&Rise) -> Option<Estimate>,
) -> Result<Text, Error> {
    let map = &e.results.of(&PROTOCOL)?[0];
    let [from, to] = s.interval()?;
    let printed = map.curves.iter().filter_map(|curve| place(&curve.rise));
    let printed = printed.filter(|at| (from..to).contains(&at.value)).count();
    let mut text = Text::of(
        "The protocol, which is not printed, decides. The printed digits come from {} of {} pairs of transient T and window W. \
         From the narrowest W to the widest that has such a place:",
        [integer(printed), integer(map.curves.len())],
    );
    for of_one in map.curves.chunk_by(|a, b| a.protocol.transient == b.protocol.transient) {
        let places: Vec<Estimate> = of_one.iter().filter_map(|curve| place(&curve.rise)).collect();
        let [Some(first), Some(last)] = [places.first(), places.last()] else { continue };
        text = text.then(Text::of(
            if of_one[0] == map.curves[0] { " {} to {} for T = {}" } else { ", {} to {} for {}" },
            [estimate(first), estimate(last), integer(of_one[0].protocol.transient as usize)],
        ));
    }
    Ok(text.then("."))
}

/// `found`, with the protocol of the sweep.
fn ours(e: &Evidence, found: Text) -> Result<Text, Error> {
    let Protocol { transient, window } = e.sweep()?.first().protocol;
    let protocol = [transient, window].map(|time| integer(time as usize));
    Ok(found.then(Text::of(" with T = {}, W = {}, from rest", protocol)))
}

fn half_height(e: &Evidence, s: &Statement) -> Judged {
    let half = some(e.sweep()?.first().rise.half_height)?;
    let found = ours(e, Text::of("σ½ = {}", [estimate(&half)]))?;
    Ok(s.open(found)
        .note(Text::from(WITH_AN_IMPACT).then(" ").then(undecided(e, s, |rise| rise.half_height)?)))
}

fn onset(e: &Evidence, s: &Statement) -> Judged {
    let onset = some(e.sweep()?.first().rise.onset)?;
    let found = ours(e, Text::of("σ = {}", [estimate(&onset)]))?;
    let note = Text::from(
        "Judged by the mean of all: where any realisation has an impact, the mean of those is above a twentieth. ",
    );
    Ok(s.open(found).note(note.then(undecided(e, s, |rise| rise.onset)?)))
}

/// The mode passes half of all gaps within a range of σ; it agrees if this meets the printed digits.
fn mode_rise(e: &Evidence, s: &Statement) -> Judged {
    let sweep = e.sweep()?;
    let [low, high] = some(mode_half(sweep.first(), sweep.ensemble.chain.gaps()))?;
    let [from, to] = s.interval()?;
    let found = ours(e, Text::of("between σ = {} and {}", [chosen(low), chosen(high)]))?;
    let map = &e.results.of(&PROTOCOL)?[0];
    let halves = map.curves.iter().filter_map(|curve| mode_half(curve, map.ensemble.chain.gaps()));
    let ranges: Vec<[f64; 2]> = halves.collect();
    let meets = ranges.iter().filter(|[low, high]| *low <= to && *high >= from).count();
    Ok(s.open(found).note(Text::of(
        "The protocol, which is not printed, decides. The mode is known to the range of σ in which its bootstrap interval \
         reaches over half of all gaps; of the {} protocols with such a range {} have one that meets the printed digits. \
         It follows the mean.",
        [integer(ranges.len()), integer(meets)],
    )))
}

/// Share of impacts that may be called negligible (ours).
pub(super) const NEGLIGIBLE: f64 = 1e-3;

fn three_way(e: &Evidence, s: &Statement) -> Judged {
    let total = total(e.sweep()?);
    let seen = *some(total.near.last())?;
    let ([expected, _], impacts) = (expected(&total), total.impacts as f64);
    // Counts of rare events: Poisson, with one event of room where almost none are expected.
    let room = e.level.quantile * expected.sqrt() + 1.0 + e.level.quantile;
    let share = expected.max(seen as f64) / impacts;
    // Masses in contact pass a hit on to one another at once.
    let passed_on = total.contact_phases as f64;
    let excess = seen as f64 - expected;
    let found = Text::of(
        "{} of {} impacts within {} of one next to it",
        [integer(seen as usize), significant(impacts, 2), significant(NEAR_SIMULTANEOUS, 1)],
    );
    let reason = "ours: one in a thousand; and the count must be what one expects by chance, but for hits \
                  that masses in contact pass on to one another at once, one for each contact phase";
    Ok(s.found(found, share <= NEGLIGIBLE && (-room..=room + passed_on).contains(&excess))
        .within(Text::of("a share of {}", [significant(NEGLIGIBLE, 1)]), reason)
        .note(Text::of(
            "The share within δ falls in proportion to δ; by chance one expects {} such impacts, and none at δ = 0.",
            [significant(expected, 2)],
        )))
}

fn sticking(e: &Evidence, s: &Statement) -> Judged {
    let total = total(e.sweep()?);
    let (impacts, contacts, slow) =
        (total.impacts, total.contact_phases, *some(total.slow.last())?);
    let share = some((impacts > 0).then(|| contacts as f64 / impacts as f64))?;
    let found = Text::of(
        "{} contact phases in {} impacts",
        [integer(contacts as usize), significant(impacts as f64, 2)],
    );
    Ok(s.found(found, share <= NEGLIGIBLE)
        .within(Text::of("a share of {}", [significant(NEGLIGIBLE, 1)]), "ours: one in a thousand")
        .note(Text::of(
            "Two masses alone can stick only if their forces differ by more than d ω². {} impacts were slower \
             than {}.",
            [integer(slow as usize), significant(SLOW, 1)],
        )))
}

fn without_impact(e: &Evidence, s: &Statement) -> Judged {
    let found = e.results.of(&TWO_MASSES)?;
    let least = some(found.excess.iter().map(|pair| pair[0]).reduce(f64::min))?;
    let safe = two_masses::safe_force(&found.parameters.directions.chain);
    let text = Text::of(
        "{} impacts below the force that the amplitudes allow; smallest force with an impact, over that bound: {}",
        [integer(found.violations as usize), significant(least, 6)],
    );
    let reason =
        "a gap whose amplitudes add up to less than d never closes; rounding of the bracket aside";
    Ok(s.found(text, found.violations == 0 && least >= 1.0 - 1e-9 && safe > 0.0)
        .within("none below 1", reason)
        .note(Text::of(
            "No direction of the forces lets the masses meet below an amplitude of {} on each.",
            [significant(safe, 4)],
        )))
}

fn walls_like_masses(e: &Evidence, s: &Statement) -> Judged {
    let starts = e.results.of(&STARTS)?;
    let half = |name| some(named(starts, name).and_then(half_height_all));
    let apart = difference(half("ring")?, half("rest")?);
    let allowed = e.half_unit()?;
    let agrees = apart.value.abs() <= allowed + e.level.quantile * apart.error;
    Ok(s.found(Text::of("σ½ of the mean of all differs by {}", [estimate(&apart)]), agrees)
        .within(plus_minus(allowed), LAST_DIGIT)
        .note(
            "A ring has N = n gaps, a chain between walls N = n + 1. After longer transients a ring rises somewhat \
             earlier.",
        ))
}

/// The threshold of percolation sharpens with size. The paper compares without a quantity.
fn percolation(e: &Evidence, s: &Statement) -> Judged {
    let transient = e.sweep()?.first().protocol.transient;
    let widths = from_rest(e.results.of(&LENGTHS)?)
        .filter(|(_, curve)| curve.protocol.transient == transient)
        .filter_map(|(chains, curve)| Some((chains.ensemble.chain.masses, curve.rise.width?)));
    let mut widths: Vec<_> = widths.filter(|(masses, _)| *masses >= 100).collect();
    widths.sort_by_key(|(masses, _)| *masses);
    let found = match (widths.first(), widths.last()) {
        (Some((n, short)), Some((most, long))) if most > n => Text::of(
            "width of the rise {} for n = {}, {} for n = {}",
            [estimate(short), integer(*n), estimate(long), integer(*most)],
        ),
        _ => "chains of one length only".into(),
    };
    Ok(s.open(found).note(
        "The paper names a likeness and no number. The threshold of percolation becomes sharp in a large system; this rise, \
         after the same transient, does not.",
    ))
}

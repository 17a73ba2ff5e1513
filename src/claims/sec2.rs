//! Judges Section 2, the simulation.

use super::shared::*;
use crate::experiments::TWO_MASSES;
use impact_chain::mode_jump::Passing;

pub fn rules() -> Vec<Rule> {
    let own = Chain::default();
    let (omega, forcing) = (own.natural_frequency, own.forcing_frequency);
    let chain = [("masses", own.masses as f64), ("spacing", own.spacing), ("mass", 1.0)];
    let times = [("natural_frequency", omega), ("forcing_frequency_squared", forcing * forcing)];
    let times = times.map(|(id, value)| (id, value.round()));
    let chain = [&chain[..], &times, &[("restitution", own.restitution)]].concat();
    vec![
        Rule::new("sec2_parameters", parameters).uses(&chain),
        Rule::new("sec2_few_below", few_below).on(OurMeasure),
        Rule::new("sec2_none_below", none_below).on(OurMeasure).statistical(),
        Rule::new("sec2_rise_exists", rise_exists).on(OurMeasure).statistical(),
        Rule::new("sec2_jump", jump).on(OurMeasure),
        Rule::new("sec2_mode_jump", mode_jump).on(OurMeasure),
        Rule::new("sec2_repeated", repeated).on(OurMeasure),
        Rule::new("sec2_half_height", |e| by_protocol(e, "half_height", |rise| rise.half_height))
            .on(PrintedDigit)
            .reads("σ ≈ 0.12"),
        Rule::new("sec2_onset", |e| by_protocol(e, "onset", |rise| rise.onset))
            .on(PrintedDigit)
            .reads("σ ≈ 0.12"),
        Rule::new("sec2_mode_rise", mode_rise).on(PrintedDigit).reads("σ ≈ 0.12"),
        Rule::new("sec2_three_way", three_way).on(OurMeasure).statistical(),
        Rule::new("sec2_sticking", sticking).on(OurMeasure),
        Rule::new("sec2_two_masses", without_impact).on(FiniteCases),
        Rule::new("sec2_percolation", percolation).on(OurMeasure),
        Rule::new("sec2_walls_like_masses", walls_like_masses).on(OurMeasure),
    ]
}

fn parameters(e: &Evidence<'_>) -> Judged {
    let chain = &sweep::main_sweep(e.results)?.ensemble.chain;
    let Chain { masses: n, spacing: d, natural_frequency: omega, restitution: r, .. } = *chain;
    let square = chain.forcing_frequency * chain.forcing_frequency;
    let printed = e.published.parameter("forcing_frequency_squared")?;
    let same = (square - printed).abs() <= 4.0 * f64::EPSILON && omega == d;
    let words = format!("n = {n}, d = m = ω = {d}, Ω = √{}, r = {r}", square.round());
    e.check(same && e.statement.printed == words, numbers![n, d, omega, square, r])
}

/// Finds the row of the sweep with the largest σ below about two thirds of the printed threshold
/// (0.67, so that 0.08 is one).
pub(super) fn small_force<'a>(e: &Evidence<'a>) -> Result<&'a RisePoint, Error> {
    let threshold = e.published.statement("sec2_half_height")?.number()?;
    let rows = &sweep::main_sweep(e.results)?.first_curve().rows;
    rows.iter().rev().find(|row| row.sigma < 0.67 * threshold).ok_or(Undecided)
}

/// “Very few” is at most N over this (ours).
pub(super) const VERY_FEW: f64 = 20.0;

/// Returns the row of the smallest σ in each window of the map that begins late enough.
fn small_in_windows<'a>(e: &Evidence<'a>) -> Result<Vec<&'a RisePoint>, Error> {
    Ok(late_curves(e, "sweep")?.iter().filter_map(|curve| curve.rows.first()).collect())
}

/// By the mean of the active realisations, in each window of the map of protocols.
fn few_below(e: &Evidence<'_>) -> Judged {
    let row = small_force(e)?;
    let here = e.estimate(&format!("sweep.rows[sigma={}].mean", row.sigma))?;
    let limit = e.number("sweep.run.gaps")? / VERY_FEW;
    let means = small_in_windows(e)?.into_iter().filter_map(|row| row.mean?.estimate());
    let means: Vec<Estimate> = means.collect();
    let few = means.iter().filter(|mean| mean.value <= limit).count();
    let [first, .., last] = means[..] else { return Err(Undecided) };
    let (all, released) = (means.len(), RELEASED);
    let RisePoint { sigma, active: kept, ran, .. } = *row;
    e.check(
        by_runs([few, all - few, all]),
        numbers![sigma, here, limit, all, released, few, first, last, kept, ran],
    )
}

/// By the share of the active realisations, with its interval, in each window of the map.
fn none_below(e: &Evidence<'_>) -> Judged {
    let row = small_force(e)?;
    let here = e.estimate(&format!("sweep.rows[sigma={}].kept", row.sigma))?;
    let limit = 1.0 / VERY_FEW;
    let (rows, level) = (small_in_windows(e)?, 1.0 - e.level()?.each);
    let intervals = rows.iter().filter_map(|row| wilson(row.active as u64, row.ran as u64, level));
    let none = intervals.clone().filter(|[_, high]| *high <= limit).count();
    let some = intervals.filter(|[low, _]| *low > limit).count();
    let shares = rows.iter().map(|row| row.active as f64 / row.ran as f64);
    let [least, most] = extremes(shares).ok_or(Undecided)?;
    let random = e.number(&format!("theory.gap[sigma={}].any_random", row.sigma))?;
    let half = e.estimate("sweep.rise.kept_half")?;
    let (all, sigma, released) = (rows.len(), row.sigma, RELEASED);
    e.check(
        by_runs([none, some, all]),
        numbers![here, sigma, limit, least, most, all, released, none, some, random, half],
    )
}

/// A jump stays in one step of the grid, however fine; a slope is shared by all.
fn jump(e: &Evidence<'_>) -> Judged {
    let columns = ["step", "largest_increase", "increase_of_two", "increase_of_all"];
    let [step, one, two, all] = e.numbers("sweep.against_theory", columns)?;
    let tenth = e.number("sweep.run.gaps")? / 10.0;
    let ratio = two / one;
    Ok(e.check(one >= tenth, numbers![step, one, tenth, ratio, all])?.explained_if(ratio > 1.5))
}

/// Returns where the mode passes to all gaps in each window that begins late enough.
fn passings<'a>(e: &Evidence<'a>) -> Result<Vec<(Protocol, &'a Passing)>, Error> {
    let windows = e.results.of(&MODE_JUMP)?.windows.iter();
    let passing = windows.map(|window| (window.protocol, &window.jump.all_gaps));
    Ok(passing.filter(|(protocol, _)| protocol.transient >= RELEASED).collect())
}

/// In each window whose half height has the printed digits, by the criterion of
/// [`impact_chain::mode_jump`].
fn mode_jump(e: &Evidence<'_>) -> Judged {
    let [transient, window] = e.numbers("sweep.run", ["transient", "window"])?;
    let row = format!("jump.windows[transient={transient},window={window}]");
    let estimate = |name| e.estimate(&format!("{row}.{name}"));
    let (place, below) = (estimate("place")?, estimate("below")?);
    let gaps = e.number("sweep.run.gaps")?;
    let half_heights = late_curves(e, "protocol")?;
    let [from, to] = e.published.statement("sec2_half_height")?.interval()?;
    let has_printed_digits = |protocol: Protocol| {
        let mut halves = half_heights.iter().filter(|curve| curve.protocol == protocol);
        let half = halves.find_map(|curve| curve.rise.half_height);
        half.is_some_and(|half| (from..to).contains(&half.value))
    };
    let passings = passings(e)?.into_iter().filter(|(protocol, _)| has_printed_digits(*protocol));
    let outcomes: Vec<_> = passings.map(|(_, passing)| passing.is_jump()).collect();
    let [jumps, climbs] =
        [true, false].map(|sure| outcomes.iter().filter(|jump| **jump == Some(sure)).count());
    let run = e.results.of(&MODE_JUMP)?;
    let single = run.windows.iter().filter(|w| w.jump.single_gap.is_jump() == Some(true)).count();
    let [windows, sure, no] = e.numbers("jump.run", ["windows", "jumps", "climbs"])?;
    let (all, tenth, released) = (outcomes.len(), gaps / 10.0, RELEASED);
    let numbers = numbers![
        below, gaps, place, transient, window, tenth, all, released, jumps, climbs, windows, sure,
        no
    ];
    let check = e.check(by_runs([jumps, climbs, all]), numbers)?;
    let [Ok(lower), Ok(above)] = ["single_place", "single_above"].map(estimate) else {
        return Ok(check);
    };
    let is_sure = e.number(&format!("{row}.single_jumps")).is_ok();
    let key = if is_sure { "note_single" } else { "note_single_open" };
    Ok(with_more(check, e.sentence(key, numbers![lower, above, single])?))
}

/// Against a chain in which each gap closes by itself: its rise from a quarter to three quarters,
/// over its half height, is what a rise without any spreading of impacts takes.
fn rise_exists(e: &Evidence<'_>) -> Judged {
    let width = e.estimate("sweep.rise.kept_width")?;
    let half = e.estimate("sweep.rise.half_height")?;
    let columns = ["alone_quarter", "alone_half", "alone_three_quarters"];
    let [quarter, middle, three_quarters] = e.numbers("theory.relation", columns)?;
    let share = width.value / half.value;
    let limit = 0.5 * (three_quarters - quarter) / middle;
    let [a, b] = [&width, &half].map(|x| (x.error / x.value) * (x.error / x.value));
    let error = share * (a + b).sqrt();
    let windows = late_curves(e, "protocol")?;
    let share_in =
        |window: &&Curve| Some(window.rise.kept_width?.value / window.rise.half_height?.value);
    let shares: Vec<f64> = windows.iter().filter_map(share_in).collect();
    let [least, most] = extremes(shares.iter().copied()).ok_or(Undecided)?;
    let (all_rise, known) = (e.estimate("sweep.rise.width")?, shares.len());
    let agrees = share <= limit + e.level()?.quantile * error;
    let (share, windows, released) = (with_error(share, error), windows.len(), RELEASED);
    e.check(agrees, numbers![share, limit, all_rise, known, windows, released, least, most])
}

/// Impacts in the window for each gap that has any, where σ is large.
fn repeated(e: &Evidence<'_>) -> Judged {
    let row = format!("sweep.rows[sigma={LARGE_SIGMA}]");
    let [impacts, gaps] = e.numbers(&row, ["impacts", "mean"])?;
    let [each, window] = [impacts / gaps, e.number("sweep.run.window")?];
    let (sigma, time) = (LARGE_SIGMA, window / each);
    e.check(None, numbers![each, sigma, window, time])
}

/// Judges a place of the rise by the windows of the map that begin late enough, and by those of
/// chains with random free parts: the number of them in which it has the printed digits decides.
fn by_protocol(e: &Evidence<'_>, name: &str, place: fn(&Rise) -> Option<Estimate>) -> Judged {
    let [from, to] = e.statement.interval()?;
    let [mut agree, mut known, mut all] = [0; 3];
    let mut pieces = Vec::new();
    let random = ensemble(e.results.of(&LENGTHS)?, "random")?.curves.iter().collect();
    for (windows, key) in
        [late_curves(e, "protocol")?, random].into_iter().zip(["note_rest", "note_random"])
    {
        let mut places = Vec::from_iter(windows.iter().filter_map(|curve| place(&curve.rise)));
        places.sort_by(|a, b| a.value.total_cmp(&b.value));
        let printed = places.iter().filter(|place| (from..to).contains(&place.value)).count();
        (agree, known, all) = (agree + printed, known + places.len(), all + windows.len());
        if let [Some(least), Some(most)] = [places.first(), places.last()] {
            let (known, windows, released) = (places.len(), windows.len(), RELEASED);
            let numbers = numbers![known, windows, released, least = *least, most = *most, printed];
            pieces.push(e.sentence(key, numbers)?);
        }
    }
    let place = e.estimate(&format!("sweep.rise.{name}"))?;
    let [transient, window] = e.numbers("sweep.run", ["transient", "window"])?;
    let half_unit = e.statement.half_unit();
    let agrees = by_runs([agree, known - agree, all]);
    let check = e.check(agrees, numbers![place, transient, window, half_unit])?;
    Ok(pieces.into_iter().fold(check, with_more))
}

/// Judges the place of the jump by the windows in which the mode surely jumps. Longer ones are in
/// the map of protocols, whose samples give a range of σ only.
fn mode_rise(e: &Evidence<'_>) -> Judged {
    let [transient, window] = e.numbers("sweep.run", ["transient", "window"])?;
    let row = format!("jump.windows[transient={transient},window={window}]");
    let place = e.estimate(&format!("{row}.place"))?;
    let [from, to] = e.statement.interval()?;
    let jumps = passings(e)?.into_iter().filter(|(_, passing)| passing.is_jump() == Some(true));
    let mut places: Vec<Estimate> = jumps.filter_map(|(_, passing)| passing.sigma).collect();
    places.sort_by(|a, b| a.value.total_cmp(&b.value));
    let [least, .., most] = places[..] else { return Err(Undecided) };
    let printed = places.iter().filter(|place| (from..to).contains(&place.value)).count();
    let all = places.len();
    let ends = passings(e)?.into_iter().map(|(protocol, _)| protocol.end());
    let longest = ends.reduce(f64::max).ok_or(Undecided)?;
    let gaps = e.number("sweep.run.gaps")? as usize;
    let beyond =
        late_curves(e, "protocol")?.into_iter().filter(|curve| curve.protocol.end() > longest);
    let ranges: Vec<[f64; 2]> = beyond.filter_map(|curve| sweep::mode_half(curve, gaps)).collect();
    let apart = ranges.iter().filter(|[low, high]| to < *low || *high < from).count();
    let (ranges, released, half_unit) = (ranges.len(), RELEASED, e.statement.half_unit());
    let numbers = numbers![
        place, transient, window, half_unit, all, released, least, most, printed, ranges, apart
    ];
    let check = e.check(by_runs([printed, all - printed, all]), numbers)?;
    let Ok(ring) = e.estimate("jump.ring.place") else { return Ok(check) };
    Ok(with_more(check, e.sentence("note_ring", numbers![ring])?))
}

/// Share of impacts that may be called negligible (ours).
pub(super) const NEGLIGIBLE: f64 = 1e-3;

fn three_way(e: &Evidence<'_>) -> Judged {
    let impacts = e.number("sweep.run.impacts")?;
    let columns = ["near_simultaneous", "near_expected", "contact_phases"];
    let [seen, expected, phases] = e.numbers("sweep.rare", columns)?;
    // Counts of rare events: Poisson, with one event of room where almost none are expected.
    let quantile = e.level()?.quantile;
    let room = quantile * expected.sqrt() + 1.0 + quantile;
    let share = expected.max(seen) / impacts;
    // Masses in contact pass a hit on to one another at once.
    let by_chance = (-room..=room + phases).contains(&(seen - expected));
    let (near, negligible) = (NEAR_SIMULTANEOUS, NEGLIGIBLE);
    let reached = near * negligible * impacts / expected;
    e.check(
        share <= negligible && by_chance,
        numbers![seen, impacts, near, negligible, reached, expected],
    )
}

fn sticking(e: &Evidence<'_>) -> Judged {
    let impacts = e.number("sweep.run.impacts")?;
    let [phases, slow] = e.numbers("sweep.rare", ["contact_phases", "slow"])?;
    if impacts == 0.0 {
        return Err(Undecided);
    }
    let (negligible, speed) = (NEGLIGIBLE, SLOW);
    e.check(phases / impacts <= negligible, numbers![phases, impacts, negligible, slow, speed])
}

fn without_impact(e: &Evidence<'_>) -> Judged {
    let two_masses = e.results.of(&TWO_MASSES)?;
    let least = two_masses.excess.iter().map(|pair| pair[0]).reduce(f64::min).ok_or(Undecided)?;
    let safe = e.number("two_masses.bound.force")?;
    let violations = two_masses.violations;
    let agrees = violations == 0 && least >= 1.0 - 1e-9 && safe > 0.0;
    let directions = e.number("two_masses.bound.directions")?;
    e.check(agrees, numbers![violations, least, directions, safe])
}

fn walls_like_masses(e: &Evidence<'_>) -> Judged {
    let difference = e.estimate("starts.variants[chain=ring].difference")?;
    let allowed = half_unit(e)?;
    let check = e.check(difference.value.abs() <= allowed, numbers![difference, allowed])?;
    let Ok(mode) = e.estimate("jump.ring.difference") else { return Ok(check) };
    Ok(with_more(check, e.sentence("note_mode", numbers![mode])?))
}

/// The threshold of percolation sharpens with size. The paper compares without a quantity.
fn percolation(e: &Evidence<'_>) -> Judged {
    let [transient, window] = e.numbers("sweep.run", ["transient", "window"])?;
    let [n, most] = [e.published.parameter("masses")?, e.number("lengths.all.longest")?];
    let width = |masses: f64| {
        let row = format!("lengths.rest[masses={masses},transient={transient},window={window}]");
        e.estimate(&format!("{row}.width"))
    };
    e.check(None, numbers![width = width(n)?, n, width_of_most = width(most)?, most])
}

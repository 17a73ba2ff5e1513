//! Judges Section 2, the simulation.

use super::shared::*;
use crate::experiments::rise::{Curve, Rise, RisePoint};
use crate::experiments::sweep::{self, mode_half};
use crate::experiments::theory::comparison::LARGE_SIGMA;
use crate::experiments::{JUMP, LENGTHS, TWO_MASSES};
use crate::params::{NEAR_SIMULTANEOUS, Protocol, SLOW};
use impact_chain::mode_jump::Passing;
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::{Estimate, wilson};

pub fn rules() -> Vec<Rule> {
    vec![
        Rule::new("sec2_parameters", parameters),
        Rule::new("sec2_few_below", few_below).on(OurMeasure),
        Rule::new("sec2_none_below", none_below).on(OurMeasure).statistical(),
        Rule::new("sec2_rise_exists", rise_exists).on(OurMeasure).statistical(),
        Rule::new("sec2_jump", jump).on(OurMeasure),
        Rule::new("sec2_mode_jump", mode_jump).on(OurMeasure),
        Rule::new("sec2_repeated", repeated).on(OurMeasure),
        Rule::new("sec2_half_height", half_height).on(PrintedDigit).reads("σ ≈ {}"),
        Rule::new("sec2_onset", onset).on(PrintedDigit).reads("σ ≈ {}"),
        Rule::new("sec2_mode_rise", mode_rise).on(PrintedDigit).reads("σ ≈ {}"),
        Rule::new("sec2_three_way", three_way).on(OurMeasure).statistical(),
        Rule::new("sec2_sticking", sticking).on(OurMeasure),
        Rule::new("sec2_two_masses", without_impact).on(FiniteCases),
        Rule::new("sec2_percolation", percolation).on(OurMeasure),
        Rule::new("sec2_walls_like_masses", walls_like_masses).on(OurMeasure).statistical(),
    ]
}

fn parameters(e: &Evidence<'_>) -> Judged {
    let chain = &sweep::main(e.results)?.ensemble.chain;
    let (n, d, omega, r) =
        (chain.masses, chain.spacing, chain.natural_frequency, chain.restitution);
    let square = chain.forcing_frequency * chain.forcing_frequency;
    let printed = e.published.parameter("forcing_frequency_squared")?;
    let mut same = (square - printed).abs() <= 4.0 * f64::EPSILON;
    let ours = [("masses", n as f64), ("spacing", d), ("natural_frequency", omega)];
    for (id, ours) in ours.into_iter().chain([("restitution", r), ("mass", 1.0)]) {
        same &= e.published.parameter(id)? == ours;
    }
    let words = format!("n = {n}, d = m = ω = {d}, Ω = √{}, r = {r}", square.round());
    let found = text!("n = {}, d = {}, ω = {}, Ω² = {:1}, r = {}", n, d, omega, square, r);
    let note = "The paper prints no initial condition, transient or window; for these it refers to Homer \
         (1999).";
    Ok(e.found(found, same && e.statement.printed == words)
        .within("none", "the same numbers")
        .note(note))
}

/// Finds the row of the sweep with the largest σ below about two thirds of the printed threshold
/// (0.67, so that 0.08 is one).
pub(super) fn small_force<'a>(e: &Evidence<'a>) -> Result<&'a RisePoint, Error> {
    let threshold = e.published.statement("sec2_half_height")?.number()?;
    let rows = &sweep::main(e.results)?.first().rows;
    rows.iter().rev().find(|row| row.sigma < 0.67 * threshold).ok_or(Undecided)
}

/// “Very few” is at most N over this (ours).
pub(super) const VERY_FEW: f64 = 20.0;

/// Returns the row of the smallest σ in each window of the map that begins late enough.
fn small_in_windows<'a>(e: &Evidence<'a>) -> Result<Vec<&'a RisePoint>, Error> {
    Ok(late(e, "sweep")?.iter().filter_map(|curve| curve.rows.first()).collect())
}

/// By the mean of the realisations with an impact, in each window of the map of protocols.
fn few_below(e: &Evidence<'_>) -> Judged {
    let row = small_force(e)?;
    let here = e.estimate(&format!("sweep.rows[sigma={}].mean", row.sigma))?;
    let limit = e.number("sweep.run.gaps")? / VERY_FEW;
    let means = small_in_windows(e)?.into_iter().filter_map(|row| row.mean?.estimate());
    let means: Vec<Estimate> = means.collect();
    let few = means.iter().filter(|mean| mean.value <= limit).count();
    let [first, .., last] = means[..] else { return Err(Undecided) };
    let found = text!("at σ = {} a mean of {}", row.sigma, here);
    let reason =
        "ours: “very few” as a twentieth of all gaps, at two thirds of the printed threshold";
    let all = means.len();
    let counts = [few, all - few, all];
    let check = by_runs(e, found, counts, text!("at most {:2}", limit), reason);
    let note = "From rest. Of {} pairs of transient T ≥ {} and window W, which are not printed, {} give at most {:2}, \
         a twentieth of all gaps: from {} in the shortest window after the shortest transient to {} in the longest. \
         Only {} of {} realisations have an impact, but in these, impacts spread.";
    Ok(check.note(text!(note, all, RELEASED, few, limit, first, last, row.kept, row.ran)))
}

/// By the share of the realisations with an impact, with its interval, in each window of the map.
fn none_below(e: &Evidence<'_>) -> Judged {
    let row = small_force(e)?;
    let here = e.estimate(&format!("sweep.rows[sigma={}].kept", row.sigma))?;
    let limit = 1.0 / VERY_FEW;
    let (rows, level) = (small_in_windows(e)?, 1.0 - e.level()?.each);
    let intervals = rows.iter().filter_map(|row| wilson(row.kept as u64, row.ran as u64, level));
    let none = intervals.clone().filter(|[_, high]| *high <= limit).count();
    let some = intervals.filter(|[low, _]| *low > limit).count();
    let shares = rows.iter().map(|row| row.kept as f64 / row.ran as f64);
    let [least, most] = ends(shares).ok_or(Undecided)?;
    let random = e.number(&format!("theory.gap[sigma={}].any_random", row.sigma))?;
    let half = e.estimate("sweep.rise.kept_half")?;
    let found = text!("{} of the realisations have an impact at σ = {}", here, row.sigma);
    let reason = "ours: “no impacts” as in at most a twentieth of the realisations, at two thirds of the printed \
         threshold";
    let counts = [none, some, rows.len()];
    let check = by_runs(e, found, counts, text!("at most {:1}", limit), reason);
    let note = "From rest the share lies from {:2} to {:2} in the {} windows of the map of protocols with T ≥ {}. With \
         its statistical error it is clearly at most {:1}, a twentieth, in {} of them and clearly more in {}. With random \
         free parts, as Eq. (20) supposes, it would be at most {:1}; the start is not printed. From rest half of the \
         realisations have an impact at σ = {}.";
    let [all, late] = [rows.len() as f64, RELEASED];
    Ok(check.note(text!(note, least, most, all, late, limit, none, some, random, half)))
}

/// A jump stays in one step of the grid, however fine; a slope is shared by all.
fn jump(e: &Evidence<'_>) -> Judged {
    let columns = ["step", "largest_increase", "increase_of_two", "increase_of_all"];
    let [step, one, two, all] = e.numbers("sweep.against_theory", columns)?;
    let tenth = e.number("sweep.run.gaps")? / 10.0;
    let found =
        text!("largest step of the mean, between σ that are {} apart: {:2} gaps", step, one);
    let why = "From rest. The rise is steep but gradual: over two steps of the grid the mean of the realisations with an impact \
         increases {:2} times as much as over one (a slope gives 2, a jump 1); the largest step of the mean of all \
         is {:2}.";
    Ok(e.found(found, one >= tenth)
        .within(text!("a step of at least {:3}", tenth), A_JUMP)
        .explained(text!(why, two / one, all), two / one > 1.5))
}

pub(super) const A_JUMP: &str =
    "ours: a jump is a step of a tenth of all gaps or more, as in Section 6";

/// Returns where the mode passes to all gaps in each window that begins late enough.
fn passings<'a>(e: &Evidence<'a>) -> Result<Vec<(Protocol, &'a Passing)>, Error> {
    let windows = e.results.of(&JUMP)?.windows.iter();
    let passing = windows.map(|window| (window.protocol, &window.jump.all_gaps));
    Ok(passing.filter(|(protocol, _)| protocol.transient >= RELEASED).collect())
}

/// In each window whose half height has the printed digits, by the criterion of
/// [`impact_chain::mode_jump`].
fn mode_jump(e: &Evidence<'_>) -> Judged {
    let [transient, window] = e.numbers("sweep.run", ["transient", "window"])?;
    let row = format!("jump.windows[transient={transient},window={window}]");
    let [place, below] = ["place", "below"].map(|name| e.estimate(&format!("{row}.{name}")));
    let gaps = e.number("sweep.run.gaps")?;
    let found = text!("a step from {} gaps to {} at σ = {}", below?, gaps, place?);
    let found = with_protocol(e, found)?;
    let half_heights = late(e, "protocol")?;
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
    let all = outcomes.len();
    let check = by_runs(
        e,
        found,
        [jumps, climbs, all],
        text!("a step of at least {:3}", gaps / 10.0),
        A_JUMP,
    );
    let run = e.results.of(&JUMP)?;
    let single = run.windows.iter().filter(|w| w.jump.single_gap.is_jump() == Some(true)).count();
    let [windows, sure, no] = e.numbers("jump.run", ["windows", "jumps", "climbs"])?;
    let note = "All gaps become the most likely number where their peak overtakes that of the bulk; it is a jump if no \
         number between is as likely there, with 95 % confidence, and else chance may move the mode. The bulk's place is \
         from one half of the chains, its height from the other. Of the {} windows with T ≥ {} whose half height has the \
         printed digits the mode surely jumps in {} and surely climbs through the numbers between in {}; in the others \
         the sample does not tell. Of all {} windows it surely jumps in {}, the long ones, and surely climbs in {}. At \
         small σ, where a single gap may be the most likely number, a jump is sure in {} of them.";
    Ok(check.note(text!(note, all, RELEASED, jumps, climbs, windows, sure, no, single)))
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
    let found =
        text!("a quarter to three quarters of all gaps within {} of σ½", with_error(share, error));
    let reason = "ours: at most half the relative width that the rise would have if each gap closed only by itself; \
         and the statistical error";
    let windows = late(e, "protocol")?;
    let share_in =
        |window: &&Curve| Some(window.rise.kept_width?.value / window.rise.half_height?.value);
    let shares: Vec<f64> = windows.iter().filter_map(share_in).collect();
    let [least, most] = ends(shares.iter().copied()).ok_or(Undecided)?;
    let more = " From rest. The mean of all rises from a tenth to nine tenths within Δσ = {}. In {} of the {} windows \
         of the map of protocols with T ≥ {} this width over σ½ is known, and lies from {:2} to {:2}.";
    let (all_rise, known) = (e.estimate("sweep.rise.width")?, shares.len());
    let more = text!(more, all_rise, known, windows.len(), RELEASED, least, most);
    let note = Text::from(WITH_AN_IMPACT).then(more);
    let agrees = share <= limit + e.level()?.quantile * error;
    let tolerance = text!("at most {:2}", limit);
    Ok(e.found(found, agrees).within(tolerance, reason).note(note))
}

const WITH_AN_IMPACT: &str = "Judged by the mean of the realisations with at least one impact.";

/// Impacts in the window for each gap that has any, where σ is large.
fn repeated(e: &Evidence<'_>) -> Judged {
    let row = format!("sweep.rows[sigma={LARGE_SIGMA}]");
    let [impacts, gaps] = e.numbers(&row, ["impacts", "mean"])?;
    let [each, window] = [impacts / gaps, e.number("sweep.run.window")?];
    let found = text!("{:2} impacts for each gap that has any, at σ = {}", each, LARGE_SIGMA);
    let note = "In a window W = {}, one per {:2} time units. Impacts go on, so a longer window has more and a short \
         one cannot have many: the window, which is not printed, decides.";
    Ok(e.open(found).note(text!(note, window, window / each)))
}

/// Adds the protocol of the sweep to what is found.
fn with_protocol(e: &Evidence<'_>, found: Text) -> Result<Text, Error> {
    let [transient, window] = e.numbers("sweep.run", ["transient", "window"])?;
    Ok(found.then(text!(" with T = {}, W = {}, from rest", transient, window)))
}

fn half_height(e: &Evidence<'_>) -> Judged {
    let found = text!("σ½ = {}", e.estimate("sweep.rise.half_height")?);
    by_protocol(e, found, WITH_AN_IMPACT, |rise| rise.half_height)
}

fn onset(e: &Evidence<'_>) -> Judged {
    let found = text!("σ = {}", e.estimate("sweep.rise.onset")?);
    let by = "Judged by the mean of all: where any realisation has an impact, the mean of those is above a twentieth.";
    by_protocol(e, found, by, |rise| rise.onset)
}

/// Judges a place of the rise by the windows of the map that begin late enough, and by those of
/// chains with random free parts: the number of them in which it has the printed digits decides.
fn by_protocol(
    e: &Evidence<'_>,
    found: Text,
    by: &str,
    place: fn(&Rise) -> Option<Estimate>,
) -> Judged {
    let [from, to] = e.statement.interval()?;
    let [mut agree, mut known, mut all] = [0; 3];
    let mut note = Text::from(by);
    let random = ensemble(e.results.of(&LENGTHS)?, "random")?.curves.iter().collect();
    let sentences = [
        " From rest it is known in {} of {} windows with T ≥ {}, from {} to {}; in {} of these it has the printed digits.",
        " With random free parts, as Eq. (20) supposes, in {} of {} with T ≥ {}, from {} to {}, and in {} of these.",
    ];
    for (windows, sentence) in [late(e, "protocol")?, random].into_iter().zip(sentences) {
        let mut at: Vec<Estimate> = windows.iter().filter_map(|it| place(&it.rise)).collect();
        at.sort_by(|a, b| a.value.total_cmp(&b.value));
        let printed = at.iter().filter(|place| (from..to).contains(&place.value)).count();
        (agree, known, all) = (agree + printed, known + at.len(), all + windows.len());
        if let [Some(least), Some(most)] = [at.first(), at.last()] {
            let [of, windows] = [at.len(), windows.len()];
            note = note.then(text!(sentence, of, windows, RELEASED, *least, *most, printed));
        }
    }
    let (found, counts) = (with_protocol(e, found)?, [agree, known - agree, all]);
    let tolerance = text!("± {:1}", e.statement.half_unit());
    Ok(by_runs(e, found, counts, tolerance, HALF_UNIT).note(note))
}

const HALF_UNIT: &str = "half a unit of the last printed digit, with any protocol";

/// Judges the place of the jump by the windows in which the mode surely jumps. Longer ones are in
/// the map of protocols, whose samples give a range of σ only.
fn mode_rise(e: &Evidence<'_>) -> Judged {
    let [transient, window] = e.numbers("sweep.run", ["transient", "window"])?;
    let row = format!("jump.windows[transient={transient},window={window}]");
    let found = with_protocol(e, text!("σ = {}", e.estimate(&format!("{row}.place"))?))?;
    let [from, to] = e.statement.interval()?;
    let passings = passings(e)?.into_iter().filter(|(_, passing)| passing.is_jump() == Some(true));
    let mut places: Vec<Estimate> = passings.filter_map(|(_, passing)| passing.sigma).collect();
    places.sort_by(|a, b| a.value.total_cmp(&b.value));
    let [least, .., most] = places[..] else { return Err(Undecided) };
    let printed = places.iter().filter(|place| (from..to).contains(&place.value)).count();
    let all = places.len();
    let longest = passings_end(e)?;
    let gaps = e.number("sweep.run.gaps")? as usize;
    let beyond = late(e, "protocol")?.into_iter().filter(|curve| curve.protocol.end() > longest);
    let ranges: Vec<[f64; 2]> = beyond.filter_map(|curve| mode_half(curve, gaps)).collect();
    let apart = ranges.iter().filter(|[low, high]| to < *low || *high < from).count();
    let note = "In the {} windows with T ≥ {} in which the mode surely jumps, the place lies from {} to {}, and has the \
         printed digits in {}. Of {} windows that end later, from fewer chains, the range of σ in which the mode passes \
         half of all gaps lies apart from the printed digits in {}.";
    let tolerance = text!("± {:1}", e.statement.half_unit());
    let check = by_runs(e, found, [printed, all - printed, all], tolerance, HALF_UNIT);
    Ok(check.note(text!(note, all, RELEASED, least, most, printed, ranges.len(), apart)))
}

/// Returns the end of the latest window in which the jump was measured.
fn passings_end(e: &Evidence<'_>) -> Result<f64, Error> {
    let windows = passings(e)?;
    windows.iter().map(|(protocol, _)| protocol.end()).reduce(f64::max).ok_or(Undecided)
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
    let excess = seen - expected;
    let by_chance = (-room..=room + phases).contains(&excess);
    let found =
        text!("{} of {:2} impacts within {:1} of one next to it", seen, impacts, NEAR_SIMULTANEOUS);
    let reason = "ours: one in a thousand; and the count agrees with chance, apart from one coincidence for each \
         contact phase";
    let note = "The share within δ falls in proportion to δ, and would reach the tolerance at δ = {:1}; by chance \
         one expects {:2} such impacts, and none at δ = 0.";
    Ok(e.found(found, share <= NEGLIGIBLE && by_chance)
        .within(text!("a share of {:1}", NEGLIGIBLE), reason)
        .note(text!(note, NEAR_SIMULTANEOUS * NEGLIGIBLE * impacts / expected, expected)))
}

fn sticking(e: &Evidence<'_>) -> Judged {
    let impacts = e.number("sweep.run.impacts")?;
    let [phases, slow] = e.numbers("sweep.rare", ["contact_phases", "slow"])?;
    if impacts == 0.0 {
        return Err(Undecided);
    }
    let found = text!("{} contact phases in {:2} impacts", phases, impacts);
    let note = "Two masses alone can stick only if their forces differ by more than d ω². {} impacts were slower \
         than {:1}.";
    Ok(e.found(found, phases / impacts <= NEGLIGIBLE)
        .within(text!("a share of {:1}", NEGLIGIBLE), "ours: one in a thousand")
        .note(text!(note, slow, SLOW)))
}

fn without_impact(e: &Evidence<'_>) -> Judged {
    let found = e.results.of(&TWO_MASSES)?;
    let least = found.excess.iter().map(|pair| pair[0]).reduce(f64::min).ok_or(Undecided)?;
    let safe = e.number("two_masses.bound.force")?;
    let text = "{} impacts below the force that the amplitudes allow; smallest force with an impact, over that \
         bound: {:6}";
    let reason =
        "a gap whose amplitudes add up to less than d never closes; rounding of the bracket aside";
    let agrees = found.violations == 0 && least >= 1.0 - 1e-9 && safe > 0.0;
    let directions = e.number("two_masses.bound.directions")?;
    let note = "With {} random directions of the two forces. No direction lets the masses meet below an amplitude of \
         {:4} on each.";
    Ok(e.found(text!(text, found.violations, least), agrees)
        .within("none below 1", reason)
        .note(text!(note, directions, safe)))
}

fn walls_like_masses(e: &Evidence<'_>) -> Judged {
    let difference = e.estimate("starts.variants[chain=ring].difference")?;
    let allowed = half_unit(e)?;
    let agrees = difference.value.abs() <= allowed + e.level()?.quantile * difference.error;
    let reason = "ours: half a unit of the digit in which the threshold is printed; and the statistical error at the \
         level of the table";
    let note = "A ring has N = n gaps, a chain between walls N = n + 1. After longer transients a ring rises \
         somewhat earlier.";
    Ok(e.found(text!("σ½ of the mean of all differs by {}", difference), agrees)
        .within(text!("± {:1}", allowed), reason)
        .note(note))
}

/// The threshold of percolation sharpens with size. The paper compares without a quantity.
fn percolation(e: &Evidence<'_>) -> Judged {
    let [transient, window] = e.numbers("sweep.run", ["transient", "window"])?;
    let [n, most] = [e.published.parameter("masses")?, e.number("lengths.all.longest")?];
    let width = |masses: f64| {
        let row = format!("lengths.rest[masses={masses},transient={transient},window={window}]");
        e.estimate(&format!("{row}.width"))
    };
    let found = "a quarter to three quarters of all gaps within {} for n = {}, {} for n = {}";
    let note = "The paper names a likeness but no number. The threshold of percolation becomes sharp in a large \
         system; this rise, after the same transient, does not.";
    Ok(e.open(text!(found, width(n)?, n, width(most)?, most)).note(note))
}

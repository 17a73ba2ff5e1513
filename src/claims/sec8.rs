//! Judges Section 8, a relation between σ and p and what it omits.

use super::sec2::{A_JUMP, NEGLIGIBLE};
use super::shared::*;
use crate::experiments::protocol::range;
use crate::experiments::rise::Curve;
use crate::experiments::starts::share_of_start;
use crate::experiments::sweep;
use crate::experiments::theory::comparison::{self, LARGE_SIGMA, largest_distance};
use crate::experiments::theory::law::law;
use crate::experiments::{LENGTHS, PROTOCOL, RESTITUTION, STARTS};
use crate::params::VERTICES;
use impact_chain::counts::Total;
use impact_chain::rise::RisePoint;
use impact_circuits::distribution::SampleSpace::Simple;
use impact_numerics::statistics::{Estimate, wilson};

pub fn rules() -> Vec<Rule> {
    vec![
        Rule::new("sec8_expected_jump", expected_jump).on(OurMeasure),
        equality("sec8_separation", 1e-13, SOLVED).reads("Eq. (19)"),
        Rule::new("sec8_no_impact", no_impact)
            .on(OurMeasure)
            .statistical()
            .reads("1 − p = P(Y₀ + Y₁/|ω² − Ω²| < d)"),
        defined("sec8_amplitude").reads("Eq. (21)"),
        equality("sec8_densities", 1e-12, INTEGRATED),
        Rule::new("sec8_eq25", eq25).on(FiniteCases).reads("Eq. (25)"),
        Rule::new("sec8_p_small", p_small).on(OurMeasure).reads("extremely small for σ < {}"),
        Rule::new("sec8_p_poor", p_poor).on(OurMeasure),
        Rule::new("sec8_large_sigma", large_sigma).on(OurMeasure),
        Rule::new("sec8_threshold_shift", threshold_shift).on(OurMeasure),
        Rule::new("sec8_mean_is_easier", mean_is_easier).on(OurMeasure),
        Rule::new("sec8_restitution_omitted", restitution_omitted).on(OurMeasure),
        Rule::new("sec8_restitution_ensures", |e| ensured(e, PHASES, |all| all.contact_phases))
            .on(OurMeasure),
        Rule::new("sec8_restitution_multiple", |e| {
            ensured(e, NEAR, |Total { near: [.., all], .. }| *all)
        })
        .on(OurMeasure),
    ]
}

const SOLVED: &str =
    "Against the equations of motion solved by variation of constants, at five times.";
const INTEGRATED: &str = "The probability of Y ≤ x at five x and three σ, against the integral of the two normal \
         densities over a disc; the second also at |ω² − Ω²| = 1/2.";

const PHASES: &str = "Contact phases over impacts. Two masses alone can stick only if their forces differ by more than d ω².";
const NEAR: &str = "Impacts near in time to one in a gap beside theirs, over all, as in Section 2. The paper \
         does not say what it means by “multiple”.";

fn eq25(e: &Evidence<'_>) -> Judged {
    let note =
        "Closed form against the double integral at five σ where the latter has digits left.";
    Ok(e.rounding(e.number("theory.relation.difference")?, 1e-12).note(note))
}

/// Weights in proportion to p^k have a mean with the slope Var(X)/p.
fn expected_jump(e: &Evidence<'_>) -> Judged {
    let [slope, variance] = e.numbers("theory.jump", ["slope", "variance_over_p"])?;
    let found = text!("dμ/dp = {:4} at p_jump", slope);
    let why = "Only the most likely number jumps. The slope of μ is the variance of X over p, finite for every \
         finite N, so that a step becomes as small as one likes between p that are near enough. The rise is steep: at \
         this slope a tenth of N takes {:2} in p.";
    let why = text!(why, VERTICES as f64 / 10.0 / slope);
    Ok(e.found(found, !slope.is_finite())
        .within("a step of at least a tenth of N between neighbouring p", A_JUMP)
        .explained(why, (slope / variance - 1.0).abs() < 1e-6))
}

/// Eq. (20) in the simulation: a chain with random free parts that overlaps at its start, or has an
/// impact later, has a gap with Y₀ + Y₁/|ω² − Ω²| ≥ d.
fn no_impact(e: &Evidence<'_>) -> Judged {
    let random = ensemble(e.results.of(&STARTS)?, "random")?;
    let [mut above, mut overlaps, mut chains, mut expected] = [0.0; 4];
    let mut shares_of_bound = Vec::new();
    for (row, counted) in random.runs.iter().zip(&random.first().rows) {
        let (ran, begun) = (row.realisations - row.failed, counted.kept + row.rejected);
        let bound = e.number(&format!("theory.gap[sigma={}].any_random", row.sigma));
        let interval = wilson(begun as u64, ran as u64, 1.0 - e.level()?.each);
        let (Ok(bound), Some([low, _])) = (bound, interval) else { continue };
        above += f64::from(u8::from(low > bound));
        if (0.05..0.95).contains(&bound) {
            shares_of_bound.push(begun as f64 / ran as f64 / bound);
            overlaps += row.rejected as f64;
            chains += begun as f64;
            expected += bound * ran as f64;
        }
    }
    if shares_of_bound.len() < 3 {
        return Err(Undecided);
    }
    let [least, most] = ends(shares_of_bound.iter().copied()).ok_or(Undecided)?;
    let found = "at {} values of σ together {:2} of the chains that the bound allows";
    let found = text!(found, shares_of_bound.len(), chains / expected);
    let reason = "intervals at the level of the table, since shares of samples scatter; two thirds are ours, of all \
         together, for gaps that share a mass and come near their infimum too late";
    let note = "Chains with random free parts, as Eq. (20) supposes. {} of these {} chains overlap at the start, \
         which Eq. (20) counts as impacts. The bound is 1 − ∏ (1 − p) over all gaps with p of Eq. (25); at single σ the \
         share is from {:2} to {:2} of it.";
    Ok(e.found(found, above == 0.0 && chains / expected >= 2.0 / 3.0)
        .within("no interval above its bound, and two thirds of it in all", reason)
        .note(text!(note, overlaps as u64, chains as u64, least, most)))
}

/// Less of a whole than this cannot be seen in a figure (ours).
pub(super) const VISIBLE: f64 = 0.05;

/// “Extremely small”, of a probability, is at most this (ours).
const EXTREMELY_SMALL: f64 = 0.005;

fn p_small(e: &Evidence<'_>) -> Judged {
    let [crit, jump] = e.numbers("theory.relation", ["sigma_crit", "sigma_jump"])?;
    let printed = e.statement.number()?;
    let p = e.number(&format!("theory.gap[sigma={printed}].p"))?;
    let found = text!("p = {:3} at σ = {}", p, printed);
    let reason = "ours: no larger than the p that the paper calls very small where it compares distributions";
    let rise = e.published.statement("sec2_half_height")?.number()?;
    let at_rise = e.number(&format!("theory.gap[sigma={rise}].p"))?;
    let why = "The statement holds up to the rise: p = {:2} at σ = {}. At the printed σ it is not small for the theory: p \
         reaches p_crit at σ = {:4} and p_jump at {:4}, less than a tenth below it.";
    Ok(e.found(found, p <= EXTREMELY_SMALL)
        .within(text!("at most {:1}", EXTREMELY_SMALL), reason)
        .explained(
            text!(why, at_rise, rise, crit, jump),
            at_rise <= EXTREMELY_SMALL && (0.9..1.0).contains(&(crit / printed)),
        ))
}

/// The p with which the theory would have the simulated mean, over that of Eq. (25): the least at
/// any σ below the printed one, in each window from rest and with random free parts.
fn p_poor(e: &Evidence<'_>) -> Judged {
    let sigma = e.published.statement("sec2_half_height")?.number()?;
    let below = e.published.statement("sec8_p_small")?.number()?;
    let curve = e.results.table("theory.curve")?;
    let column = |name| curve.curve(&[], "sigma", name);
    let (mean, relation) = (column("simple")?, column("p")?);
    let inverse: Vec<(f64, f64)> = mean.iter().zip(&relation).map(|(a, b)| (a.1, b.1)).collect();
    let times = |(sigma, mean): (f64, f64)| {
        Some(comparison::at(&inverse, mean)? / comparison::at(&relation, sigma)?)
    };
    let there = |means: &Vec<(f64, f64)>| times((sigma, comparison::at(means, sigma)?));
    let means = e.results.table("sweep.rows")?.curve(&[], "sigma", "mean")?;
    let everywhere = |means: &Vec<(f64, f64)>| {
        let rows = means.iter().copied().filter(|(sigma, _)| *sigma < below);
        rows.filter_map(times).reduce(f64::min)
    };
    let (here, windows) = (everywhere(&means).ok_or(Undecided)?, windows(e)?);
    let there = windows.iter().filter_map(there).reduce(f64::min).ok_or(Undecided)?;
    let random = ensemble(e.results.of(&LENGTHS)?, "random")?.curves.iter().map(means_of).collect();
    let [rest, random] = [windows, random].map(|all: Vec<_>| {
        let least: Vec<f64> = all.iter().filter_map(everywhere).collect();
        [least.iter().filter(|least| **least >= 2.0).count(), least.len()]
    });
    let [poor, all] = [rest[0] + random[0], rest[1] + random[1]];
    let found = text!("the theory needs at least {:2} times the p of Eq. (25) for the mean", here);
    let note = "At each σ below {}, from rest with our protocol. It needs at least twice the p at each of these σ in \
         {} of {} windows from rest with T ≥ {}, and in {} of {} with random free parts, as Eq. (20) supposes; the paper \
         does not print its start. At σ = {} it needs at least {:2} times the p in each window from rest. The paper \
         suspects p; the numbers do not exclude that the theory itself is at fault.";
    let note = text!(note, below, rest[0], rest[1], RELEASED, random[0], random[1], sigma, there);
    let reason = "ours: “poor” as less than half of what is needed";
    Ok(by_runs(e, found, [poor, all - poor, all], "at least twice", reason).note(note))
}

/// Returns the simulated means of the realisations with an impact, against σ.
fn means_of(curve: &Curve) -> Vec<(f64, f64)> {
    let mean = |row: &RisePoint| Some((row.sigma, row.mean?.value));
    curve.rows.iter().filter_map(mean).collect()
}

/// Returns the simulated means against σ in each window of the map of protocols that begins late
/// enough after the release.
pub(super) fn windows(e: &Evidence<'_>) -> Result<Vec<Vec<(f64, f64)>>, Error> {
    Ok(late(e, "protocol")?.into_iter().map(means_of).collect())
}

fn large_sigma(e: &Evidence<'_>) -> Judged {
    let columns = ["large_distance", "large_distance_at", "large_mean"];
    let [distance, at, mean] = e.numbers("sweep.against_theory", columns)?;
    let gaps = e.number("sweep.run.gaps")?;
    let limit = gaps / 10.0;
    let curve = e.results.table("theory.curve")?.curve(&[], "sigma", "simple")?;
    let means = e.results.table("sweep.rows")?.curve(&[], "sigma", "mean")?;
    let all = VERTICES as f64;
    let constant = largest_distance(&means, &[(0.0, all), (1.0, all)]).ok_or(Undecided)?[0];
    let windows = windows(e)?;
    let distances = windows.iter().filter_map(|means| largest_distance(means, &curve));
    let far = distances.map(|[distance, ..]| distance).fold(distance, f64::max);
    let found = text!("largest distance from σ = {} on: {:2} gaps", LARGE_SIGMA, distance);
    let printed = e.published.statement("sec8_p_small")?.number()?;
    let [mean_there, theory_there] =
        [&means, &curve].map(|curve| comparison::at(curve, printed).ok_or(Undecided));
    let before = mean_there? - theory_there?;
    // Without a free part only the forced amplitude counts: p = exp(−d²/4σ²) at this Ω.
    let is_far = |(sigma, mean): (f64, f64)| {
        let theory = comparison::at(&curve, sigma)?;
        (sigma < LARGE_SIGMA && (mean - theory).abs() > limit).then_some(sigma)
    };
    let down = means.iter().copied().filter_map(is_far).reduce(f64::max).ok_or(Undecided)?;
    let forced = law(Simple, pxfm::f_exp(-0.25 / (LARGE_SIGMA * LARGE_SIGMA))).mean();
    let note = "Reached at σ = {}; in all windows of the map with T ≥ {} at most {:2}. A relation without free parts \
         would leave {:2} gaps there, so that the comparison can fail. It is weak all the same: both curves approach \
         all gaps, and the constant N is at most {:2} away. The paper does not say from where on σ is large: at {}, \
         below which it finds its own estimate poor, {:2} gaps are missing, and the limit is passed from σ = {} down.";
    Ok(e.found(found, far <= limit)
        .within(text!("at most {:3}", limit), "ours: a tenth of all gaps")
        .note(text!(note, at, RELEASED, far, mean - forced, constant, printed, before, down)))
}

/// By the half heights in all windows of the map of protocols: of theory and simulation, each of
/// half of all gaps.
fn threshold_shift(e: &Evidence<'_>) -> Judged {
    let half = e.estimate("sweep.rise.half_height")?;
    let theory = e.number("theory.relation.sigma_half")?;
    let near = |half: &Estimate| (theory / half.value - 1.0).abs() <= 0.2;
    let windows = late(e, "protocol")?;
    let halves: Vec<Estimate> = windows.iter().filter_map(|curve| curve.rise.half_height).collect();
    let (agree, all) = (halves.iter().filter(|half| near(half)).count(), halves.len());
    let found =
        text!("half height of the theory at σ = {:4}, of the simulation at {}", theory, half);
    let tolerance = "within a fifth of one another";
    let reason = "ours: a curve that is shifted further agrees nowhere along the rise";
    let check = by_runs(e, found, [agree, all - agree, all], tolerance, reason);
    let note = "Along the rise the protocol, which is not printed, decides: from rest in {} of {} windows of the map \
         with T ≥ {} the half heights are within a fifth of one another. The paper itself finds the agreement poor at \
         small σ.";
    Ok(check.note(text!(note, agree, all, RELEASED)))
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
    let found = text!("the interval of the mode is {:2} times as wide as that of the mean", ratio);
    Ok(e.found(found, ratio >= 2.0)
        .within("at least twice", "ours: “much easier” as at least four times fewer realisations")
        .note("Median over the rows from onset to half height."))
}

/// Part of the distance between theory and simulation is due to the start that the theory assumes,
/// and not to r.
fn restitution_omitted(e: &Evidence<'_>) -> Judged {
    let theory = e.number("theory.relation.sigma_half")?;
    let share = e.estimate("starts.against_theory.share")?;
    let halves = e.results.table("restitution.curves")?.series(&[], "r", "half_height")?;
    let [Some((lowest, _)), Some((highest, _))] = [halves.first(), halves.last()] else {
        return Err(Undecided);
    };
    let moved = range(halves.iter().map(|(_, half)| Some(*half))).ok_or(Undecided)?;
    let map = ensemble(e.results.of(&PROTOCOL)?, "protocol")?;
    let share_after = |curve: &Curve| {
        let rest = map.curve(curve.protocol.transient, curve.protocol.window)?;
        let [rest, random] = [rest.rise.half_height?, curve.rise.half_height?];
        Some(share_of_start(rest, random, theory).value)
    };
    let shares = ensemble(e.results.of(&LENGTHS)?, "random")?.curves.iter().filter_map(share_after);
    let [least, most] = ends(shares).ok_or(Undecided)?;
    let found = "from rest the start makes up {} of the distance between theory and simulation";
    let note = "By the mean of the chains with an impact, which the paper plots; by the mean of all it would be {}. The \
         paper says “perhaps”, and does not print its start. In smaller samples the share lies from {:2} to {:2} after \
         other transients. The theory assumes random free parts, for which none of the distance is due \
         to the start. From r = {} to {} the half height moves by {}, more than with the start.";
    let by_all = e.estimate("starts.against_theory.share_of_all")?;
    Ok(e.open(text!(found, share)).note(text!(note, by_all, least, most, *lowest, *highest, moved)))
}

/// Judges whether the paper's r makes a share of impacts negligible that another r does not, at all
/// σ. Where no r has more, none ensures it.
fn ensured(e: &Evidence<'_>, what: &str, pick: fn(&Total) -> u64) -> Judged {
    let restitutions = e.results.table("restitution.curves")?.distinct("r")?;
    let (r, lowest) = (e.published.parameter("restitution")?, restitutions[0]);
    let found = e.results.of(&RESTITUTION)?;
    let chains = |r: f64| found.iter().find(|chains| chains.ensemble.chain.restitution == r);
    // Of all impacts at r and σ; none where these were not run.
    let share = |r, sigma| {
        let total = &chains(r)?.runs.iter().find(|row| row.sigma == sigma)?.total;
        Some(pick(total) as f64 / total.impacts.max(1) as f64)
    };
    // Share at the paper's r and at the lowest for each σ, and whether only the lowest has many.
    let mut shares = Vec::new();
    for sigma in chains(lowest).ok_or(Undecided)?.runs.iter().map(|row| row.sigma) {
        if let Some((ours, without)) = share(r, sigma).zip(share(lowest, sigma)) {
            shares.push((sigma, ours, without, ours <= NEGLIGIBLE && without > NEGLIGIBLE));
        }
    }
    let [(first, ..), .., (sigma, ours, without, _)] = shares[..] else { return Err(Undecided) };
    let text = "at σ = {} a share of {:1} at r = {}, {:1} at r = {}";
    let text = text!(text, sigma, ours, r, without, lowest);
    let decided: Vec<f64> = shares.iter().filter(|row| row.3).map(|row| row.0).collect();
    let (at, all) = (decided.len(), shares.len());
    let counts = [at, all - at, all];
    let tolerance =
        text!("at most {:1} at the paper's r, more at the lowest, at each σ", NEGLIGIBLE);
    let check = by_runs(e, text, counts, tolerance, "ours: one in a thousand, as in Section 2");
    let is_rare = |r: &&f64| shares.iter().all(|row| share(**r, row.0) <= Some(NEGLIGIBLE));
    let enough = *restitutions.iter().find(is_rare).ok_or(Undecided)?;
    let more = " Of the {} values of σ from {} to {} that were run with both, r decides at {}.";
    let mut note = Text::from(what).then(text!(more, all, first, sigma, at));
    if let Some(from) = decided.first().filter(|_| at < all) {
        let open = " The lowest of these is {}; which σ the paper simulated is not printed.";
        note = note.then(text!(open, *from));
    }
    let wide = " Every r from {} on has a share of at most {:1}.";
    Ok(check.note(note.then(text!(wide, enough, NEGLIGIBLE))))
}

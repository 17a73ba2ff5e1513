//! Judges Section 8, a relation between σ and p and what it omits.

use super::sec2::NEGLIGIBLE;
use super::shared::*;
use crate::experiments::starts::share_of_start;
use crate::experiments::theory::comparison::largest_distance;
use crate::experiments::theory::law::law;
use crate::experiments::{RESTITUTION, STARTS};
use impact_chain::counts::Total;
use impact_circuits::distribution::SampleSpace::Simple;

pub fn rules() -> Vec<Rule> {
    vec![
        Rule::new("sec8_expected_jump", expected_jump).on(OurMeasure),
        equality("sec8_separation", 1e-13).reads("Eq. (19)"),
        Rule::new("sec8_no_impact", no_impact)
            .on(OurMeasure)
            .statistical()
            .reads("1 − p = P(Y₀ + Y₁/|ω² − Ω²| < d)"),
        defined("sec8_amplitude").reads("Eq. (21)"),
        equality("sec8_densities", 1e-12),
        Rule::new("sec8_eq25", eq25).on(FiniteCases).reads("Eq. (25)"),
        Rule::new("sec8_p_small", p_small).on(OurMeasure).reads("extremely small for σ < {}"),
        Rule::new("sec8_p_poor", p_poor).on(OurMeasure),
        Rule::new("sec8_large_sigma", large_sigma).on(OurMeasure),
        Rule::new("sec8_threshold_shift", threshold_shift).on(OurMeasure),
        Rule::new("sec8_mean_is_easier", mean_is_easier).on(OurMeasure),
        Rule::new("sec8_restitution_omitted", restitution_omitted).on(OurMeasure),
        Rule::new("sec8_restitution_ensures", |e| ensured(e, |total| total.contact_phases))
            .on(OurMeasure),
        Rule::new("sec8_restitution_multiple", |e| {
            ensured(e, |Total { near: [.., all], .. }| *all)
        })
        .on(OurMeasure),
    ]
}

fn eq25(e: &Evidence<'_>) -> Judged {
    Ok(e.rounding(e.number("theory.relation.difference")?, 1e-12).note(e.sentence("note", &[])?))
}

/// Weights in proportion to p^k have a mean with the slope Var(X)/p.
fn expected_jump(e: &Evidence<'_>) -> Judged {
    let [slope, variance] = e.numbers("theory.jump", ["slope", "variance_over_p"])?;
    let tenth = VERTICES as f64 / 10.0 / slope;
    let check = e.check(!slope.is_finite(), numbers![slope, tenth])?;
    Ok(check.explained_if((slope / variance - 1.0).abs() < 1e-6))
}

/// Eq. (20) in the simulation: a chain with random free parts that overlaps at its start, or has an
/// impact later, has a gap with Y₀ + Y₁/|ω² − Ω²| ≥ d.
fn no_impact(e: &Evidence<'_>) -> Judged {
    let random = ensemble(e.results.of(&STARTS)?, "random")?;
    let [mut above, mut overlaps, mut chains, mut expected] = [0.0; 4];
    let mut shares_of_bound = Vec::new();
    for (row, point) in random.runs.iter().zip(&random.first_curve().rows) {
        let (ran, begun) = (row.realisations - row.failed, point.active + row.rejected);
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
    let [least, most] = extremes(shares_of_bound.iter().copied()).ok_or(Undecided)?;
    let (sigmas, share) = (shares_of_bound.len(), chains / expected);
    let agrees = above == 0.0 && share >= 2.0 / 3.0;
    e.check(agrees, numbers![sigmas, share, overlaps, chains, least, most])
}

/// Less of a whole than this cannot be seen in a figure (ours).
pub(super) const VISIBLE: f64 = 0.05;

/// “Extremely small”, of a probability, is at most this (ours).
const EXTREMELY_SMALL: f64 = 0.005;

fn p_small(e: &Evidence<'_>) -> Judged {
    let [crit, jump] = e.numbers("theory.relation", ["sigma_crit", "sigma_jump"])?;
    let printed = e.statement.number()?;
    let p = e.number(&format!("theory.gap[sigma={printed}].p"))?;
    let rise = e.published.statement("sec2_half_height")?.number()?;
    let at_rise = e.number(&format!("theory.gap[sigma={rise}].p"))?;
    let limit = EXTREMELY_SMALL;
    let check = e.check(p <= limit, numbers![p, printed, limit, at_rise, rise, crit, jump])?;
    Ok(check.explained_if(at_rise <= limit && (0.9..1.0).contains(&(crit / printed))))
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
        Some(interpolate(&inverse, mean)? / interpolate(&relation, sigma)?)
    };
    let there = |means: &Vec<(f64, f64)>| times((sigma, interpolate(means, sigma)?));
    let means = e.results.table("sweep.rows")?.curve(&[], "sigma", "mean")?;
    let everywhere = |means: &Vec<(f64, f64)>| {
        let rows = means.iter().copied().filter(|(sigma, _)| *sigma < below);
        rows.filter_map(times).reduce(f64::min)
    };
    let (here, windows) = (everywhere(&means).ok_or(Undecided)?, means_in_windows(e)?);
    let there = windows.iter().filter_map(there).reduce(f64::min).ok_or(Undecided)?;
    let random = ensemble(e.results.of(&LENGTHS)?, "random")?.curves.iter().map(means_of).collect();
    let [[poor_rest, rest], [poor_random, random]] = [windows, random].map(|all: Vec<_>| {
        let least: Vec<f64> = all.iter().filter_map(everywhere).collect();
        [least.iter().filter(|least| **least >= 2.0).count(), least.len()]
    });
    let (poor, all, released) = (poor_rest + poor_random, rest + random, RELEASED);
    e.check(
        by_runs([poor, all - poor, all]),
        numbers![here, below, poor_rest, rest, released, poor_random, random, sigma, there],
    )
}

/// Returns the simulated means of the active realisations, against σ.
fn means_of(curve: &Curve) -> Vec<(f64, f64)> {
    let mean = |row: &RisePoint| Some((row.sigma, row.mean?.value));
    curve.rows.iter().filter_map(mean).collect()
}

/// Returns the simulated means against σ in each window of the map of protocols that begins late
/// enough after the release.
pub(super) fn means_in_windows(e: &Evidence<'_>) -> Result<Vec<Vec<(f64, f64)>>, Error> {
    Ok(late_curves(e, "protocol")?.into_iter().map(means_of).collect())
}

fn large_sigma(e: &Evidence<'_>) -> Judged {
    let columns = ["large_distance", "large_distance_at", "large_mean"];
    let [distance, at, mean] = e.numbers("sweep.against_theory", columns)?;
    let limit = e.number("sweep.run.gaps")? / 10.0;
    let curve = e.results.table("theory.curve")?.curve(&[], "sigma", "simple")?;
    let means = e.results.table("sweep.rows")?.curve(&[], "sigma", "mean")?;
    let all = VERTICES as f64;
    let constant = largest_distance(&means, &[(0.0, all), (1.0, all)]).ok_or(Undecided)?[0];
    let windows = means_in_windows(e)?;
    let distances = windows.iter().filter_map(|means| largest_distance(means, &curve));
    let far = distances.map(|[distance, ..]| distance).fold(distance, f64::max);
    let printed = e.published.statement("sec8_p_small")?.number()?;
    let [mean_there, theory_there] =
        [&means, &curve].map(|curve| interpolate(curve, printed).ok_or(Undecided));
    let missing = mean_there? - theory_there?;
    // Without a free part only the forced amplitude counts: p = exp(−d²/4σ²) at this Ω.
    let is_far = |(sigma, mean): (f64, f64)| {
        let theory = interpolate(&curve, sigma)?;
        (sigma < LARGE_SIGMA && (mean - theory).abs() > limit).then_some(sigma)
    };
    let down = means.iter().copied().filter_map(is_far).reduce(f64::max).ok_or(Undecided)?;
    let forced = law(Simple, pxfm::f_exp(-0.25 / (LARGE_SIGMA * LARGE_SIGMA))).mean();
    let (large, released, forced) = (LARGE_SIGMA, RELEASED, mean - forced);
    let numbers = numbers![
        large, distance, limit, at, released, far, forced, constant, printed, missing, down
    ];
    e.check(far <= limit, numbers)
}

/// By the half heights in all windows of the map of protocols: of theory and simulation, each of
/// half of all gaps.
fn threshold_shift(e: &Evidence<'_>) -> Judged {
    let half = e.estimate("sweep.rise.half_height")?;
    let theory = e.number("theory.relation.sigma_half")?;
    let near = |half: &Estimate| (theory / half.value - 1.0).abs() <= 0.2;
    let windows = late_curves(e, "protocol")?;
    let halves: Vec<Estimate> = windows.iter().filter_map(|curve| curve.rise.half_height).collect();
    let (agree, all) = (halves.iter().filter(|half| near(half)).count(), halves.len());
    let released = RELEASED;
    e.check(by_runs([agree, all - agree, all]), numbers![theory, half, agree, all, released])
}

fn mean_is_easier(e: &Evidence<'_>) -> Judged {
    let [low, high] = e.numbers("sweep.rise", ["onset", "half_height_all"])?;
    let rows = sweep::main_sweep(e.results)?.first_curve().rows.iter();
    let rows = rows.filter(|row| low <= row.sigma && row.sigma <= high);
    // Width of the mode's bootstrap interval over that of the mean.
    let ratio = |row: &RisePoint| {
        let ([low, high], [from, to]) = (row.mode_interval?, row.mean?.interval?);
        (to > from).then(|| (high - low) as f64 / (to - from))
    };
    let mut ratios: Vec<f64> = rows.filter_map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    let ratio = *ratios.get(ratios.len() / 2).ok_or(Undecided)?;
    e.check(ratio >= 2.0, numbers![ratio])
}

/// Part of the distance between theory and simulation is due to the start that the theory assumes,
/// and not to r.
fn restitution_omitted(e: &Evidence<'_>) -> Judged {
    let theory = e.number("theory.relation.sigma_half")?;
    let share = e.estimate("starts.against_theory.share")?;
    let mut halves = e.results.table("restitution.curves")?.series(&[], "r", "half_height")?;
    let [(lowest, _), .., (highest, _)] = halves[..] else { return Err(Undecided) };
    halves.sort_by(|(_, a), (_, b)| a.value.total_cmp(&b.value));
    let moved = difference(halves[halves.len() - 1].1, halves[0].1);
    let map = ensemble(e.results.of(&PROTOCOL)?, "protocol")?;
    let share_after = |curve: &Curve| {
        let rest = map.find_curve(curve.protocol)?;
        let [rest, random] = [rest.rise.half_height?, curve.rise.half_height?];
        Some(share_of_start(rest, random, theory).value)
    };
    let shares = ensemble(e.results.of(&LENGTHS)?, "random")?.curves.iter().filter_map(share_after);
    let [least, most] = extremes(shares).ok_or(Undecided)?;
    let by_all = e.estimate("starts.against_theory.share_of_all")?;
    e.check(None, numbers![share, by_all, least, most, lowest, highest, moved])
}

/// Judges whether the paper's r makes a share of impacts negligible that another r does not, at all
/// σ. Where no r has more, none ensures it.
fn ensured(e: &Evidence<'_>, pick: fn(&Total) -> u64) -> Judged {
    let restitutions = e.results.table("restitution.curves")?.distinct("r")?;
    let (r, lowest) = (e.published.parameter("restitution")?, restitutions[0]);
    let ensembles = e.results.of(&RESTITUTION)?;
    let chains = |r: f64| ensembles.iter().find(|chains| chains.ensemble.chain.restitution == r);
    // Of all impacts at r and σ, or `None` where these were not run.
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
    let decided: Vec<f64> = shares.iter().filter(|row| row.3).map(|row| row.0).collect();
    let is_rare = |r: &&f64| shares.iter().all(|row| share(**r, row.0) <= Some(NEGLIGIBLE));
    let enough = *restitutions.iter().find(is_rare).ok_or(Undecided)?;
    let (only_there, all, negligible) = (decided.len(), shares.len(), NEGLIGIBLE);
    let mut check = e.check(
        by_runs([only_there, all - only_there, all]),
        numbers![sigma, ours, r, without, lowest, negligible, all, first, decided = only_there],
    )?;
    if let Some(from) = decided.first().filter(|_| only_there < all) {
        check = with_more(check, e.sentence("note_some", numbers![from = *from])?);
    }
    Ok(with_more(check, e.sentence("note_enough", numbers![enough, negligible])?))
}

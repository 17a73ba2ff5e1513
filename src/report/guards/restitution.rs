//! What restitution does to a chain.

use super::places::between;
use super::{Guard, Look, far, model, unless};
use crate::experiments::restitution::{Curve, Ensemble, Restitution, Run};
use crate::numerics::statistics::Estimate;
use crate::report::values::cell;

pub const GUARDS: &[Guard] = &[
    Guard { name: "restitution_of_runs", ids: &["restitution*"], find: of_runs },
    Guard { name: "restitution_as_tabled", ids: &["restitution.*"], find: tabled },
    Guard {
        name: "restitution_half_heights",
        ids: &["restitution.*", "restitution_half_*", "restitution_shift"],
        find: halves,
    },
    Guard { name: "restitution_as_run", ids: &["restitution_*"], find: as_run },
    Guard {
        name: "restitution_warmth",
        ids: &["restitution_warm*", "restitution.*"],
        find: warmth,
    },
    Guard {
        name: "contact_needs_force",
        ids: &["restitution_able*", "restitution_touched_*"],
        find: contact,
    },
    Guard { name: "no_loss_no_rest", ids: &["restitution_one_*", "restitution_near_*"], find: hot },
];

fn found(look: Look<'_>) -> Option<&Restitution> {
    look.results.restitution.as_ref()
}

/// All ensembles, with the lengths of their windows.
fn rows(found: &Restitution) -> impl Iterator<Item = (&Ensemble, Vec<f64>)> {
    let (protocol, ends) = (found.parameters.protocol, &found.parameters.ends);
    let curves = found.curves.iter().flat_map(|curve| &curve.rows);
    let curves = curves.map(move |row| (row, vec![protocol.transient, protocol.window]));
    let begins = std::iter::once(&0.0).chain(ends);
    let lengths: Vec<f64> = ends.iter().zip(begins).map(|(end, begin)| end - begin).collect();
    curves.chain(found.heated.iter().map(move |row| (row, lengths.clone())))
}

fn sum(runs: &[Run], of: impl Fn(&Run) -> f64) -> f64 {
    runs.iter().map(of).sum()
}

fn last_of(counts: &[u64]) -> f64 {
    counts.last().map_or(0.0, |&n| n as f64)
}

/// Means are those of the realisations, and ratios those of their sums.
fn of_runs(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let chain = &found.parameters.chain;
    let (masses, gaps) = (chain.masses as f64, chain.gaps() as f64);
    let is = |what: &str, own: Option<Estimate>, expected: f64| {
        own.and_then(|own| far(what, own.value, expected))
    };
    let of = |(row, time): (&Ensemble, Vec<f64>)| {
        let (runs, n) = (&row.runs, row.runs.len() as f64);
        let heat = n * masses * row.sigma * row.sigma;
        let window = |(i, time): (usize, &f64)| {
            let impacts = sum(runs, |run| run.impacts[i] as f64);
            is("impacts per unit of time", row.rates[i], impacts / (n * time))
                .or_else(|| is("free parts", row.ratios[i], sum(runs, |run| run.free[i]) / heat))
        };
        let loss = 0.5 * (1.0 - row.restitution) * sum(runs, |run| run.squares);
        let able = sum(runs, |run| run.able_touched as f64);
        let others = sum(runs, |run| run.others_touched as f64);
        let impacts = sum(runs, |run| last_of(&run.impacts));
        let looks = gaps * sum(runs, |run| run.looks as f64);
        is("a mean count", row.count, sum(runs, |run| run.distinct as f64) / n)
            .or_else(|| time.iter().enumerate().find_map(window))
            .or_else(|| is("a balance", row.balance, sum(runs, |run| run.products) / loss))
            .or_else(|| is("phases", row.phases, sum(runs, |run| run.phases as f64) / impacts))
            .or_else(|| is("gaps in contact", row.touched, (able + others) / (n * gaps)))
            .or_else(|| is("time in contact", row.held, sum(runs, |run| run.held as f64) / looks))
            .or_else(|| {
                far("gaps that forces can press", row.able as f64, sum(runs, |run| run.able as f64))
            })
            .or_else(|| far("gaps in contact", row.able_touched as f64, able))
            .or_else(|| far("other gaps in contact", row.others_touched as f64, others))
    };
    rows(found).find_map(of)
}

fn at(curve: &Curve, sigma: f64) -> Option<&Ensemble> {
    curve.rows.iter().find(|row| row.sigma == sigma)
}

fn end(list: &[Option<Estimate>]) -> Option<f64> {
    Some(list.last().copied()??.value)
}

/// The table and the text have the numbers of the rows.
fn tabled(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let sigma = |letter: &str| look.number(&format!("restitution_sigma_{letter}"));
    let [a, b, c] = [sigma("a")?, sigma("b")?, sigma("c")?];
    let line = |curve: &Curve| {
        let is = |column: &str, expected: f64| {
            look.is(&cell("restitution", curve.restitution, column), expected)
        };
        let (Some(a), Some(b), Some(c)) = (at(curve, a), at(curve, b), at(curve, c)) else {
            return Some(format!("no row of the table at r = {}", curve.restitution));
        };
        is("r", curve.restitution)
            .or_else(|| is("ratio_a", end(&a.ratios)?))
            .or_else(|| is("ratio_b", end(&b.ratios)?))
            .or_else(|| is("balance", b.balance?.value))
            .or_else(|| is("rate", end(&c.rates)?))
            .or_else(|| is("phases", sum(&c.runs, |run| run.phases as f64)))
            .or_else(|| is("touched", (c.able_touched + c.others_touched) as f64))
    };
    // Who has less energy meets less often, but for sequences of impacts that accumulate at small r.
    let accumulate = || {
        let rates = found.curves.iter().filter_map(|curve| end(&at(curve, c)?.rates));
        let rates: Vec<f64> = rates.collect();
        let least = rates.iter().skip(1).copied().fold(f64::INFINITY, f64::min);
        unless(*rates.first()? > least, || {
            format!("no accumulation, {rates:?} impacts by rising r")
        })
    };
    let text = || {
        let (first, last) = (at(found.curves.first()?, c)?, at(found.curves.last()?, a)?);
        let gaps = sum(&first.runs, |_| 1.0) * found.parameters.chain.gaps() as f64;
        look.are([
            ("restitution_able", first.able as f64),
            ("restitution_able_touched", first.able_touched as f64),
            ("restitution_gaps", gaps),
        ])
        .or_else(|| look.is("restitution_phases", first.phases?.value))
        .or_else(|| look.is("restitution_held", first.held?.value))
        .or_else(|| look.is("restitution_warm", end(&last.ratios)?))
    };
    found.curves.iter().find_map(line).or_else(text).or_else(accumulate)
}

/// At half height the curve through the means has half of all gaps, and the shift is from the first
/// to the last. No mean is at half before half of the chains can have an impact at all.
fn halves(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let half = 0.5 * found.parameters.chain.gaps() as f64;
    let one = |curve: &Curve| {
        let place = curve.half_height?;
        let mean = |row: &Ensemble| {
            let n = row.runs.len() as f64;
            (row.sigma, sum(&row.runs, |run| run.distinct as f64) / n)
        };
        let points: Vec<(f64, f64)> = curve.rows.iter().map(mean).collect();
        let bound = look.number("kept_half_predicted")?;
        match between(&points, place.value) {
            Some(height) => far("the count at half height", height, half),
            None => Some(format!("no count at half height {}", place.value)),
        }
        .or_else(|| look.is(&cell("restitution", curve.restitution, "half"), place.value))
        .or_else(|| {
            unless(place.value > bound - 5.0 * place.error, || {
                format!("half height {} below the bound {bound}", place.value)
            })
        })
    };
    let text = || {
        let [low, high] =
            [found.curves.first()?.half_height?.value, found.curves.last()?.half_height?.value];
        look.are([
            ("restitution_half_low", low),
            ("restitution_half_high", high),
            ("restitution_shift", high - low),
        ])
        .or_else(|| far("the shift", found.shift?.value, high - low))
    };
    found.curves.iter().find_map(one).or_else(text)
}

/// Sizes are those of what was run, by the protocol of the main sweep.
fn as_run(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let parameters = &found.parameters;
    let number = |row: &Ensemble| (row.runs.len() + row.failed) as f64;
    let first = found.curves.first()?;
    let one = found.heated.last()?;
    let near = found.heated.get(found.heated.len().checked_sub(2)?)?;
    let until = *parameters.ends.last()?;
    let protocol = look.results.sweep.as_ref()?.parameters.protocol;
    look.are([
        ("restitution_realisations", number(first.rows.first()?)),
        ("restitution_sigma_count", first.rows.len() as f64),
        ("restitution_heated_realisations", number(one)),
        ("restitution_heated_sigma", one.sigma),
        ("restitution_heated_until", until),
        ("restitution_near_r", near.restitution),
        ("restitution_r_low", first.restitution),
        ("restitution_r_high", found.curves.last()?.restitution),
    ])
    .or_else(|| {
        let asked: Vec<f64> = found.curves.iter().map(|curve| curve.restitution).collect();
        let like =
            |curve: &Curve| curve.rows.iter().all(|row| row.restitution == curve.restitution);
        let so = asked == parameters.restitutions && found.curves.iter().all(like);
        unless(so, || format!("curves at {asked:?}, which is not what was asked for"))
    })
    .or_else(|| unless(one.restitution == 1.0, || "nothing was run without loss".into()))
    .or_else(|| unless(protocol == parameters.protocol, || "another protocol".into()))
}

/// With ω = d = 1 and Ω² = 2 the balance of rare impacts is 2 (1 + r)/(1 − r).
fn warmth(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let of = |r: f64| 2.0 * (1.0 + r) / (1.0 - r);
    let one = |curve: &Curve| {
        // Without a quotient, which at r = 1 is far from no number.
        let r = curve.restitution;
        far("the expected heat", curve.balanced * (1.0 - r), 2.0 * (1.0 + r)).or_else(|| {
            let id = cell("restitution", curve.restitution, "balanced");
            look.is(&id, of(curve.restitution))
        })
    };
    let last = found.curves.last()?.restitution;
    let near = look.number("restitution_near_r")?;
    found
        .curves
        .iter()
        .find_map(one)
        .or_else(|| look.is("restitution_warm_balanced", of(last)))
        .or_else(|| look.is("restitution_near_balanced", of(near)))
}

/// Which gaps can be pressed depends on the forces alone, which are common to all r; how many follows
/// from the Rayleigh law of their amplitudes, within five standard errors.
fn contact(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let gaps = found.parameters.chain.gaps() as f64;
    let first = found.curves.first()?;
    let share = |(place, row): (usize, &Ensemble)| {
        let expected = *found.able_expected.get(place)?;
        let inner = model::rayleigh_above(1.0, row.sigma * std::f64::consts::SQRT_2);
        let wall = model::rayleigh_above(1.0, row.sigma);
        let n = gaps * row.runs.len() as f64;
        let own = row.able as f64 / n;
        // Neighbours share a force: twice the error of independent gaps is more than enough.
        let room = 10.0 * (expected * (1.0 - expected) / n).sqrt() + 5.0 / n;
        far("gaps that forces can press", expected, ((gaps - 2.0) * inner + 2.0 * wall) / gaps)
            .or_else(|| {
                unless((own - expected).abs() <= room, || {
                    format!("a share {own} can be pressed at {}, not {expected}", row.sigma)
                })
            })
    };
    let common = |curve: &Curve| {
        let same = |(a, b): (&Ensemble, &Ensemble)| {
            let comparable = a.failed == 0 && b.failed == 0;
            unless(!comparable || a.able == b.able, || {
                format!("{} and {} gaps can be pressed at {}", a.able, b.able, a.sigma)
            })
        };
        first.rows.iter().zip(&curve.rows).find_map(same)
    };
    let c = look.number("restitution_sigma_c")?;
    let place = first.rows.iter().position(|row| row.sigma == c);
    let text = || look.is("restitution_able_expected", *found.able_expected.get(place?)?);
    let rows = || found.curves.iter().flat_map(|curve| &curve.rows);
    let able: u64 = rows().map(|row| row.able_touched).sum();
    let others: u64 = rows().map(|row| row.others_touched).sum();
    let touched = |row: &&Ensemble| {
        sum(&row.runs, |run| (run.able_touched + run.others_touched) as f64) > 0.0
    };
    let totals = || {
        look.are([
            ("restitution_touched_all", (able + others) as f64),
            ("restitution_touched_others", others as f64),
        ])
        .or_else(|| look.is("restitution_touched_from", first.rows.iter().find(touched)?.sigma))
        .or_else(|| look.is("restitution_touched_to", rows().rfind(touched)?.restitution))
    };
    let list = first.rows.iter().enumerate();
    let mut list = list.map(share);
    list.find_map(|off| off)
        .or_else(|| found.curves.iter().find_map(common))
        .or_else(text)
        .or_else(totals)
}

/// What is expected of a hot chain, by other integrals; its rate rises in every window, while a chain
/// that loses something levels off.
fn hot(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let parameters = &found.parameters;
    let sigma = parameters.heated_sigma;
    let gaps = parameters.chain.gaps() as f64;
    let ends = &parameters.ends;
    let begin = |i: usize| if i == 0 { 0.0 } else { ends[i - 1] };
    let window = |(i, own): (usize, &crate::experiments::restitution::Hot)| {
        let rate = gaps * model::hot_rate(sigma, begin(i), ends[i]);
        far("impacts of a hot chain", own.rate, rate)
            .or_else(|| far("energy of a hot chain", own.ratio, model::hot_ratio(sigma, ends[i])))
    };
    let (one, expected) = (found.heated.last()?, found.hot.last()?);
    let near = found.heated.get(found.heated.len().checked_sub(2)?)?;
    let text = || {
        // u⁴ √2 (1 − r²) = σ², and s² is half of u².
        let s2 = look.number("restitution_near_hot")? * sigma * sigma;
        let r = near.restitution;
        let fourth = 4.0 * s2 * s2 * std::f64::consts::SQRT_2 * (1.0 - r * r);
        look.are([
            ("restitution_one_rate_expected", expected.rate),
            ("restitution_one_ratio_expected", expected.ratio),
        ])
        .or_else(|| far("what forces give", fourth, sigma * sigma))
        .or_else(|| look.is("restitution_one_rate", end(&one.rates)?))
        .or_else(|| look.is("restitution_one_ratio", end(&one.ratios)?))
        .or_else(|| look.is("restitution_near_rate", end(&near.rates)?))
        .or_else(|| look.is("restitution_near_ratio", end(&near.ratios)?))
    };
    let rises = |pair: &[Option<Estimate>]| {
        let (a, b) = (pair[0]?, pair[1]?);
        unless(b.value > a.value, || format!("without loss {} follows {}", b.value, a.value))
    };
    let exponent = |(row, own): (&Ensemble, &Option<Estimate>)| {
        let slope = slope(row, ends)?;
        let own = own.as_ref()?;
        let name = if row.restitution == 1.0 { "one" } else { "near" };
        let told = || {
            let said = row.restitution == 1.0 || row.restitution == near.restitution;
            look.is(&format!("restitution_{name}_exponent"), slope).filter(|_| said)
        };
        far("an exponent", own.value, slope).or_else(told)
    };
    found
        .hot
        .iter()
        .enumerate()
        .find_map(window)
        .or_else(text)
        .or_else(|| one.rates.windows(2).find_map(rises))
        .or_else(|| found.heated.iter().zip(&found.exponents).find_map(exponent))
}

/// The slope over equal steps of ln t, from the differences of all pairs, each weighed by its distance.
fn slope(row: &Ensemble, ends: &[f64]) -> Option<f64> {
    let first = ends.len().saturating_sub(4).max(1);
    let log = |i: usize| {
        let rate = sum(&row.runs, |run| run.impacts[i] as f64) / (ends[i] - ends[i - 1]);
        (pxfm::f_log(ends[i]), pxfm::f_log(rate))
    };
    let points: Vec<(f64, f64)> = (first..ends.len()).map(log).collect();
    let (mut above, mut below) = (0.0, 0.0);
    for (x, y) in &points {
        for (other, height) in &points {
            above += (x - other) * (y - height);
            below += (x - other) * (x - other);
        }
    }
    (below > 0.0).then(|| above / below)
}

//! What is rare, what chaos does, and two masses.

use super::{Guard, Look, far, model, unless};
use crate::claims;
use crate::experiments::horizon::{Horizon, Twins};
use crate::experiments::laws::LawsRow;
use crate::experiments::observe::{NEAR_DECADES, SLOW_DECADES};
use crate::numerics::quadrature::GaussLegendre;

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "exponents_of_laws",
        ids: &["near_exponent", "slow_exponent", "laws_sigma"],
        find: exponents,
    },
    Guard {
        name: "coefficient_of_law",
        ids: &["near_coefficient", "laws_sigma"],
        find: coefficient,
    },
    Guard {
        name: "totals_of_laws",
        ids: &[
            "near_simultaneous",
            "slow_impacts",
            "near_expected",
            "slow_expected",
            "sweep_impacts",
            "contact_phases",
            "contact_phases_rise",
            "sigma_contact",
            "near_limit",
            "slow_limit",
        ],
        find: totals,
    },
    Guard {
        name: "chance_to_stick",
        ids: &["stick_rise", "stick_above", "sigma_stick_above"],
        find: stick,
    },
    Guard {
        name: "means_of_twins",
        ids: &["horizon_order", "horizon_impacts", "horizon_order_first", "horizon_twins"],
        find: twins,
    },
    Guard {
        name: "growth_of_errors",
        ids: &["horizon_tenfold", "growth_rate", "chaos_ceiling", "displaced_limit"],
        find: growth,
    },
    Guard { name: "confidence", ids: &["confidence"], find: confidence },
    Guard {
        name: "bound_of_two_masses",
        ids: &["two_masses_bound", "two_masses_time"],
        find: bound,
    },
];

fn fitted(look: Look<'_>) -> Option<LawsRow> {
    let sigma = look.number("laws_sigma")?;
    look.results.laws().ok()?.rows.into_iter().find(|row| row.sigma == sigma)
}

/// What chance makes of events that need no coincidence beyond being near: the share within a time
/// goes with that time, and the share of slow impacts with the square of the speed, because the
/// rate of impacts goes with the speed itself. Within as many standard errors as claims allow.
fn exponents(look: Look<'_>) -> Option<String> {
    let Some(row) = fitted(look) else { return Some("no law was fitted at laws_sigma".into()) };
    let level = claims::level().quantile;
    let off = |id: &str, error: f64, expected: f64| {
        let found = look.number(id)?;
        unless((found - expected).abs() <= level * error, || {
            format!("{id} is {found}({error}); a power of {expected} is expected")
        })
    };
    off("near_exponent", row.near?.exponent_error, 1.0)
        .or_else(|| off("slow_exponent", row.slow?.exponent_error, 2.0))
}

/// The law in proportion to δ predicts as many impacts within the time from which it was fitted
/// as there were, with the error of such a count.
fn coefficient(look: Look<'_>) -> Option<String> {
    let row = fitted(look)?;
    let sweep = look.results.sweep().ok()?;
    let own = sweep.rows.iter().find(|own| own.sigma == row.sigma)?;
    let expected = look.number("near_coefficient")? * NEAR_DECADES[1] * own.impacts as f64;
    let seen = own.near_decades[1] as f64;
    unless((expected - seen).abs() <= claims::level().quantile * seen.sqrt(), || {
        format!("the law predicts {expected} near impacts where there were {seen}")
    })
}

/// Sums over rows of what each row counted by itself; the expected numbers from the counts of one
/// decade; the contact phases below and above a σ make up all. The limits that are named are the last
/// decades that were counted.
fn totals(look: Look<'_>) -> Option<String> {
    let (sweep, laws) = look.results.sweep().ok().zip(look.results.laws().ok())?;
    let sum = |pick: &dyn Fn(&crate::experiments::sweep::SweepRow) -> u64| {
        sweep.rows.iter().map(pick).sum::<u64>() as f64
    };
    let below = look.number("sigma_contact")?;
    let above = sum(&|row| if row.sigma > below { row.contact_phases } else { 0 });
    let decades = |list: &[f64], from: usize| list[list.len() - 1] / list[from];
    let slow = decades(&SLOW_DECADES, 0);
    look.are([
        ("near_simultaneous", sum(&|row| row.near_simultaneous)),
        ("slow_impacts", sum(&|row| row.slow)),
        ("near_expected", sum(&|row| row.near_decades[1]) * decades(&NEAR_DECADES, 1)),
        ("slow_expected", sum(&|row| row.slow_decades[0]) * slow * slow),
        ("sweep_impacts", laws.totals.impacts as f64),
        ("contact_phases", laws.totals.contact_phases as f64),
        ("contact_phases_rise", laws.totals.contact_phases as f64 - above),
        ("near_limit", NEAR_DECADES[NEAR_DECADES.len() - 1]),
        ("slow_limit", SLOW_DECADES[SLOW_DECADES.len() - 1]),
    ])
}

/// The amplitude of the difference of two forces is Rayleigh distributed with variance 2σ² in each
/// quadrature; the chance that it exceeds one is the integral of that density.
fn stick(look: Look<'_>) -> Option<String> {
    let rule = GaussLegendre::new(20);
    let chance = |sigma: f64| {
        let variance = 2.0 * sigma * sigma;
        let density = |x: f64| x / variance * pxfm::f_exp(-0.5 * x * x / variance);
        rule.integrate_panels(1.0, 1.0 + 12.0 * sigma, 30, density)
    };
    let threshold = look.published.statement("sec2_half_height").ok()?.number().ok()?;
    look.is("stick_rise", chance(threshold))
        .or_else(|| look.is("stick_above", chance(look.number("sigma_stick_above")?)))
}

fn mean(twins: &[Twins], pick: impl Fn(&Twins) -> Option<f64>) -> Option<f64> {
    let own: Vec<f64> = twins.iter().filter_map(pick).collect();
    (!own.is_empty()).then(|| own.iter().sum::<f64>() / own.len() as f64)
}

/// Times and impacts up to which two copies agree, from the pairs; none agrees for less than the
/// first; and all pairs that were asked for are there.
fn twins(look: Look<'_>) -> Option<String> {
    let found: &Horizon = look.results.horizon().ok()?;
    let mut orders: Vec<f64> = found.twins.iter().filter_map(|pair| pair.order).collect();
    orders.sort_by(f64::total_cmp);
    let impacts = |pair: &Twins| Some(pair.order_impacts? as f64);
    look.is("horizon_order", mean(&found.twins, |pair| pair.order)?)
        .or_else(|| look.is("horizon_impacts", mean(&found.twins, impacts)?))
        .or_else(|| look.is("horizon_order_first", *orders.first()?))
        .or_else(|| look.is("horizon_twins", found.parameters.realisations as f64))
}

/// An error that grows at the rate λ is ten times as large after the tenfold time, and grows from the
/// rounding of a double to the limit within the time that chaos allows.
fn growth(look: Look<'_>) -> Option<String> {
    let rate = look.results.horizon().ok().and_then(|found| found.growth);
    let tenfold = look.number("horizon_tenfold").zip(rate).and_then(|(time, rate)| {
        far("growth within horizon_tenfold", pxfm::f_exp(rate.value * time), 10.0)
    });
    tenfold.or_else(|| {
        let race = &look.results.race().ok()?.growth;
        let (time, rate) = look.number("chaos_ceiling").zip(look.number("growth_rate"))?;
        let own = mean(&race.twins, |pair| pair.growth)?;
        let reached = 0.5 * f64::EPSILON * pxfm::f_exp(rate * time);
        far("growth_rate", rate, own)
            .or_else(|| far("an error at chaos_ceiling", reached, look.number("displaced_limit")?))
    })
}

/// The normal interval of an estimate leaves out the share of the distribution that the confidence
/// leaves out.
fn confidence(look: Look<'_>) -> Option<String> {
    let order = look.results.horizon().ok()?.order?;
    let errors = 0.5 * (order.interval[1] - order.interval[0]) / order.error;
    // The quantile of the normal distribution has nine digits.
    let left = 1.0 - model::both_tails(errors);
    let confidence = look.number("confidence")?;
    unless((left - confidence).abs() < 1e-6, || {
        format!("an interval holds {left} of the distribution, not {confidence}")
    })
}

/// Two masses that are driven against each other by the bound F each have a relative motion of forced
/// amplitude 2F d/(2F) that reaches d exactly: (1 + Ω/ω) 2F = |ω² − Ω²| d. And no time is named at
/// which nothing was asked.
fn bound(look: Look<'_>) -> Option<String> {
    let found = look.results.two_masses().ok()?;
    let chain = &found.parameters.chain;
    let (w, big_w) = (chain.natural_frequency, chain.forcing_frequency);
    let reach = (1.0 + big_w / w) * 2.0 * look.number("two_masses_bound")?;
    far("the reach of two masses", reach, (w * w - big_w * big_w).abs() * chain.spacing).or_else(
        || {
            let time = look.number("two_masses_time")?;
            let last = found.parameters.times.last().copied();
            unless(last.is_some_and(|last| last.floor() == time), || {
                format!("two masses were not followed to {time}")
            })
        },
    )
}

//! The main sweep: what chance must not break.

use super::{Guard, Look, room, unless};
use crate::claims;
use impact_numerics::statistics::Estimate;

pub const GUARDS: &[Guard] = &[
    Guard { name: "two_seeds", ids: &["second_seed.*"], find: two_seeds },
    Guard { name: "laws_of_chance", ids: &["sweep.laws*"], find: exponents },
];

/// Two seeds differ by what chance allows: in the half height, and in the means at each σ.
fn two_seeds(look: Look<'_>) -> Option<String> {
    let half = |name| {
        let table = look.results.table(name).ok()?;
        table.estimates(&[], "half_height", "half_height").pop().map(|(_, half)| half)
    };
    let halves: Option<(Estimate, Estimate)> = half("sweep.rise").zip(half("second_seed.rise"));
    let apart = halves.and_then(|(a, b)| {
        unless((a.value - b.value).abs() <= room(&a, &b), || {
            format!("half heights of two seeds are {} and {}", a.value, b.value)
        })
    });
    apart.or_else(|| {
        let both = look.results.table("second_seed.beside_first").ok()?;
        let largest = both.number(&[], "largest").ok()?;
        let limit = claims::level().among(both.number(&[], "compared").ok()? as usize);
        unless(largest <= limit, || {
            format!("two seeds are {largest} standard errors apart, and {limit} are allowed")
        })
    })
}

/// What chance makes of events that need no coincidence beyond being near: the share within a time
/// goes with that time, and the share of slow impacts with the square of the speed, because the
/// rate of impacts goes with the speed itself. Within as many standard errors as claims allow.
fn exponents(look: Look<'_>) -> Option<String> {
    let laws = look.results.table("sweep.laws").ok()?;
    let off = |column: &'static str, expected: f64| {
        let (sigma, own) =
            laws.estimates(&[], "sigma", column).into_iter().find(|(sigma, _)| *sigma == 0.2)?;
        let room = claims::level().quantile * own.error;
        unless((own.value - expected).abs() <= room, || {
            format!("{column} at {sigma} is {}({}), not {expected}", own.value, own.error)
        })
    };
    off("near_exponent", 1.0).or_else(|| off("slow_exponent", 2.0))
}

//! Speed against accuracy: what must hold of methods whatever they are.

use super::{Guard, Look, far, unless};
use crate::experiments::accuracy::race::{DISPLACED, Entry};
use crate::params::MethodName;
use crate::report::values::{Digits, Number};

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "horizons_of_runs",
        ids: &[
            "own_horizon",
            "sampled_coarse_horizon",
            "runge_fine_horizon",
            "verlet_fine_horizon",
            "race_chains",
        ],
        find: horizons,
    },
    Guard { name: "same_states_for_all", ids: &["race_segments", "own_misses"], find: states },
    Guard {
        name: "sizes_asked_for",
        ids: &[
            "factorials_last",
            "gamma_n",
            "eq25_*",
            "scale_small",
            "scale_large",
            "scale_rival_large",
        ],
        find: sizes,
    },
    Guard {
        name: "sentences_of_bias",
        ids: &[
            "bias.*",
            "bias_low",
            "bias_high",
            "coarse_far",
            "coarse_near",
            "bias_worst_share",
            "bias_good",
            "bias_settings",
        ],
        find: bias,
    },
];

fn entries(look: Look<'_>) -> impl Iterator<Item = &Entry> {
    look.results.race().into_iter().flat_map(|race| &race.entries)
}

/// A horizon is the mean time at which runs end; each method follows every chain.
fn horizons(look: Look<'_>) -> Option<String> {
    let chains = look.results.race().ok()?.parameters.chains;
    let off = entries(look).find_map(|entry| {
        let sum: f64 = entry.runs.iter().map(|run| run.time).sum();
        let what = format!("a horizon of {:?}", entry.setting.method);
        far(&what, entry.horizon?[0], sum / entry.runs.len() as f64)
            .or_else(|| unless(entry.runs.len() == chains, || format!("{what} has other chains")))
    });
    off.or_else(|| look.is("race_chains", chains as f64))
}

/// Every method is asked for the next impact from the same states, and an impact that is displaced is
/// one whose error is above the limit.
fn states(look: Look<'_>) -> Option<String> {
    let asked = look.results.race().ok()?.parameters.segments as u64;
    let tried: Vec<u64> = entries(look).map(|entry| entry.segments.tried).collect();
    let all = tried.iter().all(|n| *n == tried[0] && *n <= asked);
    unless(all, || format!("methods are asked from different numbers of states: {tried:?}"))
        .or_else(|| {
            entries(look).find_map(|entry| {
                let largest = entry.segments.errors?[2];
                let so = (entry.segments.displaced > 0) == (largest > DISPLACED);
                unless(so, || format!("{:?} errs by at most {largest}", entry.setting.method))
            })
        })
}

/// Points and rows stand at the sizes that were asked for, each once for a method; the ends that are named are
/// the ends of what was asked for.
fn sizes(look: Look<'_>) -> Option<String> {
    let (analytic, scale) = look.results.analytic().ok().zip(look.results.scale().ok())?;
    let lists = analytic.distribution.iter().map(|own| own.points.iter().map(|p| p.big_n));
    let uneven = lists.into_iter().any(|sizes| sizes.ne(analytic.parameters.sizes.iter().copied()));
    let rows =
        |method: MethodName| scale.rows.iter().filter(move |row| row.setting.method == method);
    let unasked = MethodName::ALL.into_iter().any(|method| {
        let own = rows(method).map(|row| row.masses);
        let asked = &scale.parameters.masses;
        // Some methods end before the largest sizes.
        own.clone().ne(asked.iter().copied().cycle().take(own.count()))
    });
    let range = |f: fn(f64, f64) -> f64| {
        analytic.relation.iter().flat_map(|own| &own.points).map(|p| p.0).reduce(f)
    };
    unless(!uneven && !unasked, || "sizes are not those that were asked for".into())
        .or_else(|| look.is("eq25_low", range(f64::min)?))
        .or_else(|| look.is("eq25_high", range(f64::max)?))
        .or_else(|| {
            let last = look.number("factorials_last")?;
            let known = analytic.parameters.sizes.iter().any(|n| *n as f64 == last);
            unless(known, || format!("no factorial was taken at N = {last}"))
        })
}

/// What the sentences say of biases is what the cells of the table say: the largest of the first column,
/// and how many of the last are within one per cent, their errors allowed for.
fn bias(look: Look<'_>) -> Option<String> {
    let columns = look.results.biases().ok()?.certified.len();
    let cells = |column: usize| {
        let own = move |value: &&crate::report::Value| {
            let cell = value.id.strip_prefix("bias.m").and_then(|rest| rest.split_once("_s"));
            cell.is_some_and(|(_, own)| own.parse() == Ok(column))
        };
        look.values.iter().filter(own).filter_map(move |value| {
            let error = match value.number {
                Number::Real { digits: Digits::Error(error), .. } => error,
                _ => 0.0,
            };
            Some((look.number(&value.id)?, error))
        })
    };
    let worst = cells(0).map(|cell| cell.0).max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let last = columns.checked_sub(1)?;
    let good = cells(last).filter(|(bias, error)| bias.abs() <= 0.01 + error).count();
    let named = |id: &str, column: usize| {
        let found = look.number(id)?;
        let held = cells(column).any(|(cell, _)| far(id, found, cell).is_none());
        unless(held, || format!("{id} is {found}, which is no cell of its column"))
    };
    look.is("bias_worst_share", worst)
        .or_else(|| look.is("bias_good", good as f64))
        .or_else(|| look.is("bias_settings", cells(last).count() as f64))
        .or_else(|| named("coarse_near", 0))
        .or_else(|| named("coarse_far", last))
        .or_else(|| look.is("bias_low", look.number("bias.sigma0")?))
        .or_else(|| look.is("bias_high", look.number(&format!("bias.sigma{last}"))?))
}

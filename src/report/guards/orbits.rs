//! Periodic orbits from circuits.

use super::{Guard, Look, far, unless};
use crate::experiments::orbits::{End, Found, Orbits, Row};
use crate::report::values::cell;
use std::collections::BTreeSet;

pub const GUARDS: &[Guard] = &[
    Guard { name: "circuits_counted", ids: &["orbits_circuits"], find: circuits },
    Guard { name: "orbits_listed", ids: &["orbits.*", "orbits_*"], find: listed },
    Guard { name: "orbits_in_sum", ids: &["orbits_*"], find: totals },
    Guard {
        name: "multipliers_shrink_volume",
        ids: &["orbits_fig5_radius", "orbits_fig6_radius"],
        find: volume,
    },
    Guard { name: "orbits_of_one_gap", ids: &["orbits_single*", "orbits_swing"], find: single },
    Guard { name: "ends_of_runs", ids: &["orbits.*", "orbits_runs_*"], find: ends },
    Guard { name: "hunts_of_figures", ids: &["orbits_fig*"], find: hunts },
];

fn orbits(look: Look<'_>) -> Option<&Orbits> {
    look.results.orbits().ok()
}

/// Σ N!/(k (N − k)!), Eqs. (6) and (7), and no circuit is another one turned.
fn circuits(look: Look<'_>) -> Option<String> {
    let orbits = orbits(look)?;
    let big_n = orbits.parameters.chain.gaps();
    let of = |k: usize| (0..k).map(|i| (big_n - i) as f64).product::<f64>() / k as f64;
    let turned = |circuit: &Vec<usize>| {
        let turn = |i: usize| [&circuit[i..], &circuit[..i]].concat();
        (0..circuit.len()).map(turn).min()
    };
    let different: BTreeSet<_> = orbits.circuits.iter().map(turned).collect();
    look.is("orbits_circuits", (1..=big_n).map(of).sum())
        .or_else(|| look.is("orbits_circuits", different.len() as f64))
}

fn stable(found: &Found) -> bool {
    found.multipliers.iter().all(|[re, im]| re * re + im * im < 1.0)
}

/// Shares are those of the list of orbits.
fn listed(look: Look<'_>) -> Option<String> {
    let orbits = orbits(look)?;
    let n = orbits.parameters.forcings as f64;
    let row = |row: &Row| {
        // Pairs of circuit and forcing, each once.
        let pairs = |k: Option<usize>, only: bool| -> BTreeSet<(usize, usize)> {
            let of = |f: &&Found| {
                k.is_none_or(|k| orbits.circuits[f.circuit].len() == k) && (!only || stable(f))
            };
            row.found.iter().filter(of).map(|f| (f.circuit, f.forcing)).collect()
        };
        let length = |k: usize| {
            let own = row.lengths.iter().find(|own| own.k == k)?;
            let number = orbits.circuits.iter().filter(|c| c.len() == k).count() as f64;
            let share = |only: bool| pairs(Some(k), only).len() as f64 / (n * number);
            far("a share of circuits", own.admissible.value, share(false))
                .or_else(|| far("a share of stable circuits", own.stable.value, share(true)))
        };
        let seen = |(circuit, seen): (usize, &[u64; 2])| {
            let of = |only: bool| pairs(None, only).iter().filter(|(c, _)| *c == circuit).count();
            far("forcings with an orbit", seen[0] as f64, of(false) as f64)
                .or_else(|| far("forcings with a stable one", seen[1] as f64, of(true) as f64))
        };
        let any: BTreeSet<_> = pairs(None, true).into_iter().map(|(_, forcing)| forcing).collect();
        let name = id(row, "sigma");
        (1..=row.lengths.len())
            .find_map(length)
            .or_else(|| row.seen.iter().enumerate().find_map(seen))
            .or_else(|| far("forcings with any", row.any_stable.value, any.len() as f64 / n))
            .or_else(|| look.is(&name, row.sigma))
    };
    let sigmas = || {
        let asked = &orbits.parameters.sigmas;
        let same = asked.iter().eq(orbits.rows.iter().map(|row| &row.sigma));
        unless(same, || "other sigmas than asked for".into())
    };
    let text = || {
        let sigma = look.number("orbits_sigma")?;
        let Some(row) = orbits.rows.iter().find(|row| row.sigma == sigma) else {
            return Some(format!("no row at sigma = {sigma}"));
        };
        let number = |circuit: &[usize]| {
            let has = |f: &&Found| orbits.circuits[f.circuit] == circuit;
            let own: BTreeSet<_> = row.found.iter().filter(has).map(|f| f.forcing).collect();
            own.len() as f64
        };
        let last = orbits.parameters.chain.gaps() - 1;
        let all: Vec<f64> = orbits.circuits.iter().map(|c| number(c)).collect();
        let pairs = || (0..last).flat_map(|i| (i + 1..=last).map(move |j| number(&[i, j])));
        look.are([
            ("orbits_wall", number(&[0]) + number(&[last])),
            ("orbits_inner", (1..last).map(|gap| number(&[gap])).sum()),
            ("orbits_never", all.iter().filter(|n| **n == 0.0).count() as f64),
            ("orbits_pair_most", pairs().fold(0.0, f64::max)),
            ("orbits_pair_least", pairs().fold(f64::INFINITY, f64::min)),
        ])
    };
    let low = || {
        let row = orbits.rows.first()?;
        let any: BTreeSet<_> = row.found.iter().filter(|f| stable(f)).map(|f| f.forcing).collect();
        look.is("orbits_low_sigma", row.sigma)
            .or_else(|| look.is("orbits_low_stable", any.len() as f64 / n))
            .or_else(|| look.is("orbits_low_silent", row.ended.silent as f64))
    };
    sigmas().or_else(|| orbits.rows.iter().find_map(row)).or_else(text).or_else(low)
}

/// Totals are those of the list.
fn totals(look: Look<'_>) -> Option<String> {
    let orbits = orbits(look)?;
    let parameters = &orbits.parameters;
    let all: Vec<&Found> = orbits.rows.iter().flat_map(|row| &row.found).collect();
    let count = |is: &dyn Fn(&Found) -> bool| all.iter().filter(|f| is(f)).count() as f64;
    look.are([
        ("orbits_total", all.len() as f64),
        ("orbits_one_period", count(&|f| f.periods == 1)),
        ("orbits_last_period", count(&|f| f.periods == parameters.periods)),
        ("orbits_stable", count(&stable)),
        ("orbits_unstable", count(&|f| !stable(f))),
        ("orbits_came_back", count(&|f| stable(f) && f.returned)),
        ("orbits_went", count(&|f| !stable(f) && !f.returned)),
        ("orbits_half", count(&|f| 2 * f.start + 1 < parameters.starts) / all.len() as f64),
        ("orbits_forcings", orbits.rows.first()?.ended.ends.len() as f64),
        ("orbits_periods", orbits.rows.first()?.by_periods.len() as f64),
    ])
}

/// An impact takes r² of a volume, whatever the orbit: so do the multipliers in their product, the
/// neutral ones being on the unit circle. The largest is the radius.
fn volume(look: Look<'_>) -> Option<String> {
    let orbits = orbits(look)?;
    let r = orbits.parameters.chain.restitution;
    let wrong = |multipliers: &[[f64; 2]], radius: f64, k: usize| {
        let moduli: Vec<f64> = multipliers.iter().map(|[x, y]| (x * x + y * y).sqrt()).collect();
        let (product, expected) =
            (moduli.iter().product::<f64>(), (0..2 * k).fold(1.0, |product, _| product * r));
        let off = (product / expected - 1.0).abs();
        unless(off < DIGITS, || format!("multipliers multiply to {product}, not {expected}"))
            .or_else(|| far("a radius", radius, moduli.iter().copied().fold(0.0, f64::max)))
    };
    let found = |f: &Found| wrong(&f.multipliers, f.radius, orbits.circuits[f.circuit].len());
    let best = || {
        orbits.hunts.iter().find_map(|hunt| {
            let best = hunt.best.as_ref()?;
            wrong(&best.multipliers, best.radius, hunt.circuit.len())
        })
    };
    orbits.rows.iter().flat_map(|row| &row.found).find_map(found).or_else(best)
}

/// What rounding leaves of a product of large and small multipliers.
const DIGITS: f64 = 1e-5;

/// The equations of one gap alone: a force that suffices, by its greatest reach over all phases.
fn single(look: Look<'_>) -> Option<String> {
    let orbits = orbits(look)?;
    let chain = &orbits.parameters.chain;
    let r = chain.restitution;
    let half = std::f64::consts::PI * chain.natural_frequency / chain.forcing_frequency;
    let (sin, cos) = pxfm::f_sincos(half);
    let ratio = chain.forcing_frequency / chain.natural_frequency;
    let h = -(cos / sin) * ratio * (1.0 + r) / (1.0 - r);
    let reach = |phase: f64| {
        let (sin, cos) = pxfm::f_sincos(phase);
        h * sin - cos
    };
    // The best of 33 phases, then of 33 around it, until they are one.
    let (mut best, mut step) = (0.5 * std::f64::consts::PI, std::f64::consts::PI / 32.0);
    for _ in 0..9 {
        let phases = (-16..=16).map(|i| best + f64::from(i) * step);
        best = phases.max_by(|a, b| reach(*a).total_cmp(&reach(*b)))?;
        step /= 8.0;
    }
    let least = chain.spacing / reach(best);
    let row = |row: &Row| {
        let wall = pxfm::f_exp(-least * least / (2.0 * row.sigma * row.sigma));
        let inner = wall.sqrt();
        let p = 0.5 * (wall + inner);
        let counted = row.singles.iter().sum::<u64>() as f64;
        let all = (chain.gaps() * row.singles.len()) as f64;
        // Gaps of one forcing share masses: the error of independent ones is too small by no more than 2.
        let allowed = 4.0 * 2.0 * (p * (1.0 - p) / all).sqrt() + 1.0 / all;
        let measured = counted / all;
        far("solutions for one gap", row.single as f64, counted)
            .or_else(|| {
                unless((row.single_expected - p).abs() < 1e-8, || {
                    format!("{} of the gaps expected, {p} by another way", row.single_expected)
                })
            })
            .or_else(|| {
                unless((measured - p).abs() < allowed, || {
                    format!("{measured} of the gaps have a solution, where {p} should")
                })
            })
    };
    let lowest = orbits.rows.first()?;
    let measured = lowest.singles.iter().sum::<u64>() as f64;
    orbits
        .rows
        .iter()
        .find_map(row)
        .or_else(|| look.is("orbits_swing", (1.0 + (sin / cos) * (sin / cos)).sqrt()))
        .or_else(|| {
            look.is("orbits_single", measured / (chain.gaps() * lowest.singles.len()) as f64)
        })
}

fn id(row: &Row, name: &str) -> String {
    cell("orbits", row.sigma, name)
}

/// Each run ends in one way.
fn ends(look: Look<'_>) -> Option<String> {
    let orbits = orbits(look)?;
    let of = |row: &Row, is: &dyn Fn(&End) -> bool| {
        row.ended.ends.iter().filter(|end| is(end)).count() as f64
    };
    let periodic = |end: &End| matches!(end, End::Periodic { .. });
    let row = |row: &Row| {
        let own = &row.ended;
        far("silent runs", own.silent as f64, of(row, &|end| *end == End::Silent))
            .or_else(|| far("periodic runs", own.periodic as f64, of(row, &periodic)))
            .or_else(|| far("other runs", own.neither as f64, of(row, &|end| *end == End::Neither)))
            .or_else(|| look.is(&id(row, "silent"), of(row, &|end| *end == End::Silent)))
            .or_else(|| look.is(&id(row, "periodic"), of(row, &periodic)))
            .or_else(|| look.is(&id(row, "neither"), of(row, &|end| *end == End::Neither)))
    };
    let sum = |is: &dyn Fn(&End) -> bool| orbits.rows.iter().map(|row| of(row, is)).sum::<f64>();
    let simple = |end: &End| match end {
        End::Periodic { gaps, .. } => gaps.iter().collect::<BTreeSet<_>>().len() == gaps.len(),
        _ => false,
    };
    orbits.rows.iter().find_map(row).or_else(|| {
        look.are([
            ("orbits_runs_periodic", sum(&periodic)),
            ("orbits_runs_simple", sum(&simple)),
            ("orbits_runs_solved", sum(&|end| matches!(end, End::Periodic { solved: true, .. }))),
            ("orbits_runs_sought", sum(&|end| matches!(end, End::Periodic { sought: true, .. }))),
            ("orbits_runs_listed", sum(&|end| matches!(end, End::Periodic { listed: true, .. }))),
        ])
    })
}

/// Counts are those over pairs of σ and forcing.
fn hunts(look: Look<'_>) -> Option<String> {
    let orbits = orbits(look)?;
    let own = &orbits.parameters.hunt;
    let pairs = (own.sigmas.len() * own.forcings) as f64;
    let starts = pairs * (own.starts * orbits.parameters.periods) as f64;
    let hunt = |(name, place): (&str, usize)| {
        let hunt = orbits.hunts.get(place)?;
        let sum = |i: usize| hunt.each.iter().map(|each| each[i]).sum::<u64>() as f64;
        let named = |what: &str| format!("orbits_{name}_{what}");
        let stable = || match name {
            "fig5" => look.is(&named("stable"), sum(3)),
            _ => None,
        };
        look.is(&named("starts"), starts)
            .or_else(|| look.is(&named("returns"), sum(0)))
            .or_else(|| look.is(&named("admissible"), sum(2)))
            .or_else(stable)
            .or_else(|| look.is(&named("radius"), hunt.best.as_ref()?.radius))
    };
    look.is("orbits_fig_pairs", pairs)
        .or_else(|| [("fig5", 0), ("fig6", 1)].into_iter().find_map(hunt))
}

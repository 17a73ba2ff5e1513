//! Gaps that close by themselves, and chains with one of them.

use super::{Guard, Look, far, model, unless};
use crate::experiments::nucleation::{AtLeastOne, Chains, Chances, Nucleation};
use crate::report::values::cell;

pub const GUARDS: &[Guard] = &[
    Guard { name: "p_of_single_gaps", ids: &["nucleation_*", "nucleation.*"], find: p },
    Guard { name: "clumps_of_gaps", ids: &["nucleation.*", "nucleation_*"], find: clumps },
    Guard { name: "half_of_chains_by_clumps", ids: &["nucleation_half"], find: half },
    Guard { name: "first_impacts_as_expected", ids: &["nucleation.*"], find: as_expected },
    Guard { name: "first_impacts_in_order", ids: &["nucleation.*"], find: in_order },
    Guard { name: "nucleation_as_tabled", ids: &["nucleation_*", "nucleation.*"], find: tabled },
];

fn nucleation(look: Look<'_>) -> Option<&Nucleation> {
    look.results.nucleation().ok()
}

/// In unlimited time, by integrals; at a wall only one of the forces differs from zero.
fn p(look: Look<'_>) -> Option<String> {
    nucleation(look)?.gaps.iter().find_map(|row| {
        let sigma = row.sigma;
        let wall = sigma * std::f64::consts::FRAC_1_SQRT_2;
        far("p from rest", row.ever.p, model::p_rest(sigma))
            .or_else(|| far("p at a wall", row.ever.wall, model::p_rest(wall)))
            .or_else(|| far("p of random starts", row.random, model::p(sigma)))
            .or_else(|| {
                far("p without free parts", row.zero, 1.0 / pxfm::f_exp(0.25 / (sigma * sigma)))
            })
    })
}

/// The mean number of clumps is that of gaps less that of neighbours that both close; what is expected, and
/// its bound, follow from it.
fn clumps(look: Look<'_>) -> Option<String> {
    let found = nucleation(look)?;
    found.chains.iter().find_map(|row| {
        let gaps = found.gaps.iter().find(|gaps| gaps.sigma == row.sigma)?;
        let chances = gaps.within.iter().chain([&gaps.ever]);
        let expected = row.expected.iter().chain([&row.ever]);
        chances.zip(expected).find_map(|(own, expected)| {
            let n = row.masses as f64;
            let gaps = 2.0 * own.wall + (n - 1.0) * own.p;
            let pairs = 2.0 * own.wall_pair + (n - 2.0) * own.pair;
            let mean = gaps - pairs;
            let none = 1.0 / pxfm::f_exp(mean);
            let log = 2.0 * pxfm::f_log1p(-own.wall) + (n - 1.0) * pxfm::f_log1p(-own.p);
            let off = (expected.independent - 1.0 + pxfm::f_exp(log)).abs();
            far("the mean number of clumps", expected.clumps, mean)
                .or_else(|| far("the share of chains", expected.value, 1.0 - none))
                .or_else(|| {
                    // One minus a product loses digits where it is small.
                    unless(off < 1e-12, || format!("the independent share is off by {off}"))
                })
                .or_else(|| far("a bound", expected.bound, bound(row.masses, own, expected)))
        })
    })
}

/// The bound of Chen and Stein, by double sums over all gaps.
fn bound(masses: usize, own: &Chances, expected: &AtLeastOne) -> f64 {
    let closes = |gap: usize| if gap.is_multiple_of(masses) { own.wall } else { own.p };
    let begins = |gap: usize| match gap {
        0 => own.wall,
        gap if gap == masses => own.wall - own.wall_pair,
        1 => own.p - own.wall_pair,
        _ => own.p - own.pair,
    };
    let near = |gap: usize| gap.saturating_sub(2)..=(gap + 2).min(masses);
    let of = |gap: usize| {
        near(gap).map(move |other| {
            let both = if gap.abs_diff(other) == 2 { closes(gap) * closes(other) } else { 0.0 };
            begins(gap) * begins(other) + both
        })
    };
    let sum: f64 = (0..=masses).flat_map(of).sum();
    sum * expected.value / expected.clumps
}

/// Half of the chains have a gap that closes where the mean number of clumps is ln 2. Its logarithm is nearly a
/// line against 1/σ², and dependence puts it above where independent gaps would.
fn half(look: Look<'_>) -> Option<String> {
    let found = nucleation(look)?;
    let rows = found.chains.iter().filter(|row| row.masses == found.parameters.chain.masses);
    let line: Vec<(f64, f64)> =
        rows.map(|row| (pxfm::f_log(row.ever.clumps), -1.0 / (row.sigma * row.sigma))).collect();
    let place = (-1.0 / super::places::between(&line, pxfm::f_log(std::f64::consts::LN_2))?).sqrt();
    let least = look.number("kept_half_predicted")?;
    unless((found.half - place).abs() < 1e-4 && found.half > least, || {
        format!("half of the chains at {}, not at {place}, above {least}", found.half)
    })
    .or_else(|| look.is("nucleation_half", found.half))
}

/// As many chains have an impact as are expected to, but for the bound and chance: five standard errors, and five
/// chains where hardly any is expected.
fn as_expected(look: Look<'_>) -> Option<String> {
    nucleation(look)?.chains.iter().find_map(|row| {
        let n = row.realisations as f64;
        row.hit.iter().zip(&row.expected).find_map(|(hit, expected)| {
            let (found, p) = (*hit as f64 / n, expected.value);
            let room = expected.bound + 5.0 * (p * (1.0 - p) / n).sqrt() + 5.0 / n;
            unless((found - p).abs() <= room, || {
                format!("{found} of the chains, {p} expected at {} masses", row.masses)
            })
        })
    })
}

/// Who has an impact early has one later, and nobody has one without a gap that closes by itself.
fn in_order(look: Look<'_>) -> Option<String> {
    let found = nucleation(look)?;
    found.chains.iter().find_map(|row| {
        let last = row.hit.last()?;
        let rises = row.hit.windows(2).all(|pair| pair[0] <= pair[1]);
        unless(rises && *last <= row.able && row.able <= row.realisations, || {
            format!("{:?} of {} of {} chains", row.hit, row.able, row.realisations)
        })
    })
}

/// The text and the table say what the results do.
fn tabled(look: Look<'_>) -> Option<String> {
    let found = nucleation(look)?;
    let lengths = || found.chains.iter().map(|row| row.masses);
    let (shortest, longest) = (lengths().min()?, lengths().max()?);
    let off = |masses: usize| {
        let rows = found.chains.iter().filter(|row| row.masses == masses);
        let off = rows.filter_map(|row| {
            let share = *row.hit.last()? as f64 / row.realisations as f64;
            Some((row.expected.last()?.value - share).abs())
        });
        off.fold(0.0, f64::max)
    };
    let sigma = look.number("nucleation_sigma")?;
    let Some(gaps) = found.gaps.iter().find(|row| row.sigma == sigma) else {
        return Some(format!("no gaps at sigma = {sigma}"));
    };
    let at = |letter: &str| {
        let time = look.number(&format!("nucleation_time_{letter}"))?;
        let place = found.parameters.times.iter().position(|own| *own == time);
        let Some(place) = place else { return Some(format!("nothing at T = {time}")) };
        let missing = (gaps.ever.p - gaps.within[place].p) / gaps.ever.p;
        look.is(&format!("nucleation_missing_{letter}"), missing)
    };
    look.are([
        ("nucleation_shortest", shortest as f64),
        ("nucleation_longest", longest as f64),
        ("nucleation_until", *found.parameters.times.last()?),
        ("nucleation_off", off(100)),
        ("nucleation_off_short", off(shortest)),
        ("nucleation_p", model::p_rest(sigma)),
        ("nucleation_wall", model::p_rest(sigma * std::f64::consts::FRAC_1_SQRT_2)),
        ("nucleation_neighbour", gaps.ever.pair / gaps.ever.p),
    ])
    .or_else(|| at("a"))
    .or_else(|| at("b"))
    .or_else(|| found.chains.iter().filter(|row| row.masses == 100).find_map(|row| line(look, row)))
}

fn line(look: Look<'_>, row: &Chains) -> Option<String> {
    let id = |name: &str| cell("nucleation", row.sigma, name);
    let last = row.expected.last()?;
    let swept = look.results.sweep().ok()?.rows.iter().find(|own| own.sigma == row.sigma);
    look.is(&id("sigma"), row.sigma)
        .or_else(|| look.is(&id("p"), model::p_rest(row.sigma)))
        .or_else(|| look.is(&id("clumps"), last.value))
        .or_else(|| look.is(&id("bound"), last.bound))
        .or_else(|| look.is(&id("independent"), last.independent))
        .or_else(|| look.is(&id("found"), *row.hit.last()? as f64 / row.realisations as f64))
        .or_else(|| {
            // Counts of the histogram: all that ran, and the kept among them.
            let ran: u32 = swept?.counts.iter().sum();
            let kept: u32 = swept?.counts.iter().skip(1).sum();
            look.is(&id("kept"), f64::from(kept) / f64::from(ran))
        })
}

//! Long chains, friction and other forces.

use super::{Guard, Look, far, model, unless};
use crate::experiments::chains::{Chains, Curve, Ensemble, Run, chain, pieces};
use crate::experiments::protocol::ProtocolCell;
use crate::params::{ChainCurve, ChainKind};

pub const GUARDS: &[Guard] = &[
    Guard { name: "chains_on_curves", ids: &["chains.*"], find: places },
    Guard { name: "chains_in_the_map", ids: &["chains.*", "chains_fall*"], find: times },
    Guard { name: "chains_silent", ids: &["chains_open*", "chains_shut*"], find: silent },
    Guard { name: "chains_by_expectation", ids: &["chains.f*"], find: expected },
    Guard { name: "chains_as_run", ids: &["chains.*", "chains_*"], find: as_run },
];

fn found(look: Look<'_>) -> Option<&Chains> {
    look.results.chains().ok()
}

/// What stands in the ids of a curve: n and T of a length, a force, a friction.
fn id(own: &ChainCurve, time: f64, column: &str) -> Option<String> {
    let text = |x: f64| x.to_string().replace('.', "_");
    Some(match (own.kind, column) {
        (ChainKind::Length, _) => format!("chains.n{}_t{time}_{column}", own.masses),
        (ChainKind::Drift, "half") => format!("chains.{}_t{time}", own.name.split_once('-')?.1),
        (ChainKind::Damping, "half") => format!("chains.d{}_t{time}", text(own.damping)),
        (ChainKind::Components, "half" | "kept") => format!("chains.m{}_{column}", own.components),
        (ChainKind::Frequency, "half" | "kept" | "ever" | "there") => {
            format!("chains.f{}_{column}", text(own.forcing_frequency))
        }
        _ => return None,
    })
}

/// The mean share of the gaps in a window, once more from the counts: a piece counts as much as another.
pub(super) fn share(found: &Chains, own: &ChainCurve, row: &Ensemble, window: usize) -> f64 {
    let gaps = chain(&found.parameters, own).gaps();
    let sizes = pieces(gaps, found.parameters.piece);
    let of = |run: &Run| -> f64 {
        let counts = run.counts[window].iter().zip(&sizes);
        counts.map(|(&k, &size)| f64::from(k) / size as f64).sum::<f64>() / sizes.len() as f64
    };
    row.runs.iter().rev().map(of).sum::<f64>() / row.runs.len() as f64
}

/// Where a curve comes from below a level for the last time.
pub(super) fn crossing(points: &[(f64, f64)], level: f64) -> Option<f64> {
    let last = points.windows(2).rev().find(|pair| pair[0].1 < level && pair[1].1 >= level)?;
    let [(a, low), (b, high)] = [last[0], last[1]];
    // It must stay there.
    let stays = points.iter().filter(|point| point.0 >= b).all(|point| point.1 >= level);
    stays.then(|| ((high - level) * a + (level - low) * b) / (high - low))
}

/// Shares, half heights and widths follow from the counts.
fn places(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let one = |(own, curve): (&ChainCurve, &Curve)| {
        let window = |(i, time): (usize, &f64)| {
            let points: Vec<(f64, f64)> =
                curve.rows.iter().map(|row| (row.sigma, share(found, own, row, i))).collect();
            let shares = || {
                let all = curve.rows.iter().zip(&points);
                let mut all = all.filter_map(|(row, (_, share))| Some((row.shares[i]?, *share)));
                all.find_map(|(saved, share)| far("a share of gaps", saved.value, share))
            };
            let half = || {
                let place = crossing(&points, 0.5)?;
                far("a half height", curve.half_heights[i]?.value, place)
                    .or_else(|| look.is(&id(own, *time, "half")?, place))
                    .or_else(|| match (own.masses, *time) {
                        (100, 500.0) if own.kind == ChainKind::Length => {
                            look.is("chains.m1_half", place)
                        }
                        _ => None,
                    })
            };
            let width = || {
                let width = crossing(&points, 0.9)? - crossing(&points, 0.1)?;
                far("a width", curve.widths[i]?.value, width)
                    .or_else(|| look.is(&id(own, *time, "width")?, width))
            };
            shares().or_else(half).or_else(width)
        };
        let kept = || {
            let alive = |row: &Ensemble| {
                let hit =
                    |run: &&Run| run.counts.last().is_some_and(|own| own.iter().sum::<u32>() > 0);
                (row.sigma, row.runs.iter().filter(hit).count() as f64 / row.runs.len() as f64)
            };
            let points: Vec<(f64, f64)> = curve.rows.iter().map(alive).collect();
            let place = crossing(&points, 0.5)?;
            far("half of the chains", curve.kept_half?.value, place)
                .or_else(|| look.is(&id(own, 0.0, "kept")?, place))
                .or_else(|| look.is("chains.m1_kept", place).filter(|_| own.name == "length-100"))
        };
        own.transients.iter().enumerate().find_map(window).or_else(kept)
    };
    found.all().find_map(one)
}

/// Half heights of the paper's chain are those of the map, and a fall is what is between two of them.
fn times(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let map = look.results.protocol().ok()?;
    let window = found.parameters.window;
    let line = |time: f64| {
        let own = |cell: &&ProtocolCell| (cell.transient, cell.window) == (time, window);
        Some(map.cells.iter().find(own)?.half_height_all?.value)
    };
    let damped = || found.of(ChainKind::Damping);
    let (own, strongest) = damped().last()?;
    let from = *own.transients.get(1)?;
    let to = *own.transients.last()?;
    let last = own.transients.len() - 1;
    let fall = || {
        let [a, b] = [1, last].map(|i| strongest.half_heights[i]);
        look.is("chains_fall_damped", a?.value - b?.value)
    };
    own.transients
        .iter()
        .find_map(|&time| look.is(&format!("chains.d0_t{time}"), line(time)?))
        .or_else(|| look.is("chains_fall", line(from)? - line(to)?))
        .or_else(fall)
        .or_else(|| {
            look.are([
                ("chains_fall_from", from),
                ("chains_fall_to", to),
                // As the curve is called.
                ("chains_damping", own.name.split_once('-')?.1.parse().ok()?),
            ])
        })
}

/// A chain with an open gap has impacts in every late window: that is the proposition, for time without
/// end, and a long one that was run. The shares of open gaps and of chains follow the law of amplitudes.
fn silent(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let quiet = |run: &&Run| run.counts.last().is_some_and(|own| own.iter().all(|&k| k == 0));
    let rows = || found.curves.iter().flat_map(|curve| &curve.rows);
    let counted = |row: &Ensemble| {
        let of = |open: bool| row.runs.iter().filter(move |run| (run.open > 0) == open);
        let both = [true, false].map(|open| [of(open).count(), of(open).filter(quiet).count()]);
        let same = both.map(|own| own[0] as u64) == row.chains
            && both.map(|own| own[1] as u64) == row.silent;
        unless(same, || format!("{both:?} chains with and without open gaps"))
    };
    let sum = |of: fn(&Ensemble) -> u64| rows().map(of).sum::<u64>() as f64;
    let (own, curve) = found.curve("silence")?;
    let first = curve.rows.first()?;
    // Neighbours share a force: twice the error of independent gaps is more than enough.
    let law = |row: &Ensemble| {
        let n = row.runs.len() as f64;
        let inner = model::rayleigh_above(1.0, row.sigma * std::f64::consts::SQRT_2);
        let wall = model::rayleigh_above(1.0, row.sigma);
        let expected = (own.masses as f64 - 1.0) * inner + 2.0 * wall;
        let mean = row.runs.iter().map(|run| f64::from(run.open)).sum::<f64>() / n;
        unless((mean - expected).abs() <= 10.0 * (expected / n).sqrt() + 5.0 / n, || {
            format!("{mean} open gaps a chain, not {expected}, at {}", row.sigma)
        })
    };
    let text = || {
        let (sigma, length) = (look.number("chains_sigma")?, look.number("chains_open_length")?);
        far("open gaps", length * model::rayleigh_above(1.0, sigma * std::f64::consts::SQRT_2), 1.0)
    };
    rows()
        .find_map(counted)
        .or_else(|| curve.rows.iter().find_map(law))
        .or_else(text)
        .or_else(|| unless(sum(|row| row.silent[0]) == 0.0, || "an open gap is silent".into()))
        .or_else(|| {
            look.are([
                ("chains_open", sum(|row| row.chains[0])),
                ("chains_open_silent", sum(|row| row.silent[0])),
                ("chains_shut", first.chains[1] as f64),
                ("chains_shut_silent", first.silent[1] as f64),
                ("chains_silence_sigma", first.sigma),
            ])
        })
}

/// Half of the chains have a gap that closes by itself where the drawn shares pass a half. With all phases more gaps
/// close than with those that there are, and of these the simulated chains have as many as chance allows: five
/// standard errors, and as much as the clumps of neighbouring gaps are off.
fn expected(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let one = |(own, curve): (&ChainCurve, &Curve)| {
        let half = curve.kept_half_expected?;
        let column = |i: usize| -> Vec<(f64, f64)> {
            curve.kept_expected.iter().map(|row| (row[0], row[i])).collect()
        };
        let place = |(i, name): (usize, &str)| {
            let height = between(&column(i + 1), half[i]);
            let off = height.is_none_or(|height| (height - 0.5).abs() > 2e-3);
            look.is(&id(own, 0.0, name)?, half[i])
                .or_else(|| unless(!off, || format!("the share is {height:?} at {}", half[i])))
        };
        let less = || {
            let more = curve.kept_expected.iter().find(|row| row[2] > row[1] * (1.0 + 1e-12));
            more.map(|row| format!("a common period lets more gaps close at {}", row[0]))
        };
        let chance = |row: &Ensemble| {
            let expected = between(&column(2), row.sigma)?;
            let n = row.runs.len() as f64;
            let share = 1.0 - (row.silent[0] + row.silent[1]) as f64 / n;
            let room = 5.0 * (expected * (1.0 - expected) / n).sqrt() + 0.05 + 1.0 / n;
            unless((share - expected).abs() <= room, || {
                format!("{share} of the chains have impacts, not {expected}, at {}", row.sigma)
            })
        };
        [(0, "ever"), (1, "there")]
            .into_iter()
            .find_map(place)
            .or_else(less)
            .or_else(|| curve.rows.iter().find_map(chance))
    };
    found.all().find_map(one)
}

/// Sizes are those of what was run, with the window of the main sweep.
fn as_run(look: Look<'_>) -> Option<String> {
    let found = found(look)?;
    let protocol = look.results.sweep().ok()?.parameters.protocol;
    let sizes = |(own, curve): (&ChainCurve, &Curve)| {
        // Of a chain between walls one gap more than masses is counted, all in all.
        let counted = |row: &Ensemble| {
            let gaps = chain(&found.parameters, own).gaps();
            let pieces: usize = pieces(gaps, found.parameters.piece).len();
            let fits = row.runs.iter().flat_map(|run| &run.counts).all(|k| k.len() == pieces);
            let ran = row.runs.len() as u64 + row.failed;
            unless(fits && ran == own.realisations as u64, || format!("{ran} runs of {}", own.name))
        };
        let rises = || {
            let sigmas: Vec<f64> = curve.rows.iter().map(|row| row.sigma).collect();
            let so = sigmas == own.sigmas && sigmas.windows(2).all(|pair| pair[0] < pair[1]);
            unless(so, || format!("{} was run at {sigmas:?}", own.name))
        };
        let named = |time: &f64| {
            look.is(&id(own, *time, "n")?, own.masses as f64)
                .or_else(|| look.is(&id(own, *time, "t")?, *time))
        };
        let head = |time: &f64| look.is(&format!("chains.t{time}"), *time);
        curve
            .rows
            .iter()
            .find_map(counted)
            .or_else(rises)
            .or_else(|| own.transients.iter().find_map(named))
            .or_else(|| own.transients.iter().filter(|_| own.damping > 0.0).find_map(head))
    };
    let masses = found.of(ChainKind::Length);
    let masses: Vec<usize> = masses.map(|(own, _)| own.masses).collect();
    let (silence, _) = found.curve("silence")?;
    found
        .all()
        .find_map(sizes)
        .or_else(|| {
            look.are([
                ("chains_shortest", *masses.iter().min()? as f64),
                ("chains_longest", *masses.iter().max()? as f64),
                ("chains_silence_masses", silence.masses as f64),
                ("chains_silence_until", *silence.transients.last()?),
                ("chains_transient", protocol.transient),
                ("chains_stroke", found.parameters.stroke),
            ])
        })
        .or_else(|| unless(protocol.window == found.parameters.window, || "another window".into()))
}

/// Between the points of a curve on both sides of σ, in a straight line.
fn between(points: &[(f64, f64)], sigma: f64) -> Option<f64> {
    let above = points.iter().position(|point| point.0 >= sigma)?;
    let (b, a) = (points[above], points[above.checked_sub(1)?]);
    Some(((b.0 - sigma) * a.1 + (sigma - a.0) * b.1) / (b.0 - a.0))
}

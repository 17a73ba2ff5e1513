//! Places of the rise, against the curves that they are places of.

use super::counts::{kept, totals};
use super::{Guard, Look, far, unless};
use crate::claims;
use crate::experiments::rise::Rise;
use crate::experiments::sweep::{Sweep, SweepRow};
use crate::numerics::statistics::Estimate;

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "places_on_curves",
        ids: &["half_height", "half_height_second", "onset", "kept_half", "rise_width", "starts.*"],
        find: places,
    },
    Guard {
        name: "interval_of_half_height",
        ids: &["half_height", "half_height_interval"],
        find: interval_of_half_height,
    },
    Guard {
        name: "differences_of_starts",
        ids: &["starts.*", "share_of_start", "sigma_half_theory"],
        find: differences,
    },
    Guard {
        name: "two_seeds",
        ids: &["second_seed_largest", "half_height_second"],
        find: two_seeds,
    },
    Guard {
        name: "modes",
        ids: &["mode_half_low", "mode_half_high", "mode_noise", "mode_noise_sigma"],
        find: modes,
    },
    Guard { name: "rise_rows", ids: &["rise_rows", "largest_increase", "gaps"], find: rise_rows },
];

/// The points of a curve through those rows that can be compared.
fn curve(rows: &[SweepRow], height: impl Fn(&SweepRow) -> f64) -> Vec<(f64, f64)> {
    let rows = rows.iter().filter(|row| row.comparable);
    rows.map(|row| (row.sigma, height(row))).filter(|point| point.1.is_finite()).collect()
}

/// Between the points of a curve on both sides of σ, in a straight line.
pub(super) fn between(points: &[(f64, f64)], sigma: f64) -> Option<f64> {
    let above = points.iter().position(|point| point.0 >= sigma)?;
    let (b, a) = (points[above], points[above.checked_sub(1)?]);
    Some(((b.0 - sigma) * a.1 + (sigma - a.0) * b.1) / (b.0 - a.0))
}

/// A place of the rise is where a curve has some height: the curve, drawn through the histograms of
/// the rows, has it there. The width is between two such places.
fn places(look: Look<'_>) -> Option<String> {
    let results = look.results;
    let sweeps = [results.sweep(), results.second_seed()].into_iter().flatten();
    let sweeps = sweeps.map(|sweep| (&sweep.rows, &sweep.rise));
    let starts =
        results.starts().into_iter().flat_map(|s| s.variants.iter().map(|v| (&v.rows, &v.rise)));
    sweeps.chain(starts).find_map(|(rows, rise)| off_curve(rows, rise))
}

fn off_curve(rows: &[SweepRow], rise: &Rise) -> Option<String> {
    let gaps = rows.first()?.counts.len() as f64 - 1.0;
    let mean = |from: usize| {
        move |row: &SweepRow| {
            let [n, sum] = totals(&row.counts, from);
            sum / n / gaps
        }
    };
    let at = |name: &str, place: Option<Estimate>, share: f64, from: Option<usize>| {
        let sigma = place?.value;
        let height = match from {
            Some(from) => between(&curve(rows, mean(from)), sigma),
            None => between(&curve(rows, kept), sigma),
        };
        match height {
            Some(height) => far(&format!("the height of the curve at the {name}"), height, share),
            None => Some(format!("the {name} at {sigma} lies outside its curve")),
        }
    };
    let width = rise.width.zip(rise.tenth).zip(rise.nine_tenths);
    at("half height", rise.half_height, 0.5, Some(1))
        .or_else(|| at("half height of all", rise.half_height_all, 0.5, Some(0)))
        .or_else(|| at("onset", rise.onset, 0.05, Some(0)))
        .or_else(|| at("half of the chains", rise.kept_half, 0.5, None))
        .or_else(|| at("tenth", rise.tenth, 0.1, Some(0)))
        .or_else(|| at("nine tenths", rise.nine_tenths, 0.9, Some(0)))
        .or_else(|| {
            let ((width, low), high) = width?;
            far("the width", width.value, high.value - low.value)
        })
}

/// The half height lies inside the interval that is printed with it.
fn interval_of_half_height(look: Look<'_>) -> Option<String> {
    let ([low, high], half) =
        look.interval("half_height_interval").zip(look.number("half_height"))?;
    unless(low <= half && half <= high, || format!("{half} lies outside [{low}, {high}]"))
}

/// A difference of two starts added to the first gives the second; and the share that the start
/// explains leads from one half height to the other on the way to the theory's.
fn differences(look: Look<'_>) -> Option<String> {
    let rest = look.number("starts.rest")?;
    let ends = look.values.iter().find_map(|value| {
        let own = value.id.strip_suffix("_difference")?.strip_prefix("starts.")?.to_string();
        let [a, b] = [value.id.as_str(), &format!("starts.{own}")].map(|id| look.number(id));
        far(&value.id, rest + a?, b?)
    });
    ends.or_else(|| {
        let share = look.number("share_of_start")?;
        let theory = look.number("sigma_half_theory")?;
        far("share_of_start", rest + share * (theory - rest), look.number("starts.random")?)
    })
}

/// The largest difference of two seeds in standard errors bounds all of them and is one of them,
/// with means and errors from the histograms; rows with fewer than thirty kept do not count. It
/// and the difference of the two half heights are what chance allows.
fn two_seeds(look: Look<'_>) -> Option<String> {
    let (first, second) = look.results.sweep().ok().zip(look.results.second_seed().ok())?;
    let normal = |row: &SweepRow| {
        let [n, sum] = totals(&row.counts, 1);
        let squares: f64 = (0_u32..)
            .zip(&row.counts)
            .skip(1)
            .map(|(k, &c)| f64::from(c) * f64::from(k) * f64::from(k))
            .sum();
        let variance = (squares - sum * sum / n) / (n - 1.0);
        (n >= 30.0).then_some([sum / n, variance / n])
    };
    let pair = |b: &SweepRow| {
        let a = first.rows.iter().find(|a| a.sigma == b.sigma)?;
        let ([m, s], [n, t]) = normal(a).zip(normal(b))?;
        (s + t > 0.0).then(|| (m - n).abs() / (s + t).sqrt())
    };
    let differences: Vec<f64> = second.rows.iter().filter_map(pair).collect();
    let halves = first.rise.half_height.zip(second.rise.half_height);
    let apart = halves.and_then(|(a, b)| {
        let room = super::room(&a, &b);
        unless((a.value - b.value).abs() <= room, || {
            format!("half heights of two seeds are {} and {}", a.value, b.value)
        })
    });
    apart.or_else(|| {
        let largest = differences.iter().copied().reduce(f64::max)?;
        let limit = claims::level().among(differences.len());
        look.is("second_seed_largest", largest).or_else(|| {
            unless(largest <= limit, || {
                format!("two seeds are {largest} standard errors apart, and {limit} are allowed")
            })
        })
    })
}

/// Below the range in which the mode passes one half no interval of the mode reaches it; from its
/// end on all lie above, and the one before does not. The widest interval is that of its row.
fn modes(look: Look<'_>) -> Option<String> {
    let sweep: &Sweep = look.results.sweep().ok()?;
    let half = (sweep.rows.first()?.counts.len() as f64 - 1.0) / 2.0;
    let known = || sweep.rows.iter().filter_map(|row| Some((row.sigma, row.mode_interval?)));
    let passes =
        look.number("mode_half_low").zip(look.number("mode_half_high")).and_then(|(low, high)| {
            let right = known().all(|(sigma, [from, to])| {
                (sigma >= low || (to as f64) < half) && (sigma < high || from as f64 >= half)
            });
            let at = |end: f64| known().find(|(sigma, _)| *sigma == end).map(|(_, ends)| ends);
            let before = known().take_while(|(sigma, _)| *sigma < high).last();
            let ends = at(low).is_some_and(|[_, to]| to as f64 >= half)
                && at(high).is_some()
                && before.is_some_and(|(_, [from, _])| (from as f64) < half);
            unless(right && ends, || format!("the mode passes one half outside [{low}, {high}]"))
        });
    passes.or_else(|| {
        let ([low, high], at) = look.interval("mode_noise").zip(look.number("mode_noise_sigma"))?;
        let own = known().find(|(sigma, _)| *sigma == at).map(|(_, ends)| ends.map(|k| k as f64));
        let wider = known().any(|(_, [from, to])| (to as f64 - from as f64) > high - low);
        unless(own == Some([low, high]) && !wider, || {
            format!("the widest interval of the mode is not [{low}, {high}] at sigma = {at}")
        })
    })
}

/// The rows within the rise are those whose mean of all, from the histogram, lies between a tenth and
/// nine tenths of all gaps, as that mean rises; no step of the finest grid is larger than the largest.
fn rise_rows(look: Look<'_>) -> Option<String> {
    let sweep = look.results.sweep().ok()?;
    let gaps = sweep.rows.first()?.counts.len() as f64 - 1.0;
    let mean = |row: &SweepRow| {
        let [n, sum] = totals(&row.counts, 0);
        sum / n
    };
    // A curve that wavers passes a level more than once, and the place is the last.
    let last = |share: f64| sweep.rows.iter().rposition(|row| mean(row) < share * gaps);
    let count = last(0.1).zip(last(0.9)).map(|(low, high)| (high - low) as f64);
    let inside =
        look.number("rise_rows").zip(count).and_then(|(n, count)| far("rise_rows", n, count));
    inside.or_else(|| {
        let steps: Vec<[f64; 2]> = sweep
            .rows
            .windows(2)
            .map(|w| [w[1].sigma - w[0].sigma, mean(&w[1]) - mean(&w[0])])
            .collect();
        let finest = steps.iter().map(|step| step[0]).fold(f64::INFINITY, f64::min);
        // Those that have a fine step beside them, as the claim looks at three rows at a time.
        let fine = |i: usize| steps.get(i).is_some_and(|step| step[0] < 1.01 * finest);
        let inside = |i: &usize| fine(*i) && (fine(*i + 1) || i.checked_sub(1).is_some_and(fine));
        let largest = (0..steps.len()).filter(inside).map(|i| steps[i][1]).fold(0.0, f64::max);
        look.is("largest_increase", largest)
    })
}

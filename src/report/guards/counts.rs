//! Means, shares and sizes of ensembles, against the counts of their realisations.

use super::{Guard, Look, far, unless};
use crate::claims::Piece;
use crate::experiments::sweep::SweepRow;
use crate::numerics::statistics::Estimate;

/// Tables of which each line is a σ of the sweep.
const LINES: [&str; 2] = ["compare", "readings"];

pub const GUARDS: &[Guard] = &[
    Guard { name: "means_of_counts", ids: &["sweep.*", "mean_*"], find: means_of_counts },
    Guard {
        name: "rows_named",
        ids: &[
            "sigma_below",
            "kept_below",
            "mean_kept_below",
            "mean_all_below",
            "sigma_above",
            "kept_above",
            "mean_above",
            "sigma_kept_a",
            "kept_a",
            "mean_all_threshold",
            "sigma_kept_b",
            "kept_b",
            "sigma_between",
            "mean_between",
            "compare.*",
            "readings.*",
            "sweep.*",
        ],
        find: rows_named,
    },
    Guard {
        name: "all_accounted_for",
        ids: &[
            "realisations",
            "level_*",
            "sweep_failed",
            "sigma_count",
            "gaps",
            "starts_realisations",
        ],
        find: all_accounted_for,
    },
    Guard { name: "impacts_by_rate", ids: &["readings.*"], find: impacts_by_rate },
    Guard { name: "whole_impacts", ids: &["window"], find: whole_impacts },
    Guard { name: "seeds_that_ran", ids: &["seed", "second_seed"], find: seeds },
    Guard {
        name: "rejected_random_starts",
        ids: &["rejected_random", "rejected_random_at"],
        find: rejected,
    },
    Guard {
        name: "estimates_in_intervals",
        ids: &[
            "half_height*",
            "onset",
            "kept_half",
            "rise_width",
            "starts.*",
            "protocol.*",
            "horizon_*",
            "growth_rate",
        ],
        find: estimates,
    },
];

/// Rows of all ensembles, with the number of realisations that was asked for.
fn rows<'a>(look: Look<'a>) -> impl Iterator<Item = (&'a SweepRow, usize)> {
    let results = look.results;
    let sweeps = [results.sweep(), results.second_seed()].into_iter().flatten();
    let sweeps = sweeps.flat_map(|sweep| {
        sweep.rows.iter().map(|row| (row, sweep.parameters.realisations_at(row.sigma)))
    });
    let starts = results.starts().into_iter().flat_map(|starts| {
        let rows = starts.variants.iter().flat_map(|variant| &variant.rows);
        rows.map(|row| (row, starts.parameters.realisations))
    });
    sweeps.chain(starts)
}

/// Number and sum of all counts from `from` on.
pub fn totals(counts: &[u32], from: usize) -> [f64; 2] {
    let own = counts.iter().enumerate().skip(from);
    own.fold([0.0, 0.0], |[n, sum], (k, &c)| [n + f64::from(c), sum + k as f64 * f64::from(c)])
}

/// The share of the realisations of a row that are kept, from its counts.
pub fn kept(row: &SweepRow) -> f64 {
    totals(&row.counts, 1)[0] / totals(&row.counts, 0)[0]
}

/// A mean is saved beside the histogram of the counts that it is the mean of, and was summed over
/// realisations: summing over the histogram must give it again, over the kept and over all.
fn means_of_counts(look: Look<'_>) -> Option<String> {
    rows(look).find_map(|(row, _)| {
        let mean = |from: usize, found: Option<f64>| {
            let [n, sum] = totals(&row.counts, from);
            far(&format!("a mean at sigma = {}", row.sigma), found?, sum / n)
        };
        mean(1, row.mean_distinct).or_else(|| mean(0, row.mean_all))
    })
}

/// Where the text names a σ with a share or a mean, there is a row at this very σ, and its
/// histogram gives share and mean. Below the rise it is the σ of which the claim speaks.
fn rows_named(look: Look<'_>) -> Option<String> {
    let sweep = look.results.sweep().ok()?;
    let named = [
        ("sigma_below", "kept_below", "mean_kept_below", "mean_all_below"),
        ("sigma_above", "kept_above", "mean_above", ""),
        ("sigma_kept_a", "kept_a", "", "mean_all_threshold"),
        ("sigma_kept_b", "kept_b", "", ""),
        ("sigma_between", "", "mean_between", ""),
    ];
    let named = named.map(|(a, b, c, d)| [a, b, c, d].map(String::from));
    let own = look.values.iter().map(|value| value.id.as_str());
    let compared = own.chain(look.values.names().map(|(name, _)| name)).filter_map(|id| {
        let line = id.strip_suffix("_sigma")?;
        let (_, at) = line.split_once('.').filter(|(table, _)| LINES.contains(table))?;
        Some([id.into(), String::new(), format!("sweep.{at}_mean"), String::new()])
    });
    let below = look.number("sigma_below").and_then(|sigma| {
        let claim = look.claims.iter().find(|claim| claim.id == "sec2_few_below")?;
        let said = claim.ours.0.iter().any(|piece| match piece {
            Piece::Number(number) => number.value == sigma,
            Piece::Words(_) => false,
        });
        unless(said, || format!("sigma_below is {sigma}, of which {} does not speak", claim.id))
    });
    let mut named = named.into_iter().chain(compared);
    let off = |[sigma, share, mean, all]: [String; 4]| {
        let at = look.number(&sigma)?;
        let Some(row) = sweep.rows.iter().find(|row| row.sigma == at) else {
            return Some(format!("{sigma} is {at}, where nothing was simulated"));
        };
        let over = |from: usize| {
            let [n, sum] = totals(&row.counts, from);
            sum / n
        };
        look.is(&share, kept(row))
            .or_else(|| look.is(&mean, over(1)))
            .or_else(|| look.is(&all, over(0)))
    };
    below.or_else(|| named.find_map(off))
}

/// Impacts in the window are their rate times its length.
fn impacts_by_rate(look: Look<'_>) -> Option<String> {
    let sweep = look.results.sweep().ok()?;
    look.values.iter().find_map(|value| {
        let line =
            value.id.strip_suffix("_impacts").filter(|line| line.starts_with("readings."))?;
        let sigma = look.number(&format!("{line}_sigma"))?;
        let row = sweep.rows.iter().find(|row| row.sigma == sigma)?;
        look.is(&value.id, row.impacts_per_time? * sweep.parameters.protocol.window)
    })
}

/// Each realisation is counted, rejected or given up; the histogram has a bin for each number of
/// gaps, zero included; and all rows have as many realisations as were asked for.
fn all_accounted_for(look: Look<'_>) -> Option<String> {
    let uneven = rows(look).find_map(|(row, asked)| {
        let [ran, _] = totals(&row.counts, 0);
        let [kept, _] = totals(&row.counts, 1);
        let all = ran as usize + row.rejected + row.failed;
        unless(all == row.realisations && asked == all && kept as usize == row.kept, || {
            format!("at sigma = {} {all} realisations ended somehow, of {asked}", row.sigma)
        })
    });
    let sweep = look.results.sweep().ok()?;
    let lost =
        |row: &SweepRow| row.realisations as f64 - row.rejected as f64 - totals(&row.counts, 0)[0];
    let bins = sweep.rows.first()?.counts.len();
    uneven
        .or_else(|| {
            look.are([
                ("sweep_failed", sweep.rows.iter().map(lost).sum()),
                ("sigma_count", sweep.parameters.sigmas.len() as f64),
                ("gaps", bins as f64 - 1.0),
            ])
        })
        .or_else(|| {
            let (first, last) = (sweep.rows.first()?, sweep.rows.last()?);
            sweep.parameters.level?;
            let whole = sweep.rows.iter().rfind(|row| row.realisations == first.realisations)?;
            look.are([
                ("level_above", whole.sigma),
                ("level_realisations", last.realisations as f64),
                ("realisations", first.realisations as f64),
            ])
        })
}

/// The rate of impacts of a row, times its kept realisations and the window, is how many impacts there
/// were: a whole number in every row.
fn whole_impacts(look: Look<'_>) -> Option<String> {
    let window = look.number("window")?;
    look.results.sweep().ok()?.rows.iter().find_map(|row| {
        let impacts = row.impacts_per_time? * row.kept as f64 * window;
        far(&format!("the number of impacts at sigma = {}", row.sigma), impacts, impacts.round())
    })
}

/// The seeds that are named are those with which the sweeps were run.
fn seeds(look: Look<'_>) -> Option<String> {
    let (sweep, second) = look.results.sweep().ok().zip(look.results.second_seed().ok())?;
    look.are([
        ("seed", sweep.parameters.seed as f64),
        ("second_seed", second.parameters.seed as f64),
    ])
}

/// The share of random starts that overlap, from the realisations that have no count.
fn rejected(look: Look<'_>) -> Option<String> {
    let variant = look.results.starts().ok()?.variant("random")?;
    let at = look.number("rejected_random_at")?;
    let Some(row) = variant.rows.iter().find(|row| row.sigma == at) else {
        return Some(format!("no random starts were drawn at sigma = {at}"));
    };
    let counted = totals(&row.counts, 0)[0] + row.failed as f64;
    look.is("rejected_random", 1.0 - counted / row.realisations as f64)
}

/// An estimate lies inside its own interval, which comes from resamples and not from it.
fn estimates(look: Look<'_>) -> Option<String> {
    let results = look.results;
    let sweeps = [results.sweep(), results.second_seed()].into_iter().flatten().map(|s| &s.rise);
    let variants = results.starts().into_iter().flat_map(|s| s.variants.iter().map(|v| &v.rise));
    let rises = sweeps.chain(variants).flat_map(|rise| {
        [
            rise.half_height,
            rise.half_height_all,
            rise.onset,
            rise.kept_half,
            rise.tenth,
            rise.nine_tenths,
            rise.width,
        ]
    });
    let cells = results.protocol().into_iter().flat_map(|map| &map.cells);
    let cells = cells.flat_map(|cell| [cell.half_height, cell.half_height_all]);
    let horizons = [results.horizon().ok(), results.race().ok().map(|race| &race.growth)];
    let horizons = horizons.into_iter().flatten().flat_map(|horizon| {
        [horizon.order, horizon.order_impacts, horizon.time, horizon.growth, horizon.tenfold]
    });
    rises.chain(cells).chain(horizons).flatten().find_map(outside)
}

fn outside(estimate: Estimate) -> Option<String> {
    let Estimate { value, interval: [low, high], .. } = estimate;
    unless(low <= value && value <= high, || format!("{value} lies outside its [{low}, {high}]"))
}

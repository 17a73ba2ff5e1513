//! Section 2 and what other sections take from the main sweep.

use super::{Error, chosen, count, estimate, from, mark, share};
use crate::claims::sec2;
use crate::experiments::laws::{self, LawsRow};
use crate::experiments::sweep::{self, Sweep, SweepRow};
use crate::experiments::{Results, horizon, rise, two_masses};
use crate::params::{
    LEVEL, NEAR_SIMULTANEOUS, PRINTED_THRESHOLD, SECOND_SEED, SEED, SLOW, SweepParams,
};
use crate::report::values::{Value, cell, origin};

/// A σ below the rise, where the text tells how little happens.
const BELOW: f64 = 0.08;
/// A σ above the rise.
const ABOVE: f64 = 0.2;
/// A σ at which masses begin to be able to stick.
const STICKING: f64 = 0.3;

/// The id of the mean over the kept of a row.
pub(super) fn mean_id(row: &SweepRow) -> String {
    cell("sweep", row.sigma, "mean")
}

/// The rows of the sweep of which the report shows the mean: those of its tables and sentences.
fn shown(sweep: &Sweep) -> Result<Vec<&SweepRow>, Error> {
    let named = [BELOW, PRINTED_THRESHOLD, ABOVE, super::theory::BETWEEN];
    let mut rows = named.iter().map(|&sigma| row(sweep, sigma)).collect::<Result<Vec<_>, _>>()?;
    rows.extend(super::comparison::lines(sweep));
    rows.sort_by(|a, b| a.sigma.total_cmp(&b.sigma));
    rows.dedup_by(|a, b| a.sigma == b.sigma);
    Ok(rows)
}

/// The other readings of "number of impacts", by column of their table.
const READINGS: [&str; 2] = ["impacts", "masses"];

/// The σ of its lines, below, at and above the rise, and the ids that the text has for them.
const LINES: [(f64, &str); 3] =
    [(BELOW, "sigma_below"), (PRINTED_THRESHOLD, "sigma_kept_a"), (ABOVE, "sigma_above")];

/// The values of that table.
fn readings(sweep: &Sweep) -> Result<Vec<Value>, Error> {
    let mut values = Vec::new();
    for (sigma, named) in LINES {
        let row = row(sweep, sigma)?;
        values.push(Value::same(cell("readings", sigma, "sigma"), named));
        for (name, found) in READINGS.iter().zip([row.impacts_in_window, row.masses_hit]) {
            let id = cell("readings", sigma, name);
            values.push(match found {
                Some([mean, error]) => Value::ensemble(id, mean, error, row.kept as u64),
                None => Value::text(id, "none"),
            });
        }
    }
    Ok(values)
}

/// The lines of that table.
pub fn readings_table(sweep: &Sweep) -> Result<Vec<[String; 4]>, Error> {
    let line = |(sigma, named): (f64, &str)| {
        let own = |column| mark(cell("readings", sigma, column));
        let gaps = mean_id(row(sweep, sigma)?);
        Ok([mark(named.to_string()), own("impacts"), mark(gaps), own("masses")])
    };
    LINES.into_iter().map(line).collect()
}

/// The row nearest to σ.
pub(super) fn row(sweep: &Sweep, sigma: f64) -> Result<&SweepRow, Error> {
    let distance = |row: &SweepRow| (row.sigma - sigma).abs();
    let nearest = sweep.rows.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.ok_or(Error::Missing("a row of the main sweep"))
}

/// Realisations of a row that ran to the end.
pub(super) fn ran(row: &SweepRow) -> usize {
    row.realisations.saturating_sub(row.rejected + row.failed)
}

/// The share of the kept of a row.
pub(super) fn kept(id: &str, row: &SweepRow) -> Value {
    share(id, row.kept, ran(row)).source(origin(sweep::reduce), "sweep")
}

/// The mean over the kept of a row.
pub(super) fn mean_kept(id: &str, row: &SweepRow) -> Value {
    let mean = match (row.mean_distinct, row.standard_error) {
        (Some(mean), Some(error)) => Value::ensemble(id, mean, error, row.kept as u64),
        (Some(mean), None) => Value::real(id, mean, 2),
        _ => Value::text(id, "none"),
    };
    mean.source(origin(sweep::reduce), "sweep")
}

/// The mean over all of a row.
pub(super) fn mean_all(id: &str, row: &SweepRow) -> Value {
    let mean = match sec2::mean_all(row) {
        Some([mean, error]) => Value::ensemble(id, mean, error, ran(row) as u64),
        None => Value::text(id, "none"),
    };
    mean.source(origin(sweep::reduce), "sweep")
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let sweep = results.sweep()?;
    let mut values = from(run(sweep), origin(SweepParams::main), "sweep");
    values.extend(from(rise(results, sweep)?, origin(rise::find), "sweep"));
    values.extend(shown(sweep)?.into_iter().map(|row| mean_kept(&mean_id(row), row)));
    values.extend(from(readings(sweep)?, origin(sweep::reduce), "sweep"));
    values.extend(from(laws(results)?, origin(laws::run), "sweep"));
    let found = results.two_masses()?;
    let longest = found.excess.last().ok_or(Error::Missing("two masses"))?;
    let two_masses = vec![
        Value::real("two_masses_bound", found.safe_force, 4),
        Value::integer("two_masses_directions", found.parameters.directions),
        Value::integer("two_masses_time", longest.time as u64),
        Value::real("two_masses_least", longest.least, 6),
        Value::real("two_masses_greatest", longest.greatest, 6),
    ];
    values.extend(from(two_masses, origin(two_masses::run), "two_masses"));
    values.extend(from(horizon(results)?, origin(horizon::run), "horizon"));
    Ok(values)
}

/// What was run.
fn run(sweep: &Sweep) -> Vec<Value> {
    let parameters = &sweep.parameters;
    let ends = |i: usize| sweep.rows.get(i).map_or(0.0, |row| row.sigma);
    let level = parameters.level.map(|level| {
        [
            chosen("level_above", level.above),
            Value::integer("level_realisations", level.realisations),
        ]
    });
    let run = vec![
        Value::integer("gaps", parameters.chain.gaps()),
        Value::integer("transient", parameters.protocol.transient as u64).unit(r"$1/\omega$"),
        Value::integer("window", parameters.protocol.window as u64).unit(r"$1/\omega$"),
        Value::integer("realisations", parameters.realisations),
        Value::integer("sigma_count", sweep.rows.len()),
        chosen("sigma_low", ends(0)),
        chosen("sigma_high", ends(sweep.rows.len().saturating_sub(1))),
        Value::real("confidence", LEVEL, 2),
        Value::integer("seed", SEED),
        Value::integer("second_seed", SECOND_SEED),
        count("sweep_impacts", sweep.rows.iter().map(|row| row.impacts).sum())
            .source(origin(sweep::reduce), "sweep"),
        Value::integer("sweep_failed", sweep.rows.iter().map(|row| row.failed).sum::<usize>())
            .source(origin(sweep::reduce), "sweep"),
    ];
    run.into_iter().chain(level.into_iter().flatten()).collect()
}

/// Figs. 2 and 3.
fn rise(results: &Results, sweep: &Sweep) -> Result<Vec<Value>, Error> {
    let n = sweep.parameters.realisations;
    let (below, above) = (row(sweep, BELOW)?, row(sweep, ABOVE)?);
    let places = &sweep.rise;
    let second = results.second_seed()?;
    let interval = places.half_height.map(|half| half.interval);
    let mode = sec2::mode_half(sweep);
    let noise = noisiest_mode(sweep);
    let largest = sec2::largest_between_seeds(sweep, second);
    let or_none = |id: &str, value: Option<Value>| value.unwrap_or_else(|| Value::text(id, "none"));
    Ok(vec![
        chosen("sigma_below", below.sigma),
        kept("kept_below", below),
        Value::same("mean_kept_below", mean_id(below)),
        mean_all("mean_all_below", below),
        chosen("sigma_above", above.sigma),
        kept("kept_above", above),
        Value::same("mean_above", mean_id(above)),
        estimate("rise_width", places.width, n),
        estimate("half_height", places.half_height, n),
        or_none(
            "half_height_interval",
            interval.map(|ends| Value::interval("half_height_interval", ends)),
        ),
        estimate("onset", places.onset, n),
        estimate("kept_half", places.kept_half, n),
        or_none("mode_half_low", mode.map(|[low, _]| chosen("mode_half_low", low)))
            .source(origin(sec2::mode_half), "sweep"),
        or_none("mode_half_high", mode.map(|[_, high]| chosen("mode_half_high", high)))
            .source(origin(sec2::mode_half), "sweep"),
        or_none("mode_noise_sigma", noise.map(|r| chosen("mode_noise_sigma", r.sigma))),
        or_none(
            "mode_noise",
            noise
                .and_then(|r| r.mode_interval)
                .map(|[low, high]| Value::interval("mode_noise", [low as f64, high as f64])),
        ),
        estimate("half_height_second", second.rise.half_height, second.parameters.realisations)
            .source(origin(rise::find), "second_seed"),
        or_none(
            "second_seed_largest",
            largest.map(|(errors, _)| {
                let item = origin(sec2::largest_between_seeds);
                Value::real("second_seed_largest", errors, 2).source(item, "second_seed")
            }),
        ),
    ])
}

/// The row whose mode is known worst.
fn noisiest_mode(sweep: &Sweep) -> Option<&SweepRow> {
    let width =
        |row: &SweepRow| row.mode_interval.map_or(0, |[low, high]| high.saturating_sub(low));
    sweep.rows.iter().filter(|row| width(row) > 0).max_by_key(|row| width(row))
}

/// The probability that the forces on a pair can press it together: |ΔF| > d ω².
fn can_stick(sigma: f64) -> f64 {
    pxfm::f_exp(-0.25 / (sigma * sigma))
}

/// Three at a time, and sticking.
fn laws(results: &Results) -> Result<Vec<Value>, Error> {
    let laws = results.laws()?;
    let distance = |sigma: f64| (sigma - ABOVE).abs();
    let fitted = laws
        .rows
        .iter()
        .filter(|row| row.near.is_some() && row.slow.is_some())
        .min_by(|a, b| distance(a.sigma).total_cmp(&distance(b.sigma)));
    let (near, slow, sigma, impacts) = match fitted {
        Some(row) => (row.near, row.slow, row.sigma, row.impacts),
        None => return Err(Error::Missing("laws of rare impacts")),
    };
    let (Some(near), Some(slow)) = (near, slow) else {
        return Err(Error::Missing("laws of rare impacts"));
    };
    let contacts = |row: &LawsRow| row.contact_phases_per_impact * row.impacts as f64;
    let on_rise: f64 = laws.rows.iter().filter(|row| row.sigma <= ABOVE).map(contacts).sum();
    let last = |decades: &[u64]| decades.last().copied().unwrap_or(0);
    Ok(vec![
        chosen("laws_sigma", sigma),
        Value::ensemble("near_exponent", near.exponent, near.exponent_error, impacts),
        Value::ensemble("near_coefficient", near.coefficient, near.coefficient_error, impacts),
        Value::ensemble("slow_exponent", slow.exponent, slow.exponent_error, impacts),
        count("near_simultaneous", last(&laws.totals.near_decades)),
        Value::real("near_expected", laws.totals.expected_near_simultaneous, 2),
        Value::real("near_limit", NEAR_SIMULTANEOUS, 1),
        count("slow_impacts", last(&laws.totals.slow_decades)),
        Value::real("slow_limit", SLOW, 1),
        Value::real("slow_expected", laws.totals.expected_slow, 1),
        Value::real("stick_rise", can_stick(PRINTED_THRESHOLD), 1).source(origin(can_stick), ""),
        chosen("sigma_stick_above", STICKING),
        Value::real("stick_above", can_stick(STICKING), 1).source(origin(can_stick), ""),
        chosen("sigma_contact", ABOVE),
        count("contact_phases_rise", on_rise.round() as u64),
        count("contact_phases", laws.totals.contact_phases),
    ])
}

fn horizon(results: &Results) -> Result<Vec<Value>, Error> {
    let found = results.horizon()?;
    let twins = found.twins.len();
    let first = found.twins.iter().filter_map(|pair| pair.order).fold(f64::INFINITY, f64::min);
    Ok(vec![
        Value::integer("horizon_twins", twins),
        chosen("horizon_sigma", found.parameters.sigma),
        estimate("horizon_order", found.order, twins),
        estimate("horizon_impacts", found.order_impacts, twins),
        estimate("horizon_tenfold", found.tenfold, twins),
        if first.is_finite() {
            Value::real("horizon_order_first", first, 3)
        } else {
            Value::text("horizon_order_first", "none")
        },
    ])
}

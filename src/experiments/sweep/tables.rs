//! What follows from the sweep: means and shares at each σ, where the rise is, and what is rare.

use super::super::{Results, rise};
use super::laws;
use super::{Sweep, SweepRow};
use crate::experiments::{SECOND_SEED, SWEEP};
use crate::params::{LEVEL, NEAR_SIMULTANEOUS, PRINTED_THRESHOLD, SLOW};
use impact_numerics::statistics::Estimate;
use literate::table::Table;
use literate::value::origin;

/// A σ above the rise.
const ABOVE: f64 = 0.2;
/// A σ at which masses begin to be able to stick.
const STICKING: f64 = 0.3;

/// All tables of the main sweep.
pub fn tables(sweep: &Sweep) -> Vec<Table> {
    vec![
        run("sweep.run", sweep),
        rows(sweep),
        rise_table("sweep.rise", sweep),
        modes(sweep),
        laws_table(sweep),
        rare(sweep),
        sticking(),
    ]
}

/// Those of the sweep with the second seed.
pub fn of_second_seed(sweep: &Sweep) -> Vec<Table> {
    vec![run("second_seed.run", sweep), rise_table("second_seed.rise", sweep)]
}

/// What follows from both.
pub fn of_both(results: &Results, _: &[Table]) -> Option<Vec<Table>> {
    let (first, second) = results.of(&SWEEP).ok().zip(results.of(&SECOND_SEED).ok())?;
    let found = largest_between_seeds(first, second);
    let table = Table::of("second_seed.beside_first", &[()], |()| 0)
        .computed_by(origin(largest_between_seeds))
        .real(
            "largest",
            "1",
            2,
            "largest difference of the means of the kept, over its standard error",
            |()| found.map_or(f64::NAN, |(errors, _)| errors),
        )
        .count("compared", "values of σ with means in both", |()| {
            found.map_or(0, |(_, rows)| rows as u64)
        })
        .done();
    Some(vec![table])
}

/// What was run.
fn run(name: &'static str, sweep: &Sweep) -> Table {
    let of = |pick: fn(&SweepRow) -> u64| move |own: &&Sweep| own.rows.iter().map(pick).sum();
    Table::of(name, &[sweep], |own| own.parameters.realisations)
        .count("gaps", "gaps of a chain", |own| own.parameters.chain.gaps() as u64)
        .chosen("transient", "1/omega", "", |own| Some(own.parameters.protocol.transient))
        .chosen("window", "1/omega", "", |own| Some(own.parameters.protocol.window))
        .count("realisations", "chains at each σ", |own| own.parameters.realisations as u64)
        .chosen("level_above", "d omega^2", "above this σ fewer chains are run", |own| {
            own.parameters.level.map(|level| level.above)
        })
        .chosen("level_realisations", "1", "so many", |own| {
            own.parameters.level.map(|level| level.realisations as f64)
        })
        .count("sigmas", "values of σ", |own| own.rows.len() as u64)
        .count("seed", "master seed", |own| own.parameters.seed)
        .chosen("confidence", "1", "of all intervals", |_| Some(LEVEL))
        .count("impacts", "impacts simulated, transients included", of(|row| row.impacts))
        .count("failed", "realisations that the engine ended early", of(|row| row.failed as u64))
        .done()
}

/// Realisations of a row that ran to the end.
fn ran(row: &SweepRow) -> usize {
    row.realisations.saturating_sub(row.rejected + row.failed)
}

/// Each σ.
fn rows(sweep: &Sweep) -> Table {
    let of = |[value, error]: [f64; 2]| Estimate { value, error, interval: [value; 2] };
    Table::of("sweep.rows", &sweep.rows, ran)
        .key("sigma", "d omega^2", |row| row.sigma)
        .computed_by(origin(super::reduce))
        .estimate("kept", "1", "share of the realisations with an impact in the window", |row| {
            let (part, whole) = (row.kept as f64, ran(row).max(1) as f64);
            let p = part / whole;
            Some(of([p, (p * (1.0 - p) / whole).sqrt()]))
        })
        .estimate("mean_all", "1", "different gaps with an impact, mean of all", |row| {
            mean_all(row).map(of)
        })
        .over(|row| row.kept)
        .estimate("mean", "1", "different gaps with an impact, mean of the kept", |row| {
            row.mean_distinct.zip(row.standard_error).map(|(mean, error)| of([mean, error]))
        })
        .estimate("impacts", "1", "impacts in the window, mean of the kept", |row| {
            row.impacts_in_window.map(of)
        })
        .estimate("masses", "1", "masses hit in the window, mean of the kept", |row| {
            row.masses_hit.map(of)
        })
        .done()
}

/// Places of the rise.
fn rise_table(name: &'static str, sweep: &Sweep) -> Table {
    Table::of(name, &[sweep], |own| own.parameters.realisations)
        .computed_by(origin(rise::find))
        .estimate(
            "half_height",
            "d omega^2",
            "the mean of the kept passes half of all gaps",
            |own| own.rise.half_height,
        )
        .interval("half_height_interval", "d omega^2", "its bootstrap interval", |own| {
            own.rise.half_height.map(|half| half.interval)
        })
        .estimate(
            "half_height_all",
            "d omega^2",
            "the mean of all passes half of all gaps",
            |own| own.rise.half_height_all,
        )
        .estimate("onset", "d omega^2", "the mean of all passes a twentieth of all gaps", |own| {
            own.rise.onset
        })
        .estimate("kept_half", "d omega^2", "half of the chains have an impact", |own| {
            own.rise.kept_half
        })
        .estimate(
            "width",
            "d omega^2",
            "from a tenth to nine tenths of all gaps, of the mean of all",
            |own| own.rise.width,
        )
        .estimate(
            "kept_width",
            "d omega^2",
            "from a quarter to three quarters of all gaps, of the mean of the kept",
            |own| own.rise.kept_width,
        )
        .done()
}

/// Where the mode is.
fn modes(sweep: &Sweep) -> Table {
    let width = |row: &SweepRow| row.mode_interval.map_or(0, |[low, high]| high - low.min(high));
    let noisiest = sweep.rows.iter().filter(|row| width(row) > 0).max_by_key(|row| width(row));
    let half = mode_half(sweep);
    Table::of("sweep.mode", &[()], |()| 0)
        .chosen("noisiest_sigma", "d omega^2", "where the interval of the mode is longest", |()| {
            noisiest.map(|row| row.sigma)
        })
        .interval("noisiest", "1", "that interval", |()| {
            noisiest?.mode_interval.map(|ends| ends.map(|end| end as f64))
        })
        .computed_by(origin(mode_half))
        .chosen(
            "half_from",
            "d omega^2",
            "to here the mode is surely under half of all gaps",
            |()| half.map(|[low, _]| low),
        )
        .chosen("half_to", "d omega^2", "from here surely over", |()| half.map(|[_, high]| high))
        .done()
}

/// The laws of near and slow impacts, at each σ that has impacts.
fn laws_table(sweep: &Sweep) -> Table {
    let fits = laws::run(&sweep.rows).rows;
    let of = |value, error| Estimate { value, error, interval: [value; 2] };
    Table::of("sweep.laws", &fits, |row| row.impacts as usize)
        .key("sigma", "d omega^2", |row| row.sigma)
        .computed_by(origin(laws::run))
        .estimate("near_exponent", "1", "of the share of impacts next to another within δ", |row| {
            row.near.map(|law| of(law.exponent, law.exponent_error))
        })
        .estimate("near_coefficient", "1", "share over δ", |row| {
            row.near.map(|law| of(law.coefficient, law.coefficient_error))
        })
        .estimate("slow_exponent", "1", "of the share of impacts slower than v", |row| {
            row.slow.map(|law| of(law.exponent, law.exponent_error))
        })
        .done()
}

/// What is rare, over all σ.
fn rare(sweep: &Sweep) -> Table {
    let laws = laws::run(&sweep.rows);
    let last = |decades: &[u64]| decades.last().copied().unwrap_or(0);
    Table::of("sweep.rare", &[laws], |_| 0)
        .computed_by(origin(laws::run))
        .count("near_simultaneous", "impacts next to another within the limit", |own| {
            last(&own.totals.near_decades)
        })
        .real("near_expected", "1", 2, "the law's", |own| own.totals.expected_near_simultaneous)
        .real("near_limit", "1/omega", 1, "", |_| NEAR_SIMULTANEOUS)
        .count("slow", "impacts slower than the limit", |own| last(&own.totals.slow_decades))
        .real("slow_expected", "1", 1, "the law's", |own| own.totals.expected_slow)
        .real("slow_limit", "d omega", 1, "", |_| SLOW)
        .chosen("contact_sigma", "d omega^2", "above the rise", |_| Some(ABOVE))
        .count("contact_phases_below", "contact phases up to that σ", |own| {
            let below = own.rows.iter().filter(|row| row.sigma <= ABOVE);
            below.map(|row| row.contact_phases).sum()
        })
        .count("contact_phases", "contact phases of all σ", |own| own.totals.contact_phases)
        .done()
}

/// The probability that the forces on a pair can press it together: |ΔF| > d ω².
fn can_stick(sigma: &f64) -> f64 {
    pxfm::f_exp(-0.25 / (sigma * sigma))
}

fn sticking() -> Table {
    Table::of("sweep.sticking", &[PRINTED_THRESHOLD, STICKING], |_| 0)
        .key("sigma", "d omega^2", |sigma| *sigma)
        .real("chance", "1", 1, "that the forces on a pair can press it together", can_stick)
        .done()
}

/// Mean over all that ran, and its standard error, from the counts of a row.
pub fn mean_all(row: &SweepRow) -> Option<[f64; 2]> {
    let ran: f64 = row.counts.iter().map(|&c| f64::from(c)).sum();
    let mean = row.mean_all?;
    let squares: f64 = (0_u32..)
        .zip(&row.counts)
        .map(|(k, &c)| f64::from(c) * (f64::from(k) - mean) * (f64::from(k) - mean))
        .sum();
    (ran > 1.0).then(|| [mean, (squares / (ran - 1.0) / ran).sqrt()])
}

/// Between which σ the mode passes half of all gaps: below the first it is surely under one half,
/// from the second on surely over it, as far as its bootstrap intervals tell.
pub fn mode_half(sweep: &Sweep) -> Option<[f64; 2]> {
    let half = sweep.parameters.chain.gaps() as f64 / 2.0;
    let intervals: Vec<(f64, [usize; 2])> =
        sweep.rows.iter().filter_map(|row| Some((row.sigma, row.mode_interval?))).collect();
    let low = intervals.iter().find(|(_, [_, top])| *top as f64 >= half)?;
    let below = intervals.iter().rposition(|(_, [bottom, _])| (*bottom as f64) < half)?;
    Some([low.0, intervals.get(below + 1)?.0])
}

/// Fewest kept realisations for a mean whose error is taken as normal.
const FEWEST: usize = 30;

/// The largest difference between the curves of two seeds, in standard errors, and the rows.
pub fn largest_between_seeds(first: &Sweep, second: &Sweep) -> Option<(f64, usize)> {
    let mut largest: Option<f64> = None;
    let mut rows = 0;
    for b in &second.rows {
        let Some(a) = first.rows.iter().find(|a| a.sigma == b.sigma) else { continue };
        if a.kept.min(b.kept) < FEWEST {
            continue;
        }
        let means = a.mean_distinct.zip(b.mean_distinct);
        let errors = a.standard_error.zip(b.standard_error);
        let (Some((m, n)), Some((s, t))) = (means, errors) else { continue };
        let error = (s * s + t * t).sqrt();
        if error > 0.0 {
            rows += 1;
            largest = Some(largest.unwrap_or(0.0).max((m - n).abs() / error));
        }
    }
    Some((largest?, rows))
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::quadrature::GaussLegendre;

    /// The amplitude of the difference of two forces is Rayleigh distributed with variance 2σ² in each
    /// quadrature; the chance that it exceeds one is the integral of that density.
    #[test]
    fn the_chance_to_stick_is_the_integral_of_a_density() {
        let rule = GaussLegendre::new(20);
        for sigma in [PRINTED_THRESHOLD, ABOVE, STICKING] {
            let variance = 2.0 * sigma * sigma;
            let density = |x: f64| x / variance * pxfm::f_exp(-0.5 * x * x / variance);
            let integral = rule.integrate_panels(1.0, 1.0 + 12.0 * sigma, 30, density);
            assert!((can_stick(&sigma) / integral - 1.0).abs() < 1e-10, "{sigma}");
        }
    }
}

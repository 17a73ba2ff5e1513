//! Runs the simulations of Sec. 2: means and shares at each σ, the rise, and rare events.

use crate::experiments::prelude::*;
use impact_chain::counts::{NEAR_DECADES, SLOW_DECADES, Total};

pub const SWEEP: Ensembles = ensembles("sweep", "main sweep", params::sweep, tables);

/// The rise again, with another seed.
pub const SECOND_SEED: Ensembles =
    ensembles("second_seed", "second seed", params::second_seed, of_second_seed);

/// A σ above the rise, and one at which masses begin to be able to stick.
const ABOVE: f64 = 0.2;
const STICKING: f64 = 0.3;

pub fn main_sweep(results: &Results) -> Result<&Counted, Error> {
    let missing = || Error::input(SWEEP.name, "its result has no chains", "run it again");
    find_ensemble(results.of(&SWEEP)?, SWEEP.name).ok_or_else(missing)
}

fn tables(ensembles: &Vec<Counted>) -> Vec<Table> {
    let Some(sweep) = find_ensemble(ensembles, SWEEP.name) else { return Vec::new() };
    let mut total = Total::default();
    sweep.runs.iter().for_each(|row| total.add(&row.total));
    let [run, rare] = [run(sweep, &total), rare(sweep, &total)];
    vec![run, rows(sweep), rise_table(sweep), modes(sweep), rare, sticking()]
}

fn of_second_seed(ensembles: &Vec<Counted>) -> Vec<Table> {
    let table = Table::builder("second_seed.rise", ensembles, |sweep| sweep.ensemble.realisations)
        .count("seed", "master seed", |sweep| sweep.ensemble.seed)
        .estimate("half_height", SIGMA, OF_ACTIVE, |sweep| sweep.first_curve().rise.half_height)
        .computed_by(origin(Curve::new), &["half_height"]);
    vec![table.done()]
}

const WIDTH_OF_ACTIVE: &str =
    "from a quarter to three quarters of all gaps, of the mean of realisations with an impact";

fn run(sweep: &Counted, total: &Total) -> Table {
    let (protocol, beyond) = (sweep.first_curve().protocol, sweep.ensemble.beyond);
    let few = beyond.and_then(|beyond| beyond.realisations);
    let failed = sweep.runs.iter().map(|runs| runs.failed as u64).sum();
    let by_engine = sweep.runs.iter().map(|runs| runs.by_engine as u64).sum();
    Table::builder("sweep.run", &[&sweep.ensemble], |ensemble| ensemble.realisations)
        .count("gaps", "gaps of a chain", |ensemble| ensemble.chain.gaps() as u64)
        .chosen("transient", TIME, "", |_| Some(protocol.transient))
        .chosen("window", TIME, "", |_| Some(protocol.window))
        .count("realisations", "chains at each σ", |ensemble| ensemble.realisations as u64)
        .chosen("level_above", SIGMA, "above this σ fewer chains are run", |_| Some(beyond?.above))
        .chosen("level_realisations", "1", "so many", |_| few.map(|few| few as f64))
        .count("sigmas", "values of σ", |ensemble| ensemble.sigmas.len() as u64)
        .count("seed", "master seed", |ensemble| ensemble.seed)
        .chosen("confidence", "1", "of all intervals", |_| Some(LEVEL))
        .count("impacts", "impacts simulated, transients included", |_| total.impacts)
        .count("failed", "realisations that the engine ended early", |_| failed)
        .count("by_engine", "realisations simulated by themselves", |_| by_engine)
        .done()
}

/// Makes the table of means (of different gaps, of impacts, of masses) and shares at each σ.
fn rows(sweep: &Counted) -> Table {
    let active = |row: &RisePoint| share(row.active as u64, row.ran as u64);
    Table::builder("sweep.rows", &sweep.first_curve().rows, |row| row.ran)
        .table_computed_by(origin(RisePoint::new))
        .key("sigma", SIGMA, |row| row.sigma)
        .estimate("kept", "1", "share of the realisations with an impact in the window", active)
        .estimate("mean_all", "1", "gaps with an impact, mean of all", |r| r.mean_all?.estimate())
        .next_columns_over(|row| row.active)
        .estimate("mean", "1", "gaps hit, mean of those with any", |row| row.mean?.estimate())
        .estimate("impacts", "1", "impacts, mean of those with any", |row| row.impacts?.estimate())
        .estimate("masses", "1", "masses hit, mean of those with any", |row| row.masses?.estimate())
        .done()
}

fn rise_table(sweep: &Counted) -> Table {
    let interval = sweep.first_curve().rise.half_height.map(|half| half.interval);
    Table::builder("sweep.rise", &[&sweep.first_curve().rise], |_| sweep.ensemble.realisations)
        .table_computed_by(origin(Curve::new))
        .estimate("half_height", SIGMA, OF_ACTIVE, |rise| rise.half_height)
        .real("half_height_from", SIGMA, 4, "lower end of its interval", |_| Some(interval?[0]))
        .real("half_height_to", SIGMA, 4, "upper end of its interval", |_| Some(interval?[1]))
        .estimate("half_height_all", SIGMA, HALF_HEIGHT, |rise| rise.half_height_all)
        .estimate("onset", SIGMA, "σ where it passes a twentieth of all gaps", |rise| rise.onset)
        .estimate("kept_half", SIGMA, HALF_OF_CHAINS, |rise| rise.kept_half)
        .estimate("width", SIGMA, "from a tenth to nine tenths of all gaps", |rise| rise.width)
        .estimate("kept_width", SIGMA, WIDTH_OF_ACTIVE, |rise| rise.kept_width)
        .done()
}

fn modes(sweep: &Counted) -> Table {
    let (sigma, interval) =
        mode_intervals(sweep.first_curve()).max_by_key(|(_, [low, high])| high - low).unzip();
    Table::builder("sweep.mode", &[()], |()| 0)
        .chosen("noisiest_sigma", SIGMA, "where the interval of the mode is longest", |()| sigma)
        .chosen("noisiest_from", "1", "its lower end", |()| Some(interval?[0] as f64))
        .chosen("noisiest_to", "1", "its upper end", |()| Some(interval?[1] as f64))
        .done()
}

/// Returns the near-simultaneous and the slow impacts expected by chance: from those within
/// δ = 1e−2 in proportion to δ, and below v = 0.1 in proportion to v², as the rate grows with v.
fn expected(total: &Total) -> [f64; 2] {
    let (near, slow) = (NEAR_SIMULTANEOUS / NEAR_DECADES[1], SLOW / SLOW_DECADES[0]);
    [total.near[1] as f64 * near, total.slow[0] as f64 * slow * slow]
}

fn rare(sweep: &Counted, total: &Total) -> Table {
    let below = sweep.runs.iter().filter(|row| row.sigma <= ABOVE);
    let contact_phases_below = below.map(|row| row.total.contact_phases).sum();
    let [near, slow] =
        [&total.near[..], &total.slow].map(|decades| decades.last().copied().unwrap_or(0));
    let [near_expected, slow_expected] = expected(total);
    Table::builder("sweep.rare", &[()], |()| 0)
        .count("near_simultaneous", "impacts next to another within the limit", |()| near)
        .real("near_expected", "1", 2, "the law's", |()| near_expected)
        .real("near_limit", TIME, 1, "", |()| NEAR_SIMULTANEOUS)
        .count("slow", "impacts slower than the limit", |()| slow)
        .real("slow_expected", "1", 1, "the law's", |()| slow_expected)
        .computed_by(origin(expected), &["near_expected", "slow_expected"])
        .real("slow_limit", "d omega", 1, "", |()| SLOW)
        .chosen("contact_sigma", SIGMA, "above the rise", |()| Some(ABOVE))
        .count("contact_phases_below", "contact phases up to that σ", |()| contact_phases_below)
        .count("contact_phases", "contact phases of all σ", |()| total.contact_phases)
        .done()
}

/// Returns the chance that forces press a pair together: Rayleigh ΔF, scale √2 σ, above d ω² = 1.
fn can_stick(sigma: &f64) -> f64 {
    pxfm::f_exp(-0.25 / (sigma * sigma))
}

fn sticking() -> Table {
    Table::builder("sweep.sticking", &[printed_threshold(), STICKING], |_| 0)
        .key("sigma", SIGMA, |sigma| *sigma)
        .real("chance", "1", 1, "that the forces on a pair can press it together", can_stick)
        .done()
}

/// Lists the σ at which the mode has an interval, with the interval.
fn mode_intervals(curve: &Curve) -> impl Iterator<Item = (f64, [usize; 2])> {
    curve.rows.iter().filter_map(|row| Some((row.sigma, row.mode_interval?)))
}

/// Returns the σ between which the mode passes half of all gaps, by its bootstrap intervals, or
/// `None` if it does not pass.
pub fn mode_half(curve: &Curve, gaps: usize) -> Option<[f64; 2]> {
    let half = gaps as f64 / 2.0;
    let intervals: Vec<(f64, [usize; 2])> = mode_intervals(curve).collect();
    let low = intervals.iter().find(|(_, [_, top])| *top as f64 >= half)?;
    let below = intervals.iter().rposition(|(_, [bottom, _])| (*bottom as f64) < half)?;
    Some([low.0, intervals.get(below + 1)?.0])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From δ = 1e−2 to 1e−9 a factor of 1e7, from v = 0.1 to 1e−8 the square of one.
    #[test]
    fn rare_impacts_follow_their_laws() {
        let mut total = Total::default();
        (total.near[1], total.slow[0]) = (10_000_000, 100_000_000_000_000);
        let [near, slow] = expected(&total);
        assert!((near - 1.0).abs() < 1e-12 && (slow - 1.0).abs() < 1e-12, "{near} {slow}");
    }
}

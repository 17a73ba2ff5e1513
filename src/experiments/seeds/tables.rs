//! Makes the tables of the runs, of fronts, and of the mean counts that follow.

use super::counting::{bits, seeded};
use super::fronts::{Fronts, beat, ratio_over_runs};
use super::growth::{GROUPS, Prediction, sums};
use super::{ByDistance, Seeds, Trace};
use crate::experiments::prelude::*;

struct RunsAtSigma<'a> {
    sigma: f64,
    runs: Vec<(usize, &'a Trace)>,
    /// Counts of all groups of runs but one, for each group in turn, and last of all.
    sums: &'a [ByDistance],
    fronts: Vec<Fronts>,
}

pub fn make(seeds: &Seeds) -> Vec<Table> {
    let parameters = &seeds.parameters;
    let sums = sums(parameters, &seeds.rows);
    let mut rows = Vec::new();
    for ((part, sums), &sigma) in seeds.rows.iter().zip(&sums).zip(&parameters.sigmas) {
        let runs: Vec<(usize, &Trace)> = seeded(part).collect();
        let fronts = runs.iter().map(|run| Fronts::count(parameters, *run)).collect();
        rows.push(RunsAtSigma { sigma, runs, sums, fronts });
    }
    vec![
        course(parameters, &rows),
        advance(parameters, &rows),
        fronts(beat(&parameters.chain), &rows),
        means(parameters, &seeds.predicted),
        rise(parameters, &seeds.predicted),
        all(parameters),
    ]
}

/// Makes the table of counts at the end of the window after each transient.
fn course(parameters: &SeedsParams, rows: &[RunsAtSigma<'_>]) -> Table {
    let (window, transients) = (parameters.window, parameters.transients.iter());
    let rows: Vec<(&RunsAtSigma<'_>, usize)> =
        rows.iter().flat_map(|row| transients.clone().map(move |&from| (row, from))).collect();
    Table::builder("seeds.course", &rows, |(row, _)| row.runs.len())
        .key("sigma", SIGMA, |(row, _)| row.sigma)
        .key("until", TIME, |(_, from)| (from + window) as f64 * parameters.bin)
        .estimate("reached", "1", "gaps hit by then", |(row, from)| row.hit(0, from + window))
        .estimate("active", "1", "gaps hit in the window", |(row, from)| row.hit(*from, window))
        .done()
}

fn advance(parameters: &SeedsParams, rows: &[RunsAtSigma<'_>]) -> Table {
    let rows: Vec<(&RunsAtSigma<'_>, usize)> =
        rows.iter().flat_map(|row| (1..=parameters.bins).map(move |bin| (row, bin))).collect();
    Table::builder("seeds.advance", &rows, |(row, _)| row.runs.len())
        .key("sigma", SIGMA, |(row, _)| row.sigma)
        .key("time", TIME, |(_, bin)| *bin as f64 * parameters.bin)
        .real("advance", "1", 3, "gaps passed by a front", |(row, bin)| {
            row.sums[GROUPS].advance(*bin)
        })
        .done()
}

fn fronts(beat: f64, rows: &[RunsAtSigma<'_>]) -> Table {
    const STANDING: &str = "share of fronts without a step in the second half";
    let share = |row: &RunsAtSigma<'_>, parts| ratio_over_runs(&row.fronts, parts);
    Table::builder("seeds.fronts", rows, |row| row.runs.len())
        .key("sigma", SIGMA, |row| row.sigma)
        .estimate("exponent", "1", "d ln(advance)/d ln t over the last three quarters", |row| {
            jackknife(GROUPS, |left_out| row.sums[left_out.unwrap_or(GROUPS)].exponent())
        })
        .estimate("bursts", "1", "share of steps within a beat", |row| {
            share(row, |sums| [sums.short, sums.steps])
        })
        .real("even", "1", 2, "the same for steps at a constant rate and this speed", |row| {
            let speed = share(row, |sums| [sums.steps, sums.waited]);
            speed.map_or(0.0, |speed| -pxfm::f_expm1(-speed.value * beat))
        })
        .estimate("standing", "1", STANDING, |row| share(row, |sums| [sums.standing, sums.fronts]))
        .done()
}

fn means(parameters: &SeedsParams, predicted: &[Prediction]) -> Table {
    let sigmas = |means| parameters.sigmas.iter().enumerate().map(move |sigma| (means, sigma));
    let rows: Vec<(&Prediction, (usize, &f64))> = predicted.iter().flat_map(sigmas).collect();
    Table::builder("seeds.means", &rows, |_| parameters.realisations)
        .key("transient", TIME, |(means, _)| means.transient as f64 * parameters.bin)
        .key("sigma", SIGMA, |(_, (_, sigma))| **sigma)
        .estimate("grown", "1", "mean count by nucleation and growth", |row| row.0.mean(row.1.0))
        .done()
}

/// Makes the table of half heights, if all gaps of a clump are seeds, or only the first.
fn rise(parameters: &SeedsParams, predicted: &[Prediction]) -> Table {
    let half = |which| move |means: &Prediction| means.half_height(parameters, which);
    Table::builder("seeds.rise", predicted, |_| parameters.realisations)
        .key("transient", TIME, |means| means.transient as f64 * parameters.bin)
        .estimate("half_height", SIGMA, "σ where that is half of all gaps", half(0))
        .estimate("of_clumps", SIGMA, "the same if only clumps are seeds", half(1))
        .done()
}

fn all(parameters: &SeedsParams) -> Table {
    Table::builder("seeds.all", &[parameters], |p| p.realisations)
        .count("realisations", "chains at each σ", |p| p.realisations as u64)
        .count("sigmas", "values of σ", |p| p.sigmas.len() as u64)
        .chosen("until", TIME, "time since the first impact", |p| Some(p.until()))
        .real("beat", TIME, 3, "2π/|Ω − ω|", |p| beat(&p.chain))
        .done()
}

impl RunsAtSigma<'_> {
    /// Estimates the number of gaps of a run with an impact in some bins.
    fn hit(&self, from: usize, count: usize) -> Option<Estimate> {
        let mask = bits(from, count);
        let hit = |trace: &Trace| trace.hits.iter().filter(|bits| **bits & mask != 0).count();
        average(&self.runs.iter().map(|(_, trace)| hit(trace) as f64).collect::<Vec<_>>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_runs_by_hand() {
        let mut parameters = SeedsParams::new(Profile::Quick);
        (parameters.chain.masses, parameters.sigmas) = (2, vec![0.1]);
        (parameters.bins, parameters.window, parameters.transients) = (4, 2, vec![0, 2]);
        // The seed is hit in the first bin, its neighbours in the second and fourth, or one.
        let run = |hits: [u64; 3], firsts: [Option<u32>; 3]| {
            let (hits, firsts) = (hits.to_vec(), firsts.to_vec());
            Some(Trace { seed: Some(1), hits, firsts })
        };
        let rows = vec![vec![
            run([0, 0b0001, 0b1010], [None, Some(0), Some(30)]),
            None,
            run([0b0010, 0b0001, 0b0010], [Some(30), Some(0), Some(40)]),
        ]];
        let tables = make(&Seeds::new(parameters, rows));
        let [course, advance, fronts, ..] = &tables[..] else { panic!() };
        let count = |until: f64, column| course.number(&[("until", until)], column).unwrap();
        let columns = ["reached", "active"];
        assert_eq!(columns.map(|column| count(50.0, column)), [2.5, 2.5]);
        assert_eq!(columns.map(|column| count(100.0, column)), [2.5, 0.5]);
        // To each side there are two neighbours, of which three of four are hit.
        let advance = advance.curve(&[], "time", "advance").unwrap();
        assert_eq!(advance, [(25.0, 0.0), (50.0, 0.75), (75.0, 0.75), (100.0, 0.75)]);
        // Waits of 30, 30 and 40, and one that is cut off at 100: of four fronts one stands.
        let beat = std::f64::consts::TAU / (std::f64::consts::SQRT_2 - 1.0);
        let front = |column| fronts.number(&[("sigma", 0.1)], column).unwrap();
        assert!((front("even") + pxfm::f_expm1(-3.0 / 200.0 * beat)).abs() < 1e-12);
        assert_eq!([front("bursts"), front("standing")], [0.0, 0.25]);
    }
}

//! What follows from the runs.

use super::hot::hot;
use super::{Case, Restitution, Run, cases};
use crate::params::RestitutionParams;
use impact_numerics::estimates::{self, average, half_height, jackknife, ratio};
use impact_numerics::statistics::{Estimate, slope};
use literate::table::Table;
use pxfm::f_log;

/// Windows at the end over which an exponent is fitted.
const LAST: usize = 4;

/// One ensemble.
struct Row<'a> {
    parameters: &'a RestitutionParams,
    case: Case,
    runs: Vec<&'a Run>,
}

/// All tables.
pub fn tables(found: &Restitution) -> Vec<Table> {
    let parameters = &found.parameters;
    let row = |(case, part)| -> Row<'_> {
        let part: &Vec<Option<Run>> = part;
        Row { parameters, case, runs: part.iter().flatten().collect() }
    };
    let rows: Vec<Row<'_>> = cases(parameters).into_iter().zip(&found.rows).map(row).collect();
    let (rise, heated) = rows.split_at(parameters.restitutions.len() * parameters.sigmas.len());
    let curves: Vec<&[Row<'_>]> = rise.chunks(parameters.sigmas.len()).collect();
    vec![
        rise_table(rise),
        curve_table(&curves),
        heating_table(heated),
        heated_table(heated),
        totals(parameters, rise),
    ]
}

/// Each (r, σ), in the window after the transient.
fn rise_table(rows: &[Row<'_>]) -> Table {
    Table::of("restitution.rise", rows, Row::realisations)
        .key("r", "1", |row| row.case.restitution)
        .key("sigma", "d omega^2", |row| row.case.sigma)
        .estimate("mean_count", "1", "different gaps with an impact", |row| {
            row.mean(|run| run.distinct as f64)
        })
        .estimate("impacts", "omega", IMPACTS, |row| row.rate(row.last()))
        .estimate("phases_per_impact", "1", "contact phases over impacts", |row| {
            row.ratio(|run| [run.phases as f64, run.impacts.last().map_or(0.0, |&n| n as f64)])
        })
        .count("phases", "contact phases", |row| row.sum(|run| run.phases))
        .done()
}

const IMPACTS: &str = "impacts per unit of time";

/// Each r.
fn curve_table(curves: &[&[Row<'_>]]) -> Table {
    let first = |curve: &&[Row<'_>]| curve.first().map_or(0.0, |row| row.case.restitution);
    Table::of("restitution.curves", curves, |curve| curve.first().map_or(0, Row::realisations))
        .key("r", "1", first)
        .estimate(
            "half_height",
            "d omega^2",
            "σ where the mean count of all chains passes half of all gaps",
            |curve| {
                let counts: Vec<Vec<f64>> = curve.iter().map(Row::counts).collect();
                let parameters = curve.first()?.parameters;
                half_height(&parameters.sigmas, &counts, half(parameters))
            },
        )
        .done()
}

/// Chains that are watched while they heat, in each window.
fn heating_table(heated: &[Row<'_>]) -> Table {
    let windows = |row| (0..Row::ends(row).len()).map(move |window| (row, window));
    let rows: Vec<(&Row<'_>, usize)> = heated.iter().flat_map(windows).collect();
    let lossless = |(row, window): &(&Row<'_>, usize)| {
        let begin = window.checked_sub(1).map_or(0.0, |before| row.ends()[before]);
        hot(&row.parameters.chain, row.case.sigma, begin, row.ends()[*window])
    };
    Table::of("restitution.heating", &rows, |(row, _)| row.realisations())
        .key("r", "1", |(row, _)| row.case.restitution)
        .key("window_end", "1/omega", |(row, window)| row.ends()[*window])
        .estimate("impacts", "omega", IMPACTS, |(row, window)| row.rate(*window))
        .real("impacts_lossless", "omega", 3, "the same for a hot chain at r = 1", lossless)
        .done()
}

/// The same over all windows.
fn heated_table(heated: &[Row<'_>]) -> Table {
    Table::of("restitution.heated", heated, Row::realisations)
        .key("r", "1", |row| row.case.restitution)
        .chosen("sigma", "d omega^2", "", |row| Some(row.case.sigma))
        .count("realisations", "chains", |row| row.case.realisations as u64)
        .estimate(
            "exponent",
            "1",
            "a of impacts per unit of time ∝ tᵃ, over the last windows",
            exponent,
        )
        .done()
}

/// Numbers of all curves together.
fn totals(parameters: &RestitutionParams, rise: &[Row<'_>]) -> Table {
    Table::of("restitution.all", &[parameters], |own| own.realisations)
        .count("realisations", "chains at each r and σ", |own| own.realisations as u64)
        .count("sigmas", "values of σ", |own| own.sigmas.len() as u64)
        .estimate("shift", "d omega^2", "half height at the last r less that at the first", |_| {
            shift(parameters, rise)
        })
        .chosen("touched_to", "1", "the largest r with a contact phase", |_| {
            let touched = |row: &&Row<'_>| row.sum(|run| run.phases) > 0;
            rise.iter().rfind(touched).map(|row| row.case.restitution)
        })
        .done()
}

fn half(parameters: &RestitutionParams) -> f64 {
    0.5 * parameters.chain.gaps() as f64
}

/// The difference of both ends' half heights: each realisation is left out of both together.
fn shift(parameters: &RestitutionParams, rise: &[Row<'_>]) -> Option<Estimate> {
    let curve = |at: usize| -> Vec<Vec<f64>> {
        let sigmas = parameters.sigmas.len();
        rise.iter().skip(at * sigmas).take(sigmas).map(Row::counts).collect()
    };
    let [first, last] = [curve(0), curve(parameters.restitutions.len().saturating_sub(1))];
    let realisations = first.iter().chain(&last).map(Vec::len).min()?;
    let half =
        |own: &[Vec<f64>], out| estimates::rise(&parameters.sigmas, own, half(parameters), out);
    jackknife(realisations, |out| Some(half(&last, out)? - half(&first, out)?))
}

/// Over the last windows, whose lengths and middles double, ln of the impacts per unit of time grows in
/// a straight line with ln t if it is a power of t.
fn exponent(row: &Row<'_>) -> Option<Estimate> {
    let ends = row.ends();
    let first = ends.len().saturating_sub(LAST).max(1);
    jackknife(row.runs.len(), |out| {
        let point = |place: usize| {
            let kept = row.runs.iter().enumerate().filter(|(at, _)| Some(*at) != out);
            let impacts: u64 = kept.map(|(_, run)| run.impacts[place]).sum();
            let rate = impacts as f64 / (ends[place] - ends[place - 1]);
            (rate > 0.0).then(|| (f_log(ends[place]), f_log(rate)))
        };
        let points: Option<Vec<_>> = (first..ends.len()).map(point).collect();
        slope(&points?)
    })
}

impl Row<'_> {
    fn realisations(&self) -> usize {
        self.case.realisations
    }

    fn ends(&self) -> &[f64] {
        &self.case.ends
    }

    /// The last window.
    fn last(&self) -> usize {
        self.case.ends.len() - 1
    }

    fn mean(&self, of: impl Fn(&Run) -> f64) -> Option<Estimate> {
        average(&self.runs.iter().map(|run| of(run)).collect::<Vec<_>>())
    }

    fn ratio(&self, of: impl Fn(&Run) -> [f64; 2]) -> Option<Estimate> {
        ratio(&self.runs.iter().map(|run| of(run)).collect::<Vec<_>>())
    }

    fn sum(&self, of: impl Fn(&Run) -> u64) -> u64 {
        self.runs.iter().map(|run| of(run)).sum()
    }

    fn counts(&self) -> Vec<f64> {
        self.runs.iter().map(|run| run.distinct as f64).collect()
    }

    fn rate(&self, window: usize) -> Option<Estimate> {
        let begin = window.checked_sub(1).map_or(0.0, |before| self.case.ends[before]);
        let time = self.case.ends[window] - begin;
        self.mean(|run| run.impacts[window] as f64 / time)
    }
}

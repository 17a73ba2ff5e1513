//! Makes the tables of the comparison of methods.

use super::bias::{self, Biases, GapCount};
use super::race::{self, DISPLACED, Entry, Race};
use super::scale::{self, Scale};
use crate::experiments::prelude::*;

/// Writes the name of a setting with its formula: `Verlet, $h = 0.1$`.
pub fn in_formulas(name: &str) -> String {
    let Some((method, setting)) = name.split_once(", ") else { return name.into() };
    let setting = setting.replace("tol", r"\mathrm{tol}");
    format!("{method}, ${}$", power(&setting))
}

/// Writes the number at the end as a power where it has an exponent: `h = 10^{-4}` for `h = 1e-4`.
fn power(number: &str) -> String {
    number.split_once("1e").map_or(number.into(), |(before, e)| format!("{before}10^{{{e}}}"))
}

/// Returns the title of a method with its steps or tolerances, and then its least rebound speeds:
/// `sampling, $h = 0.1$; $0.01$`.
pub fn titled(settings: &[Setting]) -> String {
    let mut title = in_formulas(&settings[0].name());
    for pair in settings.windows(2) {
        let (name, starts) = (pair[1].name(), pair[0].stop == 0.0 && pair[1].stop > 0.0);
        let value = power(name.rsplit(" = ").next().unwrap_or_default());
        title += &format!("; {}${value}$", if starts { "least rebound $=$ " } else { "" });
    }
    title
}

pub fn race(race: &Race) -> Vec<Table> {
    let methods = race.entries.chunk_by(|a, b| a.setting.method == b.setting.method);
    let (coarsest, finest): (Vec<&Entry>, Vec<&Entry>) =
        methods.map(|entries| (&entries[0], &entries[entries.len() - 1])).unzip();
    vec![entries("race.coarsest", &coarsest), entries("race.finest", &finest), all(race)]
}

fn entries(name: &'static str, entries: &[&Entry]) -> Table {
    Table::builder(name, entries, |entry| entry.runs.len())
        .table_computed_by(origin(race::run))
        .text_key("method", |entry| entry.setting.method.id().into())
        .chosen("setting", TIME, "step or tolerance", |entry| Some(entry.setting.value))
        .count("misses", "states from which the next impact is missed", |entry| entry.misses)
        .real("error", TIME, 1, "median error of its time", |entry| Some(entry.errors?[0]))
        .real("units", "1", 2, "largest error over what rounding the gap does", |entry| entry.units)
        .real("work", "1", 2, "evaluations per impact", |entry| entry.work)
        .estimate("horizon", TIME, "time up to which a run is true", |entry| entry.horizon())
        .done()
}

fn all(race: &Race) -> Table {
    let tried = race.entries.iter().map(|entry| entry.tried).max().unwrap_or(0);
    // ln of a displacement over the rounding of one.
    let folds = pxfm::f_log(DISPLACED / (f64::EPSILON / 2.0));
    let (run, growth) = (&race.parameters.growth, race.growth.growth());
    Table::builder("race.all", &[()], |()| race.growth.twins.len())
        .table_computed_by(origin(race::run))
        .chosen("masses", "1", "masses", |()| Some(run.chain.masses as f64))
        .chosen("sigma", SIGMA, "standard deviation σ", |()| Some(run.sigma))
        .chosen("until", TIME, "the end of the runs", |()| Some(race.parameters.until))
        .chosen("displaced", TIME, "from here on an impact is another", |()| Some(DISPLACED))
        .count("chains", "chains", |()| race.parameters.chains as u64)
        .count("states", "from which each method is asked for the next impact", |()| tried)
        .estimate("growth", "omega", "rate λ at which neighbouring motions part", |()| growth)
        .estimate("ceiling", TIME, "time that chaos allows to doubles", |()| {
            growth.map(|g| with_error(folds / g.value, folds / g.value * g.error / g.value))
        })
        .done()
}

/// One method at one σ, and the engine on the same chains.
pub struct Compared {
    pub setting: Setting,
    pub sigma: f64,
    /// Chains that both ran to the end.
    pub pairs: usize,
    /// Ratio of their mean counts less one, with its 95 % interval by the jackknife.
    pub share: Option<Estimate>,
    /// The error of the engine's mean through its own draw of chaos, which all methods share.
    pub engine: f64,
}

/// One in a thousand differences is clear by chance.
const CLEAR: f64 = 0.999;

impl Compared {
    pub fn is_clear(&self) -> bool {
        let bound = student_quantile(CLEAR, self.pairs.saturating_sub(1)).unwrap_or(f64::INFINITY);
        let error = |off: Estimate| (off.error * off.error + self.engine * self.engine).sqrt();
        self.share.is_some_and(|off| off.value.abs() > bound * error(off))
    }
}

/// Returns the counts of a method and those of the engine (the mean of two runs) for each chain
/// that all three ran to the end.
pub fn pairs(run: &[GapCount], ours: [&[GapCount]; 2]) -> Vec<[f64; 2]> {
    let counts = run.iter().zip(ours[0].iter().zip(ours[1]));
    let pair = |(theirs, (first, second)): (&GapCount, (&GapCount, &GapCount))| {
        Some([f64::from((*theirs)?), 0.5 * (f64::from((*first)?) + f64::from((*second)?))])
    };
    counts.filter_map(pair).collect()
}

/// Returns the relative error that chaos makes of roundings in the mean count of the engine, for
/// the mean of two runs of so many chains.
pub fn own_error(ours: [&[GapCount]; 2], chains: usize) -> f64 {
    let both = pairs(ours[0], [ours[1]; 2]);
    let half: Vec<f64> = both.iter().map(|[first, second]| 0.5 * (first - second)).collect();
    let sum: f64 = both.iter().map(|pair| pair[0]).sum();
    let of_all = standard_error(&half).unwrap_or(f64::INFINITY) * both.len() as f64 / sum;
    of_all * (both.len() as f64 / chains as f64).sqrt()
}

/// Returns the comparisons of all rivals, σ outer.
pub fn compared(biases: &Biases) -> Vec<Compared> {
    let mut rows = Vec::new();
    let again = biases.runs.iter().zip(&biases.again);
    for (means, (runs, again)) in biases.parameters.means.iter().zip(again) {
        for (&(setting, _), run) in means.settings.iter().zip(runs).skip(1) {
            let ours = [&runs[0][..], again];
            let pairs = pairs(run, ours);
            let share = || {
                // With few chains all ratios may be equal.
                let Estimate { value, error, .. } =
                    ratio(&pairs).filter(|ratio| ratio.error > 0.0)?;
                let (value, half) =
                    (value - 1.0, student_quantile(LEVEL, pairs.len() - 1)? * error);
                Some(Estimate { value, error, interval: [value - half, value + half] })
            };
            let (sigma, share) = (means.chains.sigma, share());
            let engine = own_error(ours, pairs.len());
            rows.push(Compared { setting, sigma, pairs: pairs.len(), share, engine });
        }
    }
    rows
}

pub fn bias(biases: &Biases) -> Vec<Table> {
    let rows = compared(biases);
    let cells = Table::builder("bias.cells", &rows, |row| row.pairs)
        .table_computed_by(origin(bias::run))
        .text_key("setting", |row| format!("{}-{}", row.setting.method.id(), row.setting.value))
        .key("sigma", SIGMA, |row| row.sigma)
        .estimate("share", "1", "error of the mean over the mean", |row| row.share)
        .done();
    let runs = biases.runs.iter().zip(&biases.again);
    let engine = biases.parameters.means.iter().zip(runs).map(|(means, (runs, again))| {
        let ours = [&runs[0][..], again];
        let counts: Vec<f64> = pairs(&runs[0], ours).iter().map(|pair| pair[1]).collect();
        (means.chains.sigma, counts, own_error(ours, runs[0].len()))
    });
    let engine: Vec<_> = engine.collect();
    let means = Table::builder("bias.means", &engine, |(_, counts, _)| counts.len())
        .table_computed_by(origin(bias::run))
        .key("sigma", SIGMA, |row| row.0)
        .real("mean", "1", 3, "mean number of impacting gaps, by the engine", |row| mean(&row.1))
        .real("chaos", "1", 1, "its error that chaos makes of roundings, over it", |row| row.2)
        .done();
    vec![cells, means]
}

pub fn scale(scale: &Scale) -> Vec<Table> {
    let methods = scale.chunk_by(|a, b| a.setting.method == b.setting.method);
    let ends: Vec<_> = methods.map(|rows| (&rows[0], &rows[rows.len() - 1])).collect();
    const WORK: &str = "evaluations per impact";
    let table = Table::builder("scale.ends", &ends, |_| 1)
        .table_computed_by(origin(scale::run))
        .text_key("method", |(few, _)| few.setting.method.id().into())
        .chosen("setting", TIME, "step or tolerance", |(few, _)| Some(few.setting.value))
        .chosen("small", "1", "fewest masses", |(few, _)| Some(few.masses as f64))
        .chosen("large", "1", "most masses", |(_, many)| Some(many.masses as f64))
        .real("work_small", "1", 2, WORK, |(few, _)| few.evaluations_per_impact)
        .real("work_large", "1", 2, WORK, |(_, many)| many.evaluations_per_impact)
        .done();
    vec![table]
}

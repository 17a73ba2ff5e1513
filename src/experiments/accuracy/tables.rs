//! Makes the tables of the comparison of methods.

use super::bias::{self, Biases, GapCount};
use super::race::{self, DISPLACED, Entry, Race};
use super::scale::{self, Scale};
use crate::experiments::prelude::*;
use crate::params::Setting;
use impact_numerics::estimates::{LEVEL, ratio};
use impact_numerics::statistics::{mean, student_quantile};

/// Writes the name of a setting with its formula: `Verlet, $h = 0.1$`.
pub fn in_formulas(name: &str) -> String {
    let Some((method, setting)) = name.split_once(", ") else { return name.into() };
    let setting = setting.replace("tol", r"\mathrm{tol}");
    format!("{method}, ${}$", power(&setting))
}

/// Writes the number at the end as a power where it has an exponent: `h = 10^{-4}` for `h = 1e-4`.
fn power(text: &str) -> String {
    text.split_once("1e").map_or(text.into(), |(before, e)| format!("{before}10^{{{e}}}"))
}

/// Returns a method with its steps or tolerances: `sampling, $h = 0.1$; $0.01$`, and its least
/// rebound speeds.
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
    Table::of(name, entries, |entry| entry.runs.len())
        .text_key("method", |entry| entry.setting.method.id().into())
        .chosen("setting", TIME, "step or tolerance", |entry| Some(entry.setting.value))
        .computed_by(origin(race::run))
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
    Table::of("race.all", &[()], |()| race.growth.twins.len())
        .chosen("masses", "1", "masses", |()| Some(run.chain.masses as f64))
        .chosen("sigma", SIGMA, "standard deviation σ", |()| Some(run.sigma))
        .chosen("until", TIME, "the end of the runs", |()| Some(race.parameters.until))
        .chosen("displaced", TIME, "from here on an impact is another", |()| Some(DISPLACED))
        .computed_by(origin(race::run))
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
}

/// One in a thousand differences is clear by chance.
const CLEAR: f64 = 0.999;

impl Compared {
    pub fn is_clear(&self) -> bool {
        let bound = student_quantile(CLEAR, self.pairs.saturating_sub(1)).unwrap_or(f64::INFINITY);
        self.share.is_some_and(|off| off.value.abs() > bound * off.error)
    }
}

/// Returns what a method and the engine count in the chains that both ran to the end, by chain.
pub fn pairs(run: &[GapCount], runs: &[Vec<GapCount>]) -> Vec<[f64; 2]> {
    let both = run.iter().zip(&runs[0]);
    both.filter_map(|(theirs, ours)| Some([f64::from((*theirs)?), f64::from((*ours)?)])).collect()
}

/// Returns the comparisons of all rivals, σ outer.
pub fn compared(biases: &Biases) -> Vec<Compared> {
    let mut rows = Vec::new();
    for (of, runs) in biases.parameters.means.iter().zip(&biases.runs) {
        for (&(setting, _), run) in of.settings.iter().zip(runs).skip(1) {
            let pairs = pairs(run, runs);
            let share = || {
                // With few chains all ratios may be equal.
                let Estimate { value, error, .. } = ratio(&pairs).filter(|of| of.error > 0.0)?;
                let (value, half) =
                    (value - 1.0, student_quantile(LEVEL, pairs.len() - 1)? * error);
                Some(Estimate { value, error, interval: [value - half, value + half] })
            };
            let (sigma, share) = (of.chains.sigma, share());
            rows.push(Compared { setting, sigma, pairs: pairs.len(), share });
        }
    }
    rows
}

pub fn bias(biases: &Biases) -> Vec<Table> {
    let rows = compared(biases);
    let cells = Table::of("bias.cells", &rows, |row| row.pairs)
        .text_key("setting", |row| format!("{}-{}", row.setting.method.id(), row.setting.value))
        .key("sigma", SIGMA, |row| row.sigma)
        .computed_by(origin(bias::run))
        .estimate("share", "1", "error of the mean over the mean", |row| row.share)
        .done();
    let engine = biases.parameters.means.iter().zip(&biases.runs).map(|(of, runs)| {
        let counts: Vec<f64> = runs[0].iter().flatten().map(|k| f64::from(*k)).collect();
        (of.chains.sigma, counts)
    });
    let engine: Vec<_> = engine.collect();
    let means = Table::of("bias.means", &engine, |(_, counts)| counts.len())
        .key("sigma", SIGMA, |(sigma, _)| *sigma)
        .computed_by(origin(bias::run))
        .real("mean", "1", 3, "mean number of impacting gaps, by the engine", |row| mean(&row.1))
        .done();
    vec![cells, means]
}

pub fn scale(scale: &Scale) -> Vec<Table> {
    let methods = scale.chunk_by(|a, b| a.0.method == b.0.method);
    let ends: Vec<_> = methods.map(|rows| (&rows[0], &rows[rows.len() - 1])).collect();
    let table = Table::of("scale.ends", &ends, |_| 1)
        .text_key("method", |(few, _)| few.0.method.id().into())
        .chosen("setting", TIME, "step or tolerance", |(few, _)| Some(few.0.value))
        .chosen("small", "1", "fewest masses", |(few, _)| Some(few.1 as f64))
        .chosen("large", "1", "most masses", |(_, many)| Some(many.1 as f64))
        .computed_by(origin(scale::run))
        .real("work_small", "1", 2, "evaluations per impact", |(few, _)| few.2)
        .real("work_large", "1", 2, "evaluations per impact", |(_, many)| many.2)
        .done();
    vec![table]
}

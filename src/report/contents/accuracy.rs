//! Speed against accuracy: the methods, their errors, their cost, and where they fail.

use super::{Error, chosen, from, mark};
use crate::claims::targets;
use crate::experiments::accuracy as methods;
use crate::experiments::accuracy::analytic::{Analytic, Relation, Route, Way};
use crate::experiments::accuracy::bias::{BiasRow, Biases};
use crate::experiments::accuracy::case::Verdict;
use crate::experiments::accuracy::race::{DISPLACED, Entry, Race};
use crate::experiments::accuracy::scale::{Scale, ScaleRow};
use crate::experiments::{Measured, Results};
use crate::params::{MethodName, Setting};
use crate::report::claims::sentence;
use crate::report::values::{Kind, Value, origin};
use serde::Serialize;

/// What a method is called in a table.
fn name(method: MethodName) -> &'static str {
    match method {
        MethodName::Certified => "certified",
        MethodName::Sampled => "sampled",
        MethodName::Newton => "Newton",
        MethodName::RungeKutta => "Runge–Kutta",
        MethodName::MoreauJean => "time stepping",
        MethodName::Verlet => "Verlet",
        MethodName::Penalty => "springs",
    }
}

/// A method with its step or tolerance, as Markdown.
fn titled(setting: Setting) -> String {
    let letter = if setting.method == MethodName::RungeKutta { r"\mathrm{tol}" } else { "h" };
    match setting.method {
        MethodName::Certified => name(setting.method).to_string(),
        method => format!("{}, ${letter} = {}$", name(method), power(setting.value)),
    }
}

/// 0.03 stays, 1e-9 becomes a power of ten.
fn power(value: f64) -> String {
    let text = format!("{value:e}");
    match text.split_once('e') {
        Some((mantissa, exponent)) if value < 0.01 => match mantissa {
            "1" => format!("10^{{{exponent}}}"),
            _ => format!(r"{mantissa}\times10^{{{exponent}}}"),
        },
        _ => format!("{value}"),
    }
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let race = results.race()?;
    let mut values = from(whole(race)?, origin(methods::race::run), "race");
    values.extend(from(bias(results.biases()?)?, origin(methods::bias::run), "bias"));
    values.extend(from(scale(results.scale()?)?, origin(methods::scale::run), "scale"));
    let analytic = results.analytic()?;
    let item = origin(methods::analytic::run);
    values.extend(from(theory(analytic)?, item, "analytic"));
    values.extend(from(clock(results)?, origin(Measured::parse), "measured"));
    let targets = targets::targets(results)?;
    let met = targets.iter().filter(|t| t.standing == targets::Standing::Met).count();
    values.extend(from(
        vec![Value::integer("targets_met", met), Value::integer("targets_all", targets.len())],
        origin(targets::targets),
        "",
    ));
    Ok(values)
}

/// The entries of one method, from the coarsest setting to the finest.
fn of(race: &Race, method: MethodName) -> Result<(&Entry, &Entry), Error> {
    let mut own = race.entries.iter().filter(|entry| entry.setting.method == method);
    let missing = Error::Missing("every method against the true motion");
    let first = own.next().ok_or(missing)?;
    Ok((first, own.next_back().unwrap_or(first)))
}

fn or_none(id: &str, value: Option<f64>, digits: usize) -> Value {
    value.map_or_else(|| Value::text(id, "none"), |x| Value::real(id, x, digits))
}

fn horizon(id: &str, entry: &Entry) -> Value {
    match entry.horizon {
        Some([mean, error]) => Value::ensemble(id, mean, error, entry.runs.len() as u64),
        None => Value::text(id, "none"),
    }
}

/// Figs. S12 and S13.
fn whole(race: &Race) -> Result<Vec<Value>, Error> {
    let (own, _) = of(race, MethodName::Certified)?;
    let (newton, _) = of(race, MethodName::Newton)?;
    let (sampled, _) = of(race, MethodName::Sampled)?;
    let (_, runge) = of(race, MethodName::RungeKutta)?;
    let (_, verlet) = of(race, MethodName::Verlet)?;
    let work = |entry: &Entry| entry.evaluations_per_impact;
    let faultless = |entry: &&Entry| {
        entry.setting.method != MethodName::Certified && entry.segments.misses() == 0
    };
    let cost = |entry: &&Entry| entry.evaluations_per_impact.unwrap_or(f64::INFINITY);
    let best = race.entries.iter().filter(faultless).min_by(|a, b| cost(a).total_cmp(&cost(b)));
    let best = best.ok_or(Error::Missing("a rival that misses nothing"))?;
    let error = |entry: &Entry, which: usize| entry.segments.errors.map(|errors| errors[which]);
    let growth = race.growth.growth;
    let folds = pxfm::f_log(DISPLACED / (f64::EPSILON / 2.0));
    let ceiling = growth.map(|g| (folds / g.value, folds / g.value * g.error / g.value));
    let pairs = race.growth.twins.len() as u64;
    Ok(vec![
        Value::integer("acc_masses", race.parameters.chain.masses),
        chosen("acc_sigma", race.parameters.sigma),
        Value::integer("race_chains", race.impacts.len()),
        Value::integer("race_segments", own.segments.tried),
        Value::real("displaced_limit", DISPLACED, 1),
        or_none("own_work", work(own), 2),
        Value::integer("own_misses", own.segments.misses()),
        or_none("own_error_median", error(own, 0), 1),
        or_none("own_units", own.segments.units, 2),
        horizon("own_horizon", own),
        Value::text("rival_best", titled(best.setting).replace(", $", " with $")),
        or_none("rival_best_work", work(best), 2),
        Value::integer("newton_coarse_misses", newton.segments.misses()),
        chosen("newton_coarse_step", newton.setting.value),
        horizon("sampled_coarse_horizon", sampled),
        chosen("sampled_coarse_step", sampled.setting.value),
        chosen("runge_fine_tolerance", runge.setting.value),
        or_none("runge_fine_work", work(runge), 2),
        horizon("runge_fine_horizon", runge),
        chosen("verlet_fine_step", verlet.setting.value),
        or_none("verlet_fine_work", work(verlet), 2),
        horizon("verlet_fine_horizon", verlet),
        growth.map_or_else(
            || Value::text("growth_rate", "none"),
            |g| Value::ensemble("growth_rate", g.value, g.error, pairs),
        ),
        ceiling.map_or_else(
            || Value::text("chaos_ceiling", "none"),
            |(time, error)| Value::ensemble("chaos_ceiling", time, error, pairs),
        ),
    ])
}

/// Bias and its error as shares of the mean.
fn share(row: &BiasRow) -> Option<[f64; 2]> {
    let own = row.own_mean.filter(|own| *own > 0.0)?;
    Some([row.bias? / own, row.error? / own])
}

fn bias_id(setting: usize, scene: usize) -> String {
    format!("bias.m{setting}_s{scene}")
}

/// Rows of the same setting, in the order of the σ.
fn bias_row(biases: &Biases, setting: Setting, sigma: f64) -> Option<&BiasRow> {
    biases.rows.iter().find(|row| row.setting == setting && row.sigma == sigma)
}

/// Fig. S14 and its table.
fn bias(biases: &Biases) -> Result<Vec<Value>, Error> {
    let mut values = Vec::new();
    for (j, own) in biases.certified.iter().enumerate() {
        values.push(chosen(&format!("bias.sigma{j}"), own.sigma));
        values.push(Value::real(format!("bias.mean{j}"), own.mean, 3));
        values.push(Value::integer(
            format!("bias.transient{j}"),
            biases.parameters.scenes[j].1.transient as u64,
        ));
        values.push(Value::integer(
            format!("bias.window{j}"),
            biases.parameters.scenes[j].1.window as u64,
        ));
        for (i, (setting, _)) in biases.parameters.settings.iter().enumerate() {
            let row = bias_row(biases, *setting, own.sigma);
            let id = bias_id(i, j);
            values.push(match row.and_then(|row| Some((share(row)?, row.pairs))) {
                Some(([bias, 0.0], _)) => Value::real(id, bias, 1),
                Some(([bias, error], pairs)) => Value::ensemble(id, bias, error, pairs),
                None => Value::text(id, "–"),
            });
        }
    }
    let mut values: Vec<Value> = values.into_iter().map(Value::data_only).collect();
    let at = |sigma: f64| {
        let rows = biases.rows.iter().filter(move |row| row.sigma == sigma);
        rows.filter_map(|row| Some((row, share(row)?)))
    };
    let ends = [biases.certified.first(), biases.certified.last()];
    let [Some(low), Some(high)] = ends else {
        return Err(Error::Missing("the bias of methods"));
    };
    let worst = at(low.sigma).max_by(|a, b| a.1[0].abs().total_cmp(&b.1[0].abs()));
    let Some((worst, _)) = worst else {
        return Err(Error::Missing("the bias of methods at the threshold"));
    };
    // Within one per cent, one standard error allowed for.
    let good = at(high.sigma).filter(|(_, [bias, error])| bias.abs() - error <= 0.01).count();
    let coarse = Setting { method: MethodName::Verlet, value: 0.1 };
    let coarse = |sigma: f64| at(sigma).find(|(row, _)| row.setting == coarse);
    let (Some((row, _)), Some((near, _))) = (coarse(high.sigma), coarse(low.sigma)) else {
        return Err(Error::Missing("the bias of Verlet's scheme"));
    };
    // Cells of the table.
    let of = |id: &str, row: &BiasRow| -> Result<Value, Error> {
        let setting = biases.parameters.settings.iter().position(|own| own.0 == row.setting);
        let scene = biases.certified.iter().position(|own| own.sigma == row.sigma);
        let cell = setting.zip(scene).map(|(setting, scene)| bias_id(setting, scene));
        Ok(Value::same(id, cell.ok_or(Error::Missing("the bias of methods"))?))
    };
    values.extend([
        of("coarse_far", row)?,
        of("coarse_near", near)?,
        chosen("coarse_step", row.setting.value),
        or_none("coarse_work", row.evaluations_per_impact, 2),
        chosen("bias_low", low.sigma),
        chosen("bias_high", high.sigma),
        Value::text("bias_worst", titled(worst.setting).replace(", $", " with $")),
        of("bias_worst_share", worst)?,
        Value::integer("bias_good", good),
        Value::integer("bias_settings", at(high.sigma).count()),
    ]);
    Ok(values)
}

/// Fig. S15.
fn scale(scale: &Scale) -> Result<Vec<Value>, Error> {
    let ends = |method: MethodName| -> Result<[&ScaleRow; 2], Error> {
        let mut own = scale.rows.iter().filter(|row| row.setting.method == method);
        let first = own.next().ok_or(Error::Missing("work against size"))?;
        Ok([first, own.next_back().unwrap_or(first)])
    };
    let [small, large] = ends(MethodName::Certified)?;
    let [first, last] = ends(MethodName::RungeKutta)?;
    let [_, verlet] = ends(MethodName::Verlet)?;
    Ok(vec![
        Value::integer("scale_small", small.masses),
        Value::integer("scale_large", large.masses),
        Value::real("scale_work_small", small.evaluations_per_impact, 2),
        Value::real("scale_work_large", large.evaluations_per_impact, 2),
        Value::integer("scale_rival_large", last.masses),
        Value::real("scale_runge_small", first.evaluations_per_impact, 2),
        Value::real("scale_runge_large", last.evaluations_per_impact, 2),
        Value::real("scale_verlet_large", verlet.evaluations_per_impact, 2),
        chosen("scale_verlet_step", verlet.setting.value),
    ])
}

/// Fig. S16.
fn theory(analytic: &Analytic) -> Result<Vec<Value>, Error> {
    let missing = || Error::Missing("the analytic methods");
    let printed = |own: &&Relation| matches!(own.route, Route::DoubleIntegral { .. });
    let printed = analytic.relation.iter().filter(printed).max_by_key(|own| own.evaluations);
    let printed = printed.ok_or_else(missing)?;
    let lost = printed.points.iter().rev().find(|point| point.1 >= 1.0);
    let threshold = crate::params::PRINTED_THRESHOLD;
    let near = |point: &&(f64, f64)| (point.0 - threshold).abs();
    let at = printed.points.iter().min_by(|a, b| near(a).total_cmp(&near(b)));
    let at = at.ok_or_else(missing)?;
    let way = |way: Way| {
        let own = analytic.distribution.iter().find(|own| own.way == way);
        own.and_then(|own| own.points.iter().rev().find(|point| point.error.is_some()))
    };
    let [gamma, ratios, factorials] =
        [Way::LogGamma, Way::Ratios, Way::Factorials].map(way).map(|p| p.ok_or_else(missing));
    let (gamma, ratios, factorials) = (gamma?, ratios?, factorials?);
    let (relation, products) = (
        targets::relation_error(analytic, Route::ClosedForm),
        targets::distribution_error(analytic, Way::Products),
    );
    let ends = [analytic.parameters.sigmas.first(), analytic.parameters.sigmas.last()];
    let [low, high] = ends.map(|sigma| sigma.copied().unwrap_or(0.0));
    Ok(vec![
        chosen("eq25_low", low),
        chosen("eq25_high", high),
        or_none("eq25_lost", lost.map(|point| point.0), 2),
        Value::real("eq25_near", at.0, 2),
        Value::real("eq25_near_error", at.1, 1),
        Value::integer("eq25_evaluations", printed.evaluations),
        or_none("eq25_closed", relation, 1),
        Value::integer("factorials_last", factorials.big_n),
        Value::integer("gamma_n", gamma.big_n),
        or_none("gamma_error", gamma.error, 1),
        or_none("ratios_error", ratios.error, 1),
        Value::integer("ratios_terms", ratios.terms),
        or_none("products_error", products, 1),
    ])
}

/// When and where times were measured.
fn clock(results: &Results) -> Result<Vec<Value>, Error> {
    let measured = results.measured()?;
    let values = vec![
        Value::text("measured_date", &*measured.date),
        Value::text("measured_processor", measured.machine.processor.replace("(R)", "")),
        Value::integer("measured_cores", measured.machine.cores),
        Value::text("measured_os", measured.machine.os.replace('_', "-")),
    ];
    Ok(values.into_iter().map(|value| value.kind(Kind::Measured)).collect())
}

/// A line of the table of targets.
#[derive(Debug, Serialize)]
pub struct TargetLine {
    what: &'static str,
    bound: String,
    found: String,
    standing: &'static str,
}

/// The table of targets.
pub fn target_table(results: &Results) -> Result<Vec<TargetLine>, Error> {
    let line = |target: &targets::Target| TargetLine {
        what: target.what,
        bound: sentence(&target.bound),
        found: sentence(&target.found),
        standing: target.standing.words(),
    };
    Ok(targets::targets(results)?.iter().map(line).collect())
}

/// A line of a table: a name, and a cell for each column.
#[derive(Debug, Serialize)]
pub struct Line {
    name: String,
    cells: Vec<String>,
}

/// The table of biases: a line for each setting.
pub fn bias_table(results: &Results) -> Result<Vec<Line>, Error> {
    let biases = results.biases()?;
    let cell = |i: usize, j: usize| {
        let id = bias_id(i, j);
        let style = crate::report::print::Style { percent: true, ..Default::default() };
        crate::report::mark::Mark { id, style }.write()
    };
    let line = |(i, (setting, _)): (usize, &(Setting, usize))| Line {
        name: titled(*setting),
        cells: (0..biases.certified.len()).map(|j| cell(i, j)).collect(),
    };
    Ok(biases.parameters.settings.iter().enumerate().map(line).collect())
}

/// Heads of the columns of the table of biases.
pub fn bias_heads(results: &Results) -> Result<Vec<String>, Error> {
    let value = |name: &str, j: usize| mark(format!("bias.{name}{j}"));
    let head = |j: usize| {
        let [sigma, t, w] = ["sigma", "transient", "window"].map(|name| value(name, j));
        format!(r"$\sigma =$ {sigma}, $T =$ {t}, $W =$ {w}")
    };
    Ok((0..results.biases()?.certified.len()).map(head).collect())
}

/// Last line of the table of biases: the mean by the engine.
pub fn bias_means(results: &Results) -> Result<Vec<String>, Error> {
    Ok((0..results.biases()?.certified.len()).map(|j| mark(format!("bias.mean{j}"))).collect())
}

/// Heads of the columns of the table of scenes.
pub fn scene_heads(results: &Results) -> Result<Vec<String>, Error> {
    Ok(results.trials()?.parameters.settings.iter().map(|s| titled(*s)).collect())
}

/// The table of scenes: in how many cases each method is right, and what goes wrong else.
pub fn scene_table(results: &Results) -> Result<Vec<Line>, Error> {
    let lines = results.trials()?.scenes.iter().map(|scene| Line {
        name: scene.what.clone(),
        cells: scene
            .trials
            .iter()
            .map(|trial| match trial.trouble() {
                None => "right".to_string(),
                Some(trouble) if trial.right() == 0 && trial.verdicts.len() == 1 => {
                    trouble.words().to_string()
                }
                Some(trouble) => {
                    let (right, all) = (trial.right(), trial.verdicts.len());
                    format!("{right} of {all}: {}", Verdict::words(trouble))
                }
            })
            .collect(),
    });
    Ok(lines.collect())
}

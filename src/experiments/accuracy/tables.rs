//! What the comparison of methods says.

use super::bias::{self, BiasRow, Biases};
use super::race::{self, DISPLACED, Entry, Race};
use super::scale::{self, Scale, ScaleRow};
use crate::experiments::Measured;
use crate::experiments::measured::What;
use crate::params::{MethodName, Setting};
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::Estimate;
use literate::table::Table;
use literate::value::origin;

/// What a method is called in figures and tables.
pub fn name(method: MethodName) -> &'static str {
    match method {
        MethodName::Certified => "engine",
        MethodName::Sampled => "sampling",
        MethodName::RungeKutta => "Runge–Kutta",
        MethodName::MoreauJean => "time stepping",
        MethodName::Verlet => "Verlet",
        MethodName::Penalty => "penalty springs",
    }
}

/// A method with its step or tolerance, as Markdown.
pub fn titled(setting: Setting) -> String {
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

/// The same within a sentence.
fn spoken(setting: Setting) -> String {
    titled(setting).replace(", $", " with $")
}

fn or_nan(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

/// Figs. S8 and S9.
pub fn race(race: &Race) -> Vec<Table> {
    let of = |method| race.entries.iter().filter(move |entry| entry.setting.method == method);
    let coarsest: Vec<&Entry> =
        MethodName::ALL.into_iter().filter_map(|method| of(method).next()).collect();
    let finest: Vec<&Entry> =
        MethodName::ALL.into_iter().filter_map(|method| of(method).next_back()).collect();
    vec![entries("race.coarsest", &coarsest), entries("race.finest", &finest), all(race)]
}

fn entries(name: &'static str, entries: &[&Entry]) -> Table {
    Table::of(name, entries, |entry| entry.runs.len())
        .text_key("method", |entry| entry.setting.method.id().into())
        .chosen("setting", "1/omega", "step or tolerance", |entry| Some(entry.setting.value))
        .computed_by(origin(race::run))
        .count("misses", "states from which the next impact is missed", |entry| {
            entry.segments.misses
        })
        .real("error", "1/omega", 1, "median error of its time", |entry| {
            or_nan(entry.segments.errors.map(|errors| errors[0]))
        })
        .real("units", "1", 2, "largest error over what rounding the gap does", |entry| {
            or_nan(entry.segments.units)
        })
        .real("work", "1", 2, "evaluations per impact", |entry| {
            or_nan(entry.evaluations_per_impact)
        })
        .estimate("horizon", "1/omega", "time up to which a run is true", |entry| {
            entry.horizon.map(|[mean, error]| with_error(mean, error))
        })
        .done()
}

fn all(race: &Race) -> Table {
    let cost = |entry: &&Entry| or_nan(entry.evaluations_per_impact);
    let faultless = race.entries.iter().filter(|entry| {
        entry.setting.method != MethodName::Certified && entry.segments.misses == 0
    });
    let best = faultless.min_by(|a, b| cost(a).total_cmp(&cost(b)));
    let tried = race.entries.iter().map(|entry| entry.segments.tried).max();
    // ln of a displacement over the rounding of one.
    let folds = pxfm::f_log(DISPLACED / (f64::EPSILON / 2.0));
    let growth = race.growth.growth;
    Table::of("race.all", &[()], |()| race.growth.twins.len())
        .chosen("masses", "1", "masses", |()| Some(race.parameters.chain.masses as f64))
        .chosen("sigma", "d omega^2", "standard deviation σ", |()| Some(race.parameters.sigma))
        .chosen("until", "1/omega", "the end of the runs", |()| Some(race.parameters.until))
        .chosen("displaced", "1/omega", "from here on an impact is another", |()| Some(DISPLACED))
        .computed_by(origin(race::run))
        .count("chains", "chains", |()| race.impacts.len() as u64)
        .count("states", "from which each method is asked for the next impact", |()| {
            tried.unwrap_or(0)
        })
        .estimate("growth", "omega", "rate λ at which neighbouring motions part", |()| {
            growth.map(|own| with_error(own.value, own.error))
        })
        .estimate("ceiling", "1/omega", "time that chaos allows to doubles", |()| {
            growth
                .map(|own| with_error(folds / own.value, folds / own.value * own.error / own.value))
        })
        .words("best", "the cheapest rival without a miss", |()| {
            best.map_or("none".into(), |own| spoken(own.setting))
        })
        .real("best_work", "1", 2, "its evaluations per impact", |()| {
            best.map_or(f64::NAN, |own| cost(&own))
        })
        .done()
}

/// Bias and its error as shares of the mean.
fn share(row: &BiasRow) -> Option<Estimate> {
    let own = row.own_mean.filter(|own| *own > 0.0)?;
    Some(with_error(row.bias? / own, row.error? / own))
}

/// A setting in addresses.
fn called(setting: Setting) -> String {
    format!("{}-{}", setting.method.id(), setting.value)
}

fn address(row: &BiasRow) -> String {
    format!("bias.cells[setting={},sigma={}].share", called(row.setting), row.sigma)
}

/// The bias of the mean.
pub fn bias(biases: &Biases) -> Vec<Table> {
    let order: Vec<Setting> = biases.parameters.settings.iter().map(|own| own.0).collect();
    let mut rows: Vec<&BiasRow> = biases.rows.iter().collect();
    rows.sort_by_key(|row| order.iter().position(|own| *own == row.setting));
    let cells = Table::of("bias.cells", &rows, |row| row.pairs as usize)
        .text_key("setting", |row| called(row.setting))
        .key("sigma", "d omega^2", |row| row.sigma)
        .words("name", "method with step or tolerance", |row| titled(row.setting))
        .computed_by(origin(bias::run))
        .estimate("share", "1", "bias of the mean over the mean", |row| share(row))
        .done();
    let scenes: Vec<_> = biases.certified.iter().zip(&biases.parameters.scenes).collect();
    let means = Table::of("bias.means", &scenes, |(own, _)| own.realisations as usize)
        .key("sigma", "d omega^2", |(own, _)| own.sigma)
        .chosen("transient", "1/omega", "transient", |(_, scene)| Some(scene.1.transient))
        .chosen("window", "1/omega", "window", |(_, scene)| Some(scene.1.window))
        .computed_by(origin(bias::run))
        .real("mean", "1", 3, "mean number of impacting gaps, by the engine", |(own, _)| own.mean)
        .done();
    let at = |sigma: Option<f64>| {
        let rows = biases.rows.iter().filter(move |row| Some(row.sigma) == sigma);
        rows.filter_map(|row| Some((row, share(row)?)))
    };
    let [low, high] =
        [biases.certified.first(), biases.certified.last()].map(|own| own.map(|own| own.sigma));
    // The one that is large for sure: two standard errors less.
    let surely = |own: &Estimate| own.value.abs() - 2.0 * own.error;
    let worst = at(low).max_by(|a, b| surely(&a.1).total_cmp(&surely(&b.1)));
    let verlet = Setting { method: MethodName::Verlet, value: 0.1 };
    let [near, far] = [low, high].map(|sigma| at(sigma).find(|(row, _)| row.setting == verlet));
    // Within one per cent, one standard error allowed for.
    let good = || at(high).filter(|(_, own)| own.value.abs() - own.error <= 0.01).count();
    let same = |own: Option<(&BiasRow, Estimate)>| own.map(|(row, _)| address(row));
    let ends = Table::of("bias.ends", &[()], |()| 0)
        .chosen("low", "d omega^2", "σ on the rise", |()| low)
        .chosen("high", "d omega^2", "σ far above it", |()| high)
        .chosen("step", "1/omega", "of a coarse scheme of Verlet", |()| Some(verlet.value))
        .words("worst", "the method with the largest bias on the rise", |()| {
            worst.map_or("none".into(), |(row, _)| spoken(row.setting))
        })
        .computed_by(origin(bias::run))
        .real("work", "1", 2, "evaluations per impact of that scheme", |()| {
            or_nan(far.and_then(|(row, _)| row.evaluations_per_impact))
        })
        .count("good", "settings within one per cent far above the rise", |()| good() as u64)
        .count("settings", "settings that were run there", |()| at(high).count() as u64)
        .estimate("near", "1", "bias of that scheme on the rise", |()| near.map(|own| own.1))
        .same("near", |()| same(near))
        .estimate("far", "1", "the same far above it", |()| far.map(|own| own.1))
        .same("far", |()| same(far))
        .estimate("largest", "1", "the largest bias on the rise", |()| worst.map(|own| own.1))
        .same("largest", |()| same(worst))
        .done();
    vec![cells, means, ends]
}

/// Fig. S10.
pub fn scale(scale: &Scale) -> Vec<Table> {
    let of = |method| scale.rows.iter().filter(move |row| row.setting.method == method);
    let methods = MethodName::ALL.into_iter();
    let ends: Vec<[&ScaleRow; 2]> =
        methods.filter_map(|method| Some([of(method).next()?, of(method).next_back()?])).collect();
    let table = Table::of("scale.ends", &ends, |_| 1)
        .text_key("method", |[own, _]| own.setting.method.id().into())
        .chosen("setting", "1/omega", "step or tolerance", |[own, _]| Some(own.setting.value))
        .chosen("small", "1", "fewest masses", |[own, _]| Some(own.masses as f64))
        .chosen("large", "1", "most masses", |[_, own]| Some(own.masses as f64))
        .computed_by(origin(scale::run))
        .real("work_small", "1", 2, "evaluations per impact", |ends| ends[0].evaluations_per_impact)
        .real("work_large", "1", 2, "evaluations per impact", |ends| ends[1].evaluations_per_impact)
        .done();
    vec![table]
}

/// When and where times were measured.
pub fn measured(measured: &Measured) -> Vec<Table> {
    let machine = &measured.machine;
    let table = Table::of("measured.machine", &[()], |()| 1)
        .computed_by(origin(Measured::parse))
        .words("date", "when", |()| measured.date.clone())
        .words("processor", "on what", |()| machine.processor.replace("(R)", ""))
        .words("os", "under what", |()| machine.os.replace('_', "-"))
        .count("cores", "processors", |()| u64::from(machine.cores))
        .measured();
    let time = |what| {
        let own = measured.of(what).filter(|row| row.n == 100 && row.chains == 1);
        or_nan(own.filter_map(|row| row.microseconds_per_impact).next())
    };
    let impact = Table::of("measured.impact", &[()], |()| 1)
        .computed_by(origin(Measured::parse))
        .real("engine", "us", 2, "time of an impact in the engine, one chain of 100 masses", |()| {
            time(What::Engine)
        })
        .real("ballistic", "us", 2, "the same of masses that fly freely", |()| time(What::Model))
        .measured();
    vec![table.done(), impact.done()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_read_and_addressed() {
        let of = |method, value| Setting { method, value };
        assert_eq!(titled(of(MethodName::Verlet, 0.1)), "Verlet, $h = 0.1$");
        let fine = of(MethodName::RungeKutta, 2e-9);
        assert_eq!(spoken(fine), r"Runge–Kutta with $\mathrm{tol} = 2\times10^{-9}$");
        assert_eq!(called(fine), "runge-kutta-0.000000002");
        assert_eq!(power(1e-6), "10^{-6}");
    }

    #[test]
    fn a_bias_is_a_share_of_the_mean() {
        let row = BiasRow {
            setting: Setting { method: MethodName::Verlet, value: 0.1 },
            sigma: 0.12,
            pairs: 4,
            own_mean: Some(50.0),
            bias: Some(-5.0),
            error: Some(1.0),
            evaluations_per_impact: None,
        };
        let found = share(&row).unwrap();
        assert_eq!((found.value, found.error), (-0.1, 0.02));
        assert_eq!(share(&BiasRow { own_mean: Some(0.0), ..row }), None);
    }
}

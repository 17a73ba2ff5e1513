//! What one gap that closes by itself sets off, and the mean count that follows.

use super::places::between;
use super::{Guard, Look, far, model, unless};
use crate::experiments::seeds::{Prediction, Seeds, Spread};
use crate::report::values::cell;

pub const GUARDS: &[Guard] = &[
    Guard { name: "spreading_as_counted", ids: &["spread.*", "seeds_*"], find: counted },
    Guard { name: "growth_of_seeds", ids: &["growth_mean", "growth.*"], find: grown },
    Guard { name: "seeds_by_integrals", ids: &["growth_mean"], find: closing },
    Guard {
        name: "growth_half_heights",
        ids: &["growth.*", "growth_half", "growth_half_found"],
        find: halves,
    },
    Guard { name: "growth_distances", ids: &["growth_*"], find: distances },
    Guard { name: "spreading_as_tabled", ids: &["spread.*", "seeds_*"], find: tabled },
];

fn seeds(look: Look<'_>) -> Option<&Seeds> {
    look.results.seeds().ok()
}

/// What is told of each σ follows from the counts by distance.
fn counted(look: Look<'_>) -> Option<String> {
    let seeds = seeds(look)?;
    let bins = seeds.parameters.bins;
    seeds.rows.iter().zip(&seeds.seen).find_map(|(row, seen)| {
        let share = |bin: usize, l: usize| {
            let places = seen.places[l].max(1);
            seen.reached[bin][l] as f64 / places as f64
        };
        let distances = || (1..seen.places.len()).rev();
        let advance = |bin: usize| distances().map(|l| share(bin, l)).sum::<f64>();
        let square: f64 = distances().map(|l| (l * l) as f64 * share(bins, l)).sum();
        let runs = row.spreads.len() as f64;
        let total = row.spreads.iter().sum::<u64>() as f64;
        // A ratio of both ends on logarithmic axes.
        let ratio = advance(bins) / advance(bins / 4);
        let steps = bins as f64 / (bins / 4) as f64;
        far("a radius", row.radius * row.radius * advance(bins), square)
            .or_else(|| (0..=bins).find_map(|b| far("an advance", row.advance[b], advance(b))))
            .or_else(|| far("an exponent", pxfm::f_pow(steps, row.exponent), ratio))
            .or_else(|| far("gaps reached", total, seen.reached[bins].iter().sum::<u64>() as f64))
            .or_else(|| far("gaps reached by a run", row.spread?.value, total / runs))
            .or_else(|| far("survivors", row.survival * runs, *seen.alive.last()? as f64))
            .or_else(|| far("runs", row.seeds as f64, seen.places[0] as f64))
            .or_else(|| far("runs", runs, seen.places[0] as f64))
    })
}

/// The mean count again, gap by gap and seed by seed, with products as sums of logarithms.
fn grown(look: Look<'_>) -> Option<String> {
    let seeds = seeds(look)?;
    let gaps = seeds.parameters.chain.gaps();
    let (bin, window) = (seeds.parameters.bin, seeds.parameters.window);
    seeds.predictions.iter().find_map(|own| {
        let transient = (own.transient / bin).round() as usize;
        let rows = seeds.seen.iter().zip(&seeds.closing).zip(&own.means);
        rows.map(|((seen, closing), mean)| {
            // ln(1 − what a gap sends) by distance; those of the bins are weighed by half at both ends.
            let logs = closing.each_ref().map(|closing| -> Vec<f64> {
                let mut sends = vec![0.0; gaps];
                for (bin, chance) in closing.iter().enumerate().take(transient + window) {
                    for since in [bin, bin + 1] {
                        let hit = match transient.checked_sub(since) {
                            Some(later) => &seen.active[later],
                            None => &seen.reached[transient + window - since],
                        };
                        sends.iter_mut().zip(hit).for_each(|(sum, n)| *sum += chance * *n as f64);
                    }
                }
                let places = seen.places.iter().map(|n| 2.0 * (*n).max(1) as f64);
                sends.iter().zip(places).map(|(sum, n)| pxfm::f_log1p(-sum / n)).collect()
            });
            // Sums over the gaps up to a distance, were all of them between masses.
            let mut up_to = logs[1].clone();
            (1..gaps).for_each(|l| up_to[l] += up_to[l - 1]);
            let silent = |x: usize| {
                let (left, right) = (x, gaps - 1 - x);
                let walls = [left, right].map(|l| logs[0][l] - logs[1][l]);
                pxfm::f_exp(up_to[left] + up_to[right] - logs[1][0] + walls[0] + walls[1])
            };
            (mean.value, gaps as f64 - (0..gaps).map(silent).sum::<f64>())
        })
        .find_map(|(mean, again)| far("a predicted mean", mean, again))
    })
}

/// The chances of gaps to close within bins add up to those within times that were computed for single
/// gaps, and to no more than those in unlimited time.
fn closing(look: Look<'_>) -> Option<String> {
    let seeds = seeds(look)?;
    let found = look.results.nucleation().ok()?;
    seeds.rows.iter().zip(&seeds.closing).find_map(|(row, [wall, inner])| {
        let all: f64 = inner.iter().sum();
        let most = model::p_rest(row.sigma);
        // By then hardly any is missing.
        let beyond = unless((0.99 * most..=most * (1.0 + super::ROUNDING)).contains(&all), || {
            format!("{all} of the gaps close at {}, and {most} in unlimited time", row.sigma)
        });
        let at = || {
            let gaps = found.gaps.iter().find(|gaps| gaps.sigma == row.sigma)?;
            let times = found.parameters.times.iter().zip(&gaps.within);
            times.clone().find_map(|(time, chances)| {
                let bins = time / seeds.parameters.bin;
                if bins.fract() != 0.0 || bins as usize > inner.len() {
                    return None;
                }
                let sum = |own: &[f64]| own.iter().take(bins as usize).sum::<f64>();
                far("closing gaps", sum(inner), chances.p)
                    .or_else(|| far("closing wall gaps", sum(wall), chances.wall))
            })
        };
        beyond.or_else(at)
    })
}

fn id(own: &Prediction, name: &str) -> String {
    format!("growth.t{}_{name}", own.transient as u64)
}

/// Where the predicted means pass half of all gaps, and where the simulated ones did.
fn halves(look: Look<'_>) -> Option<String> {
    let seeds = seeds(look)?;
    let half = 0.5 * seeds.parameters.chain.gaps() as f64;
    let sweep = look.results.sweep().ok()?;
    let protocol = sweep.parameters.protocol;
    seeds.predictions.iter().find_map(|own| {
        let points: Vec<_> =
            seeds.rows.iter().zip(&own.means).map(|(row, mean)| (row.sigma, mean.value)).collect();
        let at = |sigma: f64| between(&points, sigma);
        let cell = look.results.protocol().ok()?.cell(own.transient, own.window);
        let of_report = own.transient == protocol.transient && own.window == protocol.window;
        let told = || match at(own.half_height?.value) {
            Some(mean) => far("the mean at half height", mean, half),
            None => Some(format!("no mean at half height {}", own.half_height?.value)),
        };
        let found = || look.is(&id(own, "found"), cell?.half_height_all?.value);
        let text = || {
            if !of_report {
                return None;
            }
            look.is("growth_half", look.number(&id(own, "predicted"))?)
                .or_else(|| look.is("growth_half_found", sweep.rise.half_height_all?.value))
                .or_else(|| {
                    let ahead = sweep.rise.half_height_all?.value - own.half_height?.value;
                    look.is("growth_early", ahead)
                })
        };
        told()
            .or_else(|| look.is(&id(own, "transient"), own.transient))
            .or_else(|| look.is(&id(own, "predicted"), own.half_height?.value))
            .or_else(found)
            .or_else(text)
    })
}

/// The largest distance from the simulation, by the histograms of the main sweep, and means of circuits by other sums.
fn distances(look: Look<'_>) -> Option<String> {
    let seeds = seeds(look)?;
    let sweep = look.results.sweep().ok()?;
    let protocol = sweep.parameters.protocol;
    let own = seeds
        .predictions
        .iter()
        .find(|own| own.transient == protocol.transient && own.window == protocol.window)?;
    let big_n = seeds.parameters.chain.gaps();
    let r = look.published.parameter("restitution").ok()?;
    let sigma = look.number("growth_sigma")?;
    if !seeds.rows.iter().any(|row| row.sigma == sigma) {
        return Some(format!("no seeds at sigma = {sigma}"));
    }
    let hot = |sigma: f64| model::p_heated(sigma, 2.0 * (1.0 + r) / (1.0 - r));
    let mut worst = (0.0_f64, 0.0);
    for (row, mean) in seeds.rows.iter().zip(&own.means) {
        let Some(ran) = sweep.rows.iter().find(|other| other.sigma == row.sigma) else { continue };
        let all: f64 = ran.counts.iter().map(|&c| f64::from(c)).sum();
        let sum: f64 = (0_u32..).zip(&ran.counts).map(|(k, &c)| f64::from(k) * f64::from(c)).sum();
        let graph = |p: f64| model::Law::new(big_n, p, false).mean();
        let probabilities = [model::p(row.sigma), model::p_rest(row.sigma), hot(row.sigma)];
        let graphs = probabilities.map(graph);
        let off = graphs.iter().zip(row.graph).find_map(|(a, b)| far("a mean of circuits", b, *a));
        if off.is_some() {
            return off;
        }
        let distance = (mean.value - sum / all).abs();
        if distance > worst.0 {
            worst = (distance, row.sigma);
        }
        if sigma == row.sigma {
            let told = look.is("growth_mean", mean.value);
            let told = told.or_else(|| look.is("growth_mean_found", sum / all));
            if told.is_some() {
                return told;
            }
        }
    }
    look.are([("growth_worst", worst.0), ("growth_worst_sigma", worst.1)])
}

/// The text and the table say what the results do.
fn tabled(look: Look<'_>) -> Option<String> {
    let seeds = seeds(look)?;
    let (first, last) = (seeds.rows.first()?, seeds.rows.last()?);
    let least = seeds.rows.iter().map(|row| row.survival).fold(1.0, f64::min);
    let until = seeds.parameters.bin * seeds.parameters.bins as f64;
    let line = |row: &Spread| {
        let id = |name: &str| cell("spread", row.sigma, name);
        look.is(&id("sigma"), row.sigma)
            .or_else(|| look.is(&id("spread"), row.spread?.value))
            .or_else(|| look.is(&id("active"), row.course.last()?.active?.value))
            .or_else(|| look.is(&id("exponent"), row.exponent))
            .or_else(|| look.is(&id("radius"), row.radius))
    };
    let each = |row: &Spread| look.is("seeds_each", (row.seeds + row.late + row.failed) as f64);
    look.are([
        ("seeds_sigma_count", seeds.seen.len() as f64),
        ("seeds_sigma_low", first.sigma),
        ("seeds_sigma_high", last.sigma),
        ("seeds_until", until),
        ("seeds_survival", least),
        ("seeds_exponent_low", first.exponent),
        ("seeds_exponent_high", last.exponent),
    ])
    .or_else(|| seeds.rows.iter().find_map(line))
    .or_else(|| seeds.rows.iter().find_map(each))
}

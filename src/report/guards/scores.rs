//! Every relation of p and σ against the simulation.

use super::places::between;
use super::{Guard, Look, far, model};
use crate::experiments::seeds::Prediction;

pub const GUARDS: &[Guard] = &[
    Guard { name: "means_of_the_map", ids: &["scores.*"], find: means },
    Guard { name: "scores_of_relations", ids: &["scores.*", "scores_*"], find: scores },
];

/// Half heights of the map are where its means pass half of all gaps.
fn means(look: Look<'_>) -> Option<String> {
    let map = look.results.protocol().ok()?;
    let half = 0.5 * map.parameters.chain.gaps() as f64;
    map.cells.iter().find_map(|cell| {
        let sigma = cell.half_height_all?.value;
        match between(&map.curve(cell.transient, cell.window)?, sigma) {
            Some(mean) => far("the mean at half height", mean, half),
            None => Some(format!("no mean at half height {sigma}")),
        }
    })
}

/// Each distance by means that were computed another way.
fn scores(look: Look<'_>) -> Option<String> {
    let seeds = look.results.seeds().ok()?;
    let map = look.results.protocol().ok()?;
    let big_n = seeds.parameters.chain.gaps();
    let r = look.published.parameter("restitution").ok()?;
    let graph = |p: f64| model::Law::new(big_n, p, false).mean();
    let fixed = |sigma: f64| {
        let hot = model::p_heated(sigma, 2.0 * (1.0 + r) / (1.0 - r));
        [model::p(sigma), model::p_rest(sigma), hot].map(graph)
    };
    // Runs that are cut short at large σ lack the windows of the longest transients alone.
    let longest = seeds.predictions.iter().rev();
    let longest = longest.filter_map(|own| map.curve(own.transient, own.window)).next()?;
    let line = |own: &Prediction| {
        let curve = map.curve(own.transient, own.window)?;
        let bins = ((own.transient + own.window) / seeds.parameters.bin).round() as usize;
        let (mut squares, mut sigmas) = ([0.0; 5], Vec::new());
        for (i, row) in seeds.rows.iter().enumerate() {
            let sigma = &row.sigma;
            let Some((_, mean)) = curve.iter().find(|(own, _)| own == sigma) else { continue };
            if !longest.iter().any(|(own, _)| own == sigma) {
                continue;
            }
            let by_then: f64 = seeds.closing[i][1][..bins].iter().rev().sum();
            let [p, rest, hot] = fixed(*sigma);
            let own = [p, rest, graph(by_then), hot, own.means[i].value];
            own.iter().zip(&mut squares).for_each(|(own, sum)| *sum += (own - mean) * (own - mean));
            sigmas.push(*sigma);
        }
        let id = |name: &str| format!("scores.t{}_{name}", own.transient as u64);
        let number = sigmas.len() as f64;
        let columns = ["p", "rest", "within", "balanced", "grown"].iter().zip(squares);
        look.is(&id("transient"), own.transient)
            .or_else(|| look.is("scores_compared", number))
            .or_else(|| look.is("scores_low", *sigmas.first()?))
            .or_else(|| look.is("scores_high", *sigmas.last()?))
            .or_else(|| {
                let is = |(name, sum): (&&str, f64)| look.is(&id(name), (sum / number).sqrt());
                columns.clone().find_map(is)
            })
    };
    seeds.predictions.iter().find_map(line)
}

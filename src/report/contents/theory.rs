//! Sections 3 to 8: graph, counting, distribution, jump, relation.

use super::simulation::{mean_all, mean_kept, ran, row};
use super::{Error, chosen, from, share};
use crate::claims::{sec5, sec6, sec8};
use crate::experiments::Results;
use crate::experiments::theory::{MeanRow, Theory};
use crate::params::PRINTED_THRESHOLD;
use crate::report::values::Value;
use std::collections::BTreeSet;

/// Where the text compares theory and simulation within the rise.
const BETWEEN: f64 = 0.13;
/// Where it compares the kept share with its estimate, beside the printed threshold.
const KEPT: f64 = 0.1;

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let theory = &results.theory;
    let mut values = from(graph(results)?, "circuits::graph", "theory");
    values.extend(from(counting(results), "circuits::counting", "theory"));
    values.extend(from(distribution(theory), "circuits::distribution", "theory"));
    values.extend(from(jump(results), "circuits::jump", "theory"));
    values.extend(from(relation(results)?, "circuits::impact_probability", "theory"));
    values.extend(from(simulated(results)?, "claims::sec8", "sweep"));
    Ok(values)
}

fn graph(results: &Results) -> Result<Vec<Value>, Error> {
    let id = &results.identities;
    let segments = results.segments()?;
    let five = segments.fig05.impacts.iter().map(|impact| impact.gap);
    let six: BTreeSet<usize> = segments.fig06.impacts.iter().map(|impact| impact.gap).collect();
    Ok(vec![
        Value::integer("graph_vertices", id.graph_vertices),
        Value::integer("graph_edges", id.graph_edges),
        Value::integer("fig5_masses", sec5::masses_in(five, segments.fig05.masses)),
        Value::integer("fig6_length", segments.fig06.circuit().len()),
        Value::integer("fig6_distinct", six.len()),
    ])
}

fn counting(results: &Results) -> Vec<Value> {
    let (theory, id) = (&results.theory, &results.identities);
    let slips = &theory.slips;
    vec![
        Value::real("eq8_ratio", slips.ratio_before_last, 4),
        Value::integer("eq8_exceptions", id.eq8_exceptions.len()),
        Value::integer("fig7_peak", slips.longest_peak),
        Value::integer("fig7_from", theory.vertices - 3),
        Value::real("fig7_share", slips.share_near_end, 2),
    ]
}

/// The p at which μ passes `level`, linear between rows.
fn crossing(rows: &[MeanRow], level: f64) -> Option<f64> {
    let w = rows.windows(2).find(|w| w[0].mean < level && level <= w[1].mean)?;
    Some(w[0].p + (w[1].p - w[0].p) * (level - w[0].mean) / (w[1].mean - w[0].mean))
}

fn distribution(theory: &Theory) -> Vec<Value> {
    let n = theory.vertices as f64;
    let [largest, second] = sec6::two_largest_steps(&theory.most_likely.steps);
    let crossing = |level: f64| {
        let rows = [&theory.most_likely.mean_inset, &theory.most_likely.mean];
        rows.into_iter().find_map(|rows| crossing(rows, level)).unwrap_or(1.0)
    };
    let mut values: Vec<Value> = ["a", "b", "c", "d"]
        .into_iter()
        .zip(&theory.distributions)
        .map(|(panel, found)| Value::real(format!("mu_fig8_{panel}"), found.mean, 3))
        .collect();
    values.extend([
        Value::integer("fig9_large_step", largest),
        Value::integer("fig9_other_steps", second),
        Value::real("mu_zero", theory.slips.mean_at_zero, 1),
        Value::real("p_tenth", crossing(0.1 * n), 3),
        Value::real("p_nine_tenths", crossing(0.9 * n), 2),
    ]);
    values
}

fn jump(results: &Results) -> Vec<Value> {
    let (theory, id) = (&results.theory, &results.identities);
    let (scalars, slips) = (&theory.scalars, &theory.slips);
    let first = &slips.first_local_maximum;
    vec![
        Value::real("p_crit", scalars.p_crit, 5).source("circuits::jump::p_crit", "theory"),
        Value::real("p_crit_walls", theory.scalars_walls.p_crit, 5)
            .source("circuits::jump::p_crit", "theory"),
        Value::real("p_jump", scalars.p_jump, 5).source("circuits::jump::p_jump", "theory"),
        Value::integer("k_before_jump", id.k_star_before_jump[1]),
        Value::integer("k_after_jump", scalars.k_after_jump),
        Value::real("k_touch", id.k_touch, 4),
        Value::integer("first_maximum_numerator", first.numerator),
        Value::integer("first_maximum_denominator", first.denominator),
        Value::real("first_maximum_p", first.p, 5),
        Value::integer("first_maximum_k", first.k),
        Value::integer("first_maximum_k_next", first.k + 1),
        Value::real("jump_after_crit", scalars.p_jump / scalars.p_crit - 1.0, 2),
        Value::integer("k_star_at_one", slips.k_star_at_one),
    ]
}

fn relation(results: &Results) -> Result<Vec<Value>, Error> {
    let (theory, id) = (&results.theory, &results.identities);
    let scalars = &theory.scalars;
    let at = |sigma: f64| {
        let found = id.nucleation.iter().find(|found| found.sigma == sigma);
        found.ok_or(Error::Missing("the printed threshold among the values of sigma"))
    };
    let (threshold, kept) = (at(PRINTED_THRESHOLD)?, at(KEPT)?);
    let gaps = crate::params::Chain::default().gaps() as f64;
    Ok(vec![
        Value::real("sigma_jump", scalars.sigma_jump, 4),
        Value::real("sigma_jump_walls", theory.scalars_walls.sigma_jump, 4),
        Value::real("sigma_jump_rest", scalars.sigma_jump_rest, 4),
        Value::real("sigma_half_theory", scalars.sigma_half, 4),
        Value::real("sigma_half_rest", scalars.sigma_half_rest, 4),
        Value::real("eq25_difference", id.eq25, 1),
        Value::real("p_012", threshold.p, 3)
            .source("circuits::impact_probability::ImpactProbability::p", "theory"),
        Value::real("p_015", theory.slips.p_at_015, 3)
            .source("circuits::impact_probability::ImpactProbability::p", "theory"),
        Value::real("p_rest_012", threshold.p_rest, 3),
        Value::real("p_rest_ratio", threshold.p_rest / threshold.p, 2),
        Value::real("self_closing", gaps * threshold.p_rest, 2),
        chosen("sigma_kept_a", threshold.sigma),
        chosen("sigma_kept_b", kept.sigma),
        Value::real("kept_predicted_a", threshold.any_rest, 3),
        Value::real("kept_predicted_b", kept.any_rest, 3),
        Value::real("kept_half_predicted", id.sigma_kept_half, 3),
        Value::real("kept_onset_predicted", id.sigma_kept_onset, 3),
        chosen("overlap_sigma", id.overlap_sigma),
        Value::real("overlap_share", id.overlap_share, 2),
    ])
}

/// Theory beside simulation.
fn simulated(results: &Results) -> Result<Vec<Value>, Error> {
    let (sweep, theory) = (results.sweep()?, &results.theory);
    let (a, b) = (row(sweep, PRINTED_THRESHOLD)?, row(sweep, KEPT)?);
    let between = row(sweep, BETWEEN)?;
    let predicted = sec8::at(&theory.curve, between.sigma, |r| r.simple)
        .ok_or(Error::Missing("the theory within the rise"))?;
    let largest = sec8::largest_distance(sweep, &theory.curve);
    let [increase, _, _] =
        sec8::increases(sweep, |row| row.mean_all).ok_or(Error::Missing("rows of the rise"))?;
    let inside = sweep.rise.tenth.zip(sweep.rise.nine_tenths).map_or(0, |(low, high)| {
        let within = |sigma: f64| low.value <= sigma && sigma <= high.value;
        sweep.rows.iter().filter(|r| within(r.sigma)).count()
    });
    let half = sweep.rise.half_height.map(|half| theory.scalars.sigma_half - half.value);
    Ok(vec![
        share("kept_a", a.kept, ran(a)),
        share("kept_b", b.kept, ran(b)),
        mean_all("mean_all_threshold", a),
        chosen("sigma_between", between.sigma),
        mean_kept("mean_between", between),
        Value::real("theory_between", predicted, 2),
        chosen("large_sigma", sec8::LARGE_SIGMA),
        largest.map_or(Value::text("large_distance", "none"), |[distance, _]| {
            Value::real("large_distance", distance, 2)
        }),
        Value::real("largest_increase", increase, 2),
        Value::integer("rise_rows", inside),
        half.map_or(Value::text("sigma_gap", "none"), |gap| Value::real("sigma_gap", gap, 2)),
    ])
}

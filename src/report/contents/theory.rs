//! Sections 3 to 8: graph, counting, distribution, jump, relation.

use super::{Error, chosen, from};
use crate::circuits::distribution::Law;
use crate::circuits::graph::Graph;
use crate::circuits::impact_probability::ImpactProbability;
use crate::circuits::{counting, jump};
use crate::claims::{sec5, sec6, sec8};
use crate::experiments::theory::jump::scalars;
use crate::experiments::theory::{MeanRow, Theory};
use crate::experiments::{Results, identities, rise, segments, theory};
use crate::params::PRINTED_THRESHOLD;
use crate::report::values::{Value, origin};
use std::collections::BTreeSet;

/// Where the text compares theory and simulation within the rise.
pub(super) const BETWEEN: f64 = 0.13;
/// Where it compares the kept share with its estimate, beside the printed threshold.
const KEPT: f64 = 0.1;

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let theory = &results.theory;
    let mut values = from(graph(results)?, origin(segments::Segment::circuit), "segments");
    values.extend(from(counted(results), origin(counting::shares), "theory"));
    values.extend(from(distribution(theory), origin(Law::mean), "theory"));
    values.extend(from(jumping(results), origin(jump::p_jump), "theory"));
    values.extend(from(relation(results)?, origin(scalars), "theory"));
    values.extend(from(simulated(results)?, origin(sec8::largest_distance), "sweep"));
    Ok(values)
}

fn graph(results: &Results) -> Result<Vec<Value>, Error> {
    let id = &results.identities;
    let segments = results.segments()?;
    let six: BTreeSet<usize> = segments.fig06.impacts.iter().map(|impact| impact.gap).collect();
    Ok(vec![
        Value::integer("graph_vertices", id.graph_vertices)
            .source(origin(Graph::vertices), "theory"),
        Value::integer("graph_edges", id.graph_edges).source(origin(identities::run), "theory"),
        Value::integer("fig5_masses", sec5::masses_of(&segments.fig05))
            .source(origin(sec5::masses_of), "segments"),
        Value::integer("fig6_length", segments.fig06.circuit().len()),
        Value::integer("fig6_distinct", six.len()),
    ])
}

fn counted(results: &Results) -> Vec<Value> {
    let (theory, id) = (&results.theory, &results.identities);
    let slips = &theory.slips;
    vec![
        Value::real("eq8_ratio", slips.ratio_before_last, 4)
            .source(origin(counting::ratio_to_longest), "theory"),
        Value::integer("eq8_exceptions", id.eq8_exceptions.len())
            .source(origin(counting::ratio_to_longest), "theory"),
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
    let p_at = |level: f64| {
        let rows = [&theory.most_likely.mean_inset, &theory.most_likely.mean];
        rows.into_iter().find_map(|rows| crossing(rows, level)).unwrap_or(1.0)
    };
    let mut values: Vec<Value> = ["a", "b", "c", "d"]
        .into_iter()
        .zip(&theory.distributions)
        .map(|(panel, found)| Value::real(format!("mu_fig8_{panel}"), found.mean, 3))
        .collect();
    values.extend([
        Value::integer("fig9_large_step", largest)
            .source(origin(sec6::two_largest_steps), "theory"),
        Value::integer("fig9_other_steps", second)
            .source(origin(sec6::two_largest_steps), "theory"),
        Value::real("mu_zero", theory.slips.mean_at_zero, 1),
        Value::real("p_tenth", p_at(0.1 * n), 3).source(origin(crossing), "theory"),
        Value::real("p_nine_tenths", p_at(0.9 * n), 2).source(origin(crossing), "theory"),
    ]);
    values
}

fn jumping(results: &Results) -> Vec<Value> {
    let (theory, id) = (&results.theory, &results.identities);
    let (scalars, slips) = (&theory.scalars, &theory.slips);
    let first = &slips.first_local_maximum;
    vec![
        Value::real("p_crit", scalars.p_crit, 5).source(origin(jump::p_crit), "theory"),
        Value::real("p_crit_walls", theory.scalars_walls.p_crit, 5)
            .source(origin(jump::p_crit), "theory"),
        Value::real("p_jump", scalars.p_jump, 5),
        Value::integer("k_before_jump", id.k_star_before_jump[1])
            .source(origin(Law::k_star), "theory"),
        Value::integer("k_after_jump", scalars.k_after_jump),
        Value::real("k_touch", id.k_touch, 4).source(origin(identities::run), "theory"),
        Value::integer("first_maximum_numerator", first.numerator)
            .source(origin(jump::first_local_maximum), "theory"),
        Value::integer("first_maximum_denominator", first.denominator)
            .source(origin(jump::first_local_maximum), "theory"),
        Value::real("first_maximum_p", first.p, 5)
            .source(origin(jump::first_local_maximum), "theory"),
        Value::integer("first_maximum_k", first.k)
            .source(origin(jump::first_local_maximum), "theory"),
        Value::integer("first_maximum_k_next", first.k + 1)
            .source(origin(jump::first_local_maximum), "theory"),
        Value::real("jump_after_crit", scalars.p_jump / scalars.p_crit - 1.0, 2),
        Value::integer("k_star_at_one", slips.k_star_at_one).source(origin(Law::k_star), "theory"),
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
        Value::real("eq25_difference", id.eq25, 1)
            .source(origin(identities::relation::eq25), "theory"),
        Value::real("p_012", threshold.p, 3).source(origin(ImpactProbability::p), "theory"),
        Value::real("p_015", theory.slips.p_at_015, 3)
            .source(origin(ImpactProbability::p), "theory"),
        Value::real("p_rest_012", threshold.p_rest, 3)
            .source(origin(ImpactProbability::p_from_rest), "theory"),
        Value::real("p_rest_ratio", threshold.p_rest / threshold.p, 2)
            .source(origin(ImpactProbability::p_from_rest), "theory"),
        Value::real("self_closing", gaps * threshold.p_rest, 2)
            .source(origin(ImpactProbability::p_from_rest), "theory"),
        Value::real("kept_predicted_a", threshold.any_rest, 3)
            .source(origin(identities::relation::any), "theory"),
        Value::real("kept_predicted_b", kept.any_rest, 3)
            .source(origin(identities::relation::any), "theory"),
        Value::real("kept_half_predicted", id.sigma_kept_half, 3)
            .source(origin(identities::relation::sigma_kept), "theory"),
        Value::real("kept_onset_predicted", id.sigma_kept_onset, 3)
            .source(origin(identities::relation::sigma_kept), "theory"),
        chosen("overlap_sigma", id.overlap_sigma),
        Value::real("overlap_share", id.overlap_share, 2)
            .source(origin(identities::relation::overlap), "theory"),
    ])
}

/// Theory beside simulation.
fn simulated(results: &Results) -> Result<Vec<Value>, Error> {
    let (sweep, theory) = (results.sweep()?, &results.theory);
    let predicted = sec8::at(&theory.curve, BETWEEN, |r| r.simple)
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
        Value::real("theory_between", predicted, 3).source(origin(theory::curves::curve), "theory"),
        chosen("large_sigma", sec8::LARGE_SIGMA),
        largest.map_or(Value::text("large_distance", "none"), |[distance, _]| {
            Value::real("large_distance", distance, 2)
        }),
        Value::real("largest_increase", increase, 2).source(origin(sec8::increases), "sweep"),
        Value::integer("rise_rows", inside).source(origin(rise::find), "sweep"),
        half.map_or(Value::text("sigma_gap", "none"), |gap| {
            Value::real("sigma_gap", gap, 2).source(origin(rise::find), "sweep")
        }),
    ])
}

//! Section 11: one long run in space and time.

use super::{Error, chosen, count, from};
use crate::experiments::{Results, spacetime};
use crate::figures::Scene;
use crate::report::values::{Value, origin};

/// How many of the most active gaps the text speaks of.
const BUSIEST: usize = 10;

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let run = results.spacetime()?;
    let parameters = &run.parameters;
    let until = parameters.until;
    let firsts = run.firsts();
    let first = firsts.iter().flatten().copied().reduce(f64::min);
    let Some((first, (silent_gap, silent_from, silent_to))) = first.zip(run.longest_silence())
    else {
        return Err(Error::Missing("a long run with impacts"));
    };
    let advances = run.advances();
    let (Some(middle), Some(last)) = (advances.get(advances.len() / 2), advances.last()) else {
        return Err(Error::Missing("a long run with fronts that move"));
    };
    let share = run.reached() as f64 / run.width() as f64;
    let time = |id: &str, t: f64| Value::real(id, t, 3);
    let values = vec![
        chosen("run_sigma", parameters.sigma),
        Value::integer("run_until", until as u64),
        Value::integer("run_last", parameters.last as u64),
        Value::integer("run_passed_over", run.realisation),
        count("run_impacts", run.times.len() as u64),
        Value::integer("run_reached", run.reached()),
        Value::real("run_reached_share", share, 2),
        Value::integer("run_reached_quarter", run.reached_by(until / 4.0)),
        Value::integer("run_reached_half", run.reached_by(until / 2.0)),
        Value::integer("run_quarter", (until / 4.0) as u64),
        Value::integer("run_half", (until / 2.0) as u64),
        Value::integer("run_starts", run.starts().len()),
        time("run_first", first),
        time("run_advance_median", middle.delay),
        time("run_advance_longest", last.delay),
        Value::integer("run_advance_gap", last.gap),
        time("run_advance_time", last.time),
        Value::integer("run_silent_gap", silent_gap),
        time("run_silence", silent_to - silent_from),
        time("run_silence_end", silent_to),
        Value::integer("run_busiest", BUSIEST),
        Value::real("run_busiest_share", run.share_of_busiest(BUSIEST), 2),
    ];
    let Some(scene) = Scene::of(run) else {
        return Err(Error::Missing("a scene of the long run"));
    };
    let mut all = from(values, origin(spacetime::run), "space-time");
    all.extend(from(moving(&scene), origin(Scene::of), "space-time"));
    Ok(all)
}

/// What the caption of the moving masses says.
fn moving(scene: &Scene) -> Vec<Value> {
    let ([first, last], [left, right]) = (scene.masses(), scene.halves());
    let until = scene.until.floor() as u64;
    vec![
        Value::integer("scene_masses", last + 1 - first),
        Value::integer("scene_first", first),
        Value::integer("scene_last", last),
        Value::integer("scene_from", scene.from as u64),
        Value::integer("scene_until", until),
        Value::integer("scene_length", until.saturating_sub(scene.from as u64)),
        Value::integer("scene_left", left),
        Value::integer("scene_right", right),
        Value::integer("scene_impacts", scene.impacts.len()),
    ]
}

//! From one gap to many: what becomes of one seed in time, how its fronts advance, and which gaps hold them.

use super::growth::{Line, SIGMA, tabled};
use super::{Error, count, estimate, from, mark, share};
use crate::experiments::seeds::{Fronts, Moment, Seeds, Spread, Waits, fronts};
use crate::experiments::{Results, seeds};
use crate::report::values::{Value, cell, origin};

/// Gaps to each side in the example of the text: half of a chain of 600 masses.
const FAR: u32 = 300;

const COURSE: [&str; 5] = ["until", "reached", "active", "alive", "radius"];

const SPEEDS: [&str; 5] = ["sigma", "speed", "bursts", "even", "standing"];

const OBSTACLES: [&str; 7] =
    ["sigma", "stands_a", "stands_b", "stands_c", "between", "memory", "dispersion"];

/// The chances of the text that an obstacle holds, by the parts of its width that it crosses.
const HOLDS: [&str; fronts::PARTS] =
    ["fronts_holds_a", "fronts_holds_b", "fronts_holds_c", "fronts_holds_d"];

pub(super) fn moment_id(own: &Moment, column: &str) -> String {
    format!("course.t{}_{column}", own.until as u64)
}

fn front_id(own: &Fronts, column: &str) -> String {
    cell("fronts", own.sigma, column)
}

/// What one seed at the rise sets off.
fn at_rise(seeds: &Seeds) -> Result<(&Spread, &Fronts), Error> {
    let mut rows = seeds.rows.iter().zip(&seeds.fronts);
    rows.find(|(row, _)| row.sigma == SIGMA).ok_or(Error::Missing("seeds at the rise"))
}

/// The fronts of the rows of the tables.
fn rows(seeds: &Seeds) -> impl Iterator<Item = &Fronts> {
    tabled(seeds).filter_map(|row| seeds.fronts.iter().find(|own| own.sigma == row.sigma))
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let seeds = results.seeds()?;
    let mut values = course(seeds)?;
    values.extend(advances(seeds)?);
    Ok(from(values, origin(seeds::fronts::fronts), "seeds"))
}

/// The table of one σ, and the share of what was reached that is active at the end, at both ends of the range.
fn course(seeds: &Seeds) -> Result<Vec<Value>, Error> {
    let (row, _) = at_rise(seeds)?;
    let runs = row.spreads.len();
    let mut values = Vec::new();
    for own in &row.course {
        values.extend([
            Value::integer(moment_id(own, "until"), own.until as u64),
            estimate(moment_id(own, "reached"), own.reached, runs),
            estimate(moment_id(own, "active"), own.active, runs),
            share(moment_id(own, "alive"), own.alive as usize, runs),
            Value::real(moment_id(own, "radius"), own.radius, 2),
        ]);
    }
    for (id, row) in
        [("seeds_active_low", seeds.rows.first()), ("seeds_active_high", seeds.rows.last())]
    {
        let own = row.and_then(|row| row.course.last()).ok_or(Error::Missing("seeds"))?;
        let both = own.active.zip(own.reached).ok_or(Error::Missing("seeds"))?;
        values.push(Value::real(id, both.0.value / both.1.value, 2));
    }
    let item = origin(seeds::course::course);
    Ok(values.into_iter().map(|value| value.source(item.clone(), "seeds")).collect())
}

fn advances(seeds: &Seeds) -> Result<Vec<Value>, Error> {
    let parameters = &seeds.parameters;
    let n = parameters.realisations;
    let all = |of: fn(&Waits) -> u64| seeds.waits.iter().map(of).sum();
    let mut values = vec![
        count("fronts_number", all(|own| own.fronts)),
        count("fronts_steps", all(|own| own.ended.iter().sum())),
        Value::integer("fronts_hold", (parameters.bin * parameters.window as f64) as u64),
        Value::real("fronts_beat", fronts::beat(&parameters.chain), 3),
    ];
    for own in rows(seeds) {
        let id = |column: &str| front_id(own, column);
        let [a, b, c] = own.stands;
        values.extend([
            super::chosen(&id("sigma"), own.sigma),
            estimate(id("speed"), own.speed, n),
            estimate(id("bursts"), own.bursts, n),
            Value::real(id("even"), own.even, 2),
            estimate(id("standing"), own.standing, n),
            estimate(id("stands_a"), a, n),
            estimate(id("stands_b"), b, n),
            estimate(id("stands_c"), c, n),
            estimate(id("between"), own.between, n),
            estimate(id("memory"), own.memory, n),
            estimate(id("dispersion"), own.dispersion, n),
        ]);
    }
    let (_, own) = at_rise(seeds)?;
    values.extend(HOLDS.iter().zip(own.holds).map(|(id, holds)| estimate(*id, holds, n)));
    values.push(Value::real("fronts_alike", own.alike, 3));
    values.extend(far(seeds)?);
    Ok(values)
}

/// How long the fastest fronts would take for a long way, and for that to the next seed's front.
fn far(seeds: &Seeds) -> Result<[Value; 4], Error> {
    let n = seeds.parameters.realisations as u64;
    let speed = seeds.fronts.last().and_then(|own| own.speed);
    let speed = speed.filter(|own| own.value > 0.0).ok_or(Error::Missing("fronts that advance"))?;
    let closing = seeds.closing.last().ok_or(Error::Missing("seeds"))?;
    let spacing = 1.0 / closing[1].iter().sum::<f64>();
    let time = f64::from(FAR) / speed.value;
    Ok([
        Value::integer("fronts_far", FAR),
        Value::ensemble("fronts_far_time", time, time * speed.error / speed.value, n),
        Value::real("fronts_spacing", spacing, 2),
        Value::real("fronts_meet", 0.5 * spacing / speed.value, 2),
    ])
}

/// The lines of the table of one σ in time.
pub fn courses(results: &Results) -> Result<Vec<Line>, Error> {
    let (row, _) = at_rise(results.seeds()?)?;
    let line = |own: &Moment| Line::new(COURSE.map(|name| mark(moment_id(own, name))));
    Ok(row.course.iter().map(line).collect())
}

/// The lines of the table of speeds.
pub fn speeds(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |own: &Fronts| Line::new(SPEEDS.map(|name| mark(front_id(own, name))));
    Ok(rows(results.seeds()?).map(line).collect())
}

/// The lines of the table of obstacles.
pub fn obstacles(results: &Results) -> Result<Vec<Line>, Error> {
    let line = |own: &Fronts| Line::new(OBSTACLES.map(|name| mark(front_id(own, name))));
    Ok(rows(results.seeds()?).map(line).collect())
}

//! diffsol: Runge–Kutta of order 5 (tsit45), events at changes of sign, all of it compiled.
//!
//! Usage and output as in `common.py`: SCENARIO.json REFERENCE.json UNTIL, a row for each setting.

use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason};
use serde_json::{Value, json};
use std::time::Instant;

type Failure = Box<dyn std::error::Error>;

/// As in `common.py`.
const CLOSE: f64 = 1e-3;
const SEGMENT: f64 = 30.0;
const ENOUGH: f64 = 3.0;
const OPEN: f64 = f64::EPSILON;

struct Scenario {
    spacing: f64,
    natural: f64,
    driving: f64,
    restitution: f64,
    forcing: Vec<[f64; 2]>,
}

/// Opens a gap that is shut but for rounding; y holds displacements, then velocities.
fn apart(y: &mut [f64], gap: usize, d: f64) {
    let n = y.len() / 2;
    if gap == 0 {
        y[0] = y[0].max(OPEN - d);
    } else if gap == n {
        y[n - 1] = y[n - 1].min(d - OPEN);
    } else {
        y[gap] = y[gap].max(y[gap - 1] - d + OPEN);
    }
}

fn bounce(y: &mut [f64], gap: usize, scenario: &Scenario) {
    let n = y.len() / 2;
    let r = scenario.restitution;
    if gap == 0 || gap == n {
        let wall = n + gap.min(n - 1);
        y[wall] *= -r;
    } else {
        let kick = 0.5 * (1.0 + r) * (y[n + gap - 1] - y[n + gap]);
        y[n + gap - 1] -= kick;
        y[n + gap] += kick;
    }
    apart(y, gap, scenario.spacing);
}

/// The impacts from displacements and velocities `start` at `t` to `until`; the first, if `first`.
fn run(
    scenario: &Scenario,
    tolerance: f64,
    t: f64,
    start: &[f64],
    until: f64,
    first: bool,
) -> Result<Vec<(f64, usize)>, Failure> {
    let (n, d) = (start.len() / 2, scenario.spacing);
    let (w2, big_w) = (scenario.natural * scenario.natural, scenario.driving);
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .t0(t)
        .rtol(tolerance)
        .atol([tolerance * 1e-3])
        .rhs(|y: &[f64], _: &[f64], t: f64, rate: &mut [f64]| {
            let (sin, cos) = (big_w * t).sin_cos();
            let (u, v) = y.split_at(n);
            rate[..n].copy_from_slice(v);
            for ((rate, u), [alpha, beta]) in rate[n..].iter_mut().zip(u).zip(&scenario.forcing) {
                *rate = alpha * cos + beta * sin - w2 * u;
            }
        })
        .init(|_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(start), 2 * n)
        .root(
            |y: &[f64], _: &[f64], _: f64, width: &mut [f64]| {
                width[0] = d + y[0];
                for k in 1..n {
                    width[k] = d + (y[k] - y[k - 1]);
                }
                width[n] = d - y[n - 1];
            },
            n + 1,
        )
        .build()?;
    let mut solver = problem.tsit45()?;
    solver.set_stop_time(until)?;
    let mut impacts = Vec::new();
    let mut y = vec![0.0; 2 * n];
    loop {
        match solver.step()? {
            OdeSolverStopReason::InternalTimestep => {}
            OdeSolverStopReason::TstopReached => return Ok(impacts),
            OdeSolverStopReason::RootFound(t, gap) => {
                solver.state_mut_back(t)?;
                impacts.push((t, gap));
                if first {
                    return Ok(impacts);
                }
                let state = solver.state_mut();
                (0..2 * n).for_each(|i| y[i] = state.y[i]);
                bounce(&mut y, gap, scenario);
                (0..2 * n).for_each(|i| state.y[i] = y[i]);
                (0..n).for_each(|i| state.dy[i] = y[n + i]);
            }
        }
    }
}

/// Runs one tolerance and prints its row.
fn row(scenario: &Scenario, reference: &Value, until: f64, tolerance: f64) -> Result<(), Failure> {
    let n = scenario.forcing.len();
    let rest = vec![0.0; 2 * n];
    let (mut impacts, mut best, mut spent) = (Vec::new(), f64::INFINITY, 0.0);
    while spent <= ENOUGH {
        let began = Instant::now();
        impacts = run(scenario, tolerance, 0.0, &rest, until, false)?;
        let took = began.elapsed().as_secs_f64();
        best = best.min(took);
        spent += took;
    }
    let right = |own: Option<&(f64, usize)>, t: f64, gap: u64| {
        own.is_some_and(|own| own.1 as u64 == gap && (own.0 - t).abs() <= CLOSE)
    };
    let truth = reference["impacts"].as_array().ok_or("impacts")?;
    let number = |x: &Value| x.as_f64().ok_or("a number");
    let mut horizon = None;
    for (i, hit) in truth.iter().enumerate() {
        let (t, gap) = (number(&hit[0])?, hit[1].as_u64().ok_or("a gap")?);
        if !right(impacts.get(i), t, gap) {
            horizon = Some((i + 1, t));
            break;
        }
    }
    let segments = reference["segments"].as_array().ok_or("segments")?;
    let mut missed = 0;
    for segment in segments {
        let part = |name: &str| serde_json::from_value::<Vec<f64>>(segment[name].clone());
        let mut start = [part("u")?, part("v")?].concat();
        (0..=n).for_each(|gap| apart(&mut start, gap, scenario.spacing));
        let (t, next) = (number(&segment["t"])?, number(&segment["next_t"])?);
        let end = (t + SEGMENT).min(next + 1.0);
        let found = run(scenario, tolerance, t, &start, end, true).unwrap_or_default();
        let gap = segment["next_gap"].as_u64().ok_or("a gap")?;
        missed += usize::from(!right(found.first(), next, gap));
    }
    let row = json!({
        "what": "peer", "name": "diffsol tsit45", "version": "0.18.0",
        "settings": format!("tol={tolerance:e}"), "n": n, "until": until,
        "impacts": impacts.len(),
        "microseconds_per_impact": (!impacts.is_empty()).then(|| best / impacts.len() as f64 * 1e6),
        "seconds": best, "compared": truth.len(), "horizon_impact": horizon.map(|h| h.0),
        "horizon_time": horizon.map(|h| h.1), "segments": segments.len(),
        "segment_misses": missed, "note": "",
    });
    println!("{row}");
    Ok(())
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scenario, reference, until] = &arguments[..] else {
        return Err("usage: diffsol-peer SCENARIO.json REFERENCE.json UNTIL".into());
    };
    let read = |path: &str| -> Result<Value, Failure> {
        Ok(serde_json::from_str(&std::fs::read_to_string(path)?)?)
    };
    let (form, reference) = (read(scenario)?, read(reference)?);
    let number = |name: &str| form[name].as_f64().ok_or("a number of the scenario");
    let scenario = Scenario {
        spacing: number("spacing")?,
        natural: number("natural_frequency")?,
        driving: number("forcing_frequency")?,
        restitution: number("restitution")?,
        forcing: serde_json::from_value(form["forcing"].clone())?,
    };
    for tolerance in [1e-6, 1e-10, 1e-12] {
        row(&scenario, &reference, until.parse()?, tolerance)?;
    }
    Ok(())
}

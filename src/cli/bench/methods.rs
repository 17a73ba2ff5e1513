//! `impact-paper bench methods`.

use super::super::signals;
use super::{Drawn, Failure, draw, print};
use impact_paper::dynamics::methods::{
    Certified, Method, MoreauJean, Penalty, RungeKutta, Sampled, State, Verlet,
};
use impact_paper::dynamics::{Error, Impact, Scenario};
use impact_paper::experiments::alive;
use impact_paper::experiments::measured::{Row, What};
use impact_paper::input;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Times the engine and its rivals on one chain and prints JSON: {"rows": […]}.
///
/// The chain is that of `bench scenario` with the same options. Each method runs with several steps
/// or tolerances, and its row is that of benches/measured.json: time and evaluations per impact, and,
/// with --reference, the first wrong impact and the segments that are missed.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    drawn: Drawn,
    /// Simulated time T.
    #[arg(long, value_name = "T", default_value_t = 200.0, allow_hyphen_values = true)]
    until: f64,
    /// True impacts and segments, as `cargo bench --bench reference` prints them.
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// Seconds in which a setting is run again for its best time; it is run once at least.
    #[arg(long, value_name = "s", default_value_t = 1.0, allow_hyphen_values = true)]
    seconds: f64,
}

/// What is printed.
#[derive(Serialize)]
struct Report {
    rows: Vec<Row>,
}

/// The truth about a chain.
#[derive(Deserialize)]
struct Reference {
    /// (t, gap) of each impact.
    impacts: Vec<(f64, usize)>,
    segments: Vec<Segment>,
}

/// The state right after an impact, and the impact that follows.
#[derive(Deserialize)]
struct Segment {
    t: f64,
    u: Vec<f64>,
    v: Vec<f64>,
    next_t: f64,
    next_gap: usize,
}

/// A time that is further off than this is wrong.
const CLOSE: f64 = 1e-3;

/// How often a setting is run at most.
const REPETITIONS: usize = 20;

pub fn run(args: &Args) -> Result<(), Failure> {
    if !(0.0..=1e6).contains(&args.until) {
        let message = format!("--until: {:?} is out of range; give 0 to 1e6", args.until);
        return Err(Failure::input(message));
    }
    if !(0.0..=1e4).contains(&args.seconds) {
        let message = format!("--seconds: {:?} is out of range; give 0 to 1e4", args.seconds);
        return Err(Failure::input(message));
    }
    let scenario = {
        let Drawn { masses, sigma, seed, chain } = args.drawn;
        draw(masses, sigma, 0.8, seed, chain)?
    };
    let reference =
        args.reference.as_deref().map(|path| read(path, args.drawn.masses)).transpose()?;
    let _alive = alive(|| Some("bench methods: at work".into()));
    let progress = signals::progress();
    let rows = settings()
        .iter()
        .map(|(method, setting)| {
            let row = row(args, &scenario, reference.as_ref(), method.as_ref(), setting);
            progress.say(&format!("{} {setting}", method.name()));
            row
        })
        .collect();
    print(&Report { rows })
}

/// Each method with its steps or tolerances, coarse to fine.
fn settings() -> Vec<(Box<dyn Method>, String)> {
    let mut all: Vec<(Box<dyn Method>, String)> = vec![(Box::new(Certified), String::new())];
    let mut stepped = |of: fn(f64) -> Box<dyn Method>, name: &str, values: &[f64]| {
        all.extend(values.iter().map(|&x| (of(x), format!("{name}={x:e}"))));
    };
    stepped(|step| Box::new(Sampled { step }), "h", &[0.1, 0.03, 0.01, 0.003]);
    let tolerances = [1e-4, 1e-6, 1e-9, 1e-12];
    stepped(|tolerance| Box::new(RungeKutta { tolerance }), "tol", &tolerances);
    stepped(|step| Box::new(MoreauJean { step }), "h", &[1e-1, 1e-2, 1e-3, 1e-4]);
    stepped(|step| Box::new(Verlet { step }), "h", &[1e-1, 1e-2, 1e-3, 1e-4]);
    stepped(|step| Box::new(Penalty { step }), "h", &[1e-2, 1e-3, 1e-4]);
    all
}

/// Reads the truth.
fn read(path: &Path, masses: usize) -> Result<Reference, Failure> {
    let remedy = "make it with cargo bench --bench reference -- SCENARIO.json UNTIL";
    let wrong = |problem: String| {
        Failure::input(format!("--reference: {}: {problem}; {remedy}", path.display()))
    };
    let text = input::read(path).map_err(|error| wrong(error.to_string()))?;
    let read: Reference = serde_json::from_str(&text)
        .map_err(|error| wrong(input::one_line(&input::plain(&error.to_string()), 300)))?;
    let whole = |one: &Segment| [&one.u, &one.v].iter().all(|parts| parts.len() == masses);
    match read.segments.iter().position(|one| !whole(one)) {
        None => Ok(read),
        Some(i) => Err(wrong(format!("segments[{i}]: u and v need {masses} numbers, one a mass"))),
    }
}

/// Runs one setting as often as there is time for.
fn row(
    args: &Args,
    scenario: &Scenario,
    reference: Option<&Reference>,
    method: &dyn Method,
    setting: &str,
) -> Row {
    let start = State::of(scenario);
    let (mut best, mut spent) = (f64::INFINITY, 0.0);
    // As many as are compared, and the number of all.
    let mut impacts: Vec<Impact> = Vec::new();
    let most = reference.map_or(0, |truth| truth.impacts.len());
    let mut count = 0_u64;
    let mut ended = Ok(Default::default());
    for _ in 0..REPETITIONS {
        impacts.clear();
        count = 0;
        let began = Instant::now();
        ended = method.run(scenario, &start, args.until, &mut |impact| {
            count += 1;
            if impacts.len() < most {
                impacts.push(impact);
            }
            true
        });
        let seconds = began.elapsed().as_secs_f64();
        best = best.min(seconds);
        spent += seconds;
        if spent > args.seconds || ended.is_err() {
            break;
        }
    }
    let per_impact = |x: f64| (count > 0).then(|| x / count as f64);
    let horizon = reference.and_then(|truth| horizon(truth, &impacts));
    Row {
        what: What::Method,
        name: method.name().into(),
        version: env!("CARGO_PKG_VERSION").into(),
        settings: setting.into(),
        n: args.drawn.masses as u64,
        sigma: args.drawn.sigma,
        until: args.until,
        chains: 1,
        threads: 1,
        lanes: 1,
        impacts: count,
        microseconds_per_impact: per_impact(best * 1e6),
        evaluations_per_impact: ended.as_ref().ok().and_then(|cost| {
            // A method that counts none has none.
            per_impact(cost.evaluations as f64).filter(|x| *x > 0.0)
        }),
        compared: reference.map(|truth| truth.impacts.len() as u64),
        horizon_impact: horizon.map(|(number, _)| number),
        horizon_time: horizon.map(|(_, time)| time),
        segment_misses: reference.map(|truth| {
            truth.segments.iter().filter(|s| !found(scenario, method, s)).count() as u64
        }),
        segments: reference.map(|truth| truth.segments.len() as u64),
        seconds: Some(best),
        peak_mib: None,
        note: ended.err().map(|error| format!("ended early: {error}")).unwrap_or_default(),
    }
}

/// Number, from 1, and time of the first true impact that a run does not have.
fn horizon(truth: &Reference, impacts: &[Impact]) -> Option<(u64, f64)> {
    (1..).zip(&truth.impacts).enumerate().find_map(|(i, (number, &(time, gap)))| {
        let own = impacts.get(i);
        let right = own.is_some_and(|own| own.gap == gap && (own.time - time).abs() <= CLOSE);
        (!right).then_some((number, time))
    })
}

/// Whether a method finds the impact that ends a segment.
fn found(scenario: &Scenario, method: &dyn Method, segment: &Segment) -> bool {
    let d = scenario.spacing;
    let start = State {
        time: segment.t,
        positions: segment.u.iter().zip(1..).map(|(u, j)| f64::from(j) * d + u).collect(),
        velocities: segment.v.clone(),
    };
    let mut first = None;
    let run: Result<_, Error> = method.run(scenario, &start, segment.next_t + 1.0, &mut |impact| {
        first = Some(impact);
        false
    });
    run.is_ok()
        && first.is_some_and(|own| {
            own.gap == segment.next_gap && (own.time - segment.next_t).abs() <= CLOSE
        })
}

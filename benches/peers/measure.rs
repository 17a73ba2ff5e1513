//! Speed of the engine and of its rivals, as JSON, and the scenarios on which other programs are measured: what
//! `make measure` calls (`benches/peers/measure.py`).
//!
//! Chain i of n masses starts from rest; its forcing is drawn from stream i of the seed.

use clap::Parser;
use impact_chain::methods::{Method, State};
use impact_chain::{Counters, Engine, Error, Impact, Scenario};
use impact_numerics::random::NormalPairs;
use impact_paper::params::{Chain, MethodName};
use rayon::prelude::*;
use serde::Deserialize;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::time::Instant;

/// What is measured, or printed.
#[derive(Parser)]
enum What {
    /// Times the engine on each number of masses.
    Engine {
        #[command(flatten)]
        drawn: Drawn,
        /// Simulated time T [default: 200000/n, but not below 10 nor above 200].
        #[arg(long)]
        until: Option<f64>,
        /// Chains in each repetition, shared out over the threads.
        #[arg(long, default_value_t = 1)]
        chains: u64,
        #[arg(long, default_value_t = 1)]
        threads: usize,
        /// Repetitions: the best and the median of them are printed.
        #[arg(long, default_value_t = 5)]
        repetitions: usize,
    },
    /// Times the engine and its rivals on one chain.
    Methods {
        #[command(flatten)]
        drawn: Drawn,
        /// Simulated time T.
        #[arg(long, default_value_t = 200.0)]
        until: f64,
        /// True impacts and segments, as `cargo bench --bench reference` prints them.
        #[arg(long)]
        reference: PathBuf,
        /// Seconds in which a setting is run again for its best time.
        #[arg(long, default_value_t = 1.0)]
        seconds: f64,
    },
    /// Prints a chain as a scenario file.
    Scenario {
        #[command(flatten)]
        drawn: Drawn,
    },
}

/// Which chain.
#[derive(clap::Args)]
struct Drawn {
    /// Number of masses n.
    #[arg(long, default_value_t = 20)]
    masses: usize,
    /// Standard deviation σ of the forcing.
    #[arg(long, default_value_t = 0.3)]
    sigma: f64,
    /// Number i of the chain.
    #[arg(long, default_value_t = 0)]
    chain: u64,
}

/// Seed of the forcing.
const SEED: u64 = 1;

/// Coefficient of restitution.
const RESTITUTION: f64 = 0.8;

type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let printed = match What::parse() {
        What::Engine { drawn, until, chains, threads, repetitions } => {
            let cases = [engine(&drawn, until, chains, threads, repetitions)?];
            json!({"version": env!("CARGO_PKG_VERSION"), "cases": cases})
        }
        What::Methods { drawn, until, reference, seconds } => {
            let truth: Truth = serde_json::from_str(&std::fs::read_to_string(reference)?)?;
            let scenario = draw(&drawn, 0)?;
            let row = |(method, setting): &(Box<dyn Method>, String)| {
                let row = row(&drawn, &scenario, until, &truth, seconds, method.as_ref(), setting);
                eprintln!("{} {setting}", method.name());
                row
            };
            json!({"rows": settings().iter().map(row).collect::<Vec<Value>>()})
        }
        What::Scenario { drawn } => {
            let scenario = draw(&drawn, 0)?;
            json!({
                "spacing": scenario.spacing, "natural_frequency": scenario.natural_frequency,
                "forcing_frequency": scenario.forcing_frequency,
                "restitution": scenario.restitution, "boundary": scenario.boundary,
                "initial": "rest", "forcing": scenario.forcing,
            })
        }
    };
    println!("{printed:#}");
    Ok(())
}

/// The chain, or the one so many behind it.
fn draw(drawn: &Drawn, behind: u64) -> Result<Scenario, Failure> {
    let chain = Chain { masses: drawn.masses, restitution: RESTITUTION, ..Chain::default() };
    let mut normals = NormalPairs::new("bench", SEED, drawn.chain + behind);
    let scenario = Scenario::draw(&chain, drawn.sigma, &mut normals);
    scenario.validate()?;
    Ok(scenario)
}

/// Times and counted work of a number of masses.
fn engine(
    drawn: &Drawn,
    until: Option<f64>,
    chains: u64,
    threads: usize,
    repetitions: usize,
) -> Result<Value, Failure> {
    let until = until.unwrap_or((200_000.0 / drawn.masses as f64).clamp(10.0, 200.0));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let began = Instant::now();
    let start = |behind| Ok(Engine::new(&draw(drawn, behind)?)?);
    let engines = pool
        .install(|| (0..chains).into_par_iter().map(start).collect::<Result<Vec<_>, Failure>>())?;
    let setup_seconds = began.elapsed().as_secs_f64();
    let (mut seconds, mut counted, mut engines) = (Vec::new(), Counters::default(), Some(engines));
    for repetition in 1..=repetitions {
        // The last repetition needs no copy of the start: at a million masses that is memory.
        let last = repetition == repetitions;
        let mut own = if last { engines.take() } else { engines.clone() }.unwrap_or_default();
        let began = Instant::now();
        let run = |engine: &mut Engine| engine.run(until, |_| true);
        pool.install(|| {
            own.par_iter_mut().with_max_len(1).map(run).collect::<Result<(), Error>>()
        })?;
        seconds.push(began.elapsed().as_secs_f64());
        counted = Counters::default();
        for own in own.iter().map(Engine::counters) {
            counted.impacts += own.impacts;
            counted.contact_phases += own.contact_phases;
            counted.searches += own.searches;
            counted.pieces += own.pieces;
            counted.evaluations += own.evaluations;
            counted.undecided += own.undecided;
        }
    }
    seconds.sort_by(f64::total_cmp);
    let per_impact = |x: f64| (counted.impacts > 0).then(|| x / counted.impacts as f64);
    Ok(json!({
        "n": drawn.masses, "sigma": drawn.sigma, "restitution": RESTITUTION, "until": until,
        "chains": chains, "threads": threads, "repetitions": repetitions,
        "impacts": counted.impacts,
        "ns_per_impact": per_impact(seconds[0] * 1e9),
        "ns_per_impact_median": per_impact(seconds[seconds.len() / 2] * 1e9),
        "evaluations_per_impact": per_impact(counted.evaluations as f64),
        "searches_per_impact": per_impact(counted.searches as f64),
        "pieces_per_impact": per_impact(counted.pieces as f64),
        "undecided": counted.undecided, "contact_phases": counted.contact_phases,
        "seconds": seconds[0], "setup_seconds": setup_seconds, "peak_mib": peak_mib(),
    }))
}

/// Largest resident memory of this process so far, where the system tells it.
fn peak_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok().map(|kib| kib / 1024.0)
}

/// The truth about a chain.
#[derive(Deserialize)]
struct Truth {
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

/// Each method with its steps or tolerances, coarse to fine.
fn settings() -> Vec<(Box<dyn Method>, String)> {
    let values = |method| -> &[f64] {
        match method {
            MethodName::Certified | MethodName::Truth => &[0.0],
            MethodName::Sampled => &[0.1, 0.03, 0.01, 0.003],
            MethodName::Advancement => &[1e-6, 1e-9, 1e-12],
            MethodName::RungeKutta => &[1e-4, 1e-6, 1e-9, 1e-12],
            MethodName::MoreauJean | MethodName::Verlet => &[1e-1, 1e-2, 1e-3, 1e-4],
            MethodName::Penalty => &[1e-2, 1e-3, 1e-4],
        }
    };
    let of = |method: MethodName| {
        let setting = move |x: f64| match method {
            MethodName::Certified => String::new(),
            own if own.has_tolerance() => format!("tol={x:e}"),
            _ => format!("h={x:e}"),
        };
        values(method).iter().map(move |&x| (method.with(x), setting(x)))
    };
    MethodName::ALL.into_iter().flat_map(of).collect()
}

/// A row of benches/measured.json: one setting, run as often as there is time for.
fn row(
    drawn: &Drawn,
    scenario: &Scenario,
    until: f64,
    truth: &Truth,
    patience: f64,
    method: &dyn Method,
    setting: &str,
) -> Value {
    let start = State::of(scenario);
    let (mut best, mut spent) = (f64::INFINITY, 0.0);
    // As many as are compared, and the number of all.
    let (mut impacts, mut count, mut ended) = (Vec::new(), 0_u64, Ok(Default::default()));
    for _ in 0..REPETITIONS {
        impacts.clear();
        count = 0;
        let began = Instant::now();
        ended = method.run((scenario, &start, until), &mut |impact| {
            count += 1;
            if impacts.len() < truth.impacts.len() {
                impacts.push(impact);
            }
            true
        });
        let seconds = began.elapsed().as_secs_f64();
        best = best.min(seconds);
        spent += seconds;
        if spent > patience || ended.is_err() {
            break;
        }
    }
    let per_impact = |x: f64| (count > 0).then(|| x / count as f64);
    let horizon = horizon(truth, &impacts);
    let missed = truth.segments.iter().filter(|segment| !found(scenario, method, segment)).count();
    // A method that counts no evaluations has none.
    let evaluations = ended.as_ref().ok().and_then(|cost| per_impact(cost.evaluations as f64));
    json!({
        "what": "method", "name": method.name(), "version": env!("CARGO_PKG_VERSION"),
        "settings": setting, "n": drawn.masses, "sigma": drawn.sigma, "until": until,
        "chains": 1, "threads": 1, "impacts": count,
        "microseconds_per_impact": per_impact(best * 1e6),
        "evaluations_per_impact": evaluations.filter(|x| *x > 0.0),
        "compared": truth.impacts.len(),
        "horizon_impact": horizon.map(|(number, _)| number),
        "horizon_time": horizon.map(|(_, time)| time),
        "segment_misses": missed, "segments": truth.segments.len(),
        "seconds": best, "peak_mib": null,
        "note": ended.err().map(|error| format!("ended early: {error}")).unwrap_or_default(),
    })
}

/// Number, from 1, and time of the first true impact that a run does not have.
fn horizon(truth: &Truth, impacts: &[Impact]) -> Option<(u64, f64)> {
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
    let first = method.first((scenario, &start, segment.next_t + 1.0));
    first.is_ok_and(|first| {
        first.is_some_and(|own| {
            own.gap == segment.next_gap && (own.time - segment.next_t).abs() <= CLOSE
        })
    })
}

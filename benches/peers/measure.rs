//! Speed of the engine and of its rivals, as JSON, and the scenarios on which other programs are
//! measured, for `make measure` (`benches/peers/measure.py`).
//!
//! Chain i of n masses starts from rest; its forcing is drawn from stream i of the seed.

use clap::Parser;
use impact_chain::methods::{Certified, CountedSteps, Method, Task, VerletAbreast};
use impact_chain::{Abreast, HitGaps, without_wide_vectors};
use impact_chain::{Counters, Engine, Error, Impact, Protocol, Scenario, State};
use impact_numerics::random::{NormalPairs, Seed};
use impact_paper::params::{
    BiasParams, Chain, Means, MethodName, Profile, RaceParams, Runs, ScaleParams, Setting,
};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::sync::LazyLock;
use std::time::Instant;

/// The quantity that is measured or printed.
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
    /// Times every rival on the chains of an experiment, in turn with the engine.
    Methods {
        /// Which experiment.
        of: Of,
        /// Repetitions: the best of each is printed.
        #[arg(long, default_value_t = 3)]
        repetitions: usize,
        /// Without vectors that not every processor of the kind has.
        #[arg(long)]
        generic: bool,
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
        What::Methods { of, repetitions, generic } => {
            if generic {
                without_wide_vectors();
            }
            for case in cases(of) {
                println!("{}", row(&case, repetitions, if generic { "-generic" } else { "" })?);
            }
            return Ok(());
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

/// The chain `behind` places after that of `drawn` in the stream.
fn draw(drawn: &Drawn, behind: u64) -> Result<Scenario, Failure> {
    let chain = Chain { masses: drawn.masses, restitution: RESTITUTION, ..Chain::default() };
    let mut normals = NormalPairs::new("bench", Seed(SEED), drawn.chain + behind);
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
        let mut running = if last { engines.take() } else { engines.clone() }.unwrap_or_default();
        let began = Instant::now();
        let run = |engine: &mut Engine| engine.advance(until);
        pool.install(|| {
            running.par_iter_mut().with_max_len(1).map(run).collect::<Result<(), Error>>()
        })?;
        seconds.push(began.elapsed().as_secs_f64());
        counted = Counters::default();
        for work in running.iter().map(Engine::counters) {
            counted.impacts += work.impacts;
            counted.contact_phases += work.contact_phases;
            counted.searches += work.searches;
            counted.pieces += work.pieces;
            counted.evaluations += work.evaluations;
            counted.undecided += work.undecided;
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

/// Largest resident memory of this process so far, where the system reports it.
fn peak_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok().map(|kib| kib / 1024.0)
}

/// An experiment on methods.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Of {
    /// How long runs are true.
    Race,
    /// The error of the mean.
    Bias,
    /// The cost against the number of masses.
    Scale,
    /// Runs that end when a question is answered: orbits to a time, and whether there is an impact.
    Questions,
}

/// The chains of the race, to its end.
fn race() -> Runs {
    let race = RaceParams::new(Profile::Full);
    Runs { until: race.until, realisations: race.chains, ..race.growth }
}

/// Chains and the method that is timed on them.
struct Case {
    what: &'static str,
    runs: Runs,
    setting: Setting,
    /// Of a question about means, for which the engine simulates chains side by side.
    window: Option<Protocol>,
    /// Whether a run ends with its first impact in the window.
    first: bool,
}

/// Times to which orbits are asked for.
const ORBITS: [f64; 2] = [10.0, 100.0];

/// The most chains of a mean that are timed.
const MOST: usize = 400;

fn means(of: Means) -> impl Iterator<Item = Case> {
    let window = Some(of.window());
    let chains = of.chains;
    of.settings.into_iter().map(move |(setting, n)| {
        let runs = Runs { realisations: n.min(MOST), ..chains.clone() };
        Case { what: "method", runs, setting, window, first: false }
    })
}

fn cases(of: Of) -> Vec<Case> {
    let alone = |what, runs, setting| Case { what, runs, setting, window: None, first: false };
    let race_settings = || RaceParams::new(Profile::Full).settings.into_iter();
    let all_means = BiasParams::new(Profile::Full).means;
    match of {
        Of::Race => race_settings().map(|way| alone("method", race(), way)).collect(),
        Of::Bias => all_means.into_iter().flat_map(means).collect(),
        Of::Questions => {
            let orbit = |until| {
                race_settings().map(move |way| alone("question", Runs { until, ..race() }, way))
            };
            let shares = all_means.into_iter().take(1).flat_map(means);
            let shares = shares.map(|case| Case { what: "question", first: true, ..case });
            ORBITS.into_iter().flat_map(orbit).chain(shares).collect()
        }
        Of::Scale => {
            let ScaleParams { sigma, masses, largest_for_rivals: most, settings } =
                ScaleParams::new(Profile::Full);
            let of = |setting: Setting| {
                let own = setting.method == MethodName::Certified;
                let chains = move |n: usize| Runs {
                    chain: Chain { masses: n, ..Chain::default() },
                    sigma,
                    until: 20.0,
                    realisations: (1000 / n).max(1),
                    ..race()
                };
                let masses = masses.iter().copied().filter(move |n| own || *n <= most);
                masses.map(move |n| alone("size", chains(n), setting))
            };
            settings.into_iter().flat_map(of).collect()
        }
    }
}

/// Seconds that a repetition takes at least.
const ENOUGH: f64 = 0.2;

/// Runs all chains; returns the number of impacts.
fn once(case: &Case, method: &dyn Method, scenarios: &[Scenario]) -> Result<u64, Error> {
    let Case { runs, window, first, .. } = case;
    let from = window.map_or(f64::INFINITY, |window| window.transient);
    let until = if *first { HitGaps::One } else { HitGaps::All };
    let alone = |scenario: &Scenario| {
        let task = Task { scenario, start: &State::from_scenario(scenario), until: runs.until };
        let mut is_hit = vec![false; scenario.gaps()];
        let mut to_hit = if *first { 1 } else { is_hit.len() };
        let mut is_unanswered = |impact: Impact| {
            if impact.time > from && !is_hit[impact.gap] {
                (is_hit[impact.gap], to_hit) = (true, to_hit - 1);
            }
            to_hit > 0
        };
        // A run that the method gives up counts with the time that it took.
        match method.run(task, &mut is_unanswered) {
            Err(Error::Work { .. }) => Ok(0),
            ended => Ok(ended?.impacts),
        }
    };
    if method.name() == MethodName::VerletAbreast.id() {
        let verlet = VerletAbreast { step: case.setting.value };
        if window.is_none() {
            return Ok(verlet.run_all(scenarios, runs.until, &mut |_, _| true)?.impacts);
        }
        let ran = verlet.count_gaps(scenarios, runs.until, CountedSteps { from, until });
        return Ok(ran?.0.impacts);
    }
    let together = window.filter(|_| method.name() == Certified.name());
    let Some(many) = together.and_then(|of| Abreast::new(&runs.chain, &[of], runs.until)) else {
        return scenarios.iter().map(alone).sum();
    };
    let many = many.until_hit(until, from);
    let mut impacts = 0;
    for some in scenarios.chunks(Abreast::batch_size(&runs.chain)) {
        for (run, scenario) in many.run(some, &|| false).into_iter().zip(some) {
            impacts += match run {
                Some(mut run) => run.counts().total.impacts,
                None => alone(scenario)?,
            };
        }
    }
    Ok(impacts)
}

/// A row of benches/measured.json: the best times of a method and of the engine on the same chains.
fn row(case: &Case, repetitions: usize, suffix: &str) -> Result<Value, Failure> {
    let Case { what, runs, setting, .. } = case;
    let scenarios: Vec<Scenario> =
        (0..runs.realisations as u64).map(|index| runs.scenario(index)).collect();
    let once = |method: &dyn Method| once(case, method, &scenarios);
    // The system counts in ticks of some milliseconds, so short runs are repeated.
    let timed = |method: &dyn Method| -> Result<f64, Error> {
        let (began, mut times) = (processor_time(), 0.0);
        loop {
            once(method)?;
            times += 1.0;
            let spent = processor_time() - began;
            if spent >= ENOUGH {
                return Ok(spent / times);
            }
        }
    };
    let method = setting.method();
    let (mut best, mut engine, impacts) = (f64::INFINITY, f64::INFINITY, once(method.as_ref())?);
    for _ in 0..repetitions {
        engine = engine.min(timed(&Certified)?);
        best = best.min(timed(method.as_ref())?);
    }
    if setting.method == MethodName::Certified {
        (best, engine) = (best.min(engine), best.min(engine));
    }
    eprintln!("{} {}, σ = {}: {best} s", method.name(), setting.value, runs.sigma);
    let text = match setting.method {
        MethodName::Certified => String::new(),
        way => format!("{}={:e}", if way.has_tolerance() { "tol" } else { "h" }, setting.value),
    };
    Ok(json!({
        "what": what, "name": format!("{}{suffix}", method.name()), "version": env!("CARGO_PKG_VERSION"),
        "settings": text, "value": setting.value, "n": runs.chain.masses, "sigma": runs.sigma,
        "until": runs.until, "chains": runs.realisations, "impacts": impacts,
        "microseconds_per_impact": (impacts > 0).then(|| best / impacts as f64 * 1e6),
        "seconds": best, "engine_seconds": engine,
    }))
}

/// Seconds that this thread has run, where the system counts them; else those of the clock.
fn processor_time() -> f64 {
    let counted = || {
        let line = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
        line.split_whitespace().next()?.parse::<f64>().ok()
    };
    static BEGAN: LazyLock<Instant> = LazyLock::new(Instant::now);
    counted().map_or_else(|| BEGAN.elapsed().as_secs_f64(), |nanoseconds| nanoseconds * 1e-9)
}

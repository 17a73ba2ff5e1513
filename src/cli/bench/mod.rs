//! `impact-paper bench`.

mod methods;

use super::{Failure, memory, sigmas, stdout, threads};
use impact_paper::dynamics::{Counters, Engine, Error, Scenario};
use impact_paper::experiments::alive;
use impact_paper::input::{Bounded, NAMED, too_long};
use impact_paper::numerics::clock::LATEST;
use impact_paper::numerics::random::NormalPairs;
use impact_paper::params::{Boundary, Chain};
use rayon::prelude::*;
use serde::Serialize;
use std::io::{self, Write};
use std::time::Instant;

/// Measures speed on this machine, and prints scenarios for other programs.
///
/// Times go to standard output only; no file of the paper depends on them.
#[derive(clap::Args)]
pub struct Args {
    #[command(subcommand)]
    what: What,
}

#[derive(clap::Subcommand)]
enum What {
    Engine(EngineArgs),
    Methods(methods::Args),
    Scenario(ScenarioArgs),
}

/// Times the engine and prints JSON: {"version", "cases": [{"n", "ns_per_impact", …}]}.
///
/// Chain i of n masses starts from rest, its forcing drawn from stream i of the seed, and runs to
/// T. A repetition runs C chains, i and those that follow; ns_per_impact is the wall time of the best repetition over all
/// its impacts, ns_per_impact_median that of the median one. setup_seconds (drawing amplitudes,
/// the first search of every gap) is apart. Evaluations and searches are counted, and the same on
/// every machine. peak_mib is the largest memory of the process so far (Linux only).
#[derive(clap::Args)]
#[command(after_help = "Examples:
  impact-paper bench engine --masses 100 --repetitions 20
  impact-paper bench engine --masses 100 --chains 64 --threads 2     an ensemble
  impact-paper bench engine --masses 1000000 --repetitions 1         memory at scale")]
struct EngineArgs {
    /// Numbers of masses n, one case each.
    #[arg(long, value_name = "n,…", value_delimiter = ',', default_values_t = [20, 100, 1_000, 10_000], allow_hyphen_values = true)]
    masses: Vec<usize>,
    /// Standard deviation σ of the forcing.
    #[arg(long, value_name = "σ", default_value_t = 0.3, allow_hyphen_values = true)]
    sigma: f64,
    /// Coefficient of restitution r, from 0 to 1.
    #[arg(long, value_name = "r", default_value_t = 0.8, allow_hyphen_values = true)]
    restitution: f64,
    /// Simulated time T [default: 200000/n, but not below 10 nor above 200].
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    until: Option<f64>,
    /// Number i of the first chain.
    #[arg(long, value_name = "i", default_value_t = 0, allow_hyphen_values = true)]
    chain: u64,
    /// Chains in each repetition; they are shared out over the threads.
    #[arg(long, value_name = "C", default_value_t = 1, allow_hyphen_values = true)]
    chains: usize,
    /// Number of threads.
    #[arg(long, value_name = "K", default_value_t = 1, allow_hyphen_values = true, value_parser = threads::read)]
    threads: usize,
    /// Repetitions: the best and the median of them are printed.
    #[arg(long, value_name = "k", default_value_t = 5, allow_hyphen_values = true)]
    repetitions: usize,
    /// Seed of the forcing.
    #[arg(long, value_name = "S", default_value_t = 1, allow_hyphen_values = true)]
    seed: u64,
}

/// Prints chain i of `bench engine` as a scenario file for `trace` and for other programs.
#[derive(clap::Args)]
struct ScenarioArgs {
    #[command(flatten)]
    drawn: Drawn,
    /// Coefficient of restitution r, from 0 to 1.
    #[arg(long, value_name = "r", default_value_t = 0.8, allow_hyphen_values = true)]
    restitution: f64,
}

/// One of the chains.
#[derive(clap::Args)]
struct Drawn {
    /// Number of masses n.
    #[arg(long, value_name = "n", default_value_t = 20, allow_hyphen_values = true)]
    masses: usize,
    /// Standard deviation σ of the forcing.
    #[arg(long, value_name = "σ", default_value_t = 0.3, allow_hyphen_values = true)]
    sigma: f64,
    /// Seed of the forcing.
    #[arg(long, value_name = "S", default_value_t = 1, allow_hyphen_values = true)]
    seed: u64,
    /// Number i of the chain.
    #[arg(long, value_name = "i", default_value_t = 0, allow_hyphen_values = true)]
    chain: u64,
}

/// What `bench engine` prints.
#[derive(Serialize)]
struct Report {
    version: &'static str,
    cases: Vec<Case>,
}

/// One number of masses.
#[derive(Serialize)]
struct Case {
    n: usize,
    sigma: f64,
    restitution: f64,
    until: f64,
    chains: usize,
    threads: usize,
    lanes: usize,
    repetitions: usize,
    impacts: u64,
    ns_per_impact: Option<f64>,
    ns_per_impact_median: Option<f64>,
    evaluations_per_impact: Option<f64>,
    searches_per_impact: Option<f64>,
    pieces_per_impact: Option<f64>,
    undecided: u64,
    contact_phases: u64,
    seconds: f64,
    setup_seconds: f64,
    peak_mib: Option<f64>,
}

/// Bytes of a mass in a scenario, at least.
const LEAST: u64 = 34;

/// Chains side by side in the registers of one thread.
const LANES: usize = 1;

pub fn run(args: Args) -> Result<(), Failure> {
    match args.what {
        What::Engine(args) => {
            let _told = alive(|| Some("bench engine: at work".into()));
            let cases = args.masses.iter().map(|&n| case(&args, n)).collect::<Result<_, _>>()?;
            print(&Report { version: env!("CARGO_PKG_VERSION"), cases })
        }
        What::Methods(args) => methods::run(&args),
        What::Scenario(ScenarioArgs { drawn, restitution }) => {
            let long = || {
                Failure::input(format!(
                    "--masses: the scenario of {}: {}, and `trace` reads no longer one; give fewer masses (about \
                     1000000 fit)",
                    drawn.masses,
                    too_long(NAMED)
                ))
            };
            if drawn.masses as u64 > (NAMED << 20) / LEAST {
                return Err(long());
            }
            let scenario = draw(drawn.masses, drawn.sigma, restitution, drawn.seed, drawn.chain)?;
            let mut text = Bounded::new(NAMED << 20);
            serde_json::to_writer_pretty(&mut text, &form(&scenario)).map_err(|_| long())?;
            stdout::print(&format!("{}\n", String::from_utf8_lossy(&text.bytes)))
        }
    }
}

/// Chain `index`, at rest.
fn draw(n: usize, sigma: f64, r: f64, seed: u64, index: u64) -> Result<Scenario, Failure> {
    if n == 0 {
        return Err(Failure::input("--masses: 0 is not allowed; give 1 or more"));
    }
    memory::fits(Engine::memory(n, 1), "--masses", "give fewer masses")?;
    if !(0.0..=sigmas::LARGEST).contains(&sigma) {
        let message = format!("--sigma: {sigma:?} is out of range; give a number from 0 to 1e6");
        return Err(Failure::input(message));
    }
    let chain = Chain { masses: n, restitution: r, ..Chain::default() };
    let scenario = Scenario::draw(&chain, sigma, &mut NormalPairs::new("bench", seed, index));
    scenario.validate().map_err(|error| Failure::input(format!("--{error}")))?;
    Ok(scenario)
}

/// Bytes of an engine besides those of its masses: 14 000 were measured, for one mass.
const ENGINE: u128 = 15 << 10;

/// Repetitions, of which each has its time kept.
const SAMPLES: usize = 1_000_000;

/// Times one number of masses.
fn case(args: &EngineArgs, n: usize) -> Result<Case, Failure> {
    let until = args.until.unwrap_or((200_000.0 / n as f64).clamp(10.0, 200.0));
    if !(0.0..=LATEST).contains(&until) {
        let message = format!("--until: {until:?} is out of range; give a time from 0 to 1e12");
        return Err(Failure::input(message));
    }
    for (name, value) in [("chains", args.chains), ("repetitions", args.repetitions)] {
        if value == 0 {
            return Err(Failure::input(format!("--{name}: 0 measures nothing; give 1 or more")));
        }
        if name == "repetitions" && value > SAMPLES {
            return Err(Failure::input(format!(
                "--{name}: {value} is too many; give {SAMPLES} at most"
            )));
        }
    }
    if args.chain.checked_add(args.chains as u64).is_none() {
        let message = format!("--chain: {} is too large; give a smaller number", args.chain);
        return Err(Failure::input(message));
    }
    // All chains at their start, and the copies that run.
    let copies = if args.repetitions > 1 { 2 } else { 1 };
    let needed = (Engine::memory(n, 1) + ENGINE).saturating_mul(copies * args.chains as u128);
    let threads = memory::THREAD * args.threads as u128;
    let needed = needed.saturating_add(threads);
    memory::fits(needed, "--masses, --chains", "give fewer masses, chains or threads")?;
    let began = Instant::now();
    let engines = threads::run(Some(args.threads), || {
        let start = |index: usize| {
            let chain = args.chain + index as u64;
            let scenario = draw(n, args.sigma, args.restitution, args.seed, chain)?;
            Engine::new(&scenario).map_err(|error| Failure::run(error.to_string()))
        };
        (0..args.chains).into_par_iter().map(start).collect::<Result<Vec<Engine>, Failure>>()
    })?;
    let setup_seconds = began.elapsed().as_secs_f64();
    let mut seconds = Vec::new();
    let mut counted = Counters::default();
    let mut engines = Some(engines);
    for repetition in 1..=args.repetitions {
        // The last repetition needs no copy of the start: at a million masses that is memory.
        let last = repetition == args.repetitions;
        let own = if last { engines.take() } else { engines.clone() }.unwrap_or_default();
        let (time, counters) = repeat(own, until, args.threads)?;
        seconds.push(time);
        counted = counters;
    }
    seconds.sort_by(f64::total_cmp);
    let per_impact = |x: f64| (counted.impacts > 0).then(|| x / counted.impacts as f64);
    Ok(Case {
        n,
        sigma: args.sigma,
        restitution: args.restitution,
        until,
        chains: args.chains,
        threads: args.threads,
        lanes: LANES,
        repetitions: args.repetitions,
        impacts: counted.impacts,
        ns_per_impact: per_impact(seconds[0] * 1e9),
        ns_per_impact_median: per_impact(seconds[seconds.len() / 2] * 1e9),
        evaluations_per_impact: per_impact(counted.evaluations as f64),
        searches_per_impact: per_impact(counted.searches as f64),
        pieces_per_impact: per_impact(counted.pieces as f64),
        undecided: counted.undecided,
        contact_phases: counted.contact_phases,
        seconds: seconds[0],
        setup_seconds,
        peak_mib: peak_mib(),
    })
}

/// Runs all engines to `until`; wall time and what they counted together.
fn repeat(
    mut engines: Vec<Engine>,
    until: f64,
    threads: usize,
) -> Result<(f64, Counters), Failure> {
    threads::run(Some(threads), || {
        let began = Instant::now();
        let run = |engine: &mut Engine| engine.run(until, |_| true);
        let run = engines.par_iter_mut().with_max_len(1).map(run).collect::<Result<(), Error>>();
        let seconds = began.elapsed().as_secs_f64();
        run.map_err(|error| Failure::run(error.to_string()))?;
        let mut sum = Counters::default();
        for own in engines.iter().map(Engine::counters) {
            sum.impacts += own.impacts;
            sum.contact_phases += own.contact_phases;
            sum.searches += own.searches;
            sum.pieces += own.pieces;
            sum.evaluations += own.evaluations;
            sum.undecided += own.undecided;
        }
        Ok((seconds, sum))
    })
}

/// Largest resident memory of this process so far, where the system tells it.
fn peak_mib() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok().map(|kib| kib / 1024.0)
}

/// A scenario file.
#[derive(Serialize)]
struct Form<'a> {
    spacing: f64,
    natural_frequency: f64,
    forcing_frequency: f64,
    restitution: f64,
    boundary: Boundary,
    initial: &'static str,
    forcing: &'a [[f64; 2]],
}

fn form(scenario: &Scenario) -> Form<'_> {
    Form {
        spacing: scenario.spacing,
        natural_frequency: scenario.natural_frequency,
        forcing_frequency: scenario.forcing_frequency,
        restitution: scenario.restitution,
        boundary: scenario.boundary,
        initial: "rest",
        forcing: &scenario.forcing,
    }
}

/// JSON on standard output; who closes the pipe has read enough.
fn print(what: &impl Serialize) -> Result<(), Failure> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    let written = serde_json::to_writer_pretty(&mut out, what).map_err(io::Error::from);
    stdout::written(written.and_then(|()| writeln!(out)).and_then(|()| out.flush()))
}

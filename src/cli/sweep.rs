//! `impact-paper sweep`.

use super::{Failure, memory, sigmas, signals, stdout, threads};
use impact_chain::counts::{NEAR_DECADES, SLOW_DECADES};
use impact_chain::rise;
use impact_chain::search::clock::LATEST;
use impact_chain::{Boundary, Chain, Counts, Engine, Ensemble, Protocol, Start};
use impact_paper::experiments::{Error, Progress};
use impact_paper::params::SEED;
use literate::input::one_line;
use rayon::prelude::*;
use serde::Serialize;
use std::io::{self, Write};

/// Runs an ensemble of random chains at each σ and prints one row for each σ.
///
/// A row counts the distinct gaps that impact in the window (T, T + W]; realisations without any
/// are not kept. Realisation i has the same standard normals at every σ. Rows come together at the
/// end, so that Ctrl-C (exit code 130) leaves no half a table. Realisations that the engine ended
/// early, and rows with more than a tenth of the starts rejected, are named on stderr.
#[derive(clap::Args)]
pub struct Args {
    /// Standard deviations: a list 0.1,0.12 or a range A..B:STEP (B included when hit).
    #[arg(long, value_name = "A..B:STEP|LIST", allow_hyphen_values = true)]
    sigma: String,
    /// Number of masses n.
    #[arg(long, value_name = "n", default_value_t = 100, allow_hyphen_values = true)]
    masses: usize,
    /// Realisations at each σ.
    #[arg(long, value_name = "R", default_value_t = 1000, allow_hyphen_values = true)]
    realisations: usize,
    /// Transient T that is dropped, in units of 1/ω.
    #[arg(long, value_name = "T", default_value_t = 500.0, allow_hyphen_values = true)]
    transient: f64,
    /// Window W in which impacts are counted, in units of 1/ω.
    #[arg(long, value_name = "W", default_value_t = 200.0, allow_hyphen_values = true)]
    window: f64,
    /// Coefficient of restitution r, from 0 to 1.
    #[arg(long, value_name = "r", default_value_t = 0.8, allow_hyphen_values = true)]
    restitution: f64,
    /// How a realisation starts: at rest, without free part, or with a random one.
    #[arg(long, value_name = "START", default_value = "rest")]
    initial: Initial,
    /// What stands at the ends.
    #[arg(long, value_name = "BOUNDARY", default_value = "walls")]
    boundary: Ends,
    /// Master seed of the random streams.
    #[arg(long, value_name = "S", default_value_t = SEED, allow_hyphen_values = true)]
    seed: u64,
    /// Number of threads; all cores without it. It changes no bit of the result.
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = threads::read)]
    threads: Option<usize>,
    /// Form of the table.
    #[arg(long, default_value = "csv")]
    format: Format,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Initial {
    Rest,
    Zero,
    Random,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Ends {
    Walls,
    Ring,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Format {
    Csv,
    Json,
}

/// One printed row; the names are the columns.
#[derive(Debug, Serialize)]
struct Row {
    sigma: f64,
    realisations: usize,
    kept: usize,
    rejected: usize,
    mean_distinct: Option<f64>,
    standard_error: Option<f64>,
    mode_distinct: Option<usize>,
    impacts_per_time: Option<f64>,
    impacts: u64,
    near_simultaneous: u64,
    slow: u64,
    contact_phases: u64,
}

pub fn run(args: Args) -> Result<(), Failure> {
    let ensemble = ensemble(&args)?;
    fits(&args)?;
    let progress = signals::progress();
    let rows = threads::run(args.threads, || rows(&ensemble, &progress))?;
    stdout::written(write(&rows, args.format))
}

/// Checks what the engine cannot check.
fn ensemble(args: &Args) -> Result<Ensemble, Failure> {
    let sigmas = sigmas::parse(&args.sigma).map_err(|e| Failure::input(one_line(&e, 500)))?;
    let at_least_one = |name: &str, value: usize| {
        let message = format!("--{name}: 0 is not allowed; give 1 or more");
        if value == 0 { Err(Failure::input(message)) } else { Ok(()) }
    };
    at_least_one("masses", args.masses)?;
    at_least_one("realisations", args.realisations)?;
    if args.transient.is_nan() || args.transient < 0.0 {
        let message = format!("--transient: {:?} is not allowed; give 0 or more", args.transient);
        return Err(Failure::input(message));
    }
    // A window that is lost in the rounding of T has no impact in it.
    if !args.window.is_finite() || args.window < 1e-3 {
        let message = format!("--window: {:?} is not allowed; give 0.001 or more", args.window);
        return Err(Failure::input(message));
    }
    if args.transient + args.window > LATEST {
        let message = "--transient, --window: they end after t = 1e12; give shorter ones";
        return Err(Failure::input(message));
    }
    if !(0.0..=1.0).contains(&args.restitution) {
        let message =
            format!("--restitution: {:?} is not in [0, 1]; give e.g. 0.8", args.restitution);
        return Err(Failure::input(message));
    }
    Ok(Ensemble {
        name: "sweep".into(),
        chain: Chain {
            masses: args.masses,
            restitution: args.restitution,
            boundary: match args.boundary {
                Ends::Walls => Boundary::Walls,
                Ends::Ring => Boundary::Ring,
            },
            start: match args.initial {
                Initial::Rest => Start::Rest,
                Initial::Zero => Start::Zero,
                Initial::Random => Start::Random,
            },
            ..Chain::default()
        },
        protocols: vec![Protocol { transient: args.transient, window: args.window }],
        sigmas,
        realisations: args.realisations,
        stream: "sweep".into(),
        seed: args.seed,
        ..Ensemble::default()
    })
}

/// Bytes that the counts of a realisation take until those of its σ are joined, as an upper bound.
const OUTCOME: u128 = 2 << 10;

/// Refuses an ensemble that is too large for the memory: each thread has a chain, and a few words for each of
/// its gaps besides.
fn fits(args: &Args) -> Result<(), Failure> {
    let threads = args.threads.unwrap_or_else(threads::cores) as u128;
    let chain = Engine::memory(args.masses, 1) + 64 * args.masses as u128;
    let needed = threads * chain + OUTCOME * args.realisations as u128;
    memory::fits(needed, "--masses, --realisations", "give fewer")
}

/// Runs σ after σ.
fn rows(ensemble: &Ensemble, progress: &Progress) -> Result<Vec<Row>, Failure> {
    let work = |&sigma: &f64| ensemble.work(sigma).saturating_mul(ensemble.realisations as u64);
    let stage =
        progress.stage("sweep", ensemble.sigmas.iter().map(work).fold(0, u64::saturating_add));
    let mut rows = Vec::with_capacity(ensemble.sigmas.len());
    for &sigma in &ensemble.sigmas {
        let one = |index| {
            progress.check()?;
            let counts = ensemble.realisation(sigma, index as u64, || progress.stopped());
            stage.advance(ensemble.work(sigma));
            progress.check()?;
            counts.map_err(|source| Error::failed("sweep", source))
        };
        let counts: Result<Vec<Counts>, Error> =
            (0..ensemble.realisations).into_par_iter().with_max_len(1).map(one).collect();
        let counts: Counts = counts?.into_iter().collect();
        let (of, all) = (counts.rejected, ensemble.realisations);
        if let Some(first) = &counts.first_failure {
            stage.say(&format!(
                "impact-paper: sigma {sigma:?}: {} of {all} realisations ended early and are in no \
                 mean; the first: {first}",
                counts.failed
            ));
        }
        if of as f64 > ensemble.most_rejected * all as f64 {
            stage.say(&format!(
                "impact-paper: sigma {sigma:?}: {of} of {all} starts overlapped and were rejected; the \
                 row is not comparable with others"
            ));
        }
        let row = rise::Row::new(sigma, &counts, 0, ensemble.chain.gaps(), [None; 2]);
        let total = &counts.total;
        rows.push(Row {
            sigma,
            realisations: all,
            kept: row.kept,
            rejected: of,
            mean_distinct: row.mean.map(|mean| mean.value),
            standard_error: row.mean.and_then(|mean| mean.error),
            mode_distinct: row.mode,
            impacts_per_time: row.impacts.map(|mean| mean.value / ensemble.protocols[0].window),
            impacts: total.impacts,
            near_simultaneous: total.near[NEAR_DECADES.len() - 1],
            slow: total.slow[SLOW_DECADES.len() - 1],
            contact_phases: total.contact_phases,
        });
    }
    Ok(rows)
}

fn write(rows: &[Row], format: Format) -> io::Result<()> {
    let mut out = io::BufWriter::new(io::stdout().lock());
    match format {
        Format::Csv => {
            let mut csv = csv::Writer::from_writer(&mut out);
            for row in rows {
                csv.serialize(row).map_err(|error| match error.into_kind() {
                    csv::ErrorKind::Io(error) => error,
                    other => io::Error::other(format!("{other:?}")),
                })?;
            }
            csv.flush()?;
        }
        Format::Json => {
            serde_json::to_writer_pretty(&mut out, rows)?;
            writeln!(out)?;
        }
    }
    out.flush()
}

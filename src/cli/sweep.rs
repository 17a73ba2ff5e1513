//! Runs the verb `sweep`: an ensemble, with a row for each σ.

use super::range::{MOST_VALUES, Values, number, numbers};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use impact_chain::counts::{NEAR_DECADES, SLOW_DECADES};
use impact_chain::rise::{Column, Mean, RisePoint};
use impact_chain::{Boundary, Chain, Counts, Graze, LATEST, Protocol, Start};
use impact_paper::experiments::Progress;
use impact_paper::experiments::ensembles::CUTTING;
use impact_paper::params::{Ensemble, SEED, windows};
use literate::Failure;
use literate::cli::terminal::{Threads, print, warn};
use literate::experiments::cutting::Cutting;
use literate::table::{DataFile, shortest};
use serde_json::from_value;
use std::ops::Range;

#[derive(clap::Args)]
#[command(about = "Run an ensemble of random chains at each σ and print a row for each σ")]
#[command(long_about = include_str!("sweep.txt"), after_help = help())]
pub struct Args {
    /// Standard deviations: a list 0.1,0.12 or a range A..B:STEP (B included when hit).
    #[arg(long, value_name = "A..B:STEP|LIST", allow_hyphen_values = true, value_parser = numbers(0.0, 1e6, MOST_VALUES))]
    sigma: Values,
    /// Number of masses n.
    #[arg(long, value_name = "n", default_value_t = 100, value_parser = at_least_one)]
    masses: usize,
    /// Realisations at each σ: their number, or A..B for those from A up to B − 1.
    #[arg(long, value_name = "R|A..B", default_value = "1000", value_parser = realisations)]
    realisations: Range<u64>,
    /// Transients T that are dropped, in units of time: a list or a range.
    #[arg(long, value_name = "T", default_value = "500", value_parser = numbers(0.0, LATEST, MOST_VALUES), allow_hyphen_values = true)]
    transient: Values,
    /// Windows W in which impacts are counted, in units of time: a list or a range.
    #[arg(long, value_name = "W", default_value = "200", value_parser = numbers(1e-3, LATEST, MOST_VALUES), allow_hyphen_values = true)]
    window: Values,
    /// Natural frequency ω.
    #[arg(long, value_name = "w", default_value = "1", value_parser = number(1e-3, 1e3), allow_hyphen_values = true)]
    natural_frequency: f64,
    /// Forcing frequency Ω, different from ω [default: √2].
    #[arg(long, value_name = "Omega", value_parser = number(1e-3, 1e3), allow_hyphen_values = true)]
    forcing_frequency: Option<f64>,
    /// Distance d between neighbouring places of the masses.
    #[arg(long, value_name = "d", default_value = "1", value_parser = number(1e-6, 1e6), allow_hyphen_values = true)]
    spacing: f64,
    /// Coefficient of restitution r.
    #[arg(long, value_name = "r", default_value = "0.8", value_parser = number(0.0, 1.0), allow_hyphen_values = true)]
    restitution: f64,
    /// How a realisation starts: at rest, without free part, or with a random one.
    #[arg(long, value_name = "START", default_value = "rest", value_parser = PossibleValuesParser::new(["rest", "zero", "random"]).try_map(|name| from_value::<Start>(name.into())))]
    initial: Start,
    /// What stands at the ends.
    #[arg(long, value_name = "BOUNDARY", default_value = "walls", value_parser = PossibleValuesParser::new(["walls", "ring"]).try_map(|name| from_value::<Boundary>(name.into())))]
    boundary: Boundary,
    /// Master seed of the random streams.
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    #[command(flatten)]
    threads: Threads,
}

fn at_least_one(text: &str) -> Result<usize, String> {
    let number: Option<usize> = text.parse().ok();
    number.filter(|&n| n > 0).ok_or_else(|| "give a whole number, 1 or more".into())
}

fn realisations(text: &str) -> Result<Range<u64>, String> {
    let (from, to) = text.split_once("..").unwrap_or(("0", text));
    let range = from.parse().ok().zip(to.parse().ok()).map(|(from, to)| from..to);
    let some = range.filter(|range: &Range<u64>| !range.is_empty());
    some.ok_or_else(|| "give a whole number, 1 or more, or a range A..B".into())
}

/// The realisations at one σ in one window.
struct Row<'a> {
    ensemble: &'a Ensemble,
    counts: &'a Counts,
    point: RisePoint,
    protocol: Protocol,
}

/// Writes the cell of a row; a missing number is an empty cell.
type Cell = fn(&Row) -> String;

/// The columns: name, meaning and cells.
const COLUMNS: [(&str, &str, Cell); 18] = [
    ("sigma", "standard deviation of the amplitudes", |row| shortest(row.point.sigma)),
    ("realisations", "chains drawn", |row| row.ensemble.realisations.to_string()),
    ("kept", "those with an impact in the window", |row| row.point.active.to_string()),
    ("rejected", "those whose start overlaps", |row| row.counts.rejected.to_string()),
    ("mean_distinct", "different gaps with an impact in the window, mean of the kept", |row| {
        value(row.point.mean)
    }),
    ("standard_error", "of this mean", |row| error(row.point.mean)),
    ("mode_distinct", "most frequent number among the kept, the lowest if several", |row| {
        row.point.mode.map_or_else(String::new, |mode| mode.to_string())
    }),
    ("impacts_per_time", "impacts in the window over W, mean of the kept", |row| {
        real(row.point.impacts.map(|mean| mean.value / row.protocol.window))
    }),
    ("impacts", "impacts in whole runs, including transients", |row| {
        row.counts.total.impacts.to_string()
    }),
    ("near_simultaneous", "those within 1e-9 of one in an adjacent gap, whatever w is", |row| {
        row.counts.total.near[NEAR_DECADES.len() - 1].to_string()
    }),
    ("slow", "those with a closing speed below 1e-8, whatever d and w are", |row| {
        row.counts.total.slow[SLOW_DECADES.len() - 1].to_string()
    }),
    ("contact_phases", "times that a gap came to rest in contact", |row| {
        row.counts.total.contact_phases.to_string()
    }),
    ("mean_all", "different gaps with an impact, mean of all that ran", |row| {
        value(row.point.mean_all)
    }),
    ("standard_error_all", "of this mean", |row| error(row.point.mean_all)),
    ("simultaneous", "impacts at exactly the instant of one in an adjacent gap", |row| {
        row.counts.total.simultaneous.to_string()
    }),
    ("undecided", "grazes that rounding could not decide, taken for misses", |row| {
        row.counts.total.undecided.to_string()
    }),
    ("transient", "T", |row| shortest(row.protocol.transient)),
    ("window", "W", |row| shortest(row.protocol.window)),
];

fn real(number: Option<f64>) -> String {
    number.map_or_else(String::new, shortest)
}

fn value(mean: Option<Mean>) -> String {
    real(mean.map(|mean| mean.value))
}

fn error(mean: Option<Mean>) -> String {
    real(mean.and_then(|mean| mean.error))
}

fn help() -> String {
    let lines = COLUMNS.map(|(name, meaning, _)| format!("  {name:<19} {meaning}\n"));
    format!("Columns:\n{}", lines.concat())
}

pub fn run(args: Args) -> Result<(), Failure> {
    let chain = Chain {
        masses: args.masses,
        spacing: args.spacing,
        natural_frequency: args.natural_frequency,
        forcing_frequency: args.forcing_frequency.unwrap_or(Chain::default().forcing_frequency),
        restitution: args.restitution,
        boundary: args.boundary,
        start: args.initial,
    };
    if chain.forcing_frequency == chain.natural_frequency {
        let message =
            "--forcing-frequency: it equals the natural frequency (resonance); choose another";
        return Err(Failure::input(message));
    }
    let protocols = windows(&args.transient, &args.window);
    let end = protocols.iter().map(Protocol::end).fold(0.0, f64::max);
    if end > LATEST {
        let message =
            format!("--transient, --window: they end after {LATEST:?}; give shorter ones");
        return Err(Failure::input(message));
    }
    let number = args.realisations.end - args.realisations.start;
    let realisations = usize::try_from(number).unwrap_or(usize::MAX);
    let ensemble = Ensemble {
        name: "sweep".into(),
        chain,
        protocols,
        sigmas: args.sigma.to_vec(),
        first: args.realisations.start,
        realisations,
        stream: "sweep".into(),
        seed: args.seed,
        ..Ensemble::default()
    };
    // Each thread has a chain, 300 bytes a mass and some for its gaps; realisations leave counts.
    let threads = args.threads.number() as u128;
    check_memory(threads * 360 * args.masses as u128 + (1 << 10) * realisations as u128)?;
    let rows = args.threads.run(|| rows(ensemble, &Progress::on_stderr()))?;
    let header = COLUMNS.map(|(name, ..)| name.to_string()).into();
    print(&DataFile { name: "sweep.csv".into(), header, rows }.to_csv())
}

/// Runs the ensemble, and returns the cells of a row for each σ and window.
fn rows(ensemble: Ensemble, progress: &Progress) -> Result<Vec<Vec<String>>, Failure> {
    let cutting: Cutting<Vec<Ensemble>, Counts, Vec<Counts>> = Cutting {
        rows: CUTTING.rows,
        run_unit: CUTTING.run_unit,
        join: |_, parts, _| Ok(parts.into_iter().map(Counts::from_iter).collect()),
    };
    let ensembles = vec![ensemble];
    let counts = cutting.run(&ensembles, "sweep", progress)?;
    let (ensemble, mut rows) = (&ensembles[0], Vec::new());
    let largest = ensemble.chain.gaps();
    for (&sigma, counts) in ensemble.sigmas.iter().zip(&counts) {
        warn_of_doubts(ensemble, sigma, counts);
        for (window_index, &protocol) in ensemble.protocols.iter().enumerate() {
            let point = RisePoint::new(sigma, counts, Column { window_index, largest });
            let row = Row { ensemble, counts, point, protocol };
            rows.push(COLUMNS.map(|(.., cell)| cell(&row)).into());
        }
    }
    Ok(rows)
}

/// Names what makes the rows of a σ doubtful.
fn warn_of_doubts(ensemble: &Ensemble, sigma: f64, counts: &Counts) {
    let doubt = |message: String| warn(&format!("sigma {sigma:?}: {message}"));
    let (drawn, rejected, failed) = (ensemble.realisations, counts.rejected, counts.failed);
    if failed > 0 {
        doubt(format!("{failed} of {drawn} realisations ended early and are in no mean"));
    }
    if !ensemble.is_comparable(sigma, rejected) {
        doubt(format!(
            "{rejected} of {drawn} starts overlapped and were rejected; the row is not comparable with others"
        ));
    }
    let total = &counts.total;
    if total.simultaneous > total.impacts / 100 {
        doubt(format!(
            "{} of {} impacts came at exactly the same instant as one in a neighbouring gap; \
             they were taken fastest first, a choice that may matter where r > 0",
            total.simultaneous, total.impacts
        ));
    }
    if let Some((realisation, Graze { time, gap, .. })) = total.first_graze {
        doubt(format!(
            "rounding could not decide {} grazes, the first in realisation {realisation}, of \
             gap {gap} at t = {time:?}; each was taken for a miss",
            total.undecided
        ));
    }
}

/// Returns the bytes of memory that there are, of the machine or of the container where it has
/// less. Linux reports them, elsewhere 4 GiB are assumed.
fn available(read: impl Fn(&str) -> Option<String>) -> u128 {
    let memory = read("/proc/meminfo").unwrap_or_default();
    let free = memory.lines().find_map(|line| line.strip_prefix("MemAvailable:"));
    let kib = free.and_then(|line| line.split_whitespace().next()?.parse::<u128>().ok());
    // A container sees its own group as the top, of either version.
    let limits = ["/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"];
    let limits = limits.iter().filter_map(|path| read(path)?.trim().parse::<u128>().ok());
    limits.chain([kib.map_or(4 << 30, |kib| kib << 10)]).min().unwrap_or(0)
}

/// Refuses what needs more memory than there is, in bytes.
fn check_memory(needed: u128) -> Result<(), Failure> {
    // A process has at most half of all addresses.
    let available =
        available(|path| std::fs::read_to_string(path).ok()).min(usize::MAX as u128 / 2);
    if needed <= available {
        return Ok(());
    }
    let gib = |bytes: u128| format!("{:.1} GiB", bytes as f64 / f64::from(1 << 30));
    let (needed, available) = (gib(needed), gib(available));
    Err(Failure::input(format!(
        "--masses, --realisations: about {needed} of memory are needed and {available} are available; use fewer"
    )))
}

#[test]
fn memory_is_that_of_the_container_where_it_has_less() {
    for (file, limit, bytes) in [
        ("/sys/fs/cgroup/memory.max", "5000\n", 5000),
        ("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n", 7 << 10),
        ("/sys/fs/cgroup/memory.max", "max\n", 7 << 10),
    ] {
        let files = [("/proc/meminfo", "MemAvailable:   7 kB\n"), (file, limit)];
        let read = |path: &str| Some(files.iter().find(|file| file.0 == path)?.1.to_string());
        assert_eq!(available(read), bytes, "{limit}");
    }
}

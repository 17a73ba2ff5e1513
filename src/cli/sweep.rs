//! The verb `sweep`: runs an ensemble and prints a row for each σ.

use super::range::within;
use impact_chain::counts::{NEAR_DECADES, SLOW_DECADES};
use impact_chain::rise;
use impact_chain::{Boundary, Chain, Counts, Engine, Ensemble, Protocol, Start};
use impact_chain::{Graze, LATEST};
use impact_paper::experiments::Progress;
use impact_paper::experiments::ensembles::CUTTING;
use impact_paper::params::SEED;
use literate::Failure;
use literate::cli::terminal::{Threads, print, progress, warn};
use literate::experiments::cutting::Cutting;
use literate::figures::{DataFile, shortest};
use std::sync::Arc;

/// Run an ensemble of random chains at each σ and print a row for each σ
///
/// Examples:
///   sweep --sigma 0.08..0.16:0.01
///   sweep --sigma 0.12,0.13 --masses 1000 --realisations 100
///
/// Read in a row how many distinct gaps impact in the window (T, T + W]; realisations without any
/// are not kept. Realisation i has the same standard normals at every σ. Rows come together at the
/// end. Standard error names realisations that the engine ended early, and rows with more than a
/// tenth of the starts rejected.
#[derive(clap::Args)]
#[command(verbatim_doc_comment)]
pub struct Args {
    /// Standard deviations: a list 0.1,0.12 or a range A..B:STEP (B included when hit).
    #[arg(long, value_name = "A..B:STEP|LIST", allow_hyphen_values = true, value_parser = sigmas)]
    sigma: Sigmas,
    /// Number of masses n.
    #[arg(long, value_name = "n", default_value_t = 100, value_parser = at_least_one)]
    masses: usize,
    /// Realisations at each σ.
    #[arg(long, value_name = "R", default_value_t = 1000, value_parser = at_least_one)]
    realisations: usize,
    /// Transient T that is dropped, in units of 1/ω.
    #[arg(long, value_name = "T", default_value = "500", value_parser = within(0.0, LATEST), allow_hyphen_values = true)]
    transient: f64,
    /// Window W in which impacts are counted, in units of 1/ω.
    #[arg(long, value_name = "W", default_value = "200", value_parser = within(1e-3, LATEST), allow_hyphen_values = true)]
    window: f64,
    /// Coefficient of restitution r.
    #[arg(long, value_name = "r", default_value = "0.8", value_parser = within(0.0, 1.0), allow_hyphen_values = true)]
    restitution: f64,
    /// How a realisation starts: at rest, without free part, or with a random one.
    #[arg(long, value_name = "START", default_value = "rest", value_parser = ["rest", "zero", "random"])]
    initial: String,
    /// What stands at the ends.
    #[arg(long, value_name = "BOUNDARY", default_value = "walls", value_parser = ["walls", "ring"])]
    boundary: String,
    /// Master seed of the random streams.
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    #[command(flatten)]
    threads: Threads,
}

/// A list of σ, which is one value of the command line.
type Sigmas = std::sync::Arc<[f64]>;

fn at_least_one(text: &str) -> Result<usize, String> {
    let number: Option<usize> = text.parse().ok();
    number.filter(|&n| n > 0).ok_or_else(|| "give a whole number, 1 or more".into())
}

/// A printed row.
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
    let chain = Chain {
        masses: args.masses,
        restitution: args.restitution,
        boundary: if args.boundary == "ring" { Boundary::Ring } else { Boundary::Walls },
        start: match args.initial.as_str() {
            "zero" => Start::Zero,
            "random" => Start::Random,
            _ => Start::Rest,
        },
        ..Chain::default()
    };
    let ensemble = Ensemble {
        name: "sweep".into(),
        chain,
        protocols: vec![Protocol { transient: args.transient, window: args.window }],
        sigmas: args.sigma.to_vec(),
        realisations: args.realisations,
        stream: "sweep".into(),
        seed: args.seed,
        ..Ensemble::default()
    };
    // Each thread has a chain, and a few words for each of its gaps; each realisation leaves its
    // counts.
    let threads = args.threads.number() as u128;
    let chain = Engine::memory(args.masses, 1) + 64 * args.masses as u128;
    let needed = threads * chain + (1 << 10) * args.realisations as u128;
    fits(needed)?;
    if args.transient + args.window > LATEST {
        return Err(Failure::input(
            "--transient, --window: they end after t = 1e12; give shorter ones",
        ));
    }
    let progress = progress();
    let rows = args.threads.run(|| rows(ensemble, &progress))?;
    print(&table(&rows))
}

/// Returns the rows as CSV; a number that there is not is an empty cell.
fn table(rows: &[Row]) -> String {
    let columns = [
        "sigma",
        "realisations",
        "kept",
        "rejected",
        "mean_distinct",
        "standard_error",
        "mode_distinct",
        "impacts_per_time",
        "impacts",
        "near_simultaneous",
        "slow",
        "contact_phases",
    ];
    let real = |value: Option<f64>| value.map_or_else(String::new, shortest);
    let cells = |row: &Row| {
        vec![
            shortest(row.sigma),
            row.realisations.to_string(),
            row.kept.to_string(),
            row.rejected.to_string(),
            real(row.mean_distinct),
            real(row.standard_error),
            row.mode_distinct.map_or_else(String::new, |mode| mode.to_string()),
            real(row.impacts_per_time),
            row.impacts.to_string(),
            row.near_simultaneous.to_string(),
            row.slow.to_string(),
            row.contact_phases.to_string(),
        ]
    };
    let rows = rows.iter().map(cells).collect();
    DataFile { name: "sweep.csv".into(), header: columns.map(String::from).into(), rows }.csv()
}

fn rows(ensemble: Ensemble, progress: &Progress) -> Result<Vec<Row>, Failure> {
    let cutting: Cutting<Vec<Ensemble>, Counts, Vec<Counts>> = Cutting {
        rows: CUTTING.rows,
        part: CUTTING.part,
        join: |_, parts, _| {
            Ok(parts.into_iter().map(|parts| parts.into_iter().collect()).collect())
        },
    };
    let all = vec![ensemble];
    let counts = cutting.run(&all, "sweep", progress)?;
    let row = |(&sigma, counts): (&f64, &Counts)| row(&all[0], sigma, counts);
    Ok(all[0].sigmas.iter().zip(&counts).map(row).collect())
}

fn row(ensemble: &Ensemble, sigma: f64, counts: &Counts) -> Row {
    let (all, rejected) = (ensemble.realisations, counts.rejected);
    if counts.failed > 0 {
        let failed = counts.failed;
        warn(&format!(
            "sigma {sigma:?}: {failed} of {all} realisations ended early and are in no mean"
        ));
    }
    if rejected as f64 > ensemble.most_rejected * all as f64 {
        warn(&format!(
            "sigma {sigma:?}: {rejected} of {all} starts overlapped and were rejected; the row is not \
             comparable with others"
        ));
    }
    let total = &counts.total;
    if total.simultaneous > total.impacts / 100 {
        warn(&format!(
            "sigma {sigma:?}: {} of {} impacts came at exactly the same instant as one in a neighbouring gap; \
             their order is a choice (fastest first), which may matter",
            total.simultaneous, total.impacts
        ));
    }
    if let Some((realisation, Graze { time, gap })) = total.first_graze {
        warn(&format!(
            "sigma {sigma:?}: rounding could not decide {} grazes, the first in realisation {realisation}, of \
             gap {gap} at t = {time:?}; each was taken for a miss",
            total.undecided
        ));
    }
    let row = rise::RisePoint::new(sigma, counts, 0, ensemble.chain.gaps(), [None; 2]);
    Row {
        sigma,
        realisations: all,
        kept: row.kept,
        rejected,
        mean_distinct: row.mean.map(|mean| mean.value),
        standard_error: row.mean.and_then(|mean| mean.error),
        mode_distinct: row.mode,
        impacts_per_time: row.impacts.map(|mean| mean.value / ensemble.protocols[0].window),
        impacts: total.impacts,
        near_simultaneous: total.near[NEAR_DECADES.len() - 1],
        slow: total.slow[SLOW_DECADES.len() - 1],
        contact_phases: total.contact_phases,
    }
}

/// Refuses what needs more memory than there is, in bytes.
fn fits(needed: u128) -> Result<(), Failure> {
    // Linux reports it, elsewhere 4 GiB are assumed. A process has at most half of all addresses.
    let text = std::fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let free = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"));
    let kib = free.and_then(|line| line.split_whitespace().next()?.parse::<u128>().ok());
    let available = kib.map_or(4 << 30, |kib| kib << 10).min(usize::MAX as u128 / 2);
    if needed <= available {
        return Ok(());
    }
    let gib = |bytes: u128| format!("{:.1} GiB", bytes as f64 / f64::from(1 << 30));
    let (needed, available) = (gib(needed), gib(available));
    Err(Failure::input(format!(
        "--masses, --realisations: about {needed} of memory are needed and {available} are available; use fewer"
    )))
}

/// A range with this many values or more is taken for a mistake.
const MOST_VALUES: f64 = 1e5;

/// Reads a list or a range of standard deviations, in units of d ω².
///
/// A range is A + i·STEP, rounded to the decimals of A and STEP, so that 0.1..0.2:0.02 holds the
/// same double 0.12 as a list does; B belongs to it when it is hit within STEP/1000.
///
/// # Errors
/// One line with what is wrong and what to write.
fn sigmas(text: &str) -> Result<Arc<[f64]>, String> {
    // With larger ones rounding would hide the spacing of 1 (see `impact_chain::rounding`).
    let number = |text: &str| within(0.0, 1e6)(text).map_err(|what| format!("{text:?}: {what}"));
    let Some((from, rest)) = text.split_once("..") else {
        return text.split(',').map(number).collect();
    };
    let (to, step) = rest.split_once(':').ok_or("the range has no step; write A..B:STEP")?;
    let [a, b, h] = [number(from)?, number(to)?, number(step)?];
    let steps = ((b - a) / h + 1e-3).floor();
    if !(0.0..MOST_VALUES).contains(&steps) {
        return Err("write a range of 1 to 100000 values, the smaller end first: A..B:STEP".into());
    }
    let decimals = |text: &str| match text.trim().split_once('.') {
        _ if text.contains(['e', 'E']) => 17,
        Some((_, decimals)) => decimals.len(),
        None => 0,
    };
    let places = decimals(from).max(decimals(step));
    let value = |i: u32| number(&format!("{:.places$}", a + f64::from(i) * h));
    (0..=steps as u32).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::sigmas;

    #[test]
    fn lists_and_ranges() {
        let read = |text: &str| sigmas(text).unwrap().to_vec();
        assert_eq!(read("0.1,0.12"), [0.1, 0.12]);
        assert_eq!(read(" 0.3 "), [0.3]);
        // 0.1 + 0.02 is 0.12000000000000001 in binary; in decimals it is 0.12.
        assert_eq!(read("0.1..0.14:0.02"), [0.1, 0.12, 0.14]);
        assert_eq!(read("0.1..0.15:0.02"), [0.1, 0.12, 0.14]);
        assert_eq!(read("0..0.001:5e-4"), [0.0, 5e-4, 1e-3]);
        assert_eq!(read("0.12..0.12:1"), [0.12]);
        // Three steps of 0.033333 end 1e−6 below 0.1: not short by STEP/1000.
        assert_eq!(read("0..0.1:0.033333").len(), 4);
        assert_eq!(read("0..0.1:0.03334").len(), 4);
        assert_eq!(read("0..0.1:0.0334").len(), 3);
        for wrong in ["0.2..0.1:0.01", "0.1..0.2:0", "0.1..0.2", "x", "0..1e6:1", "-0.1", "NaN"] {
            assert!(sigmas(wrong).is_err(), "{wrong}");
        }
    }
}

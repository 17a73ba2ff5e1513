//! `impact-paper trace`.

use super::{Failure, memory, method, stdout};
use impact_chain::methods::State;
use impact_chain::search::clock::LATEST;
use impact_chain::{Engine, Error, Impact, Scenario, rounding};
use impact_numerics::text::count;
use impact_paper::experiments::{alive, say};
use literate::input;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::atomic::{AtomicBool, AtomicU64};

/// Prints the impacts of one scenario as CSV: time, gap, closing speed
///
/// Examples:
///   impact-paper trace chain.json --until 100
///   impact-paper trace - --until 100 --max-impacts 20 < chain.json
///   impact-paper trace chain.json --until 100 --method verlet --step 0.01
///   impact-paper trace chain.json --until 100 --method truth
///
/// Count gaps from the left wall: gap 0 lies between it and mass 1, gap j between masses j and
/// j + 1; on a ring gap n lies between masses n and 1. Of neighbouring gaps that close at exactly
/// the same instant the lowest is taken first; of the method certified, standard error says how often.
///
/// Do not trust single impacts far into a chaotic run: errors grow about tenfold in a dozen units
/// of time. Compare with --method truth to see from where on a run is off. The truth has every
/// time to 106 bits, but only for walls, one frequency and no contact; it asks the engine which
/// gap is next, so it cannot show an impact that the engine misses.
///
/// Give smaller amplitudes where rounding may move a gap by more than 1e-6 of the spacing (near
/// resonance, say): they are refused. From 1e-9 on, standard error says by how much (methods in
/// closed form). Bodies that part more slowly than 1e-10 d w stay in contact while forces press
/// them.
#[derive(clap::Args)]
#[command(verbatim_doc_comment, after_help = FORM)]
pub struct Args {
    /// Read the scenario from this JSON file (the form is below), 64 MiB at most; - for standard input.
    #[arg(value_name = "SCENARIO.json")]
    scenario: PathBuf,
    /// Stop at this time, from 0 to 1e12.
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    until: f64,
    /// Stop after this many impacts.
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    max_impacts: Option<u64>,
    #[command(flatten)]
    method: method::Choice,
}

const FORM: &str = r#"The scenario, with the defaults of everything but "forcing":
  {"spacing": 1, "natural_frequency": 1, "forcing_frequency": 1.4142135623730951,
   "restitution": 0.8, "boundary": "walls", "initial": "rest",
   "forcing": [[alpha_1, beta_1], ..., [alpha_n, beta_n]]}
Several components of the forcing, 8 at most:
   "forcing_frequencies": [W_1, W_2, ...], "forcing": [[[alpha_1, beta_1], ...], [[...], ...], ...]
boundary: "walls" or "ring".
initial:  "rest" (at equilibrium), "zero" (no free part),
          {"free": [[a_1, b_1], ...]} (x_j = j d + a_j cos wt + b_j sin wt + forced response),
          {"at": {"positions": [x_1, ...], "velocities": [v_1, ...]}} (from the left wall),
          {"random": {"sigma": s, "seed": k}} (normal free parts)."#;

/// What rounding does to the times of a scenario with large amplitudes; nothing where it is little.
fn rounded(scenario: &Scenario) -> Option<String> {
    let width = rounding::width(scenario);
    (width > rounding::TOLD * scenario.spacing).then(|| {
        format!(
            "rounding of large amplitudes may move each impact at closing speed v by {width:.1e}/v, and errors grow \
             from impact to impact"
        )
    })
}

/// What is said of impacts of several neighbouring gaps at once.
fn simultaneous(count: u64) -> String {
    let times = if count == 1 { "once" } else { &format!("{count} times") };
    format!(
        "impact-paper: {times}, neighbouring gaps closed at exactly the same instant; \
         they were taken one after the other, lowest gap first"
    )
}

/// Bytes that a number takes while a list grows: the old place, and the new one of twice its length.
const NUMBER: u128 = 3 * size_of::<f64>() as u128;

/// So much is printed at once, in bytes.
const BLOCK: usize = 16 << 10;

pub fn run(args: Args) -> Result<(), Failure> {
    if !(0.0..=LATEST).contains(&args.until) {
        let message =
            format!("--until: {:?} is out of range; give a time from 0 to 1e12", args.until);
        return Err(Failure::input(message));
    }
    let path = args.scenario.as_path();
    let piped = path == Path::new("-");
    let name = if piped { "standard input".into() } else { path.display().to_string() };
    let text = if piped { input::read_from(io::stdin()) } else { input::read(path) };
    let text = text.map_err(|error| {
        let remedy = match error.kind() {
            ErrorKind::InvalidInput | ErrorKind::OutOfMemory => "give a scenario of fewer masses",
            _ if piped => "write a scenario into it",
            _ => "give the path of a readable scenario file",
        };
        Failure::input(format!("{name}: {error}; {remedy}"))
    })?;
    let in_file = |error: Error| match error {
        Error::Work { .. } => Failure::run(error.to_string()),
        Error::Input { ref field, .. } if ["step", "tolerance"].contains(&field.as_str()) => {
            Failure::input(format!("--{error}"))
        }
        Error::Input { .. } | Error::Overlap { .. } => Failure::input(format!("{name}: {error}")),
    };
    let numbers = text.bytes().filter(|byte| *byte == b',').count() as u128;
    let most = NUMBER * numbers + Engine::memory(numbers as usize / 2, 1);
    memory::fits(most, &name, "give fewer masses")?;
    let scenario = Scenario::from_json(&text).map_err(in_file)?;
    let (masses, components) = (scenario.forcing.len(), 1 + scenario.overtones.len());
    memory::fits(Engine::memory(masses, components), &name, "give fewer masses")?;
    let (method, start) = (args.method.method()?, State::of(&scenario));
    // Written in whole lines: a signal that ends the program leaves no half of a number.
    let (mut out, mut lines) = (io::stdout().lock(), String::new());
    let mut written = Ok(());
    let mut header = "time,gap,closing_speed\n";
    let mut left = args.max_impacts.unwrap_or(u64::MAX);
    // Impacts so far, the time of the last, and whether a reader is waited for.
    let told = Arc::new((AtomicU64::new(0), AtomicU64::new(0), AtomicBool::new(false)));
    let _alive = alive({
        let told = Arc::clone(&told);
        move || {
            let (met, latest, waits) = &*told;
            let impacts = count(met.load(Relaxed) as usize, "impact");
            let last = match f64::from_bits(latest.load(Relaxed)) {
                0.0 => " yet".to_owned(),
                latest => format!(", the last at t = {latest:?}"),
            };
            (!waits.load(Relaxed)).then(|| format!("trace: {impacts}{last}"))
        }
    });
    let mut sink = |impact: Impact| {
        let Impact { time, gap, closing_speed } = impact;
        told.0.fetch_add(1, Relaxed);
        told.1.store(time.to_bits(), Relaxed);
        if left > 0 {
            // A run that is refused at its start prints nothing.
            lines.push_str(std::mem::take(&mut header));
            lines.push_str(&format!("{time:?},{gap},{closing_speed:?}\n"));
            left -= 1;
            if lines.len() >= BLOCK {
                told.2.store(true, Relaxed);
                written = out.write_all(lines.as_bytes());
                told.2.store(false, Relaxed);
                lines.clear();
            }
        }
        left > 0 && written.is_ok()
    };
    let until = if args.max_impacts == Some(0) { 0.0 } else { args.until };
    let ran = method.run(&scenario, &start, until, &mut sink);
    // What was found before a run was stopped is printed; a run that is refused at its start prints nothing.
    if ran.is_ok() {
        lines.push_str(header);
    }
    let written = written.and_then(|()| out.write_all(lines.as_bytes()));
    let rounded = rounded(&scenario).filter(|_| args.method.is_closed());
    let cost = match (ran, written.and_then(|()| out.flush())) {
        (_, Err(error)) => return stdout::written(Err(error)),
        (Ok(cost), Ok(())) => cost,
        (Err(error), Ok(())) => {
            // The impacts of a run that was stopped have the same rounding.
            if let Some(rounded) = rounded.filter(|_| matches!(error, Error::Work { .. })) {
                say(&format!("impact-paper: {rounded}"));
            }
            return Err(in_file(error));
        }
    };
    if cost.simultaneous > 0 {
        say(&simultaneous(cost.simultaneous));
    }
    if let Some(rounded) = rounded {
        say(&format!("impact-paper: {rounded}"));
    }
    Ok(())
}

//! `impact-paper trace`.

use super::{Failure, memory, method, stdout};
use impact_paper::dynamics::methods::State;
use impact_paper::dynamics::{
    Certificate, Engine, Error, Impact, Scenario, Sensitivity, Simultaneous, TWINS, certify,
    rounding,
};
use impact_paper::experiments::{alive, say};
use impact_paper::input;
use impact_paper::numerics::clock::LATEST;
use impact_paper::numerics::text::count;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::atomic::{AtomicBool, AtomicU64};

/// Prints the impacts of one scenario as CSV: time, gap, closing speed.
///
/// Gap 0 lies between the left wall and mass 1, gap j between masses j and j + 1; on a ring gap n
/// lies between masses n and 1. Neighbouring gaps that close at exactly the same instant (a three-way
/// impact) follow the law "simultaneous" of the scenario; how often there were such is said on
/// standard error, if there were any. Past some 150 units of time a chaotic chain depends on the last
/// bit: only statistics are reproducible there. --certify says where that begins. Amplitudes so large
/// (near resonance, say) that rounding may move a gap by more than 1e-6 of the spacing are refused; where it
/// may by more than 1e-9, standard error says by how much (of methods in closed form). A chatter has come to rest
/// when its bodies part more slowly than 1e-10 d w; they then stay in contact as long as forces press them.
#[derive(clap::Args)]
#[command(after_help = FORM)]
pub struct Args {
    /// File with the scenario as JSON (the form is below), 64 MiB at most; - for standard input.
    #[arg(value_name = "SCENARIO.json")]
    scenario: PathBuf,
    /// Time at which to stop, from 0 to 1e12.
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    until: f64,
    /// Stop after this many impacts.
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    max_impacts: Option<u64>,
    /// Say on standard error, in one line at the end, up to which impact the run can be trusted:
    /// before any of 8 twins, which differ in the last bits of every amplitude, has another gap or a
    /// time that differs by 0.001 divided by the largest of w and W, and before rounding decides which of two neighbouring gaps
    /// closes first (unless by a symmetry both close at once) or whether an impact is a mere graze. An estimate, not a proof: a touch
    /// that neither the run nor a twin finds is not seen; impacts of gaps that share no mass may have come the other way round within
    /// that time; of a chatter only the end is sure. The output stays the same; the time is that of 10 runs as long as they agree.
    /// Also says how fast errors grow.
    #[arg(long)]
    certify: bool,
    /// Add a column: the derivative of the time of each impact with regard to ln sigma. All forces are multiplied, and with them the free
    /// parts of a start from rest; other starts stay. Ends with an error at an impact that has no derivative: where a gap
    /// grazes (rounding of the impact's time could take more than 1e-4 of the derivative), closes together with a neighbour, or
    /// comes to rest in contact.
    #[arg(long, value_name = "PARAMETER")]
    sensitivity: Option<Parameter>,
    #[command(flatten)]
    method: method::Choice,
}

/// What impact times are differentiated by.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Parameter {
    Sigma,
}

const FORM: &str = r#"The scenario, with the defaults of everything but "forcing":
  {"spacing": 1, "natural_frequency": 1, "forcing_frequency": 1.4142135623730951,
   "restitution": 0.8, "boundary": "walls", "simultaneous": "sequential", "initial": "rest",
   "forcing": [[alpha_1, beta_1], ..., [alpha_n, beta_n]]}
Several components of the forcing, 8 at most:
   "forcing_frequencies": [W_1, W_2, ...], "forcing": [[[alpha_1, beta_1], ...], [[...], ...], ...]
boundary: "walls" or "ring".
simultaneous: when neighbouring gaps close at exactly the same instant, "sequential" takes one after
          the other, lowest gap first, until none closes; "joint" takes all at once, each with
          Newton's restitution, those in contact with them as well. Only the method certified.
initial:  "rest" (at equilibrium), "zero" (no free part),
          {"free": [[a_1, b_1], ...]} (x_j = j d + a_j cos wt + b_j sin wt + forced response),
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

/// What a certificate says, of a run with so many impacts in all.
fn line(certificate: &Certificate, printed: u64) -> String {
    let count = |number: u64, noun| count(number as usize, noun);
    let trusted = match certificate.horizon {
        None if printed == 0 => "there is no impact to trust".into(),
        Some(time) if printed == 0 => format!("there may be an impact from t = {time:.2} on"),
        None => format!("{} can be trusted, to the end", count(printed, "impact")),
        Some(time) => format!(
            "{} of {} can be trusted, before t = {time:.2}",
            certificate.impacts,
            count(printed, "impact")
        ),
    };
    match certificate.growth {
        Some(rate) if rate <= 0.0 => format!("impact-paper: {trusted}; errors do not grow"),
        Some(rate) => format!("impact-paper: {trusted}; errors grow as exp({rate:.3} t)"),
        None => format!("impact-paper: {trusted}; errors are too small to see them grow"),
    }
}

/// What is said of impacts of several neighbouring gaps at once.
fn simultaneous(count: u64, law: Simultaneous) -> String {
    let times = if count == 1 { "once" } else { &format!("{count} times") };
    let taken = match law {
        Simultaneous::Sequential => "one after the other, lowest gap first",
        Simultaneous::Joint => "all at once",
    };
    format!(
        "impact-paper: {times}, neighbouring gaps closed at exactly the same instant; \
         they were taken {taken}"
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
    memory::fits(NUMBER * numbers, &name, "give fewer masses")?;
    let scenario = Scenario::from_json(&text).map_err(in_file)?;
    // The run, its twins, and one more that tells ties of a symmetry.
    let engines = if args.certify { 2 + TWINS } else { 1 };
    let (masses, components) = (scenario.forcing.len(), 1 + scenario.overtones.len());
    let derivatives = args.sensitivity.map_or(0, |_| Sensitivity::memory(masses));
    let needed = u128::from(engines) * Engine::memory(masses, components) + derivatives;
    memory::fits(needed, &name, "give fewer masses")?;
    let (method, start) = (args.method.method()?, State::of(&scenario));
    let only = [
        ("--certify", args.certify, "has a horizon to tell"),
        ("--sensitivity", args.sensitivity.is_some(), "has impacts exact enough to differentiate"),
        ("simultaneous", scenario.simultaneous == Simultaneous::Joint, "has the joint law"),
    ];
    let asked = only.iter().find(|(_, asked, _)| *asked && !args.method.is_certified());
    if let Some((what, _, has)) = asked {
        let name = method.name();
        let message = format!(
            "{what}: only the method certified {has}, not {name}; leave out one of the two"
        );
        return Err(Failure::input(message));
    }
    let sensitivity = args.sensitivity.map(|Parameter::Sigma| Sensitivity::new(&scenario));
    let mut sensitivity = sensitivity.transpose().map_err(in_file)?;
    let mut no_derivative = None;
    // Written in whole lines: a signal that ends the program leaves no half of a number.
    let (mut out, mut lines) = (io::stdout().lock(), String::new());
    let mut written = Ok(());
    let mut header = match sensitivity {
        Some(_) => "time,gap,closing_speed,dtime_dlnsigma\n",
        None => "time,gap,closing_speed\n",
    };
    let most = args.max_impacts.unwrap_or(u64::MAX);
    let mut left = most;
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
            let shift = match sensitivity.as_mut().map(|own| own.shift(&impact)).transpose() {
                Ok(shift) => shift.map_or(String::new(), |shift| format!(",{shift:?}")),
                Err(error) => {
                    no_derivative = Some(error);
                    return false;
                }
            };
            lines.push_str(&format!("{time:?},{gap},{closing_speed:?}{shift}\n"));
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
    let ran = if args.certify {
        certify(&scenario, until, &mut sink).map(|own| (Some(own), own.simultaneous))
    } else {
        method.run(&scenario, &start, until, &mut sink).map(|cost| (None, cost.simultaneous))
    };
    // What was found before a run was stopped is printed; a run that is refused at its start prints nothing.
    if ran.is_ok() {
        lines.push_str(header);
    }
    let written = written.and_then(|()| out.write_all(lines.as_bytes()));
    let rounded = rounded(&scenario).filter(|_| args.method.is_closed());
    let (certificate, ties) = match (ran, written.and_then(|()| out.flush())) {
        (_, Err(error)) => return stdout::written(Err(error)),
        (Ok(ran), Ok(())) => ran,
        (Err(error), Ok(())) => {
            let stopped = matches!(error, Error::Work { .. });
            let failure = in_file(error);
            // The impacts of a run that was stopped have the same rounding.
            if let Some(rounded) = rounded.filter(|_| stopped) {
                say(&format!("impact-paper: {rounded}"));
            }
            let uncertain = stopped && args.certify;
            return Err(if uncertain { failure.and("it has no certificate") } else { failure });
        }
    };
    if let Some(error) = no_derivative {
        return Err(in_file(error));
    }
    if ties > 0 {
        say(&simultaneous(ties, scenario.simultaneous));
    }
    match (certificate.map(|own| line(&own, most - left)), rounded) {
        (Some(line), Some(rounded)) => say(&format!("{line}; {rounded}")),
        (Some(line), None) => say(&line),
        (None, Some(rounded)) => say(&format!("impact-paper: {rounded}")),
        (None, None) => {}
    }
    Ok(())
}

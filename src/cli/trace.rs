//! Runs the verb `trace`: one scenario, with its impacts.

use super::range::{Values, values, within};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use impact_chain::methods::{Cost, Method};
use impact_chain::{Counters, Engine, Error, Graze, Impact, LATEST, Scenario, State, rounding};
use impact_paper::experiments::alive;
use impact_paper::params::MethodName::{self, *};
use literate::Failure;
use literate::cli::terminal::{warn, written as printed};
use literate::input::{self, one_line, plain};
use std::fmt;
use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Read, StdoutLock, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// Print the impacts of a scenario as CSV: time, gap, closing speed
///
/// Masses 1..n in a row, points, each on a spring to its place: between impacts
///   x_j'' = w^2 (j d - x_j) + alpha_j cos Wt + beta_j sin Wt.
/// Where neighbours meet, their velocities jump: the gap opens at r times the speed at which it
/// closed, and momentum is conserved. All masses are 1; walls, at 0 and (n + 1) d, do not move.
/// Times are in units of 1/w, lengths of d, if these are 1. Not in the model: damping, springs
/// between masses, unequal masses or springs, friction, three at once (pairs collide in turn).
///
/// Examples:
///   trace chain.json --until 100
///   trace - --until 100 --max-impacts 20 < chain.json
///   trace chain.json --at 0..100:0.5
///   trace - --lines --until 100 < chains.jsonl
///   trace chain.json --until 100 --method verlet --step 0.01
///   trace chain.json --until 100 --method truth
///
/// Count gaps from the left wall: gap 0 lies between it and mass 1, gap j between masses j and j +
/// 1; on a ring gap n lies between masses n and 1. Of neighbouring gaps that close at exactly the
/// same instant, the fastest comes first. A note on stderr says how many impacts coincide, and how
/// often rounding could not decide whether a gap closes (method certified).
///
/// Do not trust single impacts far into a chaotic run: errors grow about tenfold in a dozen units
/// of time. Compare with --method truth to see from when on a run is off. The truth has every
/// time to 106 bits, but only for walls, one frequency and no contact; it takes the next gap from
/// the engine, so it cannot show an impact that the engine misses.
///
/// Amplitudes are refused where rounding may move a gap by more than 1e-6 of the spacing (near
/// resonance, say): give smaller ones. From 1e-9 on, a note on stderr says by how much (methods in
/// closed form). Bodies that part more slowly than 1e-10 d w stay in contact while forces press
/// them.
#[derive(clap::Args)]
#[command(verbatim_doc_comment, after_help = SCENARIO_HELP)]
pub struct Args {
    /// Read the scenario from this JSON file (the form is below), 64 MiB at most; - for standard
    /// input.
    #[arg(value_name = "SCENARIO.json")]
    scenario: PathBuf,
    /// Stop at this time.
    #[arg(long, value_name = "T", value_parser = within(0.0, LATEST), allow_hyphen_values = true,
        required_unless_present = "at")]
    until: Option<f64>,
    /// Print time, mass, position and velocity at these times instead: a rising list or a range.
    #[arg(long, value_name = "A..B:STEP|LIST", value_parser = values(0.0, LATEST), allow_hyphen_values = true,
        conflicts_with_all = ["until", "max_impacts"])]
    at: Option<Values>,
    /// Read a scenario from each line; the first column is its number. Each is answered
    /// before the next is read; the first that is refused ends the run.
    #[arg(long)]
    lines: bool,
    /// Stop after this many impacts.
    #[arg(long, value_name = "M")]
    max_impacts: Option<u64>,
    /// Simulate by this method; all but the first are there to be compared with it.
    #[arg(long, value_name = "NAME", value_parser = method_names(), default_value = MethodName::Certified.id(),
        hide_default_value = true)]
    method: MethodName,
    /// Step in time, for the methods that have one.
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    step: Option<f64>,
    /// For runge-kutta the error allowed in a step, for advancement the width at which a gap counts
    /// as closed.
    #[arg(long, value_name = "TOL", allow_hyphen_values = true)]
    tolerance: Option<f64>,
}

/// A method, its option with the usual value, and its line of `trace --help` with `{}` for that.
type MethodLine = (MethodName, Option<(&'static str, f64)>, &'static str);

const METHODS: [MethodLine; 9] = [
    (Certified, None, "Closed form, the first root of each gap certified: misses nothing"),
    (Sampled, step(0.01), "Closed form, sampled every {}, then Newton: misses close roots"),
    (Advancement, tolerance(1e-12), "Closed form, parabolas to {}: near misses are impacts"),
    (RungeKutta, tolerance(1e-9), "Dormand–Prince 5(4) with events, {}: misses close roots"),
    (MoreauJean, step(1e-3), "Time stepping, {}: first order, near misses are impacts, can rest"),
    (Verlet, step(1e-3), "Velocity Verlet, reflected after steps of {}: first order, late"),
    (
        VerletAbreast,
        step(1e-2),
        "The same for many chains side by side, {}: single precision, for means",
    ),
    (Penalty, step(1e-4), "Stiff damped springs, {}: order 1/2, wrong in clusters"),
    (Truth, None, "106 bits, slowly: walls, one frequency, no contact; the gap from the engine"),
];

const fn step(usual: f64) -> Option<(&'static str, f64)> {
    Some(("--step", usual))
}

const fn tolerance(usual: f64) -> Option<(&'static str, f64)> {
    Some(("--tolerance", usual))
}

/// Returns a parser of the names of methods, which lists them with their lines in the help.
fn method_names() -> impl TypedValueParser<Value = MethodName> {
    let name = |(method, option, line): &MethodLine| {
        let option = option.map_or(String::new(), |(name, usual)| format!("{name} [{usual:?}]"));
        PossibleValue::new(method.id()).help(line.replace("{}", &option))
    };
    let names: Vec<PossibleValue> = METHODS.iter().map(name).collect();
    PossibleValuesParser::new(names).try_map(|name| serde_json::from_value(name.into()))
}

const SCENARIO_HELP: &str = r#"The scenario, with the defaults of everything but "forcing":
  {"spacing": 1, "natural_frequency": 1, "forcing_frequency": 1.4142135623730951,
   "restitution": 0.8, "boundary": "walls", "initial": "rest",
   "forcing": [[alpha_1, beta_1], ..., [alpha_n, beta_n]]}
Several components of the forcing, 8 at most:
   "forcing_frequencies": [W_1, W_2, ...], "forcing": [[[alpha_1, beta_1], ...], [[...], ...], ...]
boundary: "walls" or "ring".
places:   [p_1, ..., p_n] instead of j d, and "walls": [left, right] instead of [0, (n + 1) d]
          (not on a ring): for gaps of any width, a wall far away, constant forces F (they shift a
          place by F/w^2).
initial:  "rest" (at equilibrium), "zero" (no free part),
          {"free": [[a_1, b_1], ...]} (x_j = j d + a_j cos wt + b_j sin wt + forced response),
          {"at": {"positions": [x_1, ...], "velocities": [v_1, ...]}} (from the left wall),
          {"random": {"sigma": s, "seed": k}} (normal free parts)."#;

pub fn run(args: Args) -> Result<(), Failure> {
    if args.at.is_some() && args.method != MethodName::Certified {
        return Err(Failure::input("--at: only the method certified prints states; leave it out"));
    }
    if args.at.as_ref().is_some_and(|times| !times.is_sorted()) {
        return Err(Failure::input("--at: the times fall; give rising ones"));
    }
    let number = if args.lines { "scenario," } else { "" };
    let columns = if args.at.is_some() { "mass,position,velocity" } else { "gap,closing_speed" };
    let method = args.method.with(setting(&args)?, 0.0);
    let latest = Arc::new(AtomicU64::new(0));
    let mut printer = Printer {
        out: BufWriter::new(io::stdout().lock()),
        header: format!("{number}time,{columns}\n"),
        prefix: String::new(),
        written: Ok(()),
        latest: Arc::clone(&latest),
    };
    let _alive = alive(move || format!("trace: at t = {:?}", f64::from_bits(latest.load(Relaxed))));
    let piped = args.scenario == Path::new("-");
    let name = if piped { "standard input".into() } else { args.scenario.display().to_string() };
    let unread = |error: io::Error| {
        Failure::input(format!("{name}: {error}; give a scenario, see `trace --help`"))
    };
    let mut file: Box<dyn BufRead> = if piped {
        Box::new(io::stdin().lock())
    } else {
        Box::new(BufReader::new(File::open(&args.scenario).map_err(unread)?))
    };
    if !args.lines {
        let text = input::read_from(file).map_err(unread)?;
        return trace(&args, &*method, &name, &text, &mut printer);
    }
    for number in 1.. {
        let mut line = Vec::new();
        (&mut file).take(input::MOST << 20).read_until(b'\n', &mut line).map_err(unread)?;
        if line.is_empty() {
            break;
        }
        let name = format!("{name}, line {number}");
        printer.prefix = format!("{number},");
        let text = input::read_from(line.as_slice()).map_err(unread)?;
        trace(&args, &*method, &name, &text, &mut printer)?;
    }
    printed(printer.flush())
}

/// Prints rows in blocks of whole ones: a signal that ends the program leaves no half of a number.
struct Printer {
    out: BufWriter<StdoutLock<'static>>,
    /// The first line, until it is printed.
    header: String,
    /// What each row begins with.
    prefix: String,
    written: io::Result<()>,
    /// The bits of the time of the latest impact.
    latest: Arc<AtomicU64>,
}

impl Printer {
    fn row(&mut self, row: fmt::Arguments) {
        self.print(format!("{}{row}\n", self.prefix));
    }

    /// Prints some rows, after the header, since a run that is refused at its start prints nothing.
    fn print(&mut self, rows: String) {
        let text = std::mem::take(&mut self.header) + &rows;
        if self.written.is_ok() {
            self.written = self.out.write_all(text.as_bytes());
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        std::mem::replace(&mut self.written, Ok(()))?;
        self.out.flush()
    }
}

/// Runs the scenario of a text and prints its impacts, or its states at given times.
fn trace(
    args: &Args,
    method: &dyn Method,
    name: &str,
    text: &str,
    printer: &mut Printer,
) -> Result<(), Failure> {
    let scenario = Scenario::from_json(text).map_err(|error| in_file(name, error))?;
    let ran = match &args.at {
        Some(times) => states(&scenario, times, printer),
        None => impacts(args, method, &scenario, printer),
    };
    if ran.is_ok() {
        printer.print(String::new());
    }
    // What was found before a run was stopped is printed.
    if let Err(error) = printer.flush() {
        return printed(Err(error));
    }
    // With many scenarios each note names the one that it is about.
    let of_line = if args.lines { format!("{name}: ") } else { String::new() };
    let note = |text: String| warn(&(of_line.clone() + &text));
    if let Ok(cost) = &ran {
        warn_of_doubts(cost, &note);
    }
    let width = rounding::width(&scenario);
    let closed = matches!(args.method, MethodName::Certified | MethodName::Sampled);
    let began = matches!(ran, Ok(_) | Err(Error::Work { .. }));
    if closed && began && width > rounding::REPORTED * scenario.spacing {
        note(format!(
            "rounding of large amplitudes may move each impact at closing speed v by {width:.1e}/v, and \
             errors grow from impact to impact"
        ));
    }
    ran.map(|_| ()).map_err(|error| in_file(name, error))
}

fn impacts(
    args: &Args,
    method: &dyn Method,
    scenario: &Scenario,
    printer: &mut Printer,
) -> Result<Cost, Error> {
    let most = args.max_impacts.unwrap_or(u64::MAX);
    let mut all = 0;
    let mut sink = |Impact { time, gap, closing_speed }: Impact| {
        printer.latest.store(time.to_bits(), Relaxed);
        if all < most {
            printer.row(format_args!("{time:?},{gap},{closing_speed:?}"));
            all += 1;
        }
        all < most && printer.written.is_ok()
    };
    let until = if most == 0 { 0.0 } else { args.until.unwrap_or_default() };
    method.run((scenario, &State::of(scenario), until), &mut sink)
}

/// Prints time, place and velocity of each mass at each of several times.
fn states(scenario: &Scenario, times: &[f64], printer: &mut Printer) -> Result<Cost, Error> {
    let mut engine = Engine::new(scenario)?;
    for &time in times {
        engine.run(time, |impact| {
            printer.latest.store(impact.time.to_bits(), Relaxed);
            true
        })?;
        let state = engine.state(time)?;
        for (j, (x, v)) in state.positions.iter().zip(&state.velocities).enumerate() {
            printer.row(format_args!("{time:?},{},{x:?},{v:?}", j + 1));
        }
        if printer.written.is_err() {
            break;
        }
    }
    let Counters { impacts, simultaneous, undecided, .. } = engine.counters();
    let first_graze = engine.first_graze();
    Ok(Cost { impacts, simultaneous, undecided, first_graze, ..Cost::default() })
}

/// Reports impacts whose order is a choice, and grazes that rounding hides.
fn warn_of_doubts(cost: &Cost, note: &dyn Fn(String)) {
    if cost.simultaneous > 0 {
        note(format!(
            "impacts at exactly the same instant as one in a neighbouring gap: {} of {}; they were taken \
             one after the other, fastest first",
            cost.simultaneous, cost.impacts
        ));
    }
    if let Some(Graze { time, gap }) = cost.first_graze {
        note(format!(
            "grazes that rounding could not decide: {}, the first of gap {gap} at t = {time:?}; each was \
             taken for a miss, and the run may be wrong from there on",
            cost.undecided
        ));
    }
}

/// The failure for an error in a scenario or a setting (exit code 2) or a run (1).
fn in_file(name: &str, error: Error) -> Failure {
    match error {
        Error::Work { .. } => Failure::check(error.to_string()),
        Error::Input { ref field, .. } if ["step", "tolerance"].contains(&field.as_str()) => {
            Failure::input(format!("--{error}"))
        }
        error => Failure::input(format!("{name}: {}", one_line(&plain(&error.to_string()), 1000))),
    }
}

/// Returns the step or tolerance; refuses an option that the method does not have.
fn setting(args: &Args) -> Result<f64, Failure> {
    let (_, option, _) =
        METHODS.into_iter().find(|(method, ..)| *method == args.method).unwrap_or(METHODS[0]);
    let (takes, usual) = option.unwrap_or(("neither", 0.0));
    for (option, value) in [("--step", args.step), ("--tolerance", args.tolerance)] {
        if value.is_some() && option != takes {
            let name = args.method.id();
            let what = format!("{option}: the method {name} takes {takes}; leave it out");
            return Err(Failure::input(what));
        }
    }
    Ok(args.step.or(args.tolerance).unwrap_or(usual))
}

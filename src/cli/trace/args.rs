//! Describes the options of the verb `trace`.

use super::super::range::{Times, number, times};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use impact_chain::LATEST;
use impact_paper::params::MethodName::{self, *};
use std::path::PathBuf;

#[derive(clap::Args)]
#[command(about = "Print the impacts of a scenario as CSV: time, gap, closing speed")]
#[command(long_about = include_str!("about.txt"), after_help = include_str!("scenario.txt"))]
pub struct Args {
    /// Read the scenario from this JSON file (the form is below), 64 MiB at most; - for standard
    /// input.
    #[arg(value_name = "SCENARIO.json")]
    pub(super) scenario: PathBuf,
    /// Stop at this time.
    #[arg(long, value_name = "T", value_parser = number(0.0, LATEST), allow_hyphen_values = true,
        required_unless_present = "at")]
    pub(super) until: Option<f64>,
    /// Print time, mass, position and velocity at these times up to --until instead: a rising list,
    /// a range, or "period" for each multiple of the (first) period of the forcing.
    #[arg(long, value_name = "A..B:STEP|LIST|period", value_parser = times(LATEST), allow_hyphen_values = true,
        conflicts_with_all = ["max_impacts", "events"])]
    pub(super) at: Option<Times>,
    /// Print all events, with a column of their names: impact; stick and release, where a gap comes
    /// into contact and leaves it; graze, a dip that rounding could not decide.
    #[arg(long)]
    pub(super) events: bool,
    /// Write the state at the end to this file, which --from reads.
    #[arg(long, value_name = "FILE", conflicts_with = "lines")]
    pub(super) save: Option<PathBuf>,
    /// Go on from the state in this file, at its time and with the phases of the forcing then; the
    /// scenario may be another, as along a branch.
    #[arg(long, value_name = "FILE", conflicts_with = "lines")]
    pub(super) from: Option<PathBuf>,
    /// Read a scenario from each line that is not blank; the first column is its number. They are
    /// run on all cores and answered in order, and the first that is refused ends the run.
    #[arg(long)]
    pub(super) lines: bool,
    /// Go on after a line that is refused or stopped: a column says "ok", "refused" or "stopped",
    /// and each line has a row, without numbers if there are none. The exit code is 1 then.
    #[arg(long, requires = "lines")]
    pub(super) keep_going: bool,
    /// Stop after this many impacts.
    #[arg(long, value_name = "M")]
    pub(super) max_impacts: Option<u64>,
    /// Simulate by this method; all but the first are there to be compared with it.
    #[arg(long, value_name = "NAME", value_parser = method_names(), default_value = MethodName::Certified.id(),
        hide_default_value = true)]
    pub(super) method: MethodName,
    /// Step in time, for the methods that have one.
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    pub(super) step: Option<f64>,
    /// For runge-kutta the error allowed in a step, for advancement the width at which a gap counts
    /// as closed.
    #[arg(long, value_name = "TOL", allow_hyphen_values = true)]
    pub(super) tolerance: Option<f64>,
}

/// A method, the usual value of its option, and its line of `trace --help` with `{}` for both.
pub type MethodLine = (MethodName, Option<f64>, &'static str);

pub const METHODS: [MethodLine; 9] = [
    (Certified, None, "Closed form, the first root of each gap certified: misses nothing"),
    (Sampled, Some(0.01), "Closed form, sampled every {}, then Newton: misses close roots"),
    (Advancement, Some(1e-12), "Closed form, parabolas to {}: near misses are impacts"),
    (RungeKutta, Some(1e-9), "Dormand–Prince 5(4) with events, {}: misses close roots"),
    (MoreauJean, Some(1e-3), "Time stepping, {}: first order, near misses are impacts, can rest"),
    (Verlet, Some(1e-3), "Velocity Verlet, reflected after steps of {}: first order, late"),
    (
        VerletAbreast,
        Some(1e-2),
        "The same for many chains side by side, {}: single precision, for means",
    ),
    (Penalty, Some(1e-4), "Stiff damped springs, {}: order 1/2, wrong in clusters"),
    (Truth, None, "106 bits, slowly: walls, one frequency, no contact; the gap from the engine"),
];

/// Returns the option of a method that has a step or a tolerance.
pub fn option(method: MethodName) -> &'static str {
    if method.has_tolerance() { "--tolerance" } else { "--step" }
}

/// Returns a parser of the names of methods, which lists them with their lines in the help.
fn method_names() -> impl TypedValueParser<Value = MethodName> {
    let name = |&(method, usual, line): &MethodLine| {
        let usual = usual.map_or(String::new(), |usual| format!("{} [{usual:?}]", option(method)));
        PossibleValue::new(method.id()).help(line.replace("{}", &usual))
    };
    let names: Vec<PossibleValue> = METHODS.iter().map(name).collect();
    PossibleValuesParser::new(names).try_map(|name| serde_json::from_value(name.into()))
}

//! `impact-paper eval`: one quantity of the theory as JSON.

mod inputs;
mod quantity;

use super::{Failure, stdout};
use impact_paper::experiments::say;
use inputs::Inputs;
use quantity::{QUANTITIES, Quantity, Value};
use serde::Serialize;

/// Evaluates one quantity of the theory (Secs. 3 to 9), as one JSON object.
///
/// `impact-paper eval p-jump --vertices 100` prints
/// {"quantity":"p-jump","value":0.01303285872435575,"inputs":{"vertices":100}}.
#[derive(clap::Args)]
#[command(after_help = help())]
pub struct Args {
    /// What to evaluate, one of the names below.
    #[arg(value_name = "QUANTITY", required_unless_present = "list", conflicts_with = "list")]
    quantity: Option<String>,

    /// Lists all quantities with their equations and what they need.
    #[arg(long)]
    list: bool,

    #[command(flatten)]
    options: Options,
}

/// The options as they were typed.
#[derive(clap::Args, Default, PartialEq)]
struct Options {
    /// Number of masses n between walls; there are N = n + 1 vertices.
    #[arg(long, value_name = "n", allow_hyphen_values = true)]
    masses: Option<String>,

    /// Number of vertices N of the graph [default: 100].
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    vertices: Option<String>,

    /// Probability p of an edge, 0 ≤ p ≤ 1; 0 means the limit p → 0+.
    #[arg(long, value_name = "P", allow_hyphen_values = true)]
    p: Option<String>,

    /// Standard deviation σ of the forcing, > 0, 1000000 at most.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    sigma: Option<String>,

    /// Number of different impacts k, 1 ≤ k ≤ N.
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    k: Option<String>,

    /// Natural frequency ω, 0.001 to 1000 [default: 1].
    #[arg(long, value_name = "w", allow_hyphen_values = true)]
    omega: Option<String>,

    /// Forcing frequency Ω, 0.001 to 1000 and different from ω [default: √2; the double nearest to √2 is
    /// read as √2 itself].
    #[arg(long, value_name = "W", allow_hyphen_values = true)]
    forcing_frequency: Option<String>,

    /// Spacing d of the masses at rest, 0.000001 to 1000000 [default: 1].
    #[arg(long, value_name = "d", allow_hyphen_values = true)]
    spacing: Option<String>,
}

/// What `eval` prints, in this order.
#[derive(Serialize)]
struct Answer {
    quantity: &'static str,
    value: Value,
    inputs: Inputs,
}

pub fn run(args: Args) -> Result<(), Failure> {
    if args.list {
        if args.options != Options::default() {
            return Err(Failure::input("--list: it takes no other option; leave them out"));
        }
        return print(&list());
    }
    let name = args.quantity.unwrap_or_default();
    let quantity = QUANTITIES.iter().find(|q| q.name == name).ok_or_else(|| {
        Failure::input(format!("quantity: `{name}` is unknown; see `impact-paper eval --list`"))
    })?;
    let inputs = Inputs::read(quantity, &args.options)?;
    let value = (quantity.evaluate)(&inputs).map_err(|error| explain(error, &inputs))?;
    if !value.is_finite() {
        return Err(Failure::run(format!("{name}: the result is not a finite number")));
    }
    if quantity.name == "p-crit" && matches!(value, Value::Float(p) if p > 1.0) {
        say("impact-paper: p_crit is above 1, so no probability reaches it: N is too small");
    }
    let answer = Answer { quantity: quantity.name, value, inputs };
    let json = serde_json::to_string(&answer)
        .map_err(|error| Failure::run(format!("{name}: cannot be written as JSON ({error})")))?;
    print(&json)
}

/// The error in terms of the option that was typed: `--masses` gives N too.
fn explain(error: impact_circuits::Error, inputs: &Inputs) -> Failure {
    let message = error.to_string();
    match (inputs.masses, message.strip_prefix("vertices:")) {
        (Some(_), Some(rest)) => Failure::input(format!("masses (N = n + 1):{rest}")),
        _ => Failure::input(message),
    }
}

fn print(text: &str) -> Result<(), Failure> {
    stdout::print(&format!("{text}\n"))
}

/// One line per quantity: name, equation, what it needs, what it is.
fn list() -> String {
    let line = |q: &Quantity| {
        let needs: Vec<String> = q.needs.iter().map(|n| n.option().to_string()).collect();
        format!("{:<20} {:<18} {:<28} {}", q.name, q.equation, needs.join(" "), q.meaning)
    };
    let lines: Vec<String> = QUANTITIES.iter().map(line).collect();
    lines.join("\n")
}

/// What stands below the options in `--help`.
fn help() -> String {
    format!(
        "Quantities (name, equation, options, meaning):\n{}\n\nOptions that a quantity does not \
         use are an error. Floats are printed with the fewest digits that read back to the same \
         double, integers as integers. N is at most {} (a result then takes some seconds). \
         P(X = k) is printed as 0 where it is below the smallest double. With higher orders, k is \
         the number of different vertices, and circuits are primitive (a repetition of a shorter \
         one is not counted).",
        list(),
        impact_circuits::LARGEST_N
    )
}

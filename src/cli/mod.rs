//! The verbs that this paper adds: `eval`, `sweep`, `trace`.

mod eval;
mod sweep;
mod trace;

use literate::Failure;

/// A verb.
#[derive(clap::Subcommand)]
pub enum Verb {
    Eval(eval::Args),
    Sweep(sweep::Args),
    Trace(trace::Args),
}

pub fn run(verb: Verb) -> Result<(), Failure> {
    match verb {
        Verb::Eval(args) => eval::run(args),
        Verb::Sweep(args) => sweep::run(args),
        Verb::Trace(args) => trace::run(args),
    }
}

/// A reader of numbers in a range, both ends among them.
fn within(
    low: f64,
    high: f64,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| {
        let range = || format!("give a number from {low:?} to {high:?}");
        let number = text.trim().parse::<f64>().map_err(|_| range())?;
        // A negative zero would be printed as one.
        (low..=high).contains(&number).then_some(number + 0.0).ok_or_else(range)
    }
}

//! Lists the verbs that this paper adds: `eval`, `sweep`, `trace`.

mod eval;
mod range;
mod sweep;
mod trace;

use literate::Failure;

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

//! Threads: how many may be asked for, and work on them.

use super::Failure;
use std::num::ParseIntError;

/// Threads for each core that may be asked for: more share the same cores, and cost memory.
const THREADS_A_CORE: usize = 4;

/// Stack of a thread that works, in bytes: the system, or RUST_MIN_STACK, may give less.
pub const STACK: usize = 8 << 20;

/// Cores at hand.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The variables by which the library of threads takes their number.
const THREADS: [&str; 2] = ["RAYON_NUM_THREADS", "RAYON_RS_NUM_CPUS"];

/// Reads a number of threads, no more than work can use: as a parser of `--threads`, before there is any work.
pub fn read(text: &str) -> Result<usize, String> {
    let threads = text.parse().map_err(|error: ParseIntError| error.to_string())?;
    let most = THREADS_A_CORE * cores();
    if (1..=most).contains(&threads) {
        return Ok(threads);
    }
    let bound = format!("give 1 to {most}, {THREADS_A_CORE} for each core");
    Err(format!("{threads} threads are not allowed; {bound}"))
}

/// Holds the environment to the bounds that options have. What is no number, or none, is passed over by who reads it.
pub fn environment() -> Result<(), Failure> {
    THREADS.into_iter().try_for_each(|name| match std::env::var(name) {
        Ok(text) if text.parse().is_ok_and(|n: usize| n > 0) => {
            read(&text).map(drop).map_err(|what| Failure::input(format!("{name}: {what}")))
        }
        _ => Ok(()),
    })
}

/// Runs `work` on that many threads; none means all cores.
pub fn run<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let number = threads.or_else(of_environment).unwrap_or_else(cores);
    let builder = rayon::ThreadPoolBuilder::new().num_threads(number).stack_size(STACK);
    let pool = builder.build().map_err(|error| {
        Failure::input(format!("--threads: {error}; give a smaller number of threads"))
    })?;
    pool.install(work)
}

/// The number of threads that the environment asks for.
fn of_environment() -> Option<usize> {
    let number = |name| std::env::var(name).ok()?.parse().ok().filter(|&n: &usize| n > 0);
    THREADS.into_iter().find_map(number)
}

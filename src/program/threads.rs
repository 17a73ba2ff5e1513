//! Threads: how many may be asked for, and work on them.

use super::Failure;

/// More threads than any machine of today has cores.
const MOST: usize = 1024;

/// Stack of a thread that works, in bytes: the system, or RUST_MIN_STACK, may give less.
pub const STACK: usize = 8 << 20;

/// Cores at hand.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Reads a number of threads.
pub fn read(text: &str) -> Result<usize, String> {
    let threads = text.parse().ok().filter(|threads| (1..=MOST).contains(threads));
    threads.ok_or_else(|| format!("give 1 to {MOST}"))
}

/// Runs `work` on that many threads; none means all cores, or as many as RAYON_NUM_THREADS says.
pub fn run<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).stack_size(STACK);
    let pool = pool.build().map_err(|error| {
        Failure::input(format!("--threads: {error}; give a smaller number of threads"))
    })?;
    pool.install(work)
}

//! Writes to the terminal, ends on signals, and starts threads; verbs that a paper adds use it too.

use crate::claims::is_trying;
use crate::experiments::{end_all, say, stop};
use crate::failure::{Failure, INTERRUPTED};
use crate::input::one_line;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

const MOST: usize = 1024;

/// Prints a line on standard error, behind the name of the program.
pub fn warn(line: &str) {
    let program = std::env::current_exe().unwrap_or_default();
    let name = program.file_stem().unwrap_or_default().to_string_lossy();
    say(&format!("{name}: {line}"));
}

/// Reports an internal error in one line: what failed, and where.
pub(super) fn report_panic(fault: &std::panic::PanicHookInfo<'_>) {
    if is_trying() {
        return;
    }
    let words = fault.payload_as_str().unwrap_or("no words");
    let place = fault.location().map_or_else(String::new, |location| format!(" at {location}"));
    let line = format!(
        "internal error{place}: {words}; mend it if that file is your paper's, else please report \
         it; if saved results were edited, remove them"
    );
    warn(&one_line(&line, 4000));
}

pub(super) fn display_path(path: &Path) -> String {
    one_line(&path.display().to_string(), 500)
}

/// Turns the outcome of writing to standard output into a failure. A broken pipe is not an error.
pub fn written(result: io::Result<()>) -> Result<(), Failure> {
    match result {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::io(&error, "standard output", "direct it to a file that can be written"))
        }
        _ => Ok(()),
    }
}

/// Prints a text on standard output; a closed pipe is not an error.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut output = io::stdout().lock();
    written(output.write_all(text.as_bytes()).and_then(|()| output.flush()))
}

/// Makes Ctrl-C, SIGTERM and SIGHUP end the programs that this one runs, and it within a second
/// after, with exit code 130. Files that are being put into place are first all there.
pub(super) fn install_signals() {
    let follow = |mut signals: Signals| {
        let ended = move || {
            if signals.forever().next().is_some() {
                stop();
                end_all();
                std::thread::sleep(std::time::Duration::from_millis(700));
                let _moment = crate::input::WRITING.write();
                warn("interrupted");
                std::process::exit(i32::from(INTERRUPTED));
            }
        };
        std::thread::Builder::new().stack_size(1 << 20).spawn(ended)
    };
    let signals = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| !is_ignored(*signal));
    // If this fails, the system ends the program.
    let _ = Signals::new(signals).and_then(follow);
}

/// Returns whether the program was started with this signal ignored, as by `nohup`.
pub fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// The option `--threads` of a verb, for `#[command(flatten)]`.
#[derive(clap::Args)]
pub struct Threads {
    /// Use this many threads instead of one for each core; the result is the same bit for bit.
    #[arg(long = "threads", value_name = "K", allow_hyphen_values = true, value_parser = threads)]
    asked: Option<usize>,
}

fn threads(number: &str) -> Result<usize, String> {
    let threads = number.parse().ok().filter(|threads| (1..=MOST).contains(threads));
    threads.ok_or_else(|| format!("give 1 to {MOST}"))
}

impl Threads {
    /// Returns how many threads there will be.
    pub fn number(&self) -> usize {
        self.asked.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from))
    }

    /// Runs `work` on them; by default on all cores, or as many as RAYON_NUM_THREADS says.
    pub fn run<T: Send>(
        &self,
        work: impl FnOnce() -> Result<T, Failure> + Send,
    ) -> Result<T, Failure> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.asked.unwrap_or(0));
        let pool = pool.stack_size(8 << 20).build().map_err(|error| {
            Failure::input(format!("--threads: {error}; give a smaller number of threads"))
        })?;
        pool.install(work)
    }
}

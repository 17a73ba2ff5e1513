//! Progress for the person who waits, and the flag by which that person ends the wait.
//!
//! Plain lines, seconds apart, with the time left. All of it goes to stderr, and nothing of it into
//! a result.

use super::Error;
use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

/// Seconds between two lines.
const LINE_EVERY: u64 = 5;

static QUIET: AtomicBool = AtomicBool::new(false);

/// From now on no progress is shown.
pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Handed to every experiment: shows its progress, and has the flag that ends it.
#[derive(Clone, Debug)]
pub struct Progress {
    quiet: bool,
    stop: Arc<AtomicBool>,
}

impl Progress {
    /// Shows nothing and is never stopped: for tests and callers inside the program.
    pub fn silent() -> Self {
        Progress { quiet: true, stop: Arc::default() }
    }

    /// Lines on stderr; `stop` ends the work.
    pub fn on_stderr(stop: Arc<AtomicBool>) -> Self {
        Progress { quiet: QUIET.load(Ordering::Relaxed), stop }
    }

    /// Whether the work was asked to end. Cheap: one relaxed load.
    pub fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// [`Error::Interrupted`] if the work was asked to end.
    pub fn check(&self) -> Result<(), Error> {
        if self.stopped() { Err(Error::Interrupted) } else { Ok(()) }
    }

    /// Begins a stage of `total` units of work.
    pub fn stage(&self, name: &str, total: u64) -> Stage {
        let (name, began, done) = (name.to_string(), Instant::now(), Arc::new(AtomicU64::new(0)));
        let position = Arc::clone(&done);
        // By the clock and not by what is done: the first unit may be a long one.
        let lines = (!self.quiet).then(|| {
            let share =
                move || progress_text(position.load(Ordering::Relaxed), total, began.elapsed());
            alive(move || Some(format!("{name}: {}", share())))
        });
        Stage { done, _lines: lines }
    }

    /// Says one plain line, unless quiet.
    pub fn say(&self, line: &str) {
        if !self.quiet {
            say(line);
        }
    }
}

/// Says one line on standard error. If it cannot be written (a full disk, a closed pipe), no work
/// ends for that.
pub fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Ends the lines of [`alive`] where it ends itself.
#[derive(Debug)]
pub struct Alive {
    _ends: Sender<()>,
}

/// A line every few seconds, with the time that passed; none as long as there is nothing to say.
pub fn alive(line: impl Fn() -> Option<String> + Send + 'static) -> Alive {
    let (ends, ended) = channel();
    let began = Instant::now();
    let speak = move || {
        while ended.recv_timeout(Duration::from_secs(LINE_EVERY)) == Err(RecvTimeoutError::Timeout)
        {
            if let Some(line) = line().filter(|_| !QUIET.load(Ordering::Relaxed)) {
                say(&format!("{line}, after {} s", began.elapsed().as_secs()));
            }
        }
    };
    // Without a thread nothing is said.
    let _ = std::thread::Builder::new().stack_size(1 << 20).spawn(speak);
    Alive { _ends: ends }
}

/// One stage of an experiment. Shared by the threads that work on it.
#[derive(Debug)]
pub struct Stage {
    done: Arc<AtomicU64>,
    _lines: Option<Alive>,
}

impl Stage {
    /// Counts `units` more as done.
    pub fn advance(&self, units: u64) {
        self.done.fetch_add(units, Ordering::Relaxed);
    }
}

/// `40 %, about 12 s left`. The last units may be the longest: what is not done is not at 100 %,
/// and no time below a second is promised.
fn progress_text(done: u64, total: u64, elapsed: Duration) -> String {
    let share = if total == 0 { 1.0 } else { done as f64 / total as f64 };
    let percent = (100.0 * share).floor();
    let left = elapsed.as_secs_f64() * (1.0 - share) / share;
    if left.is_finite() && left >= 1.0 {
        format!("{percent:.0} %, about {left:.0} s left")
    } else {
        format!("{percent:.0} %")
    }
}

//! Shows progress as plain lines on standard error, and says whether a run is to end.

use super::Error;
use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

static QUIET: AtomicBool = AtomicBool::new(false);

static STOP: AtomicBool = AtomicBool::new(false);

pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

pub(crate) fn stop() {
    STOP.store(true, Ordering::Relaxed);
}

#[derive(Clone, Copy, Debug)]
pub struct Progress {
    quiet: bool,
}

impl Progress {
    pub fn silent() -> Self {
        Progress { quiet: true }
    }

    pub fn on_stderr() -> Self {
        Progress { quiet: QUIET.load(Ordering::Relaxed) }
    }

    /// Returns whether the work was asked to end. This costs one relaxed load.
    pub fn stopped(&self) -> bool {
        STOP.load(Ordering::Relaxed)
    }

    pub fn check(&self) -> Result<(), Error> {
        if self.stopped() { Err(Error::Interrupted) } else { Ok(()) }
    }

    pub fn stage(&self, name: &str, total: u64) -> Stage {
        let (name, began, done) = (name.to_string(), Instant::now(), Arc::new(AtomicU64::new(0)));
        let position = Arc::clone(&done);
        // At equal times, since the first unit may be a long one.
        let share = move || progress_text(position.load(Ordering::Relaxed), total, began.elapsed());
        let lines = (!self.quiet).then(|| alive(move || format!("{name}: {}", share())));
        Stage { done, _lines: lines }
    }

    pub fn say(&self, line: &str) {
        if !self.quiet {
            say(line);
        }
    }
}

/// Prints one line on standard error. A full disk or a closed pipe is not an error.
pub fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Prints a line every few seconds, with the time that passed, until what it returns is dropped.
pub fn alive(line: impl Fn() -> String + Send + 'static) -> Sender<()> {
    let (ends, ended) = channel();
    let began = Instant::now();
    let speak = move || {
        while ended.recv_timeout(Duration::from_secs(5)) == Err(RecvTimeoutError::Timeout) {
            if !QUIET.load(Ordering::Relaxed) {
                say(&format!("{}, after {} s", line(), began.elapsed().as_secs()));
            }
        }
    };
    // Without a thread nothing is printed.
    let _ = std::thread::Builder::new().stack_size(1 << 20).spawn(speak);
    ends
}

/// One stage of an experiment, shared by the threads that work on it.
#[derive(Debug)]
pub struct Stage {
    done: Arc<AtomicU64>,
    _lines: Option<Sender<()>>,
}

impl Stage {
    pub fn advance(&self, units: u64) {
        self.done.fetch_add(units, Ordering::Relaxed);
    }
}

/// Returns `40 %, about 12 s left`: 100 % only when all is done, and no time below a second.
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

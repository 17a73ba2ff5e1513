//! Shows progress as plain lines on standard error, and says whether a run is to end.

use super::{Error, Fault};
use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

static QUIET: AtomicBool = AtomicBool::new(false);

static STOP: AtomicBool = AtomicBool::new(false);

pub(crate) fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

pub(crate) fn stop() {
    STOP.store(true, Ordering::Relaxed);
}

/// Where a run shows how far it is, and learns that it is to end.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    is_quiet: bool,
}

impl Progress {
    /// Makes one that shows nothing.
    pub fn silent() -> Self {
        Progress { is_quiet: true }
    }

    /// Makes one that prints on standard error, unless the program was told to be quiet.
    pub fn on_stderr() -> Self {
        Progress { is_quiet: QUIET.load(Ordering::Relaxed) }
    }

    /// Returns whether the work was asked to end. This costs one relaxed load.
    pub fn stopped(&self) -> bool {
        STOP.load(Ordering::Relaxed)
    }

    /// Fails if the work was asked to end; a run asks this often.
    pub fn check(&self) -> Result<(), Error> {
        if self.stopped() { Err(Error(Fault::Interrupted)) } else { Ok(()) }
    }

    /// Begins a stage with so much work in all, in any unit.
    pub fn stage(&self, name: &str, total: u64) -> Stage {
        let (name, began, done) = (name.to_string(), Instant::now(), Arc::new(AtomicU64::new(0)));
        let position = Arc::clone(&done);
        // At equal times, since the first unit may be a long one.
        let share = move || progress_text(position.load(Ordering::Relaxed), total, began.elapsed());
        let lines = (!self.is_quiet).then(|| alive(move || format!("{name}: {}", share())));
        Stage { done, _lines: lines }
    }

    /// Prints a line, unless progress is not shown.
    pub fn say(&self, line: &str) {
        if !self.is_quiet {
            say(line);
        }
    }
}

/// Prints one line on standard error. A full disk or a closed pipe is not an error.
pub(crate) fn say(line: &str) {
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
    /// Counts work as done, in the unit of the stage.
    pub fn advance(&self, units: u64) {
        self.done.fetch_add(units, Ordering::Relaxed);
    }

    /// Sets the share that is done of [`PARTS`].
    pub(super) fn reach(&self, share: f64) {
        self.done.store((share * PARTS as f64).round() as u64, Ordering::Relaxed);
    }
}

/// The units of a stage of which only shares are known.
pub(super) const PARTS: u64 = 1_000_000;

/// Returns the share that a line reports, `progress 40 %` or `progress 40/100`, or else `None`.
pub(super) fn share_in(line: &str) -> Option<f64> {
    let words = line.strip_prefix("progress ")?.trim();
    let percent = words.strip_suffix('%').map(|done| (done, "100"));
    let (done, total) = percent.or_else(|| words.split_once('/'))?;
    let share = done.trim().parse::<f64>().ok()? / total.trim().parse::<f64>().ok()?;
    (0.0..=1.0).contains(&share).then_some(share)
}

/// Returns `40 %, about 12 s left`: 100 % only when all is done, and no time below a second.
fn progress_text(done: u64, total: u64, elapsed: Duration) -> String {
    if done == 0 && total > 0 {
        return "running".into();
    }
    let share = if total == 0 { 1.0 } else { done as f64 / total as f64 };
    let percent = (100.0 * share).floor();
    let seconds_left = elapsed.as_secs_f64() * (1.0 - share) / share;
    if seconds_left.is_finite() && seconds_left >= 1.0 {
        format!("{percent:.0} %, about {seconds_left:.0} s left")
    } else {
        format!("{percent:.0} %")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_is_shown_once_it_is_known() {
        let after_eight_seconds = |done| progress_text(done, 10, Duration::from_secs(8));
        assert_eq!([0, 4].map(after_eight_seconds), ["running", "40 %, about 12 s left"]);
        let known = ["progress 40 %", "progress 2.5%", "progress 1 / 2"].map(share_in);
        assert_eq!(known, [Some(0.4), Some(0.025), Some(0.5)]);
        let others = ["progress 140 %", "progress 0/0", "progress is slow", "40 %"].map(share_in);
        assert_eq!(others, [None; 4]);
    }
}

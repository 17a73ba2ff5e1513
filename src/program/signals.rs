//! Ctrl-C, SIGTERM and the end of the terminal: what they end, and what they leave.

use crate::experiments::{Progress, say};
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// Stack of a thread that only waits and tells, in bytes: RUST_MIN_STACK may ask for more than there is.
const SMALL: usize = 1 << 20;

/// What a shell calls a program that Ctrl-C ended: 128 + SIGINT.
pub(super) const INTERRUPTED: u8 = 130;

/// Whether a signal is ending the program.
static ENDING: AtomicBool = AtomicBool::new(false);

/// Leaves the last word to a signal that is ending the program, if one is: what fails now fails for that.
pub(super) fn yield_to_end() {
    while ENDING.load(Ordering::Relaxed) {
        std::thread::sleep(PATIENCE);
    }
}

/// Gives a signal, which may be on its way, the time in which it ends the program.
pub(super) fn await_end() {
    std::thread::sleep(PATIENCE + Duration::from_millis(300));
    yield_to_end();
}

/// The flag of the work under way.
static WORK: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// How long work may take to see its flag.
const PATIENCE: Duration = Duration::from_millis(700);

/// From now on Ctrl-C (SIGTERM, or the end of the terminal) raises the flag that work with [`Progress`] looks at; without such
/// work, or the second time, it ends the program at once. Always with exit code 130.
pub fn obey() {
    let end = |now| -> ! {
        ENDING.store(true, Ordering::Relaxed);
        for path in TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner).iter() {
            // Again, should the work that goes on have saved something meanwhile.
            let gone = || std::fs::remove_dir_all(path).or_else(|_| std::fs::remove_file(path));
            let _ = (0..9).any(|_| gone().is_ok());
        }
        remove_empty(&MADE.lock().unwrap_or_else(PoisonError::into_inner));
        // Standard error may wait for a reader for ever.
        let (tells, told) = std::sync::mpsc::channel();
        let tell = move || {
            say(match now {
                Now::Placing => "impact-paper: interrupted between two files; the next run goes on",
                _ => "impact-paper: interrupted",
            });
            let _ = tells.send(());
        };
        if std::thread::Builder::new().stack_size(SMALL).spawn(tell).is_ok() {
            let _ = told.recv_timeout(Duration::from_millis(200));
        }
        std::process::exit(i32::from(INTERRUPTED))
    };
    // A file that would grow past the limit of `ulimit -f` fails to be written, as on a full disk.
    #[cfg(unix)]
    let _ =
        signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::new(AtomicBool::new(false)));
    // Where memory ends, that is told and aborts.
    #[cfg(unix)]
    let _ = signal_hook::flag::register_conditional_shutdown(
        signal_hook::consts::SIGABRT,
        4,
        Arc::new(AtomicBool::new(true)),
    );
    let now = || NOW.lock().unwrap_or_else(PoisonError::into_inner);
    // A handler can only be refused if there is one already; then a signal just ends the program.
    let obeyed = move || {
        // Held to the end, so that no work begins and no file is moved meanwhile.
        let mut held = now();
        if let Some(stop) = WORK.get()
            && *held != Now::Idle
            && !stop.swap(true, Ordering::Relaxed)
        {
            drop(held);
            std::thread::sleep(PATIENCE);
            held = now();
        }
        let placing = *held == Now::Placing;
        for _ in 0..20 {
            if *held == Now::Placing {
                drop(held);
                std::thread::sleep(Duration::from_millis(10));
                held = now();
            }
        }
        if placing && *held != Now::Placing {
            // All is in its place: what is left is to tell of it.
            drop(held);
            std::thread::sleep(PATIENCE);
            held = now();
        }
        // Also on a disk where placing takes long: the next run goes on from any moment of it.
        end(*held);
    };
    #[cfg(not(unix))]
    let _ = ctrlc::set_handler(obeyed);
    #[cfg(unix)]
    on_signals(obeyed);
}

/// Calls `obey` at each signal that ends programs, but for what the caller has ignored: `nohup` does.
#[cfg(unix)]
fn on_signals(obey: impl Fn() + Send + 'static) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let hangup = (!is_ignored(SIGHUP)).then_some(SIGHUP);
    let signals = signal_hook::iterator::Signals::new(hangup.into_iter().chain([SIGINT, SIGTERM]));
    let follow = |mut signals: signal_hook::iterator::Signals| {
        let thread = std::thread::Builder::new().stack_size(SMALL);
        thread.spawn(move || signals.forever().for_each(|_| obey()))
    };
    // Without, such a signal just ends the program.
    let _ = signals.and_then(follow);
}

/// Whether a signal was ignored when the program began; Linux tells it.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// What a signal has to know of the moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Now {
    /// Work is under way.
    Working,
    /// Text is printed, and may wait for a reader for ever: the first signal ends the program.
    Idle,
    /// Files are moved into place, which is a matter of moments: the signal waits for so long.
    Placing,
}

static NOW: Mutex<Now> = Mutex::new(Now::Working);

/// As long as this lives, the moment is what it was said to be.
pub struct Moment(());

/// Says what the moment is.
pub fn moment(now: Now) -> Moment {
    *NOW.lock().unwrap_or_else(PoisonError::into_inner) = now;
    Moment(())
}

impl Drop for Moment {
    fn drop(&mut self) {
        *NOW.lock().unwrap_or_else(PoisonError::into_inner) = Now::Working;
    }
}

/// Folders that this run makes, the deepest first.
static MADE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Temporary files and folders of this run, which go with all that is in them.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Says that a signal which ends the program is to remove a file, or a folder with all that is in it.
pub fn temporary(path: &Path) {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner).push(path.into());
}

/// At the end of this, and of the program, what was made and left empty is removed.
#[derive(Debug)]
pub struct Made(Vec<PathBuf>);

/// Says that a folder is about to be made, with those above it that are missing.
pub fn made(folder: &Path) -> Made {
    let missing = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
    let missing: Vec<PathBuf> = folder.ancestors().take_while(missing).map(PathBuf::from).collect();
    MADE.lock().unwrap_or_else(PoisonError::into_inner).extend(missing.clone());
    Made(missing)
}

impl Drop for Made {
    fn drop(&mut self) {
        remove_empty(&self.0);
        let own: HashSet<&PathBuf> = self.0.iter().collect();
        MADE.lock().unwrap_or_else(PoisonError::into_inner).retain(|path| !own.contains(path));
    }
}

fn remove_empty(folders: &[PathBuf]) {
    for folder in folders {
        // Fails, as it should, if the folder is not empty.
        let _ = std::fs::remove_dir(folder);
    }
}

/// Progress on stderr of work that a signal ends within a moment. What has not looked at the flag by then, such as a
/// chain of many masses, is ended all the same.
pub fn progress() -> Progress {
    let _ending = NOW.lock().unwrap_or_else(PoisonError::into_inner);
    Progress::on_stderr(Arc::clone(WORK.get_or_init(Arc::default)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_that_were_made_and_left_empty_go() {
        let folder = tempfile::tempdir().unwrap();
        let [new, below] = ["new", "new/below"].map(|name| folder.path().join(name));
        for (file, left) in [("", false), ("kept", true)] {
            let made = made(&below);
            std::fs::create_dir_all(&below).unwrap();
            if left {
                std::fs::write(new.join(file), "").unwrap();
            }
            drop(made);
            assert_eq!((new.exists(), below.exists()), (left, false));
        }
        assert!(folder.path().exists());
    }
}

//! Ctrl-C and SIGTERM: work is asked to end, and what has not ended within a moment is ended.

use crate::experiments::Progress;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, LazyLock};
#[cfg(unix)]
use {
    crate::experiments::say,
    literate::input::WRITING,
    signal_hook::consts::{SIGINT, SIGTERM},
    signal_hook::iterator::Signals,
    std::time::Duration,
};

/// What a shell calls a program that Ctrl-C ended: 128 + SIGINT.
pub(super) const INTERRUPTED: u8 = 130;

/// Whether the work is to end.
static STOP: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// From now on Ctrl-C and SIGTERM end the program within a second, with exit code 130. Files that are being put into
/// place are first all there.
#[cfg(unix)]
pub fn obey() {
    let follow = |mut signals: Signals| {
        let ended = move || {
            if signals.forever().next().is_some() {
                STOP.store(true, std::sync::atomic::Ordering::Relaxed);
                std::thread::sleep(Duration::from_millis(700));
                let _moment = WRITING.write();
                say("impact-paper: interrupted");
                std::process::exit(i32::from(INTERRUPTED));
            }
        };
        std::thread::Builder::new().stack_size(1 << 20).spawn(ended)
    };
    // Without, such a signal just ends the program.
    let _ = Signals::new([SIGINT, SIGTERM]).and_then(follow);
}

/// Elsewhere the system ends the program.
#[cfg(not(unix))]
pub fn obey() {}

/// Progress on stderr of work that a signal ends.
pub fn progress() -> Progress {
    Progress::on_stderr(Arc::clone(&STOP))
}

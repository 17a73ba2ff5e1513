//! Memory: work that needs more than there is gets refused before it begins.

use super::Failure;
use crate::input::{FOUND, MEMORY};
use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Refuses work that needs more memory than there is, before any of it is taken: an estimate in bytes, the
/// option that asks for it, and what to give instead.
pub fn fits(needed: u128, option: &str, remedy: &str) -> Result<(), Failure> {
    let at_hand = at_hand();
    // Where addresses are few, what threads set aside counts.
    let pool = THREAD * POOL.load(Ordering::Relaxed) as u128;
    let needed = needed + addresses().map_or(0, |_| OWN + pool);
    if needed <= at_hand {
        return Ok(());
    }
    let (needed, at_hand) = (size(needed), size(at_hand));
    Err(Failure::input(format!(
        "{option}: about {needed} of memory are needed and {at_hand} are at hand; {remedy}"
    )))
}

/// Memory that results, figures and documents need at least, in MiB: measured, with a little room.
pub const RESULTS: u128 = 256;

/// Refuses a verb, or a part of one, that needs at least so many MiB, where there are fewer.
pub fn least(mib: u128, what: &str) -> Result<(), Failure> {
    fits(mib << 20, what, MEMORY)
}

/// Length of a file, as far as it may be read.
pub fn length(path: &Path) -> u128 {
    let long = path.metadata().map_or(0, |found| found.len());
    u128::from(long.min(FOUND << 20))
}

/// Bytes for each of a text that is parsed: measured, with a little room.
const PARSED: u128 = 40;

/// Refuses files of a folder that take more memory, parsed, than there is.
///
/// # Errors
/// Exit code 2 with an estimate, told of `what`.
pub fn to_parse(folder: &Path, names: &[&str], what: &str) -> Result<(), Failure> {
    let long: u128 = names.iter().map(|name| length(&folder.join(name))).sum();
    fits(PARSED * long + (128 << 20), what, MEMORY)
}

/// What any verb takes at least, in MiB: asked for before there is a second thread.
pub const BEGIN: u128 = 16;

/// Addresses of the threads besides those that compute (of the verb, of the signals, of the signs of life), and once what
/// the system takes for a moment to align a heap.
const OWN: u128 = 3 * THREAD + HEAP;

/// What the system sets aside for the heap of a thread.
const HEAP: u128 = 64 << 20;

/// Addresses that a thread takes besides: its stack and its heap.
pub const THREAD: u128 = STACK as u128 + HEAP;

/// Stack of a thread that works, in bytes: the system, or RUST_MIN_STACK, may give less.
pub const STACK: usize = 8 << 20;

/// Stack of a thread that only waits and tells: RUST_MIN_STACK may ask for more than there is.
pub const SMALL: usize = 1 << 20;

/// Threads of the pool under way.
pub(super) static POOL: AtomicUsize = AtomicUsize::new(0);

/// The first number of a file in which Linux tells something.
fn number(text: &str) -> Option<u128> {
    text.split_whitespace().next()?.parse().ok()
}

/// The number behind a name at the beginning of a line.
fn named(path: &str, name: &str) -> Option<u128> {
    std::fs::read_to_string(path).ok()?.lines().find_map(|line| number(line.strip_prefix(name)?))
}

/// Addresses that the process may still take, where its limit is below the infinite. Counted from its beginning, and not
/// from what it has now: what the system sets aside for the heaps of threads depends on their order.
fn addresses() -> Option<u128> {
    static BEGAN: OnceLock<u128> = OnceLock::new();
    let most = named("/proc/self/limits", "Max address space")?;
    let kib = |name| Some(named("/proc/self/status", name)? << 10);
    let began = *BEGAN.get_or_init(|| kib("VmSize:").unwrap_or_default());
    let taken = kib("RssAnon:")?;
    Some(most.saturating_sub(began + taken))
}

/// Memory that the system has to give, in bytes: Linux tells it, elsewhere 4 GiB are taken for granted. Less where
/// the process or its group may not have as much.
fn at_hand() -> u128 {
    let group = || {
        let at =
            |name: &str| number(&std::fs::read_to_string(format!("/sys/fs/cgroup/{name}")).ok()?);
        Some(at("memory.max")?.saturating_sub(at("memory.current")?))
    };
    let free = named("/proc/meminfo", "MemAvailable:").map_or(4 << 30, |kib| kib << 10);
    // Half of the addresses are what a process can hope for.
    let limits = [addresses(), group(), Some(usize::MAX as u128 / 2)];
    limits.into_iter().flatten().fold(free, u128::min)
}

/// Bytes in GiB or, where they are fewer, MiB.
fn size(bytes: u128) -> String {
    match bytes as f64 / f64::from(1 << 20) {
        mib if mib < 1024.0 => format!("{mib:.0} MiB"),
        mib => format!("{:.1} GiB", mib / 1024.0),
    }
}

//! Memory: chains that need more than there is are refused before they begin.

use super::Failure;

/// Refuses chains that need more memory than there is: an estimate in bytes, the option that asks for them, and what
/// to give instead.
///
/// # Errors
/// Exit code 2 with the estimate.
pub fn fits(needed: u128, option: &str, remedy: &str) -> Result<(), Failure> {
    let at_hand = at_hand();
    if needed <= at_hand {
        return Ok(());
    }
    let (needed, at_hand) = (size(needed), size(at_hand));
    Err(Failure::input(format!(
        "{option}: about {needed} of memory are needed and {at_hand} are at hand; {remedy}"
    )))
}

/// The first number of a file in which Linux tells something.
fn number(text: &str) -> Option<u128> {
    text.split_whitespace().next()?.parse().ok()
}

/// Memory that the system has to give, in bytes: Linux tells it, elsewhere 4 GiB are taken for granted. Less where
/// the group of the process may not have as much, or a process has fewer addresses.
fn at_hand() -> u128 {
    let group = || {
        let at =
            |name: &str| number(&std::fs::read_to_string(format!("/sys/fs/cgroup/{name}")).ok()?);
        Some(at("memory.max")?.saturating_sub(at("memory.current")?))
    };
    let free = || {
        let text = std::fs::read_to_string("/proc/meminfo").ok()?;
        text.lines().find_map(|line| number(line.strip_prefix("MemAvailable:")?))
    };
    let free = free().map_or(4 << 30, |kib| kib << 10);
    group().unwrap_or(free).min(free).min(usize::MAX as u128 / 2)
}

/// Bytes in GiB or, where they are fewer, MiB.
fn size(bytes: u128) -> String {
    match bytes as f64 / f64::from(1 << 20) {
        mib if mib < 1024.0 => format!("{mib:.0} MiB"),
        mib => format!("{:.1} GiB", mib / 1024.0),
    }
}

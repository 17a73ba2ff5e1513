//! Memory: chains that need more than there is are refused before they begin.

use super::Failure;

/// Refuses chains that need more memory than there is: an estimate in bytes, the option that asks for them, and what
/// to give instead.
pub fn fits(needed: u128, option: &str, remedy: &str) -> Result<(), Failure> {
    let at_hand = at_hand();
    if needed <= at_hand {
        return Ok(());
    }
    let gib = |bytes: u128| format!("{:.1} GiB", bytes as f64 / f64::from(1 << 30));
    Err(Failure::input(format!(
        "{option}: about {} of memory are needed and {} are at hand; {remedy}",
        gib(needed),
        gib(at_hand)
    )))
}

/// Memory that the system has to give, in bytes: Linux tells it, elsewhere 4 GiB are taken for granted. No process has
/// more addresses than half of all.
fn at_hand() -> u128 {
    let text = std::fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let free = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"));
    let kib = free.and_then(|line| line.split_whitespace().next()?.parse::<u128>().ok());
    kib.map_or(4 << 30, |kib| kib << 10).min(usize::MAX as u128 / 2)
}

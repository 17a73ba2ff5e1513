//! Says how much there is to run, and about how long that takes, before the first run begins.

use super::cutting::{SECOND, Unit};
use super::{Error, Profile, Session};
use crate::text::count;

/// Prints one line if some units are to be run: what they belong to, and about how long they take.
///
/// # Errors
/// If their results cannot be saved.
pub(crate) fn announce(what: &str, units: &[Unit], session: &Session<'_>) -> Result<(), Error> {
    if units.is_empty() {
        return Ok(());
    }
    session.store.prepare()?;
    let work: u64 = units.iter().map(|unit| unit.weight).sum();
    let threads = rayon::current_num_threads();
    let time = duration(work / SECOND / threads as u64);
    let quick = match session.profile {
        Profile::Full => "; `--profile quick` takes seconds",
        Profile::Quick => "",
    };
    let threads = count(threads, "thread");
    session.progress.say(&format!("{what} to run, {time} on {threads}{quick}"));
    Ok(())
}

/// Returns a time in words, as precise as an estimate from counted work is.
fn duration(seconds: u64) -> String {
    match seconds {
        0..10 => "a few seconds".into(),
        10..100 => format!("about {} seconds", seconds.div_ceil(10) * 10),
        _ => format!("about {} minutes", seconds.div_ceil(60)),
    }
}

#[cfg(test)]
mod tests {
    use super::duration;

    #[test]
    fn times_are_rounded_up() {
        assert_eq!(duration(3), "a few seconds");
        assert_eq!(duration(41), "about 50 seconds");
        assert_eq!(duration(179), "about 3 minutes");
    }
}

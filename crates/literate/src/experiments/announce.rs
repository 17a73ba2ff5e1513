//! Says how many experiments there are to run, and about how long that takes, before the first of
//! them begins.

use super::cutting::SECOND;
use super::{AnyExperiment, Error, Profile, Session};
use crate::text::count;

/// Prints one line if any of the experiments has no fresh result.
///
/// # Errors
/// If results cannot be saved.
pub(super) fn announce(
    experiments: &[&'static dyn AnyExperiment],
    session: &Session<'_>,
) -> Result<(), Error> {
    let is_stale = |one: &&&dyn AnyExperiment| one.stale(session).is_some();
    let stale: Vec<_> = experiments.iter().filter(is_stale).collect();
    if stale.is_empty() {
        return Ok(());
    }
    session.store.prepare()?;
    let units = stale.iter().flat_map(|one| one.units(session.profile));
    let work: u64 = units.map(|unit| unit.weight).sum();
    let threads = rayon::current_num_threads();
    let time = duration(work / SECOND / threads as u64);
    let quick = match session.profile {
        Profile::Full => "; `--profile quick` takes seconds",
        Profile::Quick => "",
    };
    let (stale, threads) = (count(stale.len(), "experiment"), count(threads, "thread"));
    session.progress.say(&format!("{stale} to run, {time} on {threads}{quick}"));
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

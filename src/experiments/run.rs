//! Runs what is needed, and nothing else; long runs are taken from the store.

use super::{ALL, Error, Need, Progress, Results, Store};
use crate::params::Profile;
use literate::experiments::experiment::Given;

/// Runs the experiments that are needed with the sample sizes of a profile. `given` gives the text of a
/// file of the templates; it is asked only by experiments that read one.
pub fn run(
    needs: &[Need],
    profile: Profile,
    given: Given<'_>,
    store: &Store,
    progress: &Progress,
) -> Result<Results, Error> {
    let mut results = Results::empty(profile);
    let needed = |one: &&Need| needs.iter().any(|need| need.name() == one.name());
    for experiment in ALL.iter().filter(needed) {
        results.put(experiment.name(), experiment.found(profile, given, store, progress)?);
    }
    progress.check()?;
    Ok(results)
}

#[cfg(test)]
mod tests {
    use super::super::{SEGMENTS, SWEEP, TWO_MASSES};
    use super::*;

    #[test]
    fn only_what_is_needed_runs() {
        let none = |_: &str| Err("not there".to_string());
        let (store, quiet) = (Store::nowhere(), Progress::silent());
        let results = run(&[&TWO_MASSES], Profile::Quick, &none, &store, &quiet).unwrap();
        assert!(results.of(&TWO_MASSES).is_ok());
        assert!(results.of(&SWEEP).is_err() && results.of(&SEGMENTS).is_err());
    }
}

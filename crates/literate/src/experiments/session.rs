//! Holds what a run needs: project, prose, profile, store and progress.

use super::cutting::{SECOND, Unit};
use super::error::Error;
use super::profile::Profile;
use super::progress::Progress;
use super::store::Store;
use crate::input::count;
use crate::project::Project;
use crate::prose::Templates;

#[derive(Debug)]
pub struct Session<'a> {
    pub project: &'a Project,
    pub templates: Templates,
    pub profile: Profile,
    pub store: Store,
    pub progress: Progress,
}

impl Session<'_> {
    /// Prints one line if some units are to be run: of what, and about how long they take.
    pub(crate) fn announce(&self, what: &str, units: &[Unit]) -> Result<(), Error> {
        if units.is_empty() {
            return Ok(());
        }
        self.store.prepare()?;
        let threads = rayon::current_num_threads();
        let (time, threads) = (time(units, threads as u64), count(threads, "thread"));
        let line = match (time, self.profile) {
            (None, _) => format!("{what} to run on {threads}, time unknown"),
            (Some(time), Profile::Quick) => format!("{what} to run, {time} on {threads}"),
            (Some(time), Profile::Full) => {
                format!("{what} to run, {time} on {threads}; `--profile quick` takes seconds")
            }
        };
        self.progress.say(&line);
        Ok(())
    }
}

/// Returns how long units take on so many threads; none if no estimate of their work was given.
fn time(units: &[Unit], threads: u64) -> Option<String> {
    let work: u64 = units.iter().map(|unit| unit.weight).sum();
    let or_more = if units.iter().any(|unit| unit.weight == 0) { " or more" } else { "" };
    (work > 0).then(|| duration(work / SECOND / threads) + or_more)
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
    use super::*;

    impl Session<'_> {
        /// Makes a session of a project of three files, with small samples and without prose.
        pub(crate) fn toy(store: Store, progress: Progress) -> Self {
            let project = Box::leak(Box::new(Project::new(crate::source::toy())));
            let (templates, profile) = (Templates::of([]), Profile::Quick);
            Session { project, templates, profile, store, progress }
        }
    }

    #[test]
    fn times_are_rounded_up() {
        assert_eq!(duration(3), "a few seconds");
        assert_eq!(duration(41), "about 50 seconds");
        assert_eq!(duration(179), "about 3 minutes");
    }

    #[test]
    fn no_time_is_given_without_an_estimate() {
        let [none, some] = [0, 100 * SECOND].map(Unit::whole);
        assert_eq!(time(&[none.clone(), none.clone()], 2), None);
        assert_eq!(time(&[some.clone()], 2).unwrap(), "about 50 seconds");
        assert_eq!(time(&[some, none], 2).unwrap(), "about 50 seconds or more");
    }
}

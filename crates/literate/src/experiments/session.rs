//! Holds what a run needs: project, prose, profile, store and progress.

use super::cutting::{Unit, WORK_PER_SECOND};
use super::error::Error;
use super::progress::Progress;
use super::store::{Profile, Store};
use crate::code::Code;
use crate::input::count;
use crate::project::Project;
use crate::prose::Templates;

/// What a run of the program works with.
#[derive(Clone, Debug)]
pub struct Session<'a> {
    /// Where files are found.
    pub project: &'a Project,
    /// The prose.
    pub templates: Templates,
    pub(crate) profile: Profile,
    pub(crate) store: Store,
    /// Where progress is shown.
    pub progress: Progress,
    pub(crate) code: Code,
}

impl Session<'_> {
    /// Prints what is run and about how long it takes, if any units are to be run.
    pub(crate) fn announce(&self, subject: &str, units: &[Unit]) -> Result<(), Error> {
        if units.is_empty() {
            return Ok(());
        }
        self.store.prepare()?;
        let threads = rayon::current_num_threads();
        let (time, threads) = (time(units, threads as u64), count(threads, "thread"));
        let remark = match self.profile {
            _ if time.is_empty() => ", time unknown",
            Profile::Full => "; `--profile quick` takes seconds",
            Profile::Quick => "",
        };
        self.progress.say(&format!("{subject} to run{time} on {threads}{remark}"));
        Ok(())
    }
}

/// Returns in words how long units take, as precise as an estimate from counted work is, or no
/// words if the work of all of them is unknown.
fn time(units: &[Unit], threads: u64) -> String {
    let work: u64 = units.iter().map(|unit| unit.work).sum();
    if work == 0 {
        return String::new();
    }
    let or_more = if units.iter().any(|unit| unit.work == 0) { " or more" } else { "" };
    match work / WORK_PER_SECOND / threads {
        0..10 => format!(", a few seconds{or_more}"),
        seconds @ 10..100 => format!(", about {} seconds{or_more}", seconds.div_ceil(10) * 10),
        seconds => format!(", about {} minutes{or_more}", seconds.div_ceil(60)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Session<'_> {
        /// Makes a session of a project of three files, with small samples and without prose.
        pub(crate) fn toy(store: Store, progress: Progress) -> Self {
            let project = Box::leak(Box::new(Project::new(crate::source::toy())));
            let (templates, profile) = (Templates::from_files([]), Profile::Quick);
            let code = Code::default();
            Session { project, templates, profile, store, progress, code }
        }
    }

    #[test]
    fn times_are_rounded_up_and_unknown_without_an_estimate() {
        let of_one = |seconds: u64| time(&[Unit::whole(seconds * WORK_PER_SECOND)], 1);
        let times = [", a few seconds", ", about 50 seconds", ", about 3 minutes"];
        assert_eq!([3, 41, 179].map(of_one), times);
        let units = [0, 100 * WORK_PER_SECOND].map(Unit::whole);
        assert_eq!(time(&units, 2), ", about 50 seconds or more");
        assert_eq!([time(&units[..1], 2), time(&units[1..], 2)], ["", ", about 50 seconds"]);
    }
}

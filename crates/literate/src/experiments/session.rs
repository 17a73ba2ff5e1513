//! Holds what a run needs: project, prose, profile, store and progress.

use super::error::Error;
use super::profile::Profile;
use super::progress::Progress;
use super::store::{Identity, Json, Store};
use crate::project::Project;
use crate::prose::Templates;

/// A run: which project, prose and samples it takes, and where it keeps results.
#[derive(Debug)]
pub struct Session<'a> {
    pub project: &'a Project,
    pub templates: Templates,
    pub profile: Profile,
    pub store: Store,
    pub progress: Progress,
}

impl Session<'_> {
    /// Returns the saved result if it is fresh, else that of a run, which is then saved.
    pub(super) fn saved<T: Json>(
        &self,
        identity: &Identity,
        run: impl FnOnce() -> Result<T, Error>,
    ) -> Result<T, Error> {
        let found = self.store.look(identity);
        let why = found.as_ref().err().map_or("fresh", String::as_str);
        self.progress.say(&format!("{}: {why}", identity.experiment));
        if let Ok(found) = found {
            return Ok(found);
        }
        self.store.prepare()?;
        let result = run()?;
        self.store.put(identity, &result)?;
        // Units that stay do no harm: the joined result is looked for first.
        let _ = self.store.remove(identity, false);
        Ok(result)
    }
}

#[cfg(test)]
impl Session<'_> {
    /// Makes a session of a project of three files, with small samples and without prose.
    pub(crate) fn toy(store: Store, progress: Progress) -> Self {
        let project = Box::leak(Box::new(Project::new(crate::source::toy())));
        Session { project, templates: Templates::of([]), profile: Profile::Quick, store, progress }
    }
}

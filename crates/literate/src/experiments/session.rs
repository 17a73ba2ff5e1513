//! Holds what a run needs: project, prose, profile, store and progress.

use super::error::Error;
use super::profile::Profile;
use super::progress::Progress;
use super::store::{Identity, Json, Store};
use crate::project::Project;
use crate::prose::Templates;

/// A run: of which project, with which samples and prose, and where results are kept.
#[derive(Debug)]
pub struct Session<'a> {
    pub project: &'a Project,
    pub templates: Templates,
    pub profile: Profile,
    pub store: Store,
    pub progress: Progress,
}

impl Session<'_> {
    /// The saved result if it is fresh, else that of a run, which is then saved.
    pub(super) fn saved<T: Json>(
        &self,
        identity: &Identity,
        run: impl FnOnce() -> Result<T, Error>,
    ) -> Result<T, Error> {
        let say = |why| self.progress.say(&format!("{}: {why}", identity.experiment));
        let why = match self.store.look(identity) {
            Ok(found) => {
                say("fresh");
                return Ok(found);
            }
            Err(why) => why,
        };
        self.store.prepare()?;
        say(&why);
        let result = run()?;
        self.store.put(identity, &result)?;
        self.store.remove_units(identity);
        Ok(result)
    }
}

//! What a run of experiments is given.

use super::experiment::Json;
use super::identity::Identity;
use super::{Error, Profile, Progress, Store};
use crate::paper::Paper;
use crate::report::Templates;

/// A run: of which paper, with which samples and prose, and where results are kept.
#[derive(Debug)]
pub struct Session<'a> {
    /// The paper.
    pub paper: &'a Paper,
    /// The prose, and what stands with it.
    pub templates: Templates,
    /// The sample sizes.
    pub profile: Profile,
    /// Where results are saved.
    pub store: Store,
    /// How far work is, and whether it is to end.
    pub progress: Progress,
}

impl Session<'_> {
    /// The saved result if it is fresh, else that of a run, which is then saved.
    pub(super) fn saved<T: Json>(
        &self,
        identity: &Identity,
        run: impl FnOnce() -> Result<T, Error>,
    ) -> Result<T, Error> {
        let (found, why) = match self.store.look(identity) {
            Ok(found) => (Some(found), "fresh".into()),
            Err(why) => (None, why),
        };
        self.progress.say(&format!("{}: {why}", identity.experiment));
        if let Some(found) = found {
            return Ok(found);
        }
        self.store.prepare()?;
        let result = run()?;
        self.store.put(identity, &result)?;
        self.store.remove_units(identity);
        Ok(result)
    }
}

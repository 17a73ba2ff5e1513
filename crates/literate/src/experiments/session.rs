//! What a run of experiments is given.

use super::{Profile, Progress, Store};
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

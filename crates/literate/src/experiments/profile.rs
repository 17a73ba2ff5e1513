//! Names the two sizes of samples.

use serde::{Deserialize, Serialize};

/// The sizes of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    /// Small samples, to try things out
    Quick,
    /// The committed report
    Full,
}

impl Profile {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Profile::Quick => "quick",
            Profile::Full => "full",
        }
    }
}

//! Sizes of samples.

use serde::{Deserialize, Serialize};

/// How much is sampled: small to try out, large for the committed report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    /// To try out: seconds.
    Quick,
    /// The committed report.
    Full,
}

impl Profile {
    /// All of them, rising.
    pub const ALL: [Profile; 2] = [Profile::Quick, Profile::Full];

    /// Its name on the command line, in reports and in names of files.
    pub fn name(self) -> &'static str {
        match self {
            Profile::Quick => "quick",
            Profile::Full => "full",
        }
    }
}

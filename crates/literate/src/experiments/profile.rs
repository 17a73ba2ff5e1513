//! Names the two sizes of samples.

use serde::{Deserialize, Serialize};

/// How much is sampled: small to try out, large for the committed report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    Quick,
    Full,
}

impl Profile {
    /// Returns its name on the command line, in reports and in names of files.
    pub fn name(self) -> &'static str {
        match self {
            Profile::Quick => "quick",
            Profile::Full => "full",
        }
    }
}

impl std::str::FromStr for Profile {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let mut all = [Profile::Quick, Profile::Full].into_iter();
        all.find(|profile| profile.name() == name)
            .ok_or_else(|| format!("no profile {name:?}; give quick or full"))
    }
}

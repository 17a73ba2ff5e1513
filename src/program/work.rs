//! What the verbs that take time have in common: sample sizes, experiments by name, and where results are kept.

use super::Failure;
use crate::experiments;
use crate::params::Profile;
use clap::builder::{PathBufValueParser, PossibleValue, PossibleValuesParser, TypedValueParser};
use literate::experiments::shards::Plan;
use std::path::PathBuf;

/// The profile of a name.
pub fn profile(name: &str) -> Option<Profile> {
    Profile::ALL.into_iter().find(|own| own.name() == name)
}

/// Reads sample sizes.
pub fn profiles() -> impl TypedValueParser<Value = Profile> {
    let about = |profile| match profile {
        Profile::Quick => "To try out: seconds",
        Profile::Full => "The committed report: minutes",
    };
    let known = Profile::ALL.map(|own| PossibleValue::new(own.name()).help(about(own)));
    PossibleValuesParser::new(known).try_map(|name| profile(&name).ok_or("unknown"))
}

/// Reads a folder that may have to be made: without dots at its end, with which none can be.
pub fn folder() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().map(|folder| folder.components().collect())
}

/// Which experiments of a profile are meant.
#[derive(clap::Args)]
pub struct Only {
    /// Only these experiments, by the names that `status` shows, with commas between them. Shards are those of
    /// the units of these: `plan`, `run` and `merge` must name the same.
    #[arg(long = "experiment", value_name = "NAME", value_delimiter = ',')]
    names: Vec<String>,
}

impl Only {
    /// The units of work of these experiments, or of all if none is named.
    pub fn plan(&self, profile: Profile) -> Result<Plan, Failure> {
        let known: Vec<&str> = experiments::of(profile).iter().map(|one| one.name()).collect();
        if let Some(name) = self.names.iter().find(|name| !known.contains(&name.as_str())) {
            let (profile, known) = (profile.name(), known.join(", "));
            return Err(Failure::input(format!(
                "--experiment: profile {profile} has no experiment \"{name}\"; give some of {known}"
            )));
        }
        let plan = Plan::new(experiments::of, profile);
        Ok(if self.names.is_empty() { plan } else { plan.only(&self.names) })
    }
}

//! Options that verbs have in common.

use crate::params::Profile;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

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

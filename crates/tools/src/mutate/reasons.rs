//! Why a number may stay without a check: `unguarded.toml`.

use impact_paper::input::toml_fault;
use impact_paper::report::Error;
use impact_paper::report::guards::fits;
use serde::Deserialize;

/// Reasons, each for some ids.
#[derive(Clone, Debug, Default)]
pub struct Reasons(Vec<Group>);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default)]
    unguarded: Vec<Group>,
}

/// Ids that have one reason.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// What they are, in a few words.
    pub kind: String,
    /// Why no check can or should notice that one of them is wrong.
    pub why: String,
    /// The ids; a `*` at the end stands for any ending.
    pub ids: Vec<String>,
}

impl Group {
    /// The pattern of this group that an id fits.
    fn pattern(&self, id: &str) -> Option<&str> {
        self.ids.iter().map(String::as_str).find(|pattern| fits(pattern, id))
    }
}

impl Reasons {
    /// Reads `unguarded.toml`.
    ///
    /// # Errors
    /// TOML that does not read, a group without a reason, an id that stands twice.
    pub fn read(text: &str) -> Result<Self, Error> {
        let fail = |what: String| Error::Template(format!("unguarded.toml: {what}"));
        let syntax =
            |error| Error::Template(format!("unguarded.toml:{}", toml_fault(text, &error)));
        let File { unguarded } = toml::from_str(text).map_err(syntax)?;
        if let Some(group) = unguarded.iter().find(|group| group.why.trim().is_empty()) {
            return Err(fail(format!("no reason for {:?}", group.ids)));
        }
        let mut ids: Vec<&String> = unguarded.iter().flat_map(|group| &group.ids).collect();
        ids.sort();
        match ids.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(fail(format!("{:?} stands twice; remove one of them", pair[0]))),
            None => Ok(Reasons(unguarded)),
        }
    }

    /// The group that gives a reason for an id.
    pub fn of(&self, id: &str) -> Option<&Group> {
        self.0.iter().find(|group| group.pattern(id).is_some())
    }

    /// The groups, in the order of the file.
    pub fn groups(&self) -> &[Group] {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reason_is_for_ids() {
        let text = "[[unguarded]]\nkind = \"sizes\"\nwhy = \"chosen\"\nids = [\"n\", \"s_*\"]";
        let reasons = Reasons::read(text).unwrap();
        assert_eq!(reasons.of("s_1").unwrap().why, "chosen");
        assert!(reasons.of("n").is_some() && reasons.of("n2").is_none());
        for broken in [
            text.replace("chosen", " "),
            text.replace("s_*", "n"),
            text.replace("why", "because"),
            "unguarded = 1".into(),
        ] {
            let error = Reasons::read(&broken).unwrap_err().to_string();
            assert!(error.starts_with("unguarded.toml"), "{error}");
        }
    }
}

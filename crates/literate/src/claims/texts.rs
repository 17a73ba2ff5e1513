//! Makes checks of their texts with the numbers that a rule gives.

use super::check::Check;
use super::evidence::{Error, Evidence, Judged};
use super::published::PublishedError;
use super::text::Text;
use super::words::{KEYS, Numbers};

impl Evidence<'_> {
    /// Makes the check of all its texts with the numbers in them; `None` leaves it open.
    pub fn check(&self, agrees: impl Into<Option<bool>>, numbers: Numbers<'_>) -> Judged {
        let [found, tolerance, reason, note] = self.filled(KEYS, numbers)?;
        let check = self.open(found).note(note);
        Ok(match agrees.into() {
            Some(agrees) => check.judged(agrees).with_tolerance(tolerance, &reason.to_string()),
            None => check,
        })
    }

    /// Makes one text of the check, for one that some results alone have or that has other numbers.
    pub fn sentence(&self, key: &str, numbers: Numbers<'_>) -> Result<Text, Error> {
        let [text] = self.filled([key], numbers)?;
        Ok(text)
    }

    fn filled<const N: usize>(
        &self,
        keys: [&str; N],
        numbers: Numbers<'_>,
    ) -> Result<[Text; N], Error> {
        let texts = self.published.words.fill(&self.statement.id, keys, numbers);
        Ok(texts.map_err(PublishedError)?)
    }
}

impl Check {
    /// Takes its note for an explanation: unless this predicts what is found, the check fails.
    pub fn explained_if(self, holds: bool) -> Check {
        let note = self.note.clone();
        self.explained(note, holds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::check::Verdict;
    use crate::claims::published::Published;
    use crate::claims::rule::{Rule, judge_all};
    use crate::claims::words::Words;
    use crate::experiments::Results;
    use crate::numbers;
    use crate::prose::Templates;

    const RISE: &str = "[shared]\nreason = \"ours\"\n[rise]\nfound = \"{share:2} of {all}\"\ntolerance = \"none\"\n";

    fn judged(file: &str, rule: Rule) -> Result<Check, String> {
        let statement =
            "[[statement]]\nid = \"rise\"\nplace = \"a\"\nstatement = \"b\"\nprinted = \"c\"";
        let published = Published::parse(statement).unwrap();
        let rules = [rule];
        let words = Words::read(&Templates::from_files([("claims/a.toml", file)]));
        let words = words.and_then(|words| words.refuse_unused(&[rules[0].id]))?;
        let published = Published { words, ..published };
        let checks = judge_all(&published, &rules, &Results::made_up(Vec::new()));
        Ok(checks.map_err(|error| error.to_string())?.remove(0))
    }

    #[test]
    fn texts_are_filled_with_the_numbers_of_the_rule() {
        let rule = |agrees: Option<bool>| {
            Rule::new("rise", move |e| e.check(agrees, numbers![all = 7, share = 0.123]))
        };
        let check = judged(RISE, rule(Some(true))).unwrap();
        assert_eq!(check.found.to_string(), "0.12 of 7");
        assert_eq!((check.tolerance.to_string(), check.reason.as_str()), ("none".into(), "ours"));
        let check = judged(RISE, rule(None)).unwrap();
        assert_eq!((check.verdict, check.reason.as_str()), (Verdict::CannotBeJudged, ""));
        for (from, to, message) in [
            ("{all}", "{al}", "claims/a.toml: [rise] has {al} in found; write {name} or {name:3}"),
            (":2", ":x", "claims/a.toml: [rise] has {share:x} in found; "),
            (" of {all}", "", "claims/a.toml: [rise] does not use {all} in found, tolerance, "),
            ("found", "finding", "claims/a.toml: [rise] has finding; its texts are found, "),
            ("found", "found_more", "claims/a.toml: [rise] has no found; write it"),
            ("[rise]", "[fall]", "claims/a.toml: no check has the id of [fall]; "),
            ("[rise]", "[rise", "claims/a.toml:3: "),
            ("[rise]\n", "", "claims: [rise] is missing; write it"),
        ] {
            let error = judged(&RISE.replace(from, to), rule(Some(true))).unwrap_err();
            assert!(error.contains(message), "{error}");
        }
    }
}

//! Reads the texts of the checks, which stand beside `published.toml` in the folder `claims`, and
//! fills them with the numbers that a rule gives.

use super::check::Check;
use super::evidence::{Error, Evidence, Judged};
use super::published::PublishedError;
use super::rule::Rule;
use super::text::Text;
use crate::input::toml_fault;
use crate::prose::Templates;
use crate::value::Number;
use std::collections::{BTreeMap, BTreeSet};

/// Names numbers for texts: `numbers![windows, share = a / b]`, where a name alone is a variable.
#[macro_export]
macro_rules! numbers {
    (@ $name:ident) => { $name };
    (@ $name:ident $value:expr) => { $value };
    ($($name:ident $(= $value:expr)?),* $(,)?) => {
        &[$((stringify!($name), $crate::value::Number::from($crate::numbers!(@ $name $($value)?)))),*]
    };
}

pub type Numbers<'a> = &'a [(&'a str, Number)];

/// The texts that a rule fills; pieces of them have a name that begins so: `note_open`.
const KEYS: [&str; 4] = ["found", "tolerance", "reason", "note"];

/// The text of a relation that says what must hold.
const STATEMENT: &str = "statement";

type Texts = BTreeMap<String, String>;

/// The texts of checks by the ids of their statements, each with the path of its file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Words(BTreeMap<String, (String, Texts)>);

impl Words {
    /// Reads all files `claims/NAME.toml`, which have a table `[id]` for each check; what stands in
    /// `[shared]` holds for each check of the file without its own.
    pub fn read(templates: &Templates) -> Result<Words, PublishedError> {
        let mut words = Words::default();
        let is_of_claims =
            |(path, _): &(&str, &str)| path.starts_with("claims/") && path.ends_with(".toml");
        for (path, file) in templates.iter().filter(is_of_claims) {
            let fault = |error| PublishedError(format!("{path}:{}", toml_fault(file, &error)));
            let mut checks: BTreeMap<String, Texts> = toml::from_str(file).map_err(fault)?;
            let shared = checks.remove("shared").unwrap_or_default();
            for (id, own) in checks {
                let is_known =
                    |key: &str| key == STATEMENT || KEYS.iter().any(|known| key.starts_with(known));
                if let Some(key) = own.keys().find(|key| !is_known(key)) {
                    let names = KEYS.join(", ");
                    let what = format!("{path}: [{id}] has {key}; its texts are {names}");
                    return Err(PublishedError(what));
                }
                let texts = shared.clone().into_iter().chain(own).collect();
                if let Some((other, _)) = words.0.insert(id.clone(), (path.into(), texts)) {
                    let what = format!("{path}: [{id}] is also in {other}; remove one");
                    return Err(PublishedError(what));
                }
            }
        }
        Ok(words)
    }

    pub(super) fn statement(&self, id: &str) -> Option<&str> {
        self.0.get(id)?.1.get(STATEMENT).map(String::as_str)
    }

    /// Refuses texts that no rule takes.
    pub(crate) fn taken(self, rules: &[Rule]) -> Result<Words, PublishedError> {
        let of_none = |(id, _): &(&String, _)| !rules.iter().any(|rule| rule.id == **id);
        if let Some((id, (path, _))) = self.0.iter().find(of_none) {
            let what = format!("{path}: no check has the id of [{id}]; correct it, or remove it");
            return Err(PublishedError(what));
        }
        Ok(self)
    }
}

impl Evidence<'_> {
    /// Makes the check of all its texts with the numbers in them; `None` leaves it open.
    pub fn check(&self, agrees: impl Into<Option<bool>>, numbers: Numbers<'_>) -> Judged {
        let [found, tolerance, reason, note] = self.texts(KEYS, numbers)?;
        let check = self.open(found).note(note);
        Ok(match agrees.into() {
            Some(agrees) => check.judged(agrees).within(tolerance, &reason.to_string()),
            None => check,
        })
    }

    /// Makes one text of the check, for one that some results alone have or that has other numbers.
    pub fn text(&self, key: &str, numbers: Numbers<'_>) -> Result<Text, Error> {
        let [text] = self.texts([key], numbers)?;
        Ok(text)
    }

    /// Fills texts of which the first may not be missing.
    fn texts<const N: usize>(
        &self,
        keys: [&str; N],
        numbers: Numbers<'_>,
    ) -> Result<[Text; N], Error> {
        let words = self.published.words.0.get(&self.statement.id);
        let (_, sentences) = words.ok_or_else(|| self.fault("is missing; write it"))?;
        if let Some(key) = keys.first().filter(|key| !sentences.contains_key(**key)) {
            return Err(self.fault(&format!("has no {key}; write it")));
        }
        let names: Vec<&str> = numbers.iter().map(|(name, _)| *name).collect();
        let mut unused: BTreeSet<&str> = names.iter().copied().collect();
        let mut texts = [const { Text(Vec::new()) }; N];
        for (text, key) in texts.iter_mut().zip(keys) {
            let Some(sentence) = sentences.get(key) else { continue };
            let mut pieces = sentence.split('{');
            *text = Text::from(pieces.next().unwrap_or_default());
            for piece in pieces {
                let (mark, words) = piece.split_once('}').unwrap_or((piece, ""));
                let (name, digits) = mark.split_once(':').unwrap_or((mark, ""));
                let number = numbers.iter().find(|(known, _)| *known == name);
                let digits = if digits.is_empty() { Ok(None) } else { digits.parse().map(Some) };
                let (Some((_, number)), Ok(digits)) = (number, digits) else {
                    let what = format!("has {{{mark}}} in {key}; write {{name}} or {{name:3}}");
                    let names = if names.is_empty() { "none".into() } else { names.join(", ") };
                    return Err(self.fault(&format!("{what}, with a name of {names}")));
                };
                unused.remove(name);
                let digits = digits.map(|digits| number.clone().significant(digits));
                let number = digits.unwrap_or_else(|| number.clone());
                *text = std::mem::take(text).then(number).then(words);
            }
        }
        match unused.first() {
            None => Ok(texts),
            Some(name) => {
                let what = format!("does not use {{{name}}} in {}", keys.join(", "));
                Err(self.fault(&format!("{what}; write it there, or remove it from its rule")))
            }
        }
    }

    fn fault(&self, what: &str) -> Error {
        let id = &self.statement.id;
        let path = self.published.words.0.get(id).map_or("claims", |(path, _)| path);
        PublishedError(format!("{path}: [{id}] {what}")).into()
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
    use super::super::{Published, Verdict, judge_all};
    use super::*;
    use crate::experiments::Results;

    const RISE: &str = "[shared]\nreason = \"ours\"\n[rise]\nfound = \"{share:2} of {all}\"\ntolerance = \"none\"\n";

    fn judged(file: &str, rule: Rule) -> Result<Check, String> {
        let statement =
            "[[statement]]\nid = \"rise\"\nplace = \"a\"\nstatement = \"b\"\nprinted = \"c\"";
        let published = Published::parse(statement).unwrap();
        let rules = [rule];
        let words = Words::read(&Templates::of([("claims/a.toml", file)]));
        let words = words.and_then(|words| words.taken(&rules)).map_err(|e| e.to_string())?;
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
            ("found", "fuond", "claims/a.toml: [rise] has fuond; its texts are found, "),
            ("found", "found_more", "claims/a.toml: [rise] has no found; write it"),
            ("[rise]", "[rsie]", "claims/a.toml: no check has the id of [rsie]; "),
            ("[rise]", "[rise", "claims/a.toml:3: "),
            ("[rise]\n", "", "claims: [rise] is missing; write it"),
        ] {
            let error = judged(&RISE.replace(from, to), rule(Some(true))).unwrap_err();
            assert!(error.contains(message), "{error}");
        }
    }
}

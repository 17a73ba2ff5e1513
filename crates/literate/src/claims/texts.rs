//! Keeps the sentences of a check as words and numbers, so that a report chooses the digits, and
//! reads those that stand beside `published.toml` in the folder `claims`.

use crate::input::toml_fault;
use crate::print::{Style, print};
use crate::prose::Templates;
use crate::value::Number;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Makes a [`Text`] of a sentence with `{}` for each number, and `{:3}` for three digits of it.
macro_rules! text {
    ($sentence:expr $(, $number:expr)* $(,)?) => {{
        let mut numbers = [$($crate::value::Number::from($number)),*].into_iter();
        $crate::claims::Text::fill($sentence, |_| numbers.next()).unwrap_or_default()
    }};
}

pub(crate) use text;

/// A short text with numbers in it; its words are [`Number::Text`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", from = "String")]
pub struct Text(pub(crate) Vec<Number>);

impl Text {
    /// Fills the marks of a sentence, `{share}`, or `{share:2}` for two digits, with the numbers
    /// that `number_of` returns for their names; the error is a mark without a number.
    pub(crate) fn fill(
        sentence: &str,
        mut number_of: impl FnMut(&str) -> Option<Number>,
    ) -> Result<Text, &str> {
        let mut pieces = sentence.split('{');
        let mut filled = Text::from(pieces.next().unwrap_or_default());
        for piece in pieces {
            let (mark, words) = piece.split_once('}').unwrap_or((piece, ""));
            let (name, digits) = mark.split_once(':').unwrap_or((mark, ""));
            let mut number = number_of(name).ok_or(mark)?;
            if !digits.is_empty() {
                number = number.significant(digits.parse().map_err(|_| mark)?);
            }
            filled = filled.then(number).then(words);
        }
        Ok(filled)
    }

    /// Returns the text with more at its end.
    pub fn then(mut self, more: impl Into<Text>) -> Text {
        self.0.extend(more.into().0);
        self
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl From<Number> for Text {
    fn from(number: Number) -> Text {
        Text(vec![number])
    }
}

impl From<&str> for Text {
    fn from(words: &str) -> Text {
        words.to_string().into()
    }
}

impl From<String> for Text {
    fn from(words: String) -> Text {
        if words.is_empty() { Text::default() } else { Number::Text(words).into() }
    }
}

impl From<Text> for String {
    fn from(text: Text) -> String {
        text.to_string()
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for piece in &self.0 {
            f.write_str(&print(piece, Style::default()).to_plain_text())?;
        }
        Ok(())
    }
}

/// Names numbers for texts: `numbers![windows, share = a / b]`, where a name alone is a variable.
#[macro_export]
macro_rules! numbers {
    (@ $name:ident) => { $name };
    (@ $name:ident $value:expr) => { $value };
    ($($name:ident $(= $value:expr)?),* $(,)?) => {
        &[$((stringify!($name), $crate::value::Number::from($crate::numbers!(@ $name $($value)?)))),*]
    };
}

/// Numbers with the names by which texts call them: what [`numbers!`](crate::numbers) makes.
pub type Numbers<'a> = &'a [(&'a str, Number)];

/// The texts that a rule fills; pieces of them have a name that begins so: `note_open`.
pub(super) const KEYS: [&str; 4] = ["found", "tolerance", "reason", "note"];

/// The text of a relation that says what must hold.
const STATEMENT: &str = "statement";

type Texts = BTreeMap<String, String>;

/// The texts of checks by the ids of their statements, each with the path of its file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Words(BTreeMap<String, (String, Texts)>);

impl Words {
    /// Reads all files `claims/NAME.toml`: a table `[id]` for each check, and `[shared]` for all of
    /// the file. Texts of an id that is not among `ids`, which no rule takes, are refused.
    pub(crate) fn read(templates: &Templates, ids: &[&str]) -> Result<Words, String> {
        let mut words = Words::default();
        let is_known = |key: &String| key == STATEMENT || KEYS.iter().any(|k| key.starts_with(k));
        let is_ours = |path: &str| path.starts_with("claims/") && path.ends_with(".toml");
        for (path, file) in templates.iter().filter(|(path, _)| is_ours(path)) {
            let fault = |error| format!("{path}:{}", toml_fault(file, &error));
            let mut checks: BTreeMap<String, Texts> = toml::from_str(file).map_err(fault)?;
            let shared = checks.remove("shared").unwrap_or_default();
            for (id, own) in checks {
                if let Some(key) = own.keys().find(|key| !is_known(key)) {
                    let names = KEYS.join(", ");
                    return Err(format!("{path}: [{id}] has {key}; its texts are {names}"));
                }
                let texts = shared.clone().into_iter().chain(own).collect();
                if let Some((other, _)) = words.0.insert(id.clone(), (path.into(), texts)) {
                    return Err(format!("{path}: [{id}] is also in {other}; remove one"));
                }
            }
        }
        match words.0.iter().find(|(id, _)| !ids.contains(&id.as_str())) {
            None => Ok(words),
            Some((id, (path, _))) => {
                let remedy = "correct it, or remove it";
                Err(format!("{path}: no check has the id of [{id}]; {remedy}"))
            }
        }
    }

    pub(super) fn statement(&self, id: &str) -> Option<&str> {
        self.0.get(id)?.1.get(STATEMENT).map(String::as_str)
    }

    /// Returns the texts of a check with these keys, filled with numbers. The first key must exist,
    /// and each number must be used.
    pub(super) fn fill<const N: usize>(
        &self,
        id: &str,
        keys: [&str; N],
        numbers: Numbers<'_>,
    ) -> Result<[Text; N], String> {
        let Some((path, sentences)) = self.0.get(id) else {
            return Err(format!("claims: [{id}] is missing; write it"));
        };
        let fault = |problem: String| format!("{path}: [{id}] {problem}");
        if let Some(key) = keys.first().filter(|key| !sentences.contains_key(**key)) {
            return Err(fault(format!("has no {key}; write it")));
        }
        let names: Vec<&str> = numbers.iter().map(|(name, _)| *name).collect();
        let mut unused: BTreeSet<&str> = names.iter().copied().collect();
        let mut filled_texts = [const { Text(Vec::new()) }; N];
        for (filled, key) in filled_texts.iter_mut().zip(keys) {
            let Some(sentence) = sentences.get(key) else { continue };
            let number_of = |name: &str| {
                unused.remove(name);
                numbers.iter().find(|(known, _)| *known == name).map(|(_, number)| number.clone())
            };
            *filled = Text::fill(sentence, number_of).map_err(|mark| {
                let problem = format!("has {{{mark}}} in {key}; write {{name}} or {{name:3}}");
                let names = if names.is_empty() { "none".into() } else { names.join(", ") };
                fault(format!("{problem}, with a name of {names}"))
            })?;
        }
        if let Some(name) = unused.first() {
            let problem = format!("does not use {{{name}}} in {}", keys.join(", "));
            return Err(fault(format!("{problem}; write it there, or remove it from its rule")));
        }
        Ok(filled_texts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::{Check, Judge, Published, Rule, Verdict};
    use crate::experiments::Results;

    const RISE: &str = "[shared]\nreason = \"ours\"\n[rise]\nfound = \"{share:2} of {all}\"\ntolerance = \"none\"\n";

    fn judged(file: &str, rule: Rule) -> Result<Check, String> {
        let entry =
            "[[statement]]\nid = \"rise\"\nplace = \"a\"\nstatement = \"b\"\nprinted = \"c\"";
        let words = Words::read(&Templates::from_files([("claims/a.toml", file)]), &[rule.id])?;
        let published = Published { words, ..Published::parse(entry).unwrap() };
        let (rules, results) = ([rule], Results::made_up(Vec::new()));
        let checks = Judge::new(&published, &rules, &results).checks();
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

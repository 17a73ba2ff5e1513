//! Reads the texts of the checks, which stand beside `published.toml` in the folder `claims`, and
//! fills them with the numbers that a rule gives.

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
    /// Reads all files `claims/NAME.toml`, which have a table `[id]` for each check; what stands in
    /// `[shared]` holds for each check of the file without its own.
    pub(crate) fn read(templates: &Templates) -> Result<Words, String> {
        let mut words = Words::default();
        let is_of_claims =
            |(path, _): &(&str, &str)| path.starts_with("claims/") && path.ends_with(".toml");
        for (path, file) in templates.iter().filter(is_of_claims) {
            let fault = |error| format!("{path}:{}", toml_fault(file, &error));
            let mut checks: BTreeMap<String, Texts> = toml::from_str(file).map_err(fault)?;
            let shared = checks.remove("shared").unwrap_or_default();
            for (id, own) in checks {
                let is_known =
                    |key: &str| key == STATEMENT || KEYS.iter().any(|known| key.starts_with(known));
                if let Some(key) = own.keys().find(|key| !is_known(key)) {
                    let names = KEYS.join(", ");
                    let problem = format!("{path}: [{id}] has {key}; its texts are {names}");
                    return Err(problem);
                }
                let texts = shared.clone().into_iter().chain(own).collect();
                if let Some((other, _)) = words.0.insert(id.clone(), (path.into(), texts)) {
                    let problem = format!("{path}: [{id}] is also in {other}; remove one");
                    return Err(problem);
                }
            }
        }
        Ok(words)
    }

    pub(super) fn statement(&self, id: &str) -> Option<&str> {
        self.0.get(id)?.1.get(STATEMENT).map(String::as_str)
    }

    /// Refuses texts that no rule takes.
    pub(crate) fn refuse_unused(self, ids: &[&str]) -> Result<Words, String> {
        let of_none = |(id, _): &(&String, _)| !ids.contains(&id.as_str());
        if let Some((id, (path, _))) = self.0.iter().find(of_none) {
            let problem =
                format!("{path}: no check has the id of [{id}]; correct it, or remove it");
            return Err(problem);
        }
        Ok(self)
    }

    /// Returns the texts of a check with these keys, filled with numbers. The first key must exist,
    /// and each number must be used.
    pub(super) fn fill<const N: usize>(
        &self,
        id: &str,
        keys: [&str; N],
        numbers: Numbers<'_>,
    ) -> Result<[Text; N], String> {
        let words = self.0.get(id);
        let fault = |problem: &str| {
            let path = words.map_or("claims", |(path, _)| path);
            format!("{path}: [{id}] {problem}")
        };
        let (_, sentences) = words.ok_or_else(|| fault("is missing; write it"))?;
        if let Some(key) = keys.first().filter(|key| !sentences.contains_key(**key)) {
            return Err(fault(&format!("has no {key}; write it")));
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
                fault(&format!("{problem}, with a name of {names}"))
            })?;
        }
        match unused.first() {
            None => Ok(filled_texts),
            Some(name) => {
                let problem = format!("does not use {{{name}}} in {}", keys.join(", "));
                Err(fault(&format!("{problem}; write it there, or remove it from its rule")))
            }
        }
    }
}

//! `literals.toml`: phrases with numbers that are nobody's result.

use super::Error;
use crate::input::{line, one_line, toml_fault};
use serde::Deserialize;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Phrases with number words that prose may have, with their reasons: `literals.toml`.
#[derive(Debug, Default)]
pub struct Declared {
    text: String,
    phrases: Vec<String>,
    met: RefCell<BTreeSet<usize>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    literal: Vec<Group>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table [[literal]]")]
struct Group {
    /// Why the numbers in these phrases are nobody's result.
    why: String,
    phrases: Vec<String>,
}

impl Declared {
    /// Reads `literals.toml`.
    pub fn read(text: &str) -> Result<Self, Error> {
        let syntax = |error| Error::Template(format!("literals.toml:{}", toml_fault(text, &error)));
        let file: File = toml::from_str(text).map_err(syntax)?;
        let mut declared = Declared { text: text.into(), ..Declared::default() };
        for Group { why, phrases } in file.literal {
            if let Some(phrase) = phrases.first().filter(|_| why.trim().is_empty()) {
                return Err(declared.fault(phrase, "it has no reason; write it in why"));
            }
            declared.phrases.extend(phrases);
        }
        Ok(declared)
    }

    /// What is wrong with a phrase, with its line.
    fn fault(&self, phrase: &str, what: &str) -> Error {
        let at = self.text.find(&format!("\"{phrase}\"")).unwrap_or_default();
        let line = line(&self.text[..at]);
        Error::Template(format!("literals.toml:{line}: {:?}: {what}", one_line(phrase, 80)))
    }

    /// Refuses phrases that no prose has. Where a section is missing they are many: other faults are told first.
    ///
    /// # Errors
    /// The first, with its line.
    pub fn refuse_unmet(&self) -> Result<(), Error> {
        match self.unmet().as_slice() {
            [] => Ok(()),
            [first, rest @ ..] => {
                let more = match rest.len() {
                    0 => String::new(),
                    more => format!(", nor {more} more"),
                };
                let what = format!(
                    "no prose has it{more}; remove what none has, or restore the section that had it"
                );
                Err(self.fault(first, &what))
            }
        }
    }

    /// Phrases that no text had so far.
    pub fn unmet(&self) -> Vec<&str> {
        let met = self.met.borrow();
        let all = self.phrases.iter().enumerate();
        all.filter(|(i, _)| !met.contains(i)).map(|(_, phrase)| phrase.as_str()).collect()
    }

    /// Does the word at these bytes stand inside a declared phrase?
    pub(super) fn allows(&self, text: &str, start: usize, word: &str) -> bool {
        let mut allowed = false;
        for (i, phrase) in self.phrases.iter().enumerate() {
            let fits = |(at, _): (usize, &str)| {
                let Some(begin) = start.checked_sub(at) else { return false };
                let found = text.get(begin..begin + phrase.len());
                // A line may end between its words.
                found.is_some_and(|found| found.replace('\n', " ").eq_ignore_ascii_case(phrase))
            };
            if phrase.to_ascii_lowercase().match_indices(&word.to_ascii_lowercase()).any(fits) {
                self.met.borrow_mut().insert(i);
                allowed = true;
            }
        }
        allowed
    }
}

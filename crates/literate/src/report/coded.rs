//! Finds hard-coded numbers in texts that code gives to figures, notes, tables and checks: a string
//! of the program, or of the texts of its checks, has the number and the words around it.

use super::error::Error;
use super::input::Input;
use super::lint::{self, Declared};
use super::values::Number;
use crate::claims::Kind;
use crate::figures::plain;
use crate::input::{line, one_line};
use crate::table::Table;
use std::collections::BTreeSet;

/// A string of the code, without markup and with single blanks.
struct Typed {
    place: String,
    text: String,
}

/// Refuses hard-coded numbers in what code gives, by the places of its strings.
pub fn check(input: &Input<'_>, declared: &Declared) -> Vec<Error> {
    let is_text = |path: &str| path.starts_with("claims/");
    let texts = input.templates.iter().filter(|(path, _)| is_text(path));
    let texts = texts.map(|(path, text)| (input.templates.place(path), text, "#"));
    let is_code = |path: &str| path.ends_with(".rs") && !path.contains("/tests");
    let code = input.project.sources.files.iter().filter(|(path, _)| is_code(path));
    let code = code.map(|(path, text)| (path.to_string(), *text, "//"));
    let typed: Vec<Typed> = code.chain(texts).flat_map(strings).collect();
    let mut errors = Vec::new();
    for (file, text) in given(input) {
        let mut numerals = lint::words(&text, 0..text.len(), declared);
        numerals.retain(|(at, numeral)| is_number(&text, *at, numeral));
        for (at, numeral) in numerals {
            let string = typed.iter().find(|typed| typed.has(&text, at, &numeral, file));
            let place = string.map(|typed| format!("{}: {:?}", typed.place, one_line(&text, 60)));
            errors.extend(place.map(|place| Error::HardCoded(numeral).at(place)));
        }
    }
    errors
}

/// All texts that code gives: of figures, with the file that draws them, of checks, named values
/// and columns.
fn given<'a>(input: &Input<'a>) -> BTreeSet<(Option<&'a str>, String)> {
    let drawn = input.figures.iter().flat_map(|figure| {
        let file = input.project.sources.file(&figure.source);
        figure.texts().into_iter().map(move |text| (file, text))
    });
    let judged = input.claims.iter().flat_map(|check| {
        let relation = (check.kind == Kind::Relation).then(|| check.statement.clone());
        let texts = [&check.found, &check.tolerance, &check.note].map(ToString::to_string);
        texts.into_iter().chain(relation)
    });
    let named = input.values.iter().flat_map(|value| match &value.number {
        Number::Text(words) => [words.clone(), value.note.clone()],
        _ => [String::new(), value.note.clone()],
    });
    let meant = input.values.tables().flat_map(Table::meanings).map(String::from);
    let all = drawn.chain(judged.chain(named).chain(meant).map(|text| (None, text)));
    all.map(|(file, text)| (file, bare(&text))).collect()
}

/// The text of a string, in which a number that a backslash makes literal counts as computed.
fn text_of(string: &str) -> String {
    let string = string.replace(r"\\", "\\");
    let mut text = string.clone();
    for (at, _) in string.rmatch_indices('\\') {
        let literal = lint::literal_name(&string[..at], &string[at + 1..]);
        text.replace_range(
            at..at + 1 + literal.unwrap_or_default(),
            if literal.is_some() { "{}" } else { "" },
        );
    }
    bare(&text)
}

fn bare(text: &str) -> String {
    plain(text).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What is numbered elsewhere, and has its number for a name.
const NUMBERED: [&str; 7] = ["Eq.", "Eqs.", "Fig.", "Figs.", "Sec.", "Section", "Table"];

/// Whether it is no part of mathematics, as `0` and `1`, indices, powers, factors and divisors are,
/// nor of a name: `Eq. (7)`, `Rice (1945)`.
fn is_number(text: &str, at: usize, numeral: &str) -> bool {
    let (before, after) = (&text[..at], &text[at + numeral.len()..]);
    let is_script = before.trim_end_matches(['-', '−', ' ']).ends_with(['^', '_']);
    let is_factor = numeral.len() == 1 && after.starts_with(char::is_alphabetic);
    let is_divisor = before.ends_with('/') && !numeral.contains('.');
    let name = before.trim_end_matches('(').split_whitespace().next_back().unwrap_or_default();
    let is_year = numeral.len() == 4 && before.ends_with('(') && after.starts_with(')');
    let is_name = NUMBERED.contains(&name) || is_year && name.starts_with(char::is_uppercase);
    let is_digit = numeral.starts_with(char::is_numeric) && !["0", "1"].contains(&numeral);
    is_digit && !is_script && !is_factor && !is_divisor && !is_name
}

impl Typed {
    /// Returns whether the number at this place of a text stands in the string, with the same words
    /// around it up to what is computed there. A number alone counts in the file of its figure.
    fn has(&self, text: &str, at: usize, numeral: &str, file: Option<&str>) -> bool {
        let is_near = text != numeral || file.is_some_and(|file| self.place.starts_with(file));
        self.text.match_indices(numeral).any(|(place, _)| {
            let (before, after) = self.text.split_at(place);
            let start = before.rfind(['{', '}']).map_or(0, |brace| brace + 1);
            let end = place + after.find(['{', '}']).unwrap_or(after.len());
            let words = &self.text[start..end];
            let is_whole = text == self.text && text.len() > 1 && is_near;
            let begin = at.checked_sub(place - start);
            let is_there = |begin| text.get(begin..).is_some_and(|text| text.starts_with(words));
            begin.is_some_and(is_there) && (is_whole || words.contains(char::is_alphabetic))
        })
    }
}

/// The strings of a file, outside of its tests and comments.
fn strings((path, code, comment): (String, &str, &str)) -> Vec<Typed> {
    let code = code.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let sign = comment.chars().next().unwrap_or('/');
    let (mut found, mut at) = (Vec::new(), 0);
    while let Some(next) = code[at..].find(['"', '\'', sign]) {
        let (before, rest) = code.split_at(at + next);
        at += next + 1;
        if rest.starts_with(comment) {
            at += rest.find('\n').unwrap_or(1) - 1;
        } else if let Some(quoted) = ["'\"'", "'\\\"'"].iter().find(|sign| rest.starts_with(**sign))
        {
            at += quoted.len() - 1;
        } else if rest.starts_with('"') {
            let opened = before.trim_end_matches('#');
            let mut escaped = false;
            let ends = |c: char| {
                let is_end = c == '"' && !escaped;
                escaped = c == '\\' && !escaped;
                is_end
            };
            let end = if opened.ends_with('r') {
                code[at..].find(&format!("\"{}", &before[opened.len()..]))
            } else {
                code[at..].find(ends)
            };
            let Some(end) = end else { break };
            let place = format!("{path}:{}", line(before));
            found.push(Typed { place, text: text_of(&code[at..at + end]) });
            at += end + 1;
        }
    }
    found
}

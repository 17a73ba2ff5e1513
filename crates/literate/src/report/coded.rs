//! Finds hard-coded numbers in texts that code gives to figures, notes, tables and checks: a string
//! of the program, or of the texts of its checks, has the number and the words around it.

use super::error::Error;
use super::input::Input;
use super::lint::{self, Declared};
use super::values::Number;
use crate::claims::Kind;
use crate::figures::plain;
use crate::input::one_line;
use crate::table::Table;
use rayon::prelude::*;
use std::collections::{BTreeSet, HashMap, HashSet};

/// Words of code with numbers that have no reason, up to what is computed between them.
struct Typed {
    place: String,
    words: String,
    numerals: Vec<String>,
}

/// Refuses hard-coded numbers in what code gives, by the places of its strings.
pub fn check(input: &Input<'_>) -> Vec<Error> {
    let mut numbered = Vec::new();
    for (text, file, with_words) in given(input) {
        let mut numerals = lint::find_numbers(&text, 0..text.len(), input.declared);
        let is_meant = |numeral: &str| with_words || numeral.starts_with(char::is_numeric);
        numerals.retain(|(at, one)| is_meant(one) && is_number(&text, *at, one));
        if !numerals.is_empty() {
            numbered.push((text, file, numerals));
        }
    }
    let meant = numbered.iter().flat_map(|(.., numerals)| numerals).map(|(_, one)| one.as_str());
    let meant: HashSet<&str> = meant.collect();
    let texts = input.templates.iter().filter(|(path, _)| path.starts_with("claims/"));
    let texts = texts.map(|(path, text)| (input.templates.place(path), text));
    let is_code = |path: &str| path.ends_with(".rs") && !path.contains("/tests");
    let code = input.project.sources.files.iter().filter(|(path, _)| is_code(path));
    let code = code.map(|(path, text)| (path.to_string(), *text));
    let files: Vec<(String, &str)> = code.chain(texts).collect();
    let read = |(path, text): &(String, &str)| typed(path, text, &meant);
    let typed: Vec<Typed> = files.par_iter().with_max_len(1).flat_map_iter(read).collect();
    let mut by_numeral: HashMap<&str, Vec<&Typed>> = HashMap::new();
    for typed in &typed {
        for numeral in &typed.numerals {
            by_numeral.entry(numeral).or_default().push(typed);
        }
    }
    let mut errors = Vec::new();
    for (text, file, numerals) in &numbered {
        // Numbers without words count where they are drawn.
        let file = file.filter(|_| text.len() > 1).map(|file| &input.project.sources.files[file]);
        let quoted = file.filter(|(_, code)| code.contains(&format!("\"{text}\"")));
        for (at, numeral) in numerals {
            let around = |(begin, words): (usize, &str)| (begin..begin + words.len()).contains(at);
            let covers = |words: &str| text.match_indices(words).any(around);
            let mut typed = by_numeral.get(&**numeral).into_iter().flatten();
            let typed = typed.find(|t| t.words.len() <= text.len() && covers(&t.words));
            let place = typed.map(|typed| &*typed.place).or(quoted.map(|(path, _)| *path));
            let place = place.map(|place| format!("{place}: {:?}", one_line(text, 60)));
            errors.extend(place.map(|place| Error::hard_coded(numeral).with_place(place)));
        }
    }
    errors
}

/// Returns what stands between quotation marks and braces, with letters and a number that is meant.
fn typed(path: &str, code: &str, meant: &HashSet<&str>) -> Vec<Typed> {
    let code = code.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let wants_words = meant.iter().any(|word| word.starts_with(char::is_alphabetic));
    let (mut typed, mut begin, mut line, mut lines) = (Vec::new(), 0, 1, 0);
    let (mut may_have_number, mut is_in_word) = (wants_words, false);
    // One pass over the bytes takes a tenth of the time of splitting.
    let (bytes, mut end) = (code.as_bytes(), 0);
    while end <= bytes.len() {
        match if end < bytes.len() { bytes[end] } else { b'"' } {
            b'"' | b'{' | b'}' => {
                if may_have_number && code[begin..end].contains(char::is_alphabetic) {
                    let piece = code[begin..end].replace(r"\\", r"\");
                    let numerals = lint::find_numbers(&piece, 0..piece.len(), &Declared::default());
                    let numerals = numerals.into_iter().map(|(_, numeral)| numeral);
                    let numerals: Vec<_> = numerals.filter(|one| meant.contains(&**one)).collect();
                    if !numerals.is_empty() {
                        let place = format!("{path}:{line}");
                        let words = bare(&piece.replace('\\', ""));
                        typed.push(Typed { place, words, numerals });
                    }
                }
                (begin, line, lines) = (end + 1, line + lines, 0);
                (may_have_number, is_in_word) = (wants_words, false);
            }
            b'0'..=b'9' => {
                if !may_have_number && !is_in_word {
                    let (numeral, after) = split_numeral(&code[end..]);
                    let is_ascii = after.starts_with(|c: char| c.is_ascii());
                    may_have_number = meant.contains(numeral) || !is_ascii;
                }
                is_in_word = true;
            }
            b'\n' => (lines, is_in_word) = (lines + 1, false),
            byte => is_in_word = byte.is_ascii_alphabetic() || byte == b'_',
        }
        end += 1;
    }
    typed
}

/// Splits off the numeral of ASCII that a text begins with.
fn split_numeral(text: &str) -> (&str, &str) {
    let after = text.trim_start_matches(|c: char| ".,0123456789".contains(c));
    (text[..text.len() - after.len()].trim_end_matches(['.', ',']), after)
}

/// All texts that code gives, with the file that draws it for one of a figure, and whether number
/// words count: in descriptions and reasons, which are sentences.
fn given(input: &Input<'_>) -> BTreeSet<(String, Option<usize>, bool)> {
    let mut given = BTreeSet::new();
    let mut add = |text: &str, file, with_words| {
        given.insert((bare(text), file, with_words));
    };
    for figure in input.figures {
        let sources = &input.project.sources;
        let path = sources.file(&figure.source);
        let file = sources.files.iter().position(|file| Some(file.0) == path);
        figure.texts().for_each(|text| add(text, file, false));
        add(&figure.description.text, file, true);
    }
    for check in input.claims {
        let texts = [&check.found, &check.tolerance, &check.note];
        texts.iter().for_each(|text| add(&text.to_string(), None, false));
        add(if check.kind == Kind::Relation { &check.statement } else { "" }, None, false);
        add(&check.reason, None, true);
    }
    for value in input.values.iter() {
        add(if let Number::Text(words) = &value.number { words } else { "" }, None, false);
    }
    let cells = input.values.tables().flat_map(Table::cells).chain(input.values.iter());
    let notes: BTreeSet<&str> = cells.map(|cell| cell.note.as_str()).collect();
    notes.into_iter().for_each(|note| add(note, None, false));
    given
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
    !["0", "1"].contains(&numeral) && !is_script && !is_factor && !is_divisor && !is_name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_typed_where_words_stand_beside_it() {
        let code = "[\"−2\", \"·10^{}\"]\nfn at() { \"at x2, of 0.12,\"; \"{} ½ of 2½ ways\" }";
        let meant = HashSet::from(["2", "10", "0.12", "2½"]);
        let typed = typed("a.rs", code, &meant);
        let typed =
            typed.iter().map(|one| format!("{} {}: {:?}", one.place, one.words, one.numerals));
        let expected = ["a.rs:2 at x2, of 0.12,: [\"0.12\"]", "a.rs:2 ½ of 2½ ways: [\"2½\"]"];
        assert_eq!(typed.collect::<Vec<_>>(), expected);
    }
}

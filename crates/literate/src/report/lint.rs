//! Finds hard-coded numbers in prose; the manual ([`crate::manual`]) lists what is exempt.

use super::error::Error;
use super::mark::{CLOSE, OPEN};
use super::tex;
use super::values::Value;
use crate::input::toml_fault;
use crate::print::Style;
use crate::value::Number;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::LazyLock;

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Declared {
    #[serde(default)]
    literal: Vec<Group>,
    /// All phrases in lower case, each ended by `\0`: one search through them is much faster than
    /// one through each.
    #[serde(skip)]
    phrases: String,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table [[literal]]")]
struct Group {
    why: String,
    phrases: Vec<String>,
}

impl Declared {
    pub fn read(text: &str) -> Result<Self, Error> {
        let syntax = |error| Error::Message(format!("literals.toml:{}", toml_fault(text, &error)));
        let mut declared: Declared = toml::from_str(text).map_err(syntax)?;
        for Group { why, phrases } in &declared.literal {
            if why.trim().is_empty() {
                let problem = format!("literals.toml: {phrases:?} have no reason in `why`");
                return Err(Error::Message(problem));
            }
            let ended = phrases.iter().map(|phrase| phrase.to_ascii_lowercase() + "\0");
            declared.phrases.extend(ended);
        }
        Ok(declared)
    }

    /// Returns whether the word at this offset stands in a declared phrase, perhaps in two lines.
    fn allows(&self, text: &str, start: usize, word: &str) -> bool {
        let stands = |phrase: &str, offset: usize| {
            let begin = start.checked_sub(offset);
            let words = begin.and_then(|begin| text.get(begin..begin + phrase.len()));
            words.is_some_and(|words| words.replace('\n', " ").eq_ignore_ascii_case(phrase))
        };
        let word = word.to_ascii_lowercase();
        self.phrases.match_indices(&word).any(|(place, _)| {
            let begin = self.phrases[..place].rfind('\0').map_or(0, |end| end + 1);
            let phrase = self.phrases[begin..].split('\0').next().unwrap_or_default();
            stands(phrase, place - begin)
        })
    }
}

/// Lists of words.txt, in its order.
struct Words {
    /// Words that are numbers and nothing else, also with the ending *-fold*.
    numbers: BTreeSet<&'static str>,
    /// Units behind a number.
    units: BTreeSet<&'static str>,
    /// Signs that end a side of a relation.
    relations: BTreeSet<&'static str>,
    /// What may surround a number in a formula that is still alone.
    around: BTreeSet<&'static str>,
}

static WORDS: LazyLock<Words> = LazyLock::new(|| {
    let mut lists = include_str!("words.txt").split("\n\n");
    let mut list = || lists.next().unwrap_or_default().split_whitespace().collect();
    Words { numbers: list(), units: list(), relations: list(), around: list() }
});

fn is_number_word(word: &str) -> bool {
    // Of most words two letters tell, much faster, that they are none.
    let [first, second, ..] = word.as_bytes() else { return false };
    match (first.to_ascii_lowercase(), second.to_ascii_lowercase()) {
        (b't', b'e' | b'h' | b'i' | b'w') | (b'f' | b's' | b'e' | b'n' | b'm' | b'b', b'i') => (),
        (b'f' | b'd', b'o') | (b's', b'e') | (b'e', b'l') | (b'h', b'u') => (),
        _ => return false,
    }
    let word = word.to_lowercase();
    let word = word.strip_suffix("fold").unwrap_or(&word);
    WORDS.numbers.contains(word)
}

/// Returns the hard-coded numbers in a part of a text, with their offsets; marks are skipped.
pub fn find_numbers(text: &str, part: Range<usize>, declared: &Declared) -> Vec<(usize, String)> {
    let (mut numbers, mut offset) = (Vec::new(), part.start);
    // The rest of a word that began before this part was checked there.
    if text[..offset].ends_with(is_word) {
        offset = part.end - text[offset..part.end].trim_start_matches(is_word).len();
    }
    while let Some(c) = text[offset..part.end].chars().next() {
        let (start, rest) = (offset, &text[offset..part.end]);
        let escaped = if c.is_numeric() { text[..start].strip_suffix('\\') } else { None };
        let is_literal = escaped.is_some_and(|before| is_name(before, &text[start..]));
        offset += match c {
            _ if is_literal => rest.find(ends_literal).unwrap_or(rest.len()),
            OPEN => rest.find(CLOSE).unwrap_or(rest.len()),
            c if is_word(c) => word_length(rest),
            c => c.len_utf8(),
        };
        let word = &text[start..offset];
        let mut numeral = "";
        if c.is_numeric() && !is_literal {
            let signs = rest.split(|c: char| !(c.is_numeric() || ".,".contains(c))).next();
            numeral = signs.unwrap_or_default().trim_end_matches(['.', ',']);
            offset = offset.max(start + numeral.len());
        } else if is_word(c) && is_number_word(word) {
            // With a hyphen before a word that is not a number it names a kind: *two-sided*.
            let next = text[offset..].strip_prefix('-').unwrap_or_default();
            let next = next.split(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
            let names_kind = !next.is_empty() && !is_number_word(next) && next != "one";
            numeral = if names_kind { "" } else { word };
        }
        if !numeral.is_empty() && !declared.allows(text, start, numeral) {
            numbers.push((start, numeral.to_string()));
        }
    }
    numbers
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Returns the length of the word that a text begins with, at once for one of ASCII.
fn word_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let mut length = 0;
    while length < bytes.len() && (bytes[length].is_ascii_alphanumeric() || bytes[length] == b'_') {
        length += 1;
    }
    if bytes.get(length).is_none_or(u8::is_ascii) {
        return length;
    }
    text.find(|c| !is_word(c)).unwrap_or(text.len())
}

/// Returns whether a character ends what a backslash before a number makes literal: `Python \3.11`.
fn ends_literal(c: char) -> bool {
    c.is_whitespace() || c == '|' || c == OPEN
}

/// Takes away the backslash of a sign `\3`: the number that it begins is meant literally.
pub fn without_backslashes(text: &str) -> String {
    if !text.contains('\\') {
        return text.into();
    }
    let is_digit = |sign: &&str| sign.starts_with(|c: char| c.is_ascii_digit());
    let literal = |sign| str::strip_prefix(sign, '\\').filter(is_digit).unwrap_or(sign);
    tex::signs(text).map(literal).collect()
}

/// Returns whether a number behind a backslash belongs to an address, `doi:`, is a year, or is a
/// version behind a name (not the first word of a sentence), and no quantity with a unit.
fn is_name(before: &str, number: &str) -> bool {
    let token = number.split(ends_literal).next().unwrap_or_default();
    let behind = number[token.len()..].split_whitespace().next().unwrap_or_default();
    let token = token.trim_end_matches(|c: char| c.is_ascii_punctuation());
    let is_year = token.len() == 4 && token.starts_with(['1', '2']) && !token.contains('.');
    let glued = before.ends_with(|c: char| c.is_alphanumeric() || ":/-".contains(c));
    let name = before.split_whitespace().next_back().unwrap_or_default();
    let is_unit = unit(behind).is_some();
    let is_named =
        before.ends_with(' ') && name.starts_with(char::is_uppercase) && !FIRST.contains(name);
    glued || !is_unit && (is_year || is_named)
}

const FIRST: &str =
    "A About Above After And At Below Between By For From If In Near Of On Only Over The To With";

/// Returns the unit, as `km/h`, that a text begins with.
fn unit(text: &str) -> Option<String> {
    let ends = |c: char| c.is_whitespace() || ",.;:!?()[]{}|*_$\\".contains(c) || c == OPEN;
    let unit = text.split(ends).next().unwrap_or_default().replace('μ', "µ");
    let first = unit.split(['/', '·', '²', '³']).next()?;
    WORDS.units.contains(first).then_some(unit)
}

/// Describes what stands beside a value and changes its unit or sign, or returns `None` if nothing.
pub fn conflict(beside: [&str; 2], value: &Value, style: Style, maths: bool) -> Option<String> {
    let tex = [r"\,", r"\;", r"\ ", "~", " ", "\u{a0}", "\u{202f}"];
    // Emphasis, links and formulas do not part a sign from its value.
    let marks = |c: char| "*_[".contains(c) && !maths;
    let (before, after) = (beside[0].trim_end_matches(marks), beside[1].trim_start_matches(marks));
    let link = after.strip_prefix("](").and_then(|link| Some(link.split_once(')')?.1));
    let after = link.unwrap_or(after);
    let (inside, before) = (before, before.strip_suffix('$').unwrap_or(before));
    let mut rest = after;
    while let Some(other) = tex.iter().find_map(|blank| rest.strip_prefix(blank)) {
        rest = other;
    }
    rest = rest.strip_prefix('$').filter(|tex| tex.starts_with('\\')).unwrap_or(rest);
    let apart = if maths { "" } else { rest };
    let apart =
        [r"\mathrm{", r"\text{"].iter().find_map(|open| rest.strip_prefix(open)).unwrap_or(apart);
    let touches = rest.trim_start_matches('\\').starts_with(['%', '‰', '°']);
    let rest = if touches { rest.trim_start_matches('\\') } else { apart.trim_start_matches(' ') };
    let typed = unit(rest).filter(|_| touches || maths || rest.len() < after.len());
    let glued = ["", ".", ",", "e"].iter().filter_map(|sign| after.strip_prefix(sign));
    let digit = |c: char| c.is_ascii_digit();
    // A point behind a word ends a sentence or a name, and begins no number.
    let ends_word = |c: char| !c.is_whitespace() && !"([".contains(c);
    let is_after =
        |text: &str| if maths { text.ends_with(digit) } else { !text.ends_with(ends_word) };
    let after_point = inside.strip_suffix('.').is_some_and(is_after);
    let is_number = !matches!(value.number, Number::Text(_));
    let goes_on = |rest: &str| !maths && rest.starts_with(OPEN);
    let before_point = maths && after.strip_prefix('.').is_some_and(|rest| rest.starts_with(digit));
    if is_number && (after_point || before_point || glued.into_iter().any(goes_on)) {
        let problem = "reads as one number with what stands beside it; put a blank between";
        return Some(format!("«{}» {problem}", value.id));
    }
    let own =
        if style.in_percent { "%" } else { &value.unit.trim_matches('$').replace('μ', "µ") };
    if style.in_percent && !value.unit.is_empty() {
        let problem = "which `percent` would change; write it without";
        return Some(format!("«{}» has the unit {}, {problem}", value.id, value.unit));
    }
    if let Some(typed) = typed
        && (style.in_percent || own != typed && (!own.is_empty() || typed == "%"))
    {
        let problem = "write it by the value's own unit or by «… | percent»";
        return Some(format!("{typed} follows «{}», whose unit is {own:?}; {problem}", value.id));
    }
    let sign = before.strip_suffix(['-', '−']).filter(|_| !maths || before != inside)?;
    let begins = |c: char| c.is_whitespace() || r"(|“$\*[".contains(c);
    let begins = sign.chars().next_back().is_none_or(begins);
    begins.then(|| format!("a minus before «{}» changes its sign; compute it so", value.id))
}

const DIGITS: &str = "0123456789 .,+-−^{}%\\()";

/// Returns the sides of the relations in a formula, without what may surround a number, and whether
/// each is what something equals.
fn sides(tex: &str) -> Vec<(String, bool)> {
    let Words { relations, around, .. } = &*WORDS;
    let mut tex = tex.replace(r"\begin{aligned}", "").replace(r"\end{aligned}", "");
    // A number with a unit or another word is still a number alone.
    for open in [r"\text{", r"\textrm{", r"\mathrm{"] {
        while let Some((before, after)) = tex.split_once(open) {
            let (word, after) = after.split_once('}').unwrap_or((after, ""));
            let number = is_number_word(word.trim()) || word.contains(|c: char| c.is_ascii_digit());
            tex = format!("{before}{}{after}", if number { word } else { "" });
        }
    }
    let (mut sides, mut depth) = (vec![(String::new(), false)], 0_i32);
    for sign in tex::signs(&tex) {
        depth += i32::from("{([".contains(sign)) - i32::from("})]".contains(sign));
        match sides.last_mut() {
            Some((side, _)) if depth > 0 || !relations.contains(sign) => {
                side.push_str(if around.contains(sign) { "" } else { sign });
            }
            _ => sides.push((String::new(), EQUALS.contains(&sign))),
        }
    }
    let whole = |side: &String| side.trim_end_matches([' ', '.', ',']).trim_start().to_string();
    let sides = sides.iter().map(|(side, equals)| (whole(side), *equals));
    let mut sides: Vec<_> = sides.filter(|(side, _)| !side.is_empty()).collect();
    // `i = 2, \dots, n` counts.
    for index in 1..sides.len() {
        sides[index - 1].1 &= ![r"\dots", r"\ldots", "…"].contains(&sides[index].0.as_str());
    }
    sides
}

const EQUALS: [&str; 5] = ["=", "≈", r"\approx", r"\simeq", r"\sim"];

/// Returns a hard-coded number in a formula, or `None` if all are mathematics, as `0` and `1` alone
/// are, and fractions with one digit above.
pub fn number_in_formula(tex: &str) -> Option<String> {
    let sides = sides(tex);
    let digits = |text: &str| text.chars().filter(char::is_ascii_digit).count();
    let is_hard_coded = |(side, equals): &&(String, bool)| {
        let fraction =
            [r"\frac{", r"\dfrac{", r"\tfrac{"].iter().find_map(|of| side.strip_prefix(of));
        let bare = fraction.unwrap_or(side);
        let end = if fraction.is_some() { '}' } else { '/' };
        let numerator = bare.split_once(end).map(|(numerator, _)| numerator);
        let long = |text: &str| text.contains('.') || digits(text) > 1;
        // One letter behind a number is a unit, or a factor of a decimal.
        let is_letter = |sign: &&str| tex::spell(sign).chars().all(char::is_alphabetic);
        let letter = tex::signs(bare).last().filter(is_letter);
        let factor =
            letter.filter(|letter| bare.contains('.') || unit(letter).is_some() && long(bare));
        let rest = factor.map_or(bare, |letter| &bare[..bare.len() - letter.len()]);
        let number = digits(rest) > 0 && rest.chars().all(|c| DIGITS.contains(c) || c == '/');
        let small = ["0", "1", "-1", "−1"].contains(&side.as_str());
        let alone = (sides.len() == 1 || *equals) && numerator.is_none() && !small;
        number && (long(numerator.unwrap_or(bare)) || alone) || is_number_word(side)
    };
    sides.iter().find(is_hard_coded).map(|(side, _)| side.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sentences with their numbers, formulas with one and without, and words around a value `V`
    /// that change its unit or sign and that do not, one a line.
    fn examples(part: usize) -> std::str::Lines<'static> {
        include_str!("tests/numbers.txt").split("\n\n").nth(part).unwrap().lines()
    }

    fn numerals(text: &str) -> Vec<String> {
        let declared =
            "[[literal]]\nwhy = \"a collision has them\"\nphrases = [\"two masses\", \"at 100 %\"]";
        let declared = Declared::read(declared).unwrap();
        let numbers = find_numbers(text, 0..text.len(), &declared);
        numbers.into_iter().map(|(_, numeral)| numeral).collect()
    }

    #[test]
    fn numerals_in_words_are_found() {
        for line in examples(0) {
            let (sentence, expected) = line.split_once(" =>").unwrap();
            let sentence = &sentence.replace('⏎', "\n");
            assert_eq!(numerals(sentence).join(" "), expected.trim(), "{sentence}");
        }
        let value = super::super::mark::framed("rows[x=12].mean", "significant2");
        assert_eq!(numerals(&format!("at {value} or 3")), ["3"]);
        let sentence = "k_12";
        assert_eq!(find_numbers(sentence, 2..4, &Declared::default()), [], "the part of a word");
        assert!(Declared::read("[[literal]]\nwhy = \" \"\nphrases = [\"two\"]").is_err());
        assert_eq!(WORDS.numbers.iter().find(|word| !is_number_word(word)), None);
    }

    #[test]
    fn another_unit_or_sign_beside_a_value_is_found() {
        for (part, wrong) in [(3, true), (4, false)] {
            for line in examples(part) {
                let (sentence, unit) = line.split_once(" =>").unwrap();
                let sentence = sentence.replace('·', "\u{a0}").replace('⏎', "\n");
                let (before, after) = sentence.split_once('V').unwrap();
                let value = Value { unit: unit.trim().into(), ..Value::real("x", 0.5, 1) };
                let problem = conflict([before, after], &value, Style::default(), false);
                assert_eq!(problem.is_some(), wrong, "{sentence}: {problem:?}");
            }
        }
        let value = Value { unit: "ms".into(), ..Value::real("x", 0.5, 1) };
        let percent = Style { in_percent: true, ..Style::default() };
        let problem = conflict([""; 2], &value, percent, false).unwrap();
        assert!(problem.contains("which `percent` would change"), "{problem}");
        let of_maths =
            |before, after| conflict([before, after], &value, Style::default(), true).is_some();
        assert!(of_maths("-$", "$") && of_maths("$0.", "$") && of_maths("$", ".5$"));
        let maths = |after| of_maths("$-", after);
        assert_eq!(
            [r"\,\mathrm{s}", r"\,\%", " h", r"\,\mathrm{ms}"].map(maths),
            [true, true, false, false]
        );
    }

    #[test]
    fn numbers_in_formulas_are_found() {
        for number in examples(1) {
            assert!(number_in_formula(number).is_some(), "{number}");
        }
        for fine in examples(2) {
            assert_eq!(number_in_formula(fine), None, "{fine}");
        }
    }
}

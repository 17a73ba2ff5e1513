//! Writes checks as rows for templates, and their numbers as values.

use super::markdown;
use super::values::{Number, Value, origin};
use crate::claims::{Basis, Check, Kind, Published, Text, Verdict, score};
use crate::print::{Style, print};
use serde_json::json;
use std::collections::BTreeMap;

/// Returns the fields of a check as Markdown for templates, its numbers printed with their digits.
pub fn to_row(check: &Check) -> serde_json::Value {
    let words = |source: &str| markdown::escape_text(&with_formulas(source));
    json!({
        "id": check.id,
        "kind": check.kind,
        "why": check.difference().unwrap_or_default(),
        // The section that an id names, `sec7_limit`: "Sec. 7".
        "section": check.id.split('_').next().unwrap_or_default().replace("sec", "Sec. "),
        "place": words(&check.place),
        "statement": words(&check.statement),
        "expected": words(&check.expected),
        "found": to_markdown(&check.found),
        "tolerance": to_markdown(&check.tolerance),
        // The reason stands in emphasis, in which GitHub renders no formula.
        "reason": markdown::escape_text(&check.reason),
        "basis": check.basis.words(),
        "verdict": check.verdict.words(),
        "note": to_markdown(&check.note),
    })
}

fn to_markdown(text: &Text) -> String {
    let piece = |piece: &Number| match piece {
        Number::Text(words) => markdown::escape_text(&with_formulas(words)),
        number => markdown::inlines(&super::document::to_inlines(&print(number, Style::default()))),
    };
    text.0.iter().map(piece).collect()
}

/// Makes formulas of variables such as n, p_crit or k*; ties a percent sign to its number.
pub(super) fn with_formulas(sentence: &str) -> String {
    if sentence.contains('$') {
        return sentence.to_string();
    }
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '*';
    let chars: Vec<char> = sentence.chars().collect();
    let words: Vec<&[char]> = chars.chunk_by(|a, b| is_part(*a) == is_part(*b)).collect();
    // (d) is a panel, and no variable.
    let is_panel = |index: usize| {
        let around = words.get(index.wrapping_sub(1)..index + 2);
        matches!(around, Some([[.., '('], ['a'..='f'], [')', ..]]))
    };
    let word = |(index, word): (usize, &&[char])| {
        symbol(word).filter(|_| !is_panel(index)).unwrap_or_else(|| word.iter().collect())
    };
    words.iter().enumerate().map(word).collect::<String>().replace(" %", "\u{a0}%")
}

/// Single letters that are words, panels or names of walls.
const WORDS: &str = "AILRabces";

fn symbol(word: &[char]) -> Option<String> {
    let (letter, rest) = word.split_first().filter(|(letter, _)| letter.is_alphabetic())?;
    let tex = if *letter == 'φ' { r"\phi".into() } else { letter.to_string() };
    match rest {
        _ if rest.iter().all(|c| "²³₀₁₂".contains(*c)) => {
            let rest: String = rest.iter().collect();
            (!WORDS.contains(*letter)).then(|| format!("${tex}${rest}"))
        }
        ['*'] => Some(format!("${tex}^*$")),
        ['½'] => Some(format!("${tex}_{{1/2}}$")),
        ['_', index] if index.is_alphanumeric() => Some(format!("${tex}_{index}$")),
        ['_', _, ..] if rest[1..].iter().all(|c| c.is_alphanumeric()) => {
            let index: String = rest[1..].iter().collect();
            Some(format!(r"${tex}_{{\mathrm{{{index}}}}}$"))
        }
        _ => None,
    }
}

/// Returns the printed numbers as values: `paper` (parameters) and `printed` (statements).
pub fn printed_values(published: &Published) -> Vec<Value> {
    let chosen = published.parameters.iter().map(|p| {
        let decimal = p.value.to_string();
        let decimals = decimal.split_once('.').map_or(0, |(_, after)| after.len());
        Value::printed(format!("paper.{}", p.id), p.value, decimals, &p.place)
    });
    let stated = published.statements.iter().filter_map(|s| {
        let decimals = s.decimals.unwrap_or(0).max(0) as usize;
        Some(Value::printed(format!("printed.{}", s.id), s.value?, decimals, &s.place))
    });
    chosen.chain(stated).collect()
}

/// Counts the statements as values: all, by verdict, by basis (those reproduced, and of how many),
/// by word for a difference; sentences, with every and with some readings reproduced; definitions.
pub fn scorecard(claims: &[Check]) -> Vec<Value> {
    let value = |name: String, count: usize| {
        let id = format!("score.{}", name.replace(' ', "_"));
        let note = format!("In the score: {}", name.replace('_', " "));
        Value { note, ..Value::integer(id, count).source(origin(scorecard)) }
    };
    let (judged, definitions): (Vec<&Check>, Vec<&Check>) =
        claims.iter().partition(|claim| claim.kind == Kind::Statement);
    let statements = || judged.iter().copied();
    let verdicts = Verdict::ALL.into_iter().zip(score(statements()));
    let verdicts = verdicts.map(|(verdict, count)| value(verdict.words().into(), count));
    let bases = Basis::ALL.into_iter().flat_map(|basis| {
        let counts = score(statements().filter(|claim| claim.basis == basis));
        let total = value(format!("{}_of", basis.words()), counts.iter().sum());
        [value(basis.words().into(), counts[0]), total]
    });
    let mut words = BTreeMap::new();
    for claim in statements().filter(|claim| !claim.why.is_empty()) {
        *words.entry(claim.why.as_str()).or_insert(0) += usize::from(claim.difference().is_some());
    }
    let words = words.into_iter().map(|(word, count)| value(word.into(), count));
    let mut sentences: BTreeMap<&str, Vec<bool>> = BTreeMap::new();
    for claim in statements() {
        let sentence = if claim.sentence.is_empty() { &claim.id } else { &claim.sentence };
        let is_reproduced = claim.verdict == Verdict::Reproduced;
        sentences.entry(sentence).or_default().push(is_reproduced);
    }
    let with =
        |readings: fn(&Vec<bool>) -> bool| sentences.values().filter(|s| readings(s)).count();
    let whole = with(|readings| !readings.contains(&false));
    let split = with(|readings| readings.contains(&true) && readings.contains(&false));
    let total = [
        value("total".into(), judged.len()),
        value("sentences".into(), sentences.len()),
        value("sentences_reproduced".into(), whole),
        value("sentences_split".into(), split),
        value("definitions".into(), definitions.len()),
    ];
    verdicts.chain(total).chain(bases).chain(words).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::estimates::with_error;

    #[test]
    fn symbols_with_an_index_or_a_star_are_formulas() {
        let sentence = "At p_crit k* of φ_N(k) is fig_3_b, 2*3, a_ and σ_x.";
        let set = r"At $p_{\mathrm{crit}}$ $k^*$ of $\phi_N$($k$) is fig_3_b, 2*3, a_ and $σ_x$.";
        assert_eq!(with_formulas(sentence), set);
        let sentence = crate::claims::text!("k* at {}.", with_error(0.11652, 0.0004));
        assert_eq!(to_markdown(&sentence), "$k^*$ at 0.1165(4).");
        let sentence = crate::claims::text!("{} and {}", -3.25, 1.2e-5);
        assert_eq!(to_markdown(&sentence), r"−3.25 and $1.2\times10^{-5}$");
    }

    #[test]
    fn a_score_counts_no_definition_and_each_word_for_a_difference() {
        let check = |kind, why: &str, holds: bool| {
            let check = Check { why: why.into(), ..Check::new(kind, "a", "b", "c") };
            check.judged(false).explained("d", holds)
        };
        let definition = check(Kind::Definition, "", true);
        assert_eq!(to_row(&definition)["kind"], "definition");
        let differs = [true, false].map(|holds| check(Kind::Statement, "misprint", holds));
        assert_eq!(differs.each_ref().map(Check::difference), [Some("misprint"), None]);
        let count = |checks: &[Check], name: &str| {
            let is_meant = |value: &Value| value.id == format!("score.{name}");
            scorecard(checks).into_iter().find(is_meant).unwrap().number
        };
        let checks = [&differs[..], &[definition]].concat();
        for (name, expected) in
            [("total", 2), ("differs", 1), ("definitions", 1), ("misprint", 1), ("exact_of", 2)]
        {
            assert_eq!(count(&checks, name), Number::Integer(expected), "{name}");
        }
        // A sentence of two readings, of which one holds, and one of one reading.
        let reading = |sentence: &str, verdict| Check {
            sentence: sentence.into(),
            verdict,
            ..differs[0].clone()
        };
        let verdicts =
            [("s", Verdict::Reproduced), ("s", Verdict::Differs), ("", Verdict::Reproduced)];
        let readings = verdicts.map(|(sentence, verdict)| reading(sentence, verdict));
        for (name, expected) in
            [("sentences", 2), ("sentences_reproduced", 1), ("sentences_split", 1)]
        {
            assert_eq!(count(&readings, name), Number::Integer(expected), "{name}");
        }
    }
}

//! Claims as rows for templates, ledgers and terminals.

use super::markdown;
use super::print::{Style, print};
use super::values::{Number, Value, origin};
use crate::claims::{Basis, Check, Published, Text, Verdict, split};
use serde::Serialize;

/// One claim for a template: every field is Markdown, its numbers printed with their digits.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the fields are documented at Check")]
pub struct Row {
    pub id: String,
    /// The section that an id names, `sec7_limit`: "Sec. 7".
    pub section: String,
    pub place: String,
    pub statement: String,
    pub printed: String,
    pub ours: String,
    pub tolerance: String,
    pub reason: String,
    pub basis: String,
    pub verdict: String,
    pub note: String,
}

impl Row {
    /// The row of a claim.
    pub fn of(claim: &Check) -> Self {
        let words = |text: &str| markdown::escaped(&symbols(text));
        Row {
            id: claim.id.clone(),
            section: claim.id.split('_').next().unwrap_or_default().replace("sec", "Sec. "),
            place: words(&claim.place),
            statement: words(&claim.statement),
            printed: words(&claim.printed),
            ours: sentence(&claim.ours),
            tolerance: sentence(&claim.tolerance),
            // Stands in emphasis, in which hosts see no formula.
            reason: markdown::escaped(&claim.reason),
            basis: claim.basis.words().to_string(),
            verdict: claim.verdict.words().to_string(),
            note: sentence(&claim.note),
        }
    }
}

/// A text of a claim as Markdown.
pub fn sentence(text: &Text) -> String {
    let piece = |piece: &Number| match piece {
        Number::Text(words) => markdown::escaped(&symbols(words)),
        number => print(number, Style::default()).markdown(),
    };
    text.0.iter().map(piece).collect()
}

/// A text in which each symbol with an index or a star, as p_crit or k*, is a formula. Other letters stay text.
fn symbols(text: &str) -> String {
    let (mut out, mut rest) = (String::new(), text);
    while let Some(at) = rest.find(['_', '*']) {
        let letter = rest[..at].chars().next_back().filter(|c| c.is_alphabetic());
        let before = &rest[..at - letter.map_or(0, char::len_utf8)];
        let (mark, after) = rest[at..].split_at(1);
        let end = after.find(|c: char| !c.is_alphanumeric()).unwrap_or(after.len());
        let (index, beyond) = after.split_at(if mark == "_" { end } else { 0 });
        let alone = !before.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        match letter.map(|letter| if letter == 'φ' { r"\phi".into() } else { letter.to_string() })
        {
            Some(tex) if alone && mark == "*" => out.push_str(&format!("{before}${tex}^*$")),
            Some(tex) if alone && index.chars().count() == 1 => {
                out.push_str(&format!("{before}${tex}_{index}$"))
            }
            Some(tex) if alone && end > 0 => {
                out.push_str(&format!(r"{before}${tex}_{{\mathrm{{{index}}}}}$"))
            }
            _ => out.push_str(&rest[..rest.len() - beyond.len()]),
        }
        rest = beyond;
    }
    out + rest
}

/// A text of a claim for terminals and data.
pub fn plain(text: &Text) -> String {
    let piece = |piece: &Number| match piece {
        Number::Text(words) => words.clone(),
        number => print(number, Style::default()).plain(),
    };
    text.0.iter().map(piece).collect()
}

/// What was printed, as values: the groups `paper` (parameters) and `printed` (statements).
pub fn printed(published: &Published) -> Vec<Value> {
    let chosen = published.parameters.iter().map(|p| {
        let id = format!("paper.{}", p.id);
        Value::printed(id, &format!("{}", p.value), &p.place).data_only()
    });
    let stated = published.statements.iter().filter_map(|s| {
        let text = format!("{:.*}", usize::from(s.decimals), s.value?);
        Some(Value::printed(format!("printed.{}", s.id), &text, &s.place).data_only())
    });
    chosen.chain(stated).collect()
}

/// The scorecard as values: `score.total`, `score.reproduced`, `score.differs_and_explained`,
/// `score.differs`, `score.cannot_be_judged`, and for each basis `score.exact`, … those reproduced
/// and `score.exact_of`, … all.
pub fn scorecard(claims: &[Check]) -> Vec<Value> {
    let value = |name: &str, count: usize| {
        Value::integer(format!("score.{name}"), count).source(origin(scorecard), "").data_only()
    };
    let count = |verdict| claims.iter().filter(|claim| claim.verdict == verdict).count();
    let verdict = |verdict: &Verdict| value(&verdict.words().replace(' ', "_"), count(*verdict));
    let bases = Basis::ALL.iter().zip(split(claims)).flat_map(|(basis, counts)| {
        let name = basis.words().replace(' ', "_");
        let all = counts.iter().sum();
        [value(&name, counts[0]), value(&format!("{name}_of"), all)]
    });
    let verdicts = Verdict::ALL.iter().map(verdict);
    verdicts.chain([value("total", claims.len())]).chain(bases).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_with_an_index_or_a_star_are_formulas() {
        let text = "At p_crit k* of φ_N(k) is fig_3_b, 2*3, a_ and σ_x.";
        let set = r"At $p_{\mathrm{crit}}$ $k^*$ of $\phi_N$(k) is fig_3_b, 2*3, a_ and $σ_x$.";
        assert_eq!(symbols(text), set);
    }

    #[test]
    fn numbers_of_claims_have_their_digits() {
        let text =
            Text::words("k* at ").with_error(0.11652, 0.0004).say(", ").significant(8.87e-4, 3);
        assert_eq!(sentence(&text), r"$k^*$ at 0.1165(4), $8.87\times10^{-4}$");
        assert_eq!(plain(&text.integer(12345)), "k* at 0.1165(4), 8.87e-412345");
    }
}

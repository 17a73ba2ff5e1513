//! What was printed, verdicts and levels.

use super::{Guard, Look, far, model, unless};
use crate::claims::{Basis, Verdict, rows};
use crate::params::{CONVERGENCE_P, DISTRIBUTION_P, HIGHER_P};

pub const GUARDS: &[Guard] = &[
    Guard {
        name: "probabilities_printed",
        ids: &[
            "paper.fig8_p_*",
            "paper.fig13_p_*",
            "paper.fig14_p_*",
            "paper.vertices",
            "paper.graph_masses",
        ],
        find: probabilities,
    },
    Guard { name: "printed_as_it_reads", ids: &["printed.*"], find: as_it_reads },
    Guard { name: "scores_add_up", ids: &["score.*"], find: scores },
    Guard {
        name: "level_of_claims",
        ids: &["claim_quantile", "family_level", "statistical_claims"],
        find: level,
    },
];

/// What is computed for a figure of the paper is computed for the p that the paper names there, and
/// for its N.
fn probabilities(look: Look<'_>) -> Option<String> {
    let panels = |name: &'static str, letters: &'static str| {
        letters.chars().map(move |letter| format!("paper.{name}_p_{letter}"))
    };
    // Panels (a) and (b) of Fig. 13 have one p.
    let ids = panels("fig8", "abcd").chain(panels("fig13", "acd")).chain(panels("fig14", "ab"));
    let chosen = DISTRIBUTION_P.iter().chain(&HIGHER_P).chain(&CONVERGENCE_P);
    let mut pairs = ids.zip(chosen);
    let masses = look.results.identities.graph_vertices as f64 - 1.0;
    pairs
        .find_map(|(id, p)| look.is(&id, *p))
        .or_else(|| look.is("paper.vertices", look.results.theory.vertices as f64))
        .or_else(|| look.is("paper.graph_masses", masses))
}

/// Numbers in a text, as they are written; not those that a formula adds to a letter.
fn numbers(text: &str) -> impl Iterator<Item = &str> {
    let digit = |c: char| c.is_ascii_digit() || c == '.';
    let starts = text.char_indices().filter(move |&(at, c)| {
        c.is_ascii_digit() && !text[..at].ends_with(digit) && {
            let before = text[..at].trim_end();
            !before.ends_with(['+', '−'])
        }
    });
    starts.map(move |(at, _)| {
        let rest = &text[at..];
        let end = rest.find(|c| !digit(c)).unwrap_or(rest.len());
        rest[..end].trim_end_matches('.')
    })
}

/// Claims that compare all that is printed with what they find.
const HELD: [&str; 4] = ["sec2_parameters", "sec5_fig5", "sec5_fig6", "sec9_fig6_repeats"];

/// `published.toml` has what can be read in the paper and the number that is judged, each typed for
/// itself: where numbers can be read, they are the one that is judged, to its last digit; and where none is judged,
/// none can be read. Claims that judge more of what is printed hold it themselves.
fn as_it_reads(look: Look<'_>) -> Option<String> {
    look.published.statements.iter().find_map(|statement| {
        let read = || numbers(&statement.printed);
        let held = HELD.contains(&statement.id.as_str());
        let Some(value) = statement.value else {
            let named = || rows().any(|row| row.id == statement.id && row.reads.is_some());
            return unless(held || read().next().is_none() || named(), || {
                format!("{} reads {:?}, and no number is judged", statement.id, statement.printed)
            });
        };
        let number = format!("{value:.*}", usize::from(statement.decimals));
        let exact = number.parse() == Ok(value) || read().next().is_none();
        let named = held || (exact && read().all(|own| own == number));
        unless(named, || {
            format!("{} reads {:?}, and is judged by {number}", statement.id, statement.printed)
        })
    })
}

/// The verdicts are those of all statements, and so are the things that they rest on; reproduced is
/// counted alike by both.
fn scores(look: Look<'_>) -> Option<String> {
    let score = |name: &str| look.number(&format!("score.{}", name.replace(' ', "_")));
    let all = look.claims.len() as f64;
    let verdicts: Option<f64> = Verdict::ALL.iter().map(|own| score(own.words())).sum();
    let bases = |end: &str| -> Option<f64> {
        Basis::ALL.iter().map(|own| score(&format!("{}{end}", own.words()))).sum()
    };
    let reproduced = Verdict::Reproduced.words();
    look.is("score.total", all)
        .or_else(|| far("the sum over all verdicts", verdicts?, all))
        .or_else(|| far("the sum over what verdicts rest on", bases("_of")?, all))
        .or_else(|| far("the reproduced", bases("")?, score(reproduced)?))
}

/// So many independent normal deviations, each beyond the quantile with its tails, keep the level of the
/// family; a hundredth less, to which the quantile is rounded up, does not.
fn level(look: Look<'_>) -> Option<String> {
    let [quantile, family, claims] = ["claim_quantile", "family_level", "statistical_claims"]
        .map(|id| look.number(id).unwrap_or(f64::NAN));
    let any = |quantile: f64| model::any(model::both_tails(quantile), claims);
    unless(any(quantile) <= family && family < any(quantile - 0.01), || {
        format!("one of {claims} claims fails with probability {}, not {family}", any(quantile))
    })
}

#[cfg(test)]
mod tests {
    use super::numbers;

    #[test]
    fn numbers_are_read() {
        let all = |text| numbers(text).collect::<Vec<_>>();
        assert_eq!(all("σ ≈ 0.12, L-1 and 16."), ["0.12", "1", "16"]);
        assert_eq!(all("N − 1, k + 1, k > 3"), ["3"]);
    }
}

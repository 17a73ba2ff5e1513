//! Puts brackets around a value to which something in its formula binds: `(-5)^2`, `2(-5)`.

use super::super::document::{Formula, Part};
use super::super::tex::{self, signs};
use crate::print::Printed;

const BLANKS: [&str; 9] = [" ", "\n", "~", r"\,", r"\:", r"\;", r"\!", r"\thinspace", r"\ "];
/// Before a sign of a number these bind; and so do letters, numbers, and brackets that close.
const BEFORE: &str = r"+ - − / ) ] } ! ' * \ast \pm \mp \times \cdot \div \partial \nabla \ell \hbar \prime \rangle
    \rvert \rVert \rceil \rfloor \rbrace";
const FUNCTIONS: &str =
    r"\exp \ln \log \sin \cos \tan \cot \sinh \cosh \tanh \coth \arcsin \arccos \arctan";

pub fn bracketed(parts: Vec<Part>) -> Formula {
    let tex = |i: Option<usize>| match i.and_then(|i| parts.get(i)) {
        Some(Part::Tex(tex)) => tex.as_str(),
        // A value beside a value.
        Some(Part::Value { .. }) => "0",
        None => "",
    };
    let is_bound = |(i, part): (usize, &Part)| match part {
        Part::Value { printed, .. } => binds(tex(i.checked_sub(1)), tex(Some(i + 1)), printed),
        Part::Tex(_) => false,
    };
    let bound: Vec<bool> = parts.iter().enumerate().map(is_bound).collect();
    let sign = |sign: &str, is_bound: bool| is_bound.then(|| Part::Tex(sign.into()));
    let written = parts.into_iter().zip(bound).flat_map(|(part, is_bound)| {
        [sign("(", is_bound), Some(part), sign(")", is_bound)].into_iter().flatten()
    });
    Formula(written.collect())
}

fn binds(mut before: &str, mut after: &str, printed: &Printed) -> bool {
    let Printed::Number(numeral) = printed else { return false };
    // Braces alone are not seen: `{«v»}^2`.
    while let (Some(outer), Some(rest)) = (before.strip_suffix('{'), after.strip_prefix('}')) {
        let last = signs(outer).last().unwrap_or_default();
        if last.len() > 1 || "}]^_".contains(last) && !last.is_empty() {
            break;
        }
        (before, after) = (outer, rest);
    }
    let visible = |tex| signs(tex).filter(|sign| !BLANKS.contains(sign)).collect::<Vec<_>>();
    let (before_signs, after) = (visible(before), visible(after));
    let digit = |sign: &&str| sign.starts_with(|c: char| c.is_ascii_digit());
    let is_degrees = after.iter().find(|sign| !["^", "{"].contains(sign)) == Some(&r"\circ");
    let raises = after.first().is_some_and(|sign| "^_'!".contains(sign)) && !is_degrees;
    let has_more = numeral.exponent.is_some() || numeral.error.is_some() || numeral.in_percent;
    let (last, rest) = before_signs.split_last().unwrap_or((&"", &[]));
    // The digits of `x^2` and `\frac12` are no factors.
    let mut ahead = rest.iter().rev().take(2);
    let is_factor = !ahead.any(|sign| ["^", "_"].contains(sign) || sign.ends_with("frac"));
    let joins = digit(last) && is_factor || after.first().is_some_and(digit);
    let of_text = [r"\text", r"\textrm", r"\begin", r"\end"];
    let opened = before.rsplit_once('{').map_or("", |(opened, _)| opened);
    let is_text = *last == "}" && of_text.iter().any(|of| opened.ends_with(of));
    let letter = tex::spell(last);
    let is_letter = letter.chars().all(char::is_alphabetic) && letter.chars().count() == 1;
    let is_in = |list: &str| list.split_whitespace().any(|sign| sign == *last);
    // The second of two bars ends what stands between them.
    let is_end = *last == "|" && before_signs.iter().filter(|sign| **sign == "|").count() % 2 == 0;
    let binds_sign =
        !is_text && (is_letter || is_in(BEFORE) || is_in(FUNCTIONS) || is_end || digit(last));
    raises && (numeral.is_negative || has_more)
        || joins
        || numeral.is_negative && binds_sign
        || (*last == "/" || is_in(FUNCTIONS))
            && numeral.exponent.is_some()
            && !numeral.is_power_alone()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::print::{Style, print};
    use impact_numerics::estimates::with_error;

    /// Formulas around −5 `M`, 1.20(3)·10⁻⁵ `P` and 0.1165(4) `E`; what is right stays as it is.
    const FORMULAS: &str = r"
(P)^2 | (M) ^2 | {(M)}^2 | (E)^2 | 2(M) | 2\,(P) | x''(M) | ¦x¦(M) | ¦M¦ | \rangle (M) | \ln (P) + x | \ln E | 2 (E) | a + (M) | \sigma(M) | a/(P) | -(M) | (M)(E) | x_{1}(M)
x = M y | x^{M} | \frac{P}{2} | 2 \cdot P | x^2 E \pm 1 | \text{at }M^\circ | f( M )^2 | \tfrac12 E | a, M | 2 < M";

    #[test]
    fn a_value_has_brackets_where_something_binds_to_it() {
        let numbers =
            [(-5_i64).into(), with_error(1.2e-5, 3e-7).into(), with_error(0.1165, 4e-4).into()];
        let part = |c: char| match "MPE".find(c) {
            Some(at) => {
                Part::Value { id: c.into(), printed: print(&numbers[at], Style::default()) }
            }
            None => Part::Tex(c.into()),
        };
        for expected in FORMULAS.trim().split(['|', '\n']).map(str::trim) {
            let expected = &*expected.replace('¦', "|");
            let bare = ["M", "P", "E"]
                .iter()
                .fold(expected.to_string(), |tex, v| tex.replace(&format!("({v})"), v));
            let mut parts: Vec<Part> = Vec::new();
            for next in bare.chars().map(part) {
                match (parts.last_mut(), next) {
                    (Some(Part::Tex(before)), Part::Tex(tex)) => before.push_str(&tex),
                    (_, next) => parts.push(next),
                }
            }
            let written = bracketed(parts).to_tex_with(|id, _| id.into());
            assert_eq!(written, expected, "{bare}");
        }
    }
}

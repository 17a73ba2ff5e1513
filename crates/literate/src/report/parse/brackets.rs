//! Puts brackets around a value to which something in its formula binds: `(-5)^2`, `2(-5)`.

use super::super::document::{Formula, Part};
use super::super::tex::{self, signs};
use crate::print::Shown;

const BLANKS: [&str; 9] = [" ", "\n", "~", r"\,", r"\:", r"\;", r"\!", r"\thinspace", r"\ "];
/// Before a sign of a number these bind; and so do letters, numbers, and brackets that close.
const BEFORE: &str = r"+ - − / ) ] } ! * \ast \pm \mp \times \cdot \div \partial \nabla \ell \hbar \exp \ln \log
    \sin \cos \tan \cot \sinh \cosh \tanh \coth \arcsin \arccos \arctan";

pub fn bracketed(parts: Vec<Part>) -> Formula {
    let tex = |i: Option<usize>| match i.and_then(|i| parts.get(i)) {
        Some(Part::Tex(tex)) => tex.as_str(),
        // A value beside a value.
        Some(Part::Value { .. }) => "0",
        None => "",
    };
    let is_bound = |(i, part): (usize, &Part)| match part {
        Part::Value { shown, .. } => binds(tex(i.checked_sub(1)), tex(Some(i + 1)), shown),
        Part::Tex(_) => false,
    };
    let bound: Vec<bool> = parts.iter().enumerate().map(is_bound).collect();
    let sign = |sign: &str, is_bound: bool| is_bound.then(|| Part::Tex(sign.into()));
    let written = parts.into_iter().zip(bound).flat_map(|(part, is_bound)| {
        [sign("(", is_bound), Some(part), sign(")", is_bound)].into_iter().flatten()
    });
    Formula(written.collect())
}

fn binds(mut before: &str, mut after: &str, shown: &Shown) -> bool {
    let Shown::Number(numeral) = shown else { return false };
    // Braces alone are not seen: `{«v»}^2`.
    while let (Some(outer), Some(rest)) = (before.strip_suffix('{'), after.strip_prefix('}')) {
        let last = signs(outer).last().unwrap_or_default();
        if last.len() > 1 || "}]^_".contains(last) && !last.is_empty() {
            break;
        }
        (before, after) = (outer, rest);
    }
    let shown = |tex| signs(tex).filter(|sign| !BLANKS.contains(sign)).collect::<Vec<_>>();
    let (before_signs, after) = (shown(before), shown(after));
    let digit = |sign: &&str| sign.starts_with(|c: char| c.is_ascii_digit());
    let is_degrees = after.iter().find(|sign| !["^", "{"].contains(sign)) == Some(&r"\circ");
    let raises = after.first().is_some_and(|sign| "^_'!".contains(sign)) && !is_degrees;
    let has_more = numeral.exponent.is_some() || numeral.error.is_some() || numeral.percent;
    let (last, rest) = before_signs.split_last().unwrap_or((&"", &[]));
    // The digits of `x^2` and `\frac12` are no factors.
    let mut ahead = rest.iter().rev().take(2);
    let is_factor = !ahead.any(|sign| ["^", "_"].contains(sign) || sign.ends_with("frac"));
    let joins = digit(last) && is_factor || after.first().is_some_and(digit);
    let of_text = [r"\text", r"\textrm", r"\begin", r"\end"];
    let words = before
        .rsplit_once('{')
        .is_some_and(|(of, _)| of_text.iter().any(|text| of.ends_with(text)));
    let is_letter =
        tex::spell(last).chars().all(char::is_alphabetic) && tex::spell(last).chars().count() == 1;
    let binds_sign = match *last {
        "}" => !words,
        last => is_letter || BEFORE.split_whitespace().any(|sign| sign == last),
    };
    raises && (numeral.negative || has_more)
        || joins
        || numeral.negative && (binds_sign || digit(last))
        || *last == "/" && numeral.exponent.is_some() && !numeral.is_power_alone()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::print::{Style, print};
    use crate::value::Number;
    use impact_numerics::estimates::with_error;

    #[test]
    fn a_value_has_brackets_where_something_binds_to_it() {
        let minus = || Number::from(-5_i64);
        let power = || with_error(1.2e-5, 3e-7).into();
        let error = || with_error(0.1165, 4e-4).into();
        for (before, number, after, expected) in [
            ("", power(), "^2", r"(1.20(3)\times10^{-5})^2"),
            ("", minus(), " ^2", "(-5) ^2"),
            ("{", minus(), "}^2", "{(-5)}^2"),
            ("", error(), "^2", "(0.1165(4))^2"),
            ("2", minus(), "", "2(-5)"),
            (r"2\,", power(), "", r"2\,(1.20(3)\times10^{-5})"),
            ("2 ", error(), "", "2 (0.1165(4))"),
            (r"a + ", minus(), "", "a + (-5)"),
            (r"\sigma", minus(), "", r"\sigma(-5)"),
            ("a/", power(), "", r"a/(1.20(3)\times10^{-5})"),
            ("-", minus(), "", "-(-5)"),
            // What is right stays as it is.
            ("x = ", minus(), " y", "x = -5 y"),
            ("x^{", minus(), "}", "x^{-5}"),
            (r"\frac{", power(), "}{2}", r"\frac{1.20(3)\times10^{-5}}{2}"),
            (r"2 \cdot ", power(), "", r"2 \cdot 1.20(3)\times10^{-5}"),
            (r"x^2 ", error(), r" \pm 1", r"x^2 0.1165(4) \pm 1"),
            (r"\text{at }", minus(), r"^\circ", r"\text{at }-5^\circ"),
            ("f(", minus(), ")^2", "f(-5)^2"),
            (r"\tfrac12 ", Number::from(5_i64), "^2", r"\tfrac12 5^2"),
        ] {
            let (id, shown) = ("v".into(), print(&number, Style::default()));
            let tex = |tex: &str| Part::Tex(tex.into());
            let parts = vec![tex(before), Part::Value { id, shown }, tex(after)];
            assert_eq!(bracketed(parts).digits(), expected);
        }
    }
}

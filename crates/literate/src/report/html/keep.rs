//! What a line may not break: browsers would put the stop behind a number or a formula on the next
//! line, because a button and a `<math>` are boxes to them, and not words.

use crate::report::document::Inline;

const OPENING: [char; 4] = ['(', '[', '“', '‘'];
const CLOSING: [char; 12] = ['.', ',', ';', ':', '!', '?', ')', ']', '”', '’', '%', '-'];

/// The same pieces in groups; what stands in one group stays in one line.
pub fn together(list: &[Inline]) -> Vec<Vec<Inline>> {
    let mut groups: Vec<Vec<Inline>> = Vec::new();
    for piece in list {
        match piece {
            Inline::Text(text) if groups.last().is_some_and(|group| ends_in_box(group)) => {
                let cut = text.find(|c| !CLOSING.contains(&c)).unwrap_or(text.len());
                let (closing, rest) = text.split_at(cut);
                if let Some(group) = groups.last_mut().filter(|_| !closing.is_empty()) {
                    group.push(Inline::Text(closing.into()));
                }
                if !rest.is_empty() {
                    groups.push(vec![Inline::Text(rest.into())]);
                }
            }
            piece if is_box(piece) => add(&mut groups, piece.clone()),
            piece => groups.push(vec![piece.clone()]),
        }
    }
    groups.retain(|group| !matches!(group.as_slice(), [Inline::Text(text)] if text.is_empty()));
    groups
}

fn is_box(piece: &Inline) -> bool {
    matches!(piece, Inline::Value { .. } | Inline::Maths(_))
}

fn ends_in_box(group: &[Inline]) -> bool {
    group.last().is_some_and(is_box)
}

/// Adds a number or a formula, with what before it has to stay at its side.
fn add(groups: &mut Vec<Vec<Inline>>, piece: Inline) {
    let is_blank = |group: &[Inline]| matches!(group, [Inline::Text(text)] if text == " ");
    let awaits =
        |group: &[Inline]| matches!(group.last(), Some(Inline::Maths(tex)) if relates(tex));
    match groups.as_mut_slice() {
        // `3$x$`.
        [.., group] if ends_in_box(group) => group.push(piece),
        // `$x =$ 3`.
        [.., group, blank] if is_blank(blank) && awaits(group) => {
            group.extend([Inline::Text("\u{a0}".into()), piece]);
            groups.pop();
        }
        [.., group] => {
            let opening = opening(group).map(Inline::Text);
            groups.push(opening.into_iter().chain([piece]).collect());
        }
        [] => groups.push(vec![piece]),
    }
}

/// Formulas that end before their right side.
fn relates(tex: &str) -> bool {
    let ends = ["=", "<", ">", r"\approx", r"\le", r"\ge", r"\lt", r"\gt", r"\pm"];
    ends.iter().any(|end| tex.trim_end().ends_with(end))
}

/// Takes opening brackets from the end of the last text.
fn opening(group: &mut [Inline]) -> Option<String> {
    let Some(Inline::Text(text)) = group.last_mut() else { return None };
    let kept = text.trim_end_matches(OPENING).len();
    (kept < text.len()).then(|| text.split_off(kept))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(list: &[Inline]) -> Vec<usize> {
        together(list).iter().map(Vec::len).collect()
    }

    #[test]
    fn stops_and_brackets_stay_with_their_numbers() {
        let text = |text: &str| Inline::Text(text.into());
        let maths = |tex: &str| Inline::Maths(tex.into());
        let value = || Inline::Value { id: "a".into(), shown: vec![Inline::Text("3".into())] };
        assert_eq!(shape(&[text("at ("), value(), text("). So")]), [1, 3, 1]);
        assert_eq!(shape(&[text("at "), value(), text(" of")]), [1, 1, 1]);
        assert_eq!(shape(&[text("at "), maths("t ="), text(" "), value(), text(".")]), [1, 4]);
        assert_eq!(shape(&[maths("t"), text(" "), value()]), [1, 1, 1]);
        assert_eq!(shape(&[text("("), maths("n"), text("-th)")]), [3, 1]);
        let all = together(&[text("at ("), value(), text("). So")]).concat();
        assert_eq!(all.len(), 5);
        assert_eq!(all[0], text("at "));
    }
}

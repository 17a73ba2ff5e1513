//! Where a displayed equation may go on in the next line.
//!
//! Browsers do not break MathML. So an equation is a row of formulas: *terms*, each of which begins with a
//! relation or a sign, and in these *factors*, which are broken apart only where a term alone is wider
//! than the screen. Style sheets let both wrap.

use crate::report::Error;
use roxmltree::{Document, Node};

/// Operators before which a line may end.
const RELATIONS: &str = "=<>≤≥≈≠∼∝→∈≪≫≲≳≡+−±";
const OPENING: &str = "([{⟨⌈⌊";
const CLOSING: &str = ")]}⟩⌉⌋!";
const LARGE: &str = "∫∮∑∏";
const PRODUCTS: &str = "·⋅×";
/// Blanks of this width in em and more part a formula from its condition.
const WIDE: f64 = 1.0;

/// One row of an equation: its terms, and in each its factors, as MathML.
pub type Row = Vec<Vec<String>>;

/// The rows of a formula that math-core made: one, or those of an aligned formula as pairs of cells.
pub fn rows(mathml: &str) -> Result<Vec<Vec<Row>>, Error> {
    let fail =
        |error: roxmltree::Error| Error::Maths { tex: mathml.into(), what: error.to_string() };
    let document = Document::parse(mathml).map_err(fail)?;
    let root = document.root_element();
    let parts: Vec<Node<'_, '_>> = root.children().filter(Node::is_element).collect();
    if let [table] = parts[..]
        && table.has_tag_name("mtable")
        && let Some(columns) = table.children().map(|row| row.children().count()).max()
        && matches!(columns, 2 | 4)
    {
        let cell = |(i, cell): (usize, Node<'_, '_>)| {
            let parts: Vec<_> = cell.children().filter(Node::is_element).collect();
            terms(mathml, &parts, i % 2 == 1)
        };
        let row = |row: Node<'_, '_>| {
            let mut cells: Vec<Row> = row.children().enumerate().map(cell).collect();
            cells.resize(columns, Row::new());
            cells
        };
        return Ok(table.children().map(row).collect());
    }
    Ok(vec![vec![terms(mathml, &parts, false)]])
}

/// What a part of a formula is to its neighbours.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    /// Nothing may part it from what stands before.
    Plain,
    Relation,
    Opening,
    Closing,
    Fraction,
    /// The sign of a product.
    Product,
    /// Other operators: what follows stays with them.
    Binding,
    /// An integral or a sum.
    Large,
    /// As exp, with its argument.
    Function,
    /// A bracket that grows.
    Bracket,
    /// A wide blank: what follows is a condition, and a term as a whole.
    Blank,
}

/// Cuts neighbours into terms and factors. What `goes_on` after something else begins with an operator
/// between two things.
fn terms(mathml: &str, parts: &[Node<'_, '_>], goes_on: bool) -> Row {
    let mut row: Row = vec![vec![String::new()]];
    let (mut depth, mut bar, mut before, mut condition) = (0_i32, false, None, false);
    for part in parts {
        let kind = kind(part);
        let outside = depth == 0 && !bar;
        let begins = before.is_some_and(|before| {
            before == Part::Blank || kind == Part::Relation && outside && !condition
        });
        let parts = outside
            && before.is_some_and(|before| match kind {
                Part::Relation | Part::Product => true,
                Part::Large | Part::Function => {
                    use Part::{Binding, Large, Product, Relation};
                    !matches!(before, Binding | Product | Relation | Large)
                }
                Part::Bracket => matches!(before, Part::Closing | Part::Fraction | Part::Bracket),
                Part::Opening => before == Part::Closing,
                _ => false,
            });
        condition |= kind == Part::Blank;
        if begins {
            row.push(vec![String::new()]);
        } else if parts {
            row.last_mut().into_iter().for_each(|term| term.push(String::new()));
        }
        let text = &mathml[part.range()];
        if let Some(piece) = row.last_mut().and_then(|term| term.last_mut()) {
            // The first operator of a row would lose the blanks about it.
            let operator = matches!(kind, Part::Relation | Part::Product) && piece.is_empty();
            let begins = operator && (before.is_some() || goes_on);
            match text.strip_prefix("<mo>").filter(|_| begins) {
                Some(rest) => piece.push_str(&format!("<mo form=\"infix\">{rest}")),
                None => piece.push_str(text),
            }
        }
        match kind {
            Part::Opening => depth += 1,
            Part::Closing if word(part) != "!" => depth -= 1,
            _ => bar ^= word(part) == "|",
        }
        before = Some(kind);
    }
    row
}

/// The text of the operator that a part begins with: `)` of `)²`.
fn word<'a>(part: &Node<'a, '_>) -> &'a str {
    let first = part.descendants().find(|node| !node.has_children() && node.is_text());
    let operator = first.and_then(|text| text.parent()).filter(|outer| outer.has_tag_name("mo"));
    operator.and_then(|outer| outer.text()).unwrap_or_default()
}

fn kind(part: &Node<'_, '_>) -> Part {
    let word = word(part);
    let among = |list: &str| word.chars().count() == 1 && list.contains(word);
    match part.tag_name().name() {
        "mspace" => {
            let width = part.attribute("width").and_then(|width| width.strip_suffix("em"));
            let wide = width.and_then(|width| width.parse::<f64>().ok()).is_some_and(|w| w >= WIDE);
            if wide { Part::Blank } else { Part::Plain }
        }
        "mfrac" => Part::Fraction,
        "mrow" if among(OPENING) => Part::Bracket,
        _ if among(LARGE) => Part::Large,
        _ if among(CLOSING) => Part::Closing,
        "mo" if among(OPENING) => Part::Opening,
        // A sign has no blanks about it.
        "mo" if among(RELATIONS) && part.attribute("lspace").is_none() => Part::Relation,
        "mo" if among(PRODUCTS) => Part::Product,
        "mo" if word.chars().count() > 1 => Part::Function,
        "mo" => Part::Binding,
        _ => Part::Plain,
    }
}

#[cfg(test)]
mod tests {
    use super::super::maths;
    use super::*;

    /// The words of each factor, with a bar before each factor and two before each term.
    fn shape(tex: &str) -> Vec<String> {
        let words = |piece: &String| {
            let text = format!("<math>{piece}</math>");
            let document = Document::parse(&text).unwrap();
            document
                .descendants()
                .filter(|node| node.is_text())
                .filter_map(|node| node.text())
                .collect::<String>()
        };
        let row = |row: &Row| {
            let terms =
                row.iter().map(|term| term.iter().map(words).collect::<Vec<_>>().join(" | "));
            terms.collect::<Vec<_>>().join(" || ")
        };
        let rows = rows(&maths::displayed(tex).unwrap()).unwrap();
        rows.iter().map(|cells| cells.iter().map(row).collect::<Vec<_>>().join(" & ")).collect()
    }

    #[test]
    fn lines_end_before_relations_signs_and_factors() {
        for (tex, expected) in [
            (r"a = b + c", "a || =b || +c"),
            (r"a = -b", "a || =−b"),
            (r"f(a + b)^2 + c", "f(a+b)2 || +c"),
            (r"|a - b| = c, \qquad j = 1", "|a−b| || =c, || j | =1"),
            (r"p \int_0^d \int_0^x t \exp\left(-t\right)", "p | ∫0d∫0xt | exp(−t)"),
            (r"(N - 1)(N - 2) \cdots (N - k)", "(N−1) | (N−2)⋯(N−k)"),
            (r"N! \left( a \right)", "N! | (a)"),
            (r"(a) \cdots (b) \cdot 1 \cdot (c)", "(a)⋯(b) | ⋅1 | ⋅(c)"),
        ] {
            assert_eq!(shape(tex), [expected], "{tex}");
        }
        let aligned = shape(r"\begin{aligned} a = b &+ c \\ &- d \end{aligned}");
        assert_eq!(aligned, ["a || =b & +c", " & −d"]);
        let two = shape(r"\begin{aligned} a &= b & c &= d \\ e &= f \end{aligned}");
        assert_eq!(two, ["a & =b & c & =d", "e & =f &  & "]);
    }

    #[test]
    fn an_operator_that_begins_a_line_keeps_its_blanks() {
        let infix = |tex: &str| {
            let rows = rows(&maths::displayed(tex).unwrap()).unwrap().concat();
            rows.concat().concat().concat().matches("form=\"infix\"").count()
        };
        assert_eq!(infix("a = b + c"), 2);
        assert_eq!(infix("-a"), 0);
        assert_eq!(infix(r"\begin{aligned} a &+ c \\ &+ d \end{aligned}"), 2);
    }
}

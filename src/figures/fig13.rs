//! Fig. 13: (a) to (d) distributions with higher-order circuits and what each class contributes; (e) and (f), (a)
//! and (d) on a logarithmic axis, which the paper does not have.

use super::prelude::*;
use crate::experiments::theory::{HigherDistribution, Theory};

/// Largest k of the detail in (b).
const DETAIL: usize = 20;

/// The lowest decade of (e) and (f).
const LOWEST: i32 = -8;

/// Name, symbol, colour and dash of a class.
type Class = (&'static str, &'static str, Colour, Dash);

/// The five classes in the order of Eq. (38).
const CLASSES: [Class; 5] = [
    ("simple circuits", "*ϕ*_{*N*}", GREEN, Dash::Long),
    ("one vertex twice", "*ϕ*_{*N*}^{1}", BLUE, Dash::Short),
    ("one vertex three times", "*ϕ*_{*N*}^{1,0}", ORANGE, Dash::Twice),
    ("one vertex four times", "*ϕ*_{*N*}^{1,0,0}", INK, Dash::Dotted),
    ("two vertices twice", "*ϕ*_{*N*}^{2}", PURPLE, Dash::Alternate),
];

/// Draws the figure.
pub fn draw(theory: &Theory) -> Result<Figure, Error> {
    let sheet = Sheet::new(11_350, None)?;
    let n = theory.vertices;
    let [small, middle, large] = theory.higher.as_slice() else {
        return Err(Error::Shape {
            figure: "13",
            expected: "higher-order distributions at three p",
        });
    };
    for (i, (distribution, shown)) in
        [(small, n), (small, DETAIL), (middle, n), (large, n)].into_iter().enumerate()
    {
        let (step, minor) = if shown == DETAIL { (5.0, 5) } else { (20.0, 2) };
        // The detail shows the higher orders: the simple circuits leave it at its upper edge.
        let top = if shown == DETAIL {
            1.5 * distribution
                .classes
                .iter()
                .skip(1)
                .map(|c| largest(&c.probability))
                .fold(0.0, f64::max)
        } else {
            largest(&distribution.total)
        };
        let end = if shown == DETAIL { shown as f64 } else { n as f64 + 1.0 };
        let x = Axis::linear(0.0, end, step, minor, "*k*");
        let y = upwards_from_zero(top, "*P*(*X* = *k*)");
        let panel = sheet.panel(FOUR[i], x, y)?;
        let p = short(distribution.p, 3);
        let detail = if shown == DETAIL { ", detail" } else { "" };
        heading(&panel, LETTERS[i], &format!("*p* = {p}{detail}"))?;
        series(&panel, distribution, shown)?;
    }
    for (left, letter, distribution) in [(1080, "(e)", small), (5230, "(f)", large)] {
        let x = Axis::linear(0.0, n as f64 + 1.0, 20.0, 2, "*k*");
        let y = Axis::decades(LOWEST, 0, 2, "*P*(*X* = *k*)");
        let panel = sheet.panel(Frame::new(left, 7080, left + 2970, 9180), x, y)?;
        heading(&panel, letter, &format!("*p* = {}", short(distribution.p, 3)))?;
        logarithmic(&panel, distribution)?;
    }
    let mut entries = vec![Entry::line(Stroke::solid(RED, LINE), "all five classes")];
    entries.extend(CLASSES.iter().map(|&(name, symbol, colour, dash)| {
        Entry::line(Stroke::dashed(colour, LINE, dash), &format!("{name}, {symbol}"))
    }));
    sheet.legend_in_columns((400, 10_250), (SMALL, 400), (3, 4100), &entries)?;
    let share = |of: &HigherDistribution| short(of.classes.first().map_or(0.0, |c| c.share), 2);
    let description = format!(
        "Probability of k different impacts, N = {n}, for five classes of circuits: a red line for the sum, broken ones for the \
         classes. (b) enlarges (a); (e), (f) are (a), (d) on a logarithmic axis. Simple circuits hold {} of the whole at p = {}, {} at p = {} and {} at p = {}.",
        share(small),
        short(small.p, 3),
        share(middle),
        short(middle.p, 3),
        share(large),
        short(large.p, 3),
    );
    Ok(sheet.finish("fig13", "Distributions with higher-order circuits", description))
}

/// All classes on a logarithmic axis, where each is seen.
fn logarithmic(panel: &Panel, distribution: &HigherDistribution) -> Result<(), Error> {
    let curve = |name: &str, values: &[f64], stroke: Stroke| {
        panel.curve(name, &over_k(values), stroke, Outside::Cut)
    };
    curve("all five classes", &distribution.total, Stroke::solid(RED, LINE))?;
    for (class, &(name, _, colour, dash)) in distribution.classes.iter().zip(&CLASSES) {
        curve(name, &class.probability, Stroke::dashed(colour, LINE, dash))?;
    }
    Ok(())
}

fn series(panel: &Panel, distribution: &HigherDistribution, shown: usize) -> Result<(), Error> {
    let detail = shown == DETAIL;
    let outside = if detail { Outside::Cut } else { Outside::Refuse };
    let total = over_k(&distribution.total[..shown.min(distribution.total.len())]);
    let red = Stroke::solid(RED, LINE);
    panel.curve("all five classes", &total, red, outside)?;
    for (class, &(name, _, colour, dash)) in distribution.classes.iter().zip(&CLASSES) {
        let points = visible(&class.probability[..shown.min(class.probability.len())], panel.y.hi);
        panel.curve(name, &points, Stroke::dashed(colour, LINE, dash), outside)?;
        if detail {
            let dots = (Mark::Disc, 28, Stroke::solid(colour, THIN));
            panel.marks(name, &points, dots, outside)?;
        }
    }
    Ok(())
}

/// The stretch over which a class stands out from the axis, so that it is not a mere zero line.
fn visible(probability: &[f64], top: f64) -> Vec<(f64, f64)> {
    let stands_out = |p: &f64| *p > 0.002 * top;
    let points = over_k(probability);
    let Some(first) = probability.iter().position(stands_out) else { return Vec::new() };
    let last = probability.iter().rposition(stands_out).unwrap_or(first);
    points[first.saturating_sub(1)..(last + 2).min(points.len())].to_vec()
}

//! Draws Fig. 13: (a) to (d) distributions with higher-order circuits and the parts of the classes;
//! (e) and (f), (a) and (d) on a logarithmic axis, which the paper does not have and where each
//! class is visible and named.

use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::theory::higher::{contributions, five};
use crate::params::{HIGHER_P, VERTICES as N};

/// Name, symbol, colour and dash of a class.
type Class = (&'static str, &'static str, RGBColor, Dash);

/// The sum of all classes: thin, so that the broken lines of the classes are seen on it.
const SUM: Stroke = Stroke::solid(GREY, THIN);

/// The five classes in the order of Eq. (38).
const CLASSES: [Class; 5] = [
    ("simple circuits", "*ϕ*_{*N*}", GREEN, LONG),
    ("one vertex twice", "*ϕ*_{*N*}^{1}", PURPLE, SHORT),
    ("one vertex three times", "*ϕ*_{*N*}^{1,0}", ORANGE, TWICE),
    ("one vertex four times", "*ϕ*_{*N*}^{1,0,0}", BLUE, DOTTED),
    ("two vertices twice", "*ϕ*_{*N*}^{2}", INK, ALTERNATE),
];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(10_600);
    let [small, middle, large] = HIGHER_P;
    let whole = N as f64 + 1.0;
    // p, first and last k, step between their numbers, and the lowest power of ten, if any.
    let panels = [
        (small, 0.0, whole, 50.0, None),
        (small, 0.0, 12.0, 6.0, None),
        (middle, 0.0, 40.0, 20.0, None),
        (large, 0.0, whole, 50.0, None),
        (small, 0.0, 20.0, 10.0, Some(-12)),
        (large, 50.0, whole, 25.0, Some(-8)),
    ];
    for (i, (p, first, last, step, lowest)) in panels.into_iter().enumerate() {
        let label = if i % 2 == 0 { "*P*(*X* = *k*)" } else { "" };
        let y = match lowest {
            Some(lowest) => Axis::decades(lowest, 0, 4, label),
            // The detail shows the higher orders: the simple circuits leave it at its upper edge.
            None if i == 1 => Axis::up_to(1.5 * largest(&contributions(p)[1..].concat()), label),
            None => Axis::up_to(largest(&five(p)), label),
        };
        let (left, row) = (1200 + 4050 * (i as i32 % 2), i as i32 / 2);
        let (top, height) = (480 + 2300 * row, if row == 2 { 3500 } else { 1200 });
        let frame = Frame::new(left, top, left + 2950, top + height);
        let x = Axis::linear(first, last, step, 5, "*k*");
        let panel = sheet.panel(frame, x, y.column("P(X = k)"))?.outside(Outside::Cut);
        panel.heading(LETTERS[i], &format!("*p* = {}", short(p, 3)))?;
        series(&panel, p)?;
        // Next to k, or to the left end, at a height: where each class has room.
        let places = match i {
            4 => [(8.0, (1, -2)), (5.0, (1, -2)), (9.0, (-2, 3)), (12.0, (-2, 2)), (20.0, (1, 0))],
            5 => [(80.0, (0, 3)), (80.0, (0, 3)), (0.0, (0, 0)), (0.0, (0, 0)), (69.0, (-2, -1))],
            _ => continue,
        };
        for ((class, (_, symbol, colour, _)), (k, side)) in
            contributions(p).iter().zip(CLASSES).zip(places)
        {
            if let Some((k, at)) = over_k(class).into_iter().find(|point| point.0 == k) {
                panel.label_nearby(symbol, (k, at), side, colour)?;
            }
        }
    }
    let names = CLASSES.map(|(name, symbol, colour, dash)| {
        (format!("{name}, {symbol}"), colour, Stroke::dashed(colour, LINE, dash))
    });
    let all = ("all five classes".to_string(), GREY, SUM);
    for (i, (name, colour, stroke)) in (0..).zip([all].into_iter().chain(names)) {
        let (left, y) = (1200 + 3500 * (i % 2), 9_650 + 340 * (i / 2));
        sheet.area.draw(&line(vec![(left, y), (left + 500, y)], stroke))?;
        let style = words(SMALL, colour, HPos::Left, VPos::Center);
        sheet.area.draw_text(&name, &style, (left + 600, y))?;
    }

    let share = |p: f64| {
        let share = results.number(&format!("theory.classes[p={p}].simple"));
        share.map(|share| short(share, 2))
    };
    let description = describe!(
        "Probability of k different impacts, N = {N}, for five classes of circuits: a thin grey line for the sum, broken ones for the \
         classes. (b) enlarges (a); (e), (f) are (a), (d) on a logarithmic axis. Simple circuits hold {} of the whole at p = {}, {} at p = {} and {} at p = {}.",
        share(small)?,
        short(small, 3),
        share(middle)?,
        short(middle, 3),
        share(large)?,
        short(large, 3),
    );
    Ok(sheet.finish("Distributions with higher-order circuits", description))
}

fn series(panel: &Panel, p: f64) -> Drawn {
    panel.curve("all five classes", &over_k(&five(p)), SUM)?;
    for (class, (name, _, colour, dash)) in contributions(p).iter().zip(CLASSES) {
        // On a logarithmic axis each is visible.
        let points = if panel.y.is_log { over_k(class) } else { visible(class, panel.y.hi) };
        panel.curve(name, &points, Stroke::dashed(colour, LINE, dash))?;
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

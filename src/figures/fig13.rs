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

/// Where a class is named: its place in [`CLASSES`], a k, and millimetres to the right and down
/// from its curve there; names at one k stand in a row, at the height of the first.
type Name = (usize, usize, i32, i32);

/// A panel: p, first and last k, step between their numbers, the least P if logarithmic, names.
type Shown = (f64, [f64; 3], Option<f64>, &'static [Name]);

/// The names in (e) and (f).
const E: [Name; 5] = [(0, 6, 1, -2), (1, 3, -3, 0), (2, 4, 0, 2), (3, 5, 0, 2), (4, 2, -1, 1)];
const F: [Name; 5] = [(0, 81, 0, 2), (1, 79, -3, 3), (2, 79, 0, 3), (3, 79, 3, 3), (4, 72, -2, -1)];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(11_200);
    let [small, middle, large] = HIGHER_P;
    let panels: [Shown; 6] = [
        (small, [0.0, 8.0, 2.0], None, &[(0, 2, 2, 0)]),
        (small, [0.0, 12.0, 4.0], None, &[(0, 8, 1, -2), (1, 3, 1, -2)]),
        (middle, [0.0, 20.0, 5.0], None, &[(0, 3, 2, 0)]),
        (large, [65.0, 95.0, 10.0], None, &[(4, 78, -2, 0)]),
        (small, [0.0, 12.0, 4.0], Some(3e-10), &E),
        (large, [65.0, 95.0, 10.0], Some(1e-7), &F),
    ];
    for (i, (p, [first, last, step], least, names)) in panels.into_iter().enumerate() {
        let label = if i % 2 == 0 { "*P*(*X* = *k*)" } else { "" };
        let (classes, most) = (contributions(p), largest(&five(p)));
        let y = match least {
            Some(least) => Axis::decades(-12, 0, 2, label).between(least, 1.5 * most),
            // The detail shows the higher orders: the simple circuits leave it at its upper edge.
            None if i == 1 => Axis::up_to(1.5 * largest(&classes[1..].concat()), label),
            None => Axis::up_to(most, label),
        };
        let (left, top) = (1200 + 4050 * (i as i32 % 2), 480 + 3250 * (i as i32 / 2));
        let frame = Frame::new(left, top, left + 2950, top + 2050);
        let x = Axis::linear(first, last, step, 2, "*k*");
        let panel = sheet.panel(frame, x, y.column("P(X = k)"))?.outside(Outside::Cut);
        panel.heading(LETTERS[i], &format!("*p* = {}", short(p, 3)))?;
        panel.curve("all five classes", &over_k(&five(p)), SUM)?;
        for (class, (name, _, colour, dash)) in classes.iter().zip(CLASSES) {
            panel.curve(name, &over_k(class), Stroke::dashed(colour, LINE, dash))?;
        }
        for &(class, k, right, down) in names {
            let first = names.iter().find(|name| name.1 == k).map_or(class, |name| name.0);
            let (_, symbol, colour, _) = CLASSES[class];
            panel.label(symbol, (k as f64, classes[first][k - 1]), (right, down), colour)?;
        }
    }
    let names = CLASSES.map(|(name, symbol, colour, dash)| {
        (format!("{name}, {symbol}"), colour, Stroke::dashed(colour, LINE, dash))
    });
    let all = ("all five classes".to_string(), GREY, SUM);
    for (i, (name, colour, stroke)) in (0..).zip([all].into_iter().chain(names)) {
        let (left, y) = (1200 + 3500 * (i / 3), 10_250 + 360 * (i % 3));
        sheet.area.draw(&line(vec![(left, y), (left + 500, y)], stroke))?;
        let style = words(SMALL, colour, HPos::Left, VPos::Center);
        sheet.area.draw_text(&name, &style, (left + 600, y))?;
    }

    let share = |p: f64| {
        results.number(&format!("theory.classes[p={p}].simple")).map(|share| short(share, 2))
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

//! Draws Fig. 13: (a) to (d) distributions with higher-order circuits and the parts of the classes;
//! (e) and (f), (a) and (d) on a logarithmic axis, which the paper does not have and where each
//! class is visible and named.

use super::prelude::*;
use crate::experiments::theory::higher::{contributions, five};

/// The sum of all classes: the ground on which the thinner broken lines of the classes are seen.
const SUM: Stroke = Stroke::solid(GREY, 2 * LINE + 8);

/// The five classes in the order of Eq. (38): name, symbol, colour and dash.
const CLASSES: [(&str, &str, RGBColor, Dash); 5] = [
    ("simple circuits", "*ϕ*_{*N*}", GREEN, LONG),
    ("one vertex twice", "*ϕ*_{*N*}^{1}", PURPLE, SHORT),
    ("one vertex three times", "*ϕ*_{*N*}^{1,0}", ORANGE, TWICE),
    ("one vertex four times", "*ϕ*_{*N*}^{1,0,0}", BLUE, DOTTED),
    ("two vertices twice", "*ϕ*_{*N*}^{2}", INK, ALTERNATE),
];

/// The name of the axis of probabilities, and of their column.
const PROBABILITY: &str = "*P*(*X* = *k*)";
const COLUMN: &str = "P(X = k)";

/// What is less than this part of an axis lies on zero, and is not drawn there.
const VISIBLE: f64 = 0.02;

/// Where a class is named: its place in [`CLASSES`], a k, and millimetres to the right and down
/// from its curve there.
type Name = (usize, usize, i32, i32);

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(12_100);
    let [small, middle, large] = HIGHER_P;
    // p, first and last k, step between their numbers, names.
    let panels: [(f64, [f64; 3], &[Name]); 4] = [
        (small, [0.0, 8.0, 2.0], &[(0, 2, 3, -2)]),
        (small, [0.0, 12.0, 4.0], &[(0, 8, 1, -2), (1, 3, 1, -2)]),
        (middle, [0.0, 20.0, 5.0], &[(0, 3, 2, -1), (1, 15, 0, -3)]),
        (large, [65.0, 95.0, 10.0], &[(4, 77, -3, 0)]),
    ];
    let axis_of_k = |[first, last, step]: [f64; 3]| Axis::linear(first, last, step, 2, "*k*");
    for (i, (p, x, names)) in panels.iter().copied().enumerate() {
        let classes = contributions(p);
        // The detail shows the higher orders: the simple circuits leave it at its upper edge.
        let most = if i == 1 { 1.5 * largest(&classes[1..].concat()) } else { largest(&five(p)) };
        let y = Axis::up_to(most, if i % 2 == 0 { PROBABILITY } else { "" }).column(COLUMN);
        let (left, top) = (1200 + 4050 * (i as i32 % 2), 480 + 2700 * (i as i32 / 2));
        let frame = Frame::new(left, top, left + 2950, top + 1700);
        let panel = sheet.panel(frame, axis_of_k(x), y)?.outside(Cut);
        draw_classes(&panel, LETTERS[i], p)?;
        for &(class, k, right, down) in names {
            let (_, symbol, colour, _) = CLASSES[class];
            panel.label(symbol, (k as f64, classes[class][k - 1]), (right, down), colour)?;
        }
        if i == 0 {
            panel.label("all", (1.0, five(p)[0]), (2, 1), GREY)?;
        }
    }
    for (letter, p, x, top) in
        [("(e)", small, panels[1].1, 5880), ("(f)", large, panels[3].1, 8980)]
    {
        let y = Axis::decades(-12, 0, 2, PROBABILITY).between(3e-10, 1.5 * largest(&five(p)));
        let frame = Frame::new(1200, top, 5300, top + 2150);
        let panel = sheet.panel(frame, axis_of_k(x), y.column(COLUMN))?.outside(Cut);
        draw_classes(&panel, letter, p)?;
        let ends = contributions(p).into_iter().zip(CLASSES);
        let ends = ends.map(|(y, look)| (format!("{}, {}", look.0, look.1), over_k(&y), look.2));
        panel.label_ends(&ends.collect::<Vec<_>>())?;
        if p == large {
            // The three names of what nearly coincides there.
            let end = contributions(p)[2][x[1] as usize - 1];
            let (x, y) = panel.area.map_coordinate(&(x[1], end));
            let bracket = [(75, -370), (45, -370), (45, 470), (75, 470)];
            let bracket = bracket.map(|(right, down)| (x + right, y + down)).into();
            sheet.area.draw(&line(bracket, Stroke::solid(GREY, HAIR)))?;
        }
    }

    let share = |p: f64| {
        results.number(&format!("theory.classes[p={p}].simple")).map(|share| short(share, 2))
    };
    let description = describe!(
        "Probability of k different impacts, N = {N}, for five classes of circuits: a thick grey line for the sum, broken ones for the \
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

/// Draws the sum and the classes; those that are not visible are data only.
fn draw_classes(panel: &Panel, letter: &str, p: f64) -> Drawn {
    panel.heading(letter, &format!("*p* = {}", short(p, 3)))?;
    panel.curve("all five classes", &over_k(&five(p)), SUM)?;
    for (class, (name, _, colour, dash)) in contributions(p).iter().zip(CLASSES) {
        if panel.y.is_log || largest(class) > VISIBLE * panel.y.hi {
            panel.curve(name, &over_k(class), Stroke::dashed(colour, LINE, dash))?;
        } else {
            panel.record(name, over_k(class));
        }
    }
    Ok(())
}

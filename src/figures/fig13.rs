//! Draws Fig. 13: (a) to (d) distributions with higher-order circuits and the parts of the classes;
//! (e) and (f), (a) and (d) on a logarithmic axis, which the paper does not have and where each
//! class is visible and named.

use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::theory::higher::{contributions, five};
use crate::params::{HIGHER_P, VERTICES as N};

/// Largest k of (e).
const FEW: f64 = 20.0;

/// Largest k of the detail in (b).
const DETAIL: usize = 12;

/// Name, symbol, colour and dash of a class.
type Class = (&'static str, &'static str, RGBColor, Dash);

/// The sum of all classes: wide and pale, so that the classes are seen on it in grey too.
const SUM: Stroke = Stroke::solid(PALE, 100);

/// The class that is largest in each of (a) to (d).
const SHOWN: [usize; 4] = [0, 1, 0, 4];

/// The five classes in the order of Eq. (38).
const CLASSES: [Class; 5] = [
    ("simple circuits", "*ϕ*_{*N*}", GREEN, Dash::Long),
    ("one vertex twice", "*ϕ*_{*N*}^{1}", PURPLE, Dash::Short),
    ("one vertex three times", "*ϕ*_{*N*}^{1,0}", ORANGE, Dash::Twice),
    ("one vertex four times", "*ϕ*_{*N*}^{1,0,0}", BLUE, Dash::Dotted),
    ("two vertices twice", "*ϕ*_{*N*}^{2}", INK, Dash::Alternate),
];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sheet = Sheet::new(12_900);
    let [small, middle, large] = HIGHER_P;
    let whole = N as f64 + 1.0;
    let k = |end: f64| {
        let (step, minor) = if end < 50.0 { (end / 2.0, 2) } else { (50.0, 5) };
        Axis::linear(0.0, end, step, minor, "*k*")
    };
    let rows = [small, small, middle, large].into_iter().zip([whole, DETAIL as f64, 40.0, whole]);
    for (i, (p, end)) in rows.enumerate() {
        // The detail shows the higher orders: the simple circuits leave it at its upper edge.
        let top =
            if i == 1 { 1.5 * largest(&contributions(p)[1..].concat()) } else { largest(&five(p)) };
        let label = if i % 2 == 0 { "*P*(*X* = *k*)" } else { "" };
        let y = upwards_from_zero(top, label).column("P(X = k)");
        let (left, top) = (1200 + 3900 * (i as i32 % 2), 480 + 2700 * (i as i32 / 2));
        let panel = sheet.panel(Frame::new(left, top, left + 3050, top + 1600), k(end), y)?;
        panel.heading(LETTERS[i], &format!("*p* = {}", short(p, 3)))?;
        series(&panel, p)?;
        let (corner, side) = if i == 3 { (0.0, 1) } else { (panel.x.hi, -1) };
        let (name, _, colour, _) = CLASSES[SHOWN[i]];
        if i == 1 {
            // In two lines above its peak: the other curve is near.
            let peak = (0.0, largest(&contributions(p)[1]));
            for (words, down) in [("one vertex", -4), ("twice", -1)] {
                panel.label(words, peak, (1, down), colour)?;
            }
        } else {
            panel.label("all five classes", (corner, panel.y.hi), (side, 4), GREY)?;
            panel.label(name, (corner, panel.y.hi), (side, 8), colour)?;
        }
    }
    let y = |lowest| Axis::decades(lowest, 0, 2, "*P*(*X* = *k*)");
    let x = Axis::linear(0.0, FEW, 5.0, 5, "*k*");
    let few = sheet.panel(Frame::new(1200, 5850, 4700, 8450), x, y(-12))?;
    few.heading("(e)", &format!("*p* = {}", short(small, 3)))?;
    series(&few, small)?;
    let names = CLASSES.map(|(name, symbol, colour, dash)| {
        (format!("{name}, {symbol}"), colour, Stroke::dashed(colour, LINE, dash))
    });
    let all = ("all five classes".to_string(), GREY, SUM);
    for (place, (name, colour, stroke)) in [all].into_iter().chain(names).enumerate() {
        let y = few.frame.top + 450 + 340 * place as i32;
        let [from, to, text] = [300, 700, 780].map(|right| (few.frame.right + right, y));
        sheet.area.draw(&line(vec![from, to], stroke))?;
        let style = words(SMALL, colour, HPos::Left, VPos::Center);
        sheet.area.draw_text(&name, &style, text)?;
    }

    let x = Axis::linear(50.0, whole, 10.0, 2, "*k*");
    let many = sheet.panel(Frame::new(1200, 9450, 8150, 12_050), x, y(-8))?;
    many.heading("(f)", &format!("*p* = {}", short(large, 3)))?;
    series(&many, large)?;
    let flank = super::simulated::reaches(&over_k(&five(large)), 1e-3);
    many.label("all five classes", flank, (-3, 0), GREY)?;
    for (class, side) in [(0, (0, 3)), (1, (0, 4)), (2, (-1, -1)), (3, (1, -1)), (4, (0, -2))] {
        let values = &contributions(large)[class];
        let top = largest(values);
        let peak = values.iter().position(|value| *value == top).unwrap_or(0) as f64 + 1.0;
        let (name, symbol, colour, _) = CLASSES[class];
        let short = name.trim_start_matches("one vertex ").to_string();
        let text = if matches!(class, 2 | 3) { short } else { format!("{name}, {symbol}") };
        many.label(&text, (peak, top), side, colour)?;
    }
    let share = |p: f64| {
        let share = results.number(&format!("theory.classes[p={p}].simple"));
        share.map(|share| short(share, 2))
    };
    let description = describe!(
        "Probability of k different impacts, N = {N}, for five classes of circuits: a wide grey line for the sum, broken ones for the \
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
    panel.curve("all five classes", &over_k(&five(p)), SUM, Outside::Cut)?;
    for (class, (name, _, colour, dash)) in contributions(p).iter().zip(CLASSES) {
        // On a logarithmic axis each is visible.
        let points = if panel.y.is_log { over_k(class) } else { visible(class, panel.y.hi) };
        panel.curve(name, &points, Stroke::dashed(colour, LINE, dash), Outside::Cut)?;
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

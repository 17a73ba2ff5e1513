//! Fig. 1: the model, a row of forced masses between two walls.

use super::prelude::*;

const LEFT: i32 = 640;
const SPACING: i32 = 1187;
const FLOOR: i32 = 2280;
const HEIGHT: i32 = 1060;
const RADIUS: i32 = 235;

/// The masses as drawn: the place on the sheet in units of the spacing, the name, the place in the row, and how far the
/// mass is bent from its equilibrium.
const MASSES: [(i32, &str, &str, i32); 4] = [
    (1, "1", "*d*", 250),
    (2, "2", "2*d*", -270),
    (4, "*n*−1", "(*n*−1)*d*", 190),
    (5, "*n*", "*nd*", -250),
];

pub fn draw() -> Result<Figure, Error> {
    let sheet = Sheet::new(3280);
    let right = LEFT + 6 * SPACING;
    walls(&sheet, right);
    for (slot, name, _, bend) in MASSES {
        draw_mass(&sheet, LEFT + slot * SPACING, name, bend)?;
    }
    let middle = LEFT + 3 * SPACING + 300;
    for dx in [-170, 0, 170] {
        sheet.free().disc((middle + dx, HEIGHT), 26, INK, Stroke::solid(INK, 4));
    }
    floor_labels(&sheet, right)?;
    distances(&sheet)?;

    let description = describe!(
        "A row of n equal masses on elastic stems, rooted a distance d apart between walls at 0 and (n + 1)d; \
         each is bent away from its equilibrium, the first and the second towards each other. Marked are d, the position x1(t), the closing gap \
         Δ1(t) between the first two masses, and the force F2(t) on the second."
    );
    Ok(sheet.finish("The chain of masses between two walls", description))
}

fn walls(sheet: &Sheet, right: i32) {
    let (top, thick) = (470, 260);
    for (edge, out) in [(LEFT, -1), (right, 1)] {
        let (a, b) = (edge.min(edge + out * thick), edge.max(edge + out * thick));
        sheet.free().rectangle(Frame::new(a, top, b, FLOOR), PALE);
        sheet.free().line(vec![(edge, top), (edge, FLOOR)], Stroke::solid(INK, 40));
    }
    sheet.free().rectangle(Frame::new(LEFT - thick, FLOOR, right + thick, FLOOR + 130), PALE);
    sheet.free().line(vec![(LEFT - thick, FLOOR), (right + thick, FLOOR)], Stroke::solid(INK, 24));
}

fn draw_mass(sheet: &Sheet, root: i32, name: &str, bend: i32) -> Result<(), Error> {
    let rest = Stroke::dashed(GREY, HAIR, Dash::Short);
    sheet.free().line(vec![(root, 740), (root, FLOOR)], rest);
    // A clamped stem with a load at its end: s²(3 − s)/2.
    let stem: Vec<_> = (0..=40)
        .map(|i| {
            let s = f64::from(i) / 40.0;
            let aside = s * s * (3.0 - s) / 2.0 * f64::from(bend);
            (root + aside.round() as i32, FLOOR - (s * f64::from(FLOOR - HEIGHT)).round() as i32)
        })
        .collect();
    sheet.free().line(stem, Stroke::solid(INK, 50));
    let centre = (root + bend, HEIGHT);
    sheet.free().disc(centre, RADIUS, WHITE, Stroke::solid(INK, 36));
    // A long name must stay inside its disc: 6.6 points.
    let size = if name.len() > 3 { 233 } else { SMALL };
    sheet.text(name, centre, (size, INK, HPos::Center, VPos::Center))
}

fn floor_labels(sheet: &Sheet, right: i32) -> Result<(), Error> {
    let y = FLOOR + 240;
    let places = MASSES.map(|(slot, _, place, _)| (LEFT + slot * SPACING, place));
    for (x, place) in [(LEFT, "0"), (right, "(*n*+1)*d*")].into_iter().chain(places) {
        sheet.free().line(vec![(x, FLOOR), (x, FLOOR + 130)], Stroke::solid(INK, HAIR));
        sheet.text(place, (x, y), (TEXT, INK, HPos::Center, VPos::Top))?;
    }
    Ok(())
}

fn double_arrow(sheet: &Sheet, a: (i32, i32), b: (i32, i32)) {
    sheet.free().arrow(vec![a, b], Stroke::solid(INK, HAIR));
    sheet.free().arrow(vec![b, a], Stroke::solid(INK, HAIR));
}

fn distances(sheet: &Sheet) -> Result<(), Error> {
    let (one, two) = (LEFT + SPACING, LEFT + 2 * SPACING);
    let (x1, x2) = (one + MASSES[0].3, two + MASSES[1].3);
    let label = |text, at, v| sheet.text(text, at, (TEXT, INK, HPos::Center, v));
    // The spacing, between the equilibria 1 and 2.
    let y = FLOOR + 760;
    double_arrow(sheet, (one, y), (two, y));
    label("*d*", ((one + two) / 2, y - 60), VPos::Bottom)?;
    for x in [one, two] {
        sheet.free().line(vec![(x, y - 90), (x, y + 90)], Stroke::solid(INK, HAIR));
    }
    // The position of mass 1 and the gap between the masses 1 and 2, one behind the other.
    let y = HEIGHT - 430;
    for x in [x1, x2] {
        sheet.free().line(vec![(x, y - 90), (x, HEIGHT - RADIUS)], Stroke::solid(INK, HAIR));
    }
    double_arrow(sheet, (LEFT + 20, y), (x1, y));
    label("*x*_{1}(*t*)", ((LEFT + x1) / 2, y - 140), VPos::Bottom)?;
    double_arrow(sheet, (x1, y), (x2, y));
    label("Δ_{1}(*t*)", ((x1 + x2) / 2, y - 140), VPos::Bottom)?;
    // The force on mass 2.
    let start = x2 + RADIUS + 25;
    sheet.free().arrow(vec![(start + 480, HEIGHT), (start, HEIGHT)], Stroke::solid(BLUE, 40));
    let at = (start + 330, HEIGHT - 150);
    sheet.text("*F*_{2}(*t*)", at, (TEXT, BLUE, HPos::Center, VPos::Bottom))
}

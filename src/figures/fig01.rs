//! Draws Fig. 1: the model, a row of forced masses between two walls.

use super::prelude::*;

const LEFT: i32 = 640;
const SPACING: i32 = 1187;
const FLOOR: i32 = 2280;
const HEIGHT: i32 = 1060;
const RADIUS: i32 = 130;

/// The masses as drawn: the place on the sheet in units of the spacing, the name, the place in the
/// row, and how far the mass is displaced from its equilibrium.
const MASSES: [(i32, &str, &str, i32); 4] = [
    (1, "1", "*d*", 190),
    (2, "2", "2*d*", -220),
    (4, "*n*−1", "(*n*−1)*d*", 160),
    (5, "*n*", "*nd*", -200),
];

pub fn draw() -> Result<Figure, Error> {
    let sheet = Sheet::new(3280);
    let right = LEFT + 6 * SPACING;
    walls(&sheet.area, right)?;
    for (slot, name, _, bend) in MASSES {
        draw_mass(&sheet.area, LEFT + slot * SPACING, name, bend)?;
    }
    let middle = LEFT + 3 * SPACING + 260;
    for dx in [-170, 0, 170] {
        let dot = (Symbol::Disc, 26, Stroke::solid(INK, 4));
        sheet.area.draw(&markers(vec![(middle + dx, HEIGHT)], dot))?;
    }
    let places = MASSES.map(|(slot, _, place, _)| (LEFT + slot * SPACING, place));
    for (x, place) in [(LEFT, "0"), (right, "(*n*+1)*d*")].into_iter().chain(places) {
        draw_line(&sheet.area, [(x, FLOOR), (x, FLOOR + 130)], HAIR)?;
        let style = words(TEXT, INK, HPos::Center, VPos::Top);
        sheet.area.draw_text(place, &style, (x, FLOOR + 240))?;
    }
    distances(&sheet.area)?;

    let description = describe!(
        "A row of n equal masses on elastic stems, rooted a distance d apart between walls at 0 and (n + 1)d; \
         each is bent away from its equilibrium, the first and the second towards each other. Marked are d, the position x1(t), the closing gap \
         Δ1(t) between the first two masses, and the force F2(t) on the second."
    );
    Ok(sheet.finish("The chain of masses between two walls", description))
}

fn walls(sheet: &SheetArea, right: i32) -> Drawn {
    let (top, thick) = (470, 260);
    for (edge, out) in [(LEFT, -1), (right, 1)] {
        sheet.draw(&Rectangle::new([(edge, top), (edge + out * thick, FLOOR)], PALE.filled()))?;
        draw_line(sheet, [(edge, top), (edge, FLOOR)], 40)?;
    }
    let (left, right) = (LEFT - thick, right + thick);
    sheet.draw(&Rectangle::new([(left, FLOOR), (right, FLOOR + 130)], PALE.filled()))?;
    draw_line(sheet, [(left, FLOOR), (right, FLOOR)], 24)
}

fn draw_line<const N: usize>(sheet: &SheetArea, points: [(i32, i32); N], width: u32) -> Drawn {
    Ok(sheet.draw(&PathElement::new(points, INK.stroke_width(width)))?)
}

fn draw_mass(sheet: &SheetArea, root: i32, name: &str, bend: i32) -> Drawn {
    sheet.draw(&line(vec![(root, 900), (root, FLOOR)], Stroke::dashed(GREY, HAIR, SHORT)))?;
    // A clamped stem with a load at its end: s²(3 − s)/2.
    let stem: [(i32, i32); 41] = std::array::from_fn(|i| {
        let s = i as f64 / 40.0;
        let aside = s * s * (3.0 - s) / 2.0 * f64::from(bend);
        (root + aside.round() as i32, FLOOR - (s * f64::from(FLOOR - HEIGHT)).round() as i32)
    });
    draw_line(sheet, stem, 50)?;
    let centre = (root + bend, HEIGHT);
    sheet.draw(&markers(vec![centre], (Symbol::Disc, RADIUS, Stroke::solid(INK, 36))))?;
    let style = words(TEXT, INK, HPos::Center, VPos::Bottom);
    Ok(sheet.draw_text(name, &style, (centre.0, HEIGHT - RADIUS - 70))?)
}

fn double_arrow(sheet: &SheetArea, a: (i32, i32), b: (i32, i32)) -> Drawn {
    sheet.draw(&arrow(vec![a, b], Stroke::solid(INK, HAIR)))?;
    Ok(sheet.draw(&arrow(vec![b, a], Stroke::solid(INK, HAIR)))?)
}

fn distances(sheet: &SheetArea) -> Drawn {
    let (one, two) = (LEFT + SPACING, LEFT + 2 * SPACING);
    let (x1, x2) = (one + MASSES[0].3, two + MASSES[1].3);
    let style = words(TEXT, INK, HPos::Center, VPos::Bottom);
    // The spacing, between the equilibria 1 and 2.
    let y = FLOOR + 760;
    double_arrow(sheet, (one, y), (two, y))?;
    sheet.draw_text("*d*", &style, ((one + two) / 2, y - 60))?;
    for x in [one, two] {
        draw_line(sheet, [(x, y - 90), (x, y + 90)], HAIR)?;
    }
    // The position of mass 1 and the gap between the masses 1 and 2, one behind the other.
    let y = HEIGHT - 580;
    for x in [x1, x2] {
        draw_line(sheet, [(x, y - 90), (x, y + 90)], HAIR)?;
    }
    double_arrow(sheet, (LEFT + 20, y), (x1, y))?;
    sheet.draw_text("*x*_{1}(*t*)", &style, ((LEFT + x1) / 2, y - 110))?;
    double_arrow(sheet, (x1, y), (x2, y))?;
    sheet.draw_text("Δ_{1}(*t*)", &style, ((x1 + x2) / 2, y - 110))?;
    // The force on mass 2.
    let start = x2 + RADIUS + 25;
    sheet.draw(&arrow(vec![(start + 480, HEIGHT), (start, HEIGHT)], Stroke::solid(BLUE, 40)))?;
    let style = words(TEXT, BLUE, HPos::Center, VPos::Bottom);
    Ok(sheet.draw_text("*F*_{2}(*t*)", &style, (start + 330, HEIGHT - 150))?)
}

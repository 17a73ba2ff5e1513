//! Fig. S7: the five classes of Sec. 9 among circuits of all orders.

use super::prelude::*;
use crate::experiments::theory::Theory;

/// Looks of the numbers of different vertices in (a), from few to many.
const LOOKS: [Dash; 5] = [Dash::Long, Dash::Short, Dash::Alternate, Dash::Twice, Dash::Dotted];

/// Upper end of the shares' axes: above one, so that curves stay clear of what stands there.
const TOP: f64 = 1.1;

pub fn draw(theory: &Theory) -> Result<Figure, Error> {
    let sheet = Sheet::new(7700);
    let orders = &theory.orders;
    let x = Axis::decades(-3, -1, 1, "*p*");
    let share = Axis::linear(0.0, TOP, 0.2, 2, "share of the five classes");
    let whole = sheet.lettered(LETTERS[0], Frame::new(1150, 480, 6250, 3380), x, share)?;
    let mut entries = Vec::new();
    for (own, dash) in orders.shares.iter().zip(LOOKS) {
        let points: Vec<_> = own.rows.iter().map(|row| (row.x, row.y)).collect();
        let stroke = Stroke::dashed(INK, LINE, dash);
        whole.curve(&format!("K = {}", own.k), &points, stroke, Outside::Cut)?;
        entries.push(Entry::line(stroke, &format!("*K* = {}", own.k)));
    }
    let points: Vec<_> = orders.whole.iter().map(|row| (row.x, row.y)).collect();
    let all = Stroke::solid(RED, LINE);
    whole.curve("all circuits", &points, all, Outside::Refuse)?;
    entries.push(Entry::line(all, "all circuits"));
    guide(&whole, orders.pole, "1/*N*", HPos::Right)?;
    guide(&whole, theory.scalars.p_jump, "*p*_{jump}", HPos::Left)?;
    sheet.legend((6480, 1000), (SMALL, 400), &entries)?;
    distributions(&sheet, theory)?;
    Ok(sheet.finish("s07", "Circuits of all orders", description(theory)))
}

/// An upright line at a place of p, with its name above.
fn guide(panel: &Panel, p: f64, name: &str, side: HPos) -> Result<(), Error> {
    let stroke = Stroke::dashed(GREY, THIN, Dash::Dotted);
    panel.guide(name, &[(p, 0.0), (p, TOP)], stroke)?;
    let dx = if matches!(side, HPos::Left) { 20 } else { -20 };
    panel.note(name, (p, TOP), (dx, -80), (TINY, INK, side, VPos::Bottom))
}

fn distributions(sheet: &Sheet, theory: &Theory) -> Result<(), Error> {
    let orders = &theory.orders;
    let n = theory.vertices as f64;
    let x = Axis::linear(0.0, n + 1.0, 20.0, 2, "*k*");
    let y = Axis::decades(-4, 0, 1, "*P*(*X* = *k*)");
    let panel = sheet.lettered(LETTERS[1], Frame::new(1150, 4680, 8150, 6580), x, y)?;
    let look = |mark, colour| (mark, 42, Stroke::solid(colour, THIN));
    let series = [
        ("simple circuits", &orders.simple_at_jump, look(Mark::Ring, GREEN)),
        ("all circuits", &orders.at_jump, look(Mark::Disc, RED)),
    ];
    for (name, values, look) in series {
        panel.marks(name, &over_k(values), look, Outside::Cut)?;
    }
    let entry = |i: usize, p: f64| {
        let (name, _, look) = series[i];
        Entry::mark(look, &format!("{name} at *p* = {}", short(p, 4)))
    };
    sheet.legend((700, 7550), (SMALL, 400), &[entry(0, theory.scalars.p_jump)])?;
    sheet.legend((4400, 7550), (SMALL, 400), &[entry(1, orders.jump.p)])
}

fn description(theory: &Theory) -> String {
    format!(
        "(a) Share of the five classes among all circuits, and among those with K vertices, against p, N = {}: it falls from one to \
         zero at p = 1/K. (b) P(X = k) at the jump: two humps with simple circuits, with all circuits a trough.",
        theory.vertices,
    )
}

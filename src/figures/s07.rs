//! Fig. S7: the five classes of Sec. 9 among circuits of all orders.

use plotters::style::text_anchor::{HPos, VPos};

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::data::cells;
use super::fig13::{CLASS_COLUMNS, CLASSES};
use super::panel::{Frame, Panel};
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{Dash, GREEN, GREY, INK, LINE, Mark, RED, SMALL, Stroke, THIN, TINY};
use super::{DataFile, Error, Figure};
use crate::experiments::theory::{AllOrders, Theory};

/// Looks of the numbers of different vertices in (b), from few to many.
const LOOKS: [Dash; 5] = [Dash::Long, Dash::Short, Dash::Alternate, Dash::Twice, Dash::Dotted];

/// Upper end of the shares' axes: above one, so that curves stay clear of what stands there.
const TOP: f64 = 1.1;

/// Draws the figure.
pub fn draw(theory: &Theory) -> Result<Figure, Error> {
    let sheet = Sheet::new(11_900, None)?;
    let orders = &theory.orders;
    let x = || Axis::decades(-3, -1, 1, "*p*");
    let share = || Axis::linear(0.0, TOP, 0.2, 2, "share");
    let classes = sheet.panel(Frame::new(1150, 480, 4250, 3380), x(), share())?;
    classes.letter(LETTERS[0])?;
    let mut entries = Vec::new();
    for (i, &(name, symbol, colour, dash)) in CLASSES.iter().enumerate() {
        let at = |shares: &Vec<f64>| shares.get(i).copied().unwrap_or(0.0);
        let points: Vec<_> = orders.classes.iter().map(|c| (log(c.p), at(&c.shares))).collect();
        let stroke = Stroke::dashed(colour, LINE, dash);
        classes.curve(name, &points, stroke, Outside::Refuse)?;
        entries.push(Entry::line(stroke, &format!("{name}, {symbol}")));
    }
    sheet.legend((4480, 1000), (SMALL, 400), &entries)?;

    let whole = sheet.panel(Frame::new(1150, 4680, 4250, 7580), x(), share())?;
    whole.letter(LETTERS[1])?;
    let mut entries = Vec::new();
    for (own, dash) in orders.shares.iter().zip(LOOKS) {
        let points: Vec<_> = own.rows.iter().map(|row| (log(row.x), row.y)).collect();
        // Colours are the classes of (a).
        let stroke = Stroke::dashed(INK, LINE, dash);
        whole.curve(&format!("K = {}", own.k), &points, stroke, Outside::Cut)?;
        entries.push(Entry::line(stroke, &format!("of *K* = {} vertices", own.k)));
    }
    let points: Vec<_> = orders.whole.iter().map(|row| (log(row.x), row.y)).collect();
    let all = Stroke::solid(RED, LINE);
    whole.curve("all circuits", &points, all, Outside::Refuse)?;
    entries.push(Entry::line(all, "of all circuits"));
    for panel in [&classes, &whole] {
        guide(panel, orders.pole, "1/*N*", HPos::Right)?;
        guide(panel, theory.scalars.p_jump, "*p*_{jump}", HPos::Left)?;
    }
    sheet.legend((4480, 5200), (SMALL, 400), &entries)?;
    distributions(&sheet, theory)?;
    let files = tables(orders);
    Ok(sheet.finish("s07", "Circuits of all orders", description(theory), files))
}

/// An upright line at a place of p, with its name above.
fn guide(panel: &Panel, p: f64, name: &str, side: HPos) -> Result<(), Error> {
    let stroke = Stroke::dashed(GREY, THIN, Dash::Dotted);
    panel.curve(name, &[(log(p), 0.0), (log(p), TOP)], stroke, Outside::Refuse)?;
    let dx = if matches!(side, HPos::Left) { 20 } else { -20 };
    panel.note(name, (log(p), TOP), (dx, -80), (TINY, INK, side, VPos::Bottom))
}

fn distributions(sheet: &Sheet, theory: &Theory) -> Result<(), Error> {
    let orders = &theory.orders;
    let n = theory.vertices as f64;
    let panel = sheet.panel(
        Frame::new(1150, 8880, 8150, 10_780),
        Axis::linear(0.0, n + 1.0, 20.0, 2, "*k*"),
        Axis::decades(-4, 0, 1, "*P*(*X* = *k*)"),
    )?;
    panel.letter(LETTERS[2])?;
    let look = |mark, colour| (mark, 42, Stroke::solid(colour, THIN));
    let series = [
        ("simple circuits", &orders.simple_at_jump, look(Mark::Ring, GREEN)),
        ("all circuits", &orders.at_jump, look(Mark::Disc, RED)),
    ];
    for (name, values, look) in series {
        let points: Vec<_> = (1..)
            .zip(values)
            .filter(|(_, p)| **p > 0.0)
            .map(|(k, p)| (f64::from(k), log(*p)))
            .collect();
        panel.marks(name, &points, look, Outside::Cut)?;
    }
    let entry = |i: usize, p: f64| {
        let (name, _, (mark, half, stroke)) = series[i];
        Entry::mark(mark, half, stroke, &format!("{name} at *p* = {}", short(p, 4)))
    };
    sheet.legend((700, 11_750), (SMALL, 400), &[entry(0, theory.scalars.p_jump)])?;
    sheet.legend((4400, 11_750), (SMALL, 400), &[entry(1, orders.jump.p)])
}

fn description(theory: &Theory) -> String {
    format!(
        "(a) Shares of the five classes against p, N = {}: simple circuits give way to those with two vertices twice. (b) Share of \
         the five classes among all circuits with K vertices, falling from one to zero at p = 1/K. (c) P(X = k) at the jump: \
         two humps with simple circuits, with all circuits a trough.",
        theory.vertices,
    )
}

fn tables(orders: &AllOrders) -> Vec<DataFile> {
    let header: Vec<&str> = ["p (1)"].into_iter().chain(CLASS_COLUMNS).collect();
    let mut classes = DataFile::new("s07a.csv", &header);
    for row in &orders.classes {
        let share = |i: usize| row.shares.get(i).copied();
        classes.row(cells![row.p, share(0), share(1), share(2), share(3), share(4)]);
    }
    let mut shares = DataFile::new("s07b.csv", &["K (1)", "p (1)", "share_of_five_classes (1)"]);
    for own in &orders.shares {
        for row in &own.rows {
            shares.row(cells![own.k, row.x, row.y]);
        }
    }
    let mut whole = DataFile::new("s07b-all.csv", &["p (1)", "share_of_five_classes (1)"]);
    for row in &orders.whole {
        whole.row(cells![row.x, row.y]);
    }
    let columns: [(&str, &[f64]); 2] = [
        ("probability_simple (1)", &orders.simple_at_jump),
        ("probability_all (1)", &orders.at_jump),
    ];
    let jump = DataFile::over_k("s07c.csv", None, &columns);
    vec![classes, shares, whole, jump]
}

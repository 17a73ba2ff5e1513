//! Fig. S6: the rise at several restitutions.

use super::FORCING;
use super::prelude::*;
use super::simulated::count_axis;
use crate::experiments::rise::Counted;
use crate::experiments::{RESTITUTION, Results};
use literate::table::Table;

/// Restitutions of (a), and their looks.
const RISES: [(f64, Mark, Colour); 5] = [
    (0.0, Mark::Disc, RED),
    (0.4, Mark::OpenSquare, ORANGE),
    (0.6, Mark::OpenTriangle, PURPLE),
    (0.8, Mark::Ring, GREEN),
    (0.95, Mark::Disc, BLUE),
];

/// What is drawn.
struct Shown<'a> {
    found: &'a [Counted],
    rise: &'a Table,
    curves: &'a Table,
}

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let shown = Shown {
        found: results.of(&RESTITUTION)?,
        rise: table("restitution.rise")?,
        curves: table("restitution.curves")?,
    };
    let sheet = Sheet::new(8150);
    rises(&sheet, &shown)?;
    places(&sheet, &shown)?;
    let title = "The rise at several restitutions";
    Ok(sheet.finish("s06", title, description(&shown)))
}

fn named(r: f64) -> String {
    format!("*r* = {r}")
}

fn rises(sheet: &Sheet, shown: &Shown<'_>) -> Result<(), Error> {
    let gaps = shown.found[0].ensemble.chain.gaps() as f64;
    let last = shown.found[0].ensemble.sigmas.iter().copied().fold(0.0, f64::max);
    let x = Axis::linear(0.05, last + 0.02, 0.1, 5, FORCING);
    let y = count_axis(shown.found[0].ensemble.chain.gaps(), "mean count");
    let panel = sheet.lettered("(a)", Frame::new(1150, 430, 8150, 3230), x, y)?;
    let half = Stroke::dashed(INK, THIN, Dash::Short);
    let level = [(0.05, 0.5 * gaps), (last + 0.02, 0.5 * gaps)];
    panel.guide("half of all gaps", &level, half)?;
    let mut entries = Vec::new();
    for (r, mark, colour) in RISES {
        let points = shown.rise.estimates(&[("r", r)], "sigma", "mean_count");
        if points.is_empty() {
            continue;
        }
        let look = (mark, MEDIUM, Stroke::solid(colour, THIN));
        panel.joined(&named(r), &points, look)?;
        entries.push(Entry::mark(look, &named(r)));
    }
    sheet.legend_in_columns((5000, 2150), (SMALL, 340), (3, 1500), &entries)
}

fn places(sheet: &Sheet, shown: &Shown<'_>) -> Result<(), Error> {
    let x = Axis::linear(0.0, 1.0, 0.2, 2, "restitution *r*");
    let y =
        Axis::linear(0.0, 0.35, 0.1, 4, "*σ*_{1/2} (*d ω*^{2})").column("half_height (d omega^2)");
    let panel = sheet.lettered("(b)", Frame::new(1150, 4700, 8150, 7200), x, y)?;
    let points = shown.curves.estimates(&[], "r", "half_height");
    panel.joined("half height", &points, (Mark::Disc, MEDIUM, Stroke::solid(RED, THIN)))
}

fn description(shown: &Shown<'_>) -> Seen {
    let halves = shown.curves.points(&[], "r", "half_height");
    let end = |at: Option<&(f64, f64)>| {
        at.map_or("none".into(), |(r, own)| format!("{} at r = {r}", short(*own, 3)))
    };
    seen!(
        "(a) Mean count of all chains against σ, a curve for each restitution r: the smaller r, the later it rises. (b) Half \
         height against r, from {} to {}.",
        end(halves.first()),
        end(halves.last()),
    )
}

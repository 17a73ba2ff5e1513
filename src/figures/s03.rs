//! Draws Fig. S3: how impacts spread from one gap, and the mean count that follows.

use super::prelude::*;
use super::simulated::{FORCING, count_axis};
use crate::experiments::Results;
use crate::experiments::ensembles::Counted;
use crate::experiments::sweep;
use crate::experiments::theory::comparison::interpolate;
use crate::params::printed_threshold;
use literate::table::Table;

/// The σ of (a).
const SIGMAS: (f64, f64) = (0.075, 0.165);

/// Nucleation and growth, which is computed at some places only.
const GROWN: (&str, Marker) = ("from seeds", (Symbol::OpenSquare, 44, Stroke::solid(INK, HAIR)));

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let sheet = Sheet::new(8600);
    counts(&sheet, table("seeds.means")?, table("theory.curve")?, sweep::main(results)?)?;
    let advance = table("seeds.advance")?;
    advances(&sheet, advance)?;
    halves(&sheet, table("seeds.rise")?, table("seeds.scores")?)?;
    let sigmas = advance.distinct("sigma")?;
    let [low, high] = [sigmas.first(), sigmas.last()].map(|end| end.copied().unwrap_or_default());
    let description = describe!(
        "(a) Mean count of all against σ: simulated points along the prediction from seeds; circuits steeper. (b) Advance \
         against time at σ from {low} to {high}: slower than ∝ t, the more so the smaller σ. (c) Half height falls with T.",
    );
    Ok(sheet.finish("From one gap to many: nucleation and growth", description))
}

fn counts(sheet: &Sheet, means: &Table, theory: &Table, sweep: &Counted) -> Drawn {
    let x = Axis::linear(SIGMAS.0, SIGMAS.1, 0.01, 2, FORCING);
    let y = count_axis(sweep.ensemble.chain.gaps(), "mean number of gaps");
    let panel = sheet.lettered("(a)", Frame::new(1150, 430, 8150, 3730), x, y)?;
    let transient = [("transient", sweep.first().protocol.transient)];
    let lines = [
        ("circuits, Eq. (25)", "simple", Stroke::dashed(BLUE, LINE, SHORT), 50.0),
        ("circuits, from rest", "rest", Stroke::dashed(PURPLE, LINE, LONG), 62.0),
    ];
    for (name, column, stroke, height) in lines {
        let mut curve = theory.curve(&[], "sigma", column)?;
        curve.retain(|(sigma, _)| *sigma >= SIGMAS.0 && *sigma <= SIGMAS.1);
        panel.curve(name, &curve, stroke)?;
        let rising: Vec<_> = curve.into_iter().map(|(sigma, mean)| (mean, sigma)).collect();
        let place = (interpolate(&rising, height).unwrap_or(SIGMAS.0), height);
        panel.label(name, place, (-2, 0), stroke.colour)?;
    }
    let grown = means.series(&transient, "sigma", "grown")?;
    panel.joined_estimates(GROWN.0, &grown, GROWN.1)?;
    if let Some((sigma, mean)) = grown.iter().find(|(_, mean)| mean.value > 85.0) {
        panel.label(GROWN.0, (*sigma, mean.value), (-1, -1), INK)?;
    }
    let inside =
        sweep.first().rows.iter().filter(|row| row.sigma > SIGMAS.0 && row.sigma < SIGMAS.1);
    let bars: Vec<_> = inside
        .filter_map(|row| Some((row.sigma, row.mean_all?.value, row.mean_all?.interval?)))
        .collect();
    let look = (Symbol::Disc, 42, Stroke::solid(RED, THIN));
    let ends: Vec<_> = bars.iter().map(|(x, _, [low, high])| (*x, *low, *high)).collect();
    panel.bars("simulation", &ends, 35, look.2)?;
    let points: Vec<_> = bars.iter().map(|(x, y, _)| (*x, *y)).collect();
    panel.markers("simulation", &points, look)?;
    let low = points.iter().copied().rfind(|(_, mean)| *mean < 40.0);
    let Some((sigma, mean)) = low else { return Ok(()) };
    let leader = [(sigma + 0.001, mean - 3.0), (sigma + 0.004, mean - 10.0)];
    panel.guide("leader", &leader, Stroke::solid(RED, HAIR))?;
    panel.label("simulation", leader[1], (1, 1), RED)
}

fn advances(sheet: &Sheet, advance: &Table) -> Drawn {
    let x = Axis::decades(1, 4, 1, "time since first impact (1/*ω*)").between(20.0, 7000.0);
    let y = Axis::decades(-1, 2, 1, "advance (gaps)").between(0.3, 80.0);
    let panel =
        sheet.lettered("(b)", Frame::new(1150, 5250, 3850, 7650), x, y)?.outside(Outside::Cut);
    let sigmas = advance.distinct("sigma")?;
    let three = [sigmas.first().copied(), Some(printed_threshold()), sigmas.last().copied()];
    let mut drawn = Vec::new();
    for (place, sigma) in three.into_iter().flatten().enumerate() {
        let points = advance.curve(&[("sigma", sigma)], "time", "advance")?;
        let (name, colour) = (format!("*σ* = {sigma}"), ordered(place, 3));
        panel.curve(&name, &points, Stroke::solid(colour, LINE))?;
        drawn.push((name, points, colour));
    }
    panel.label_ends(&drawn)?;
    let straight = Stroke::dashed(INK, THIN, SHORT);
    panel.guide("constant speed", &[(10.0, 1.0), (1e3, 100.0)], straight)?;
    panel.label("∝ *t*", (200.0, 20.0), (-1, -1), INK)
}

fn halves(sheet: &Sheet, rise: &Table, scores: &Table) -> Drawn {
    let x = Axis::decades(1, 4, 1, "transient *T* (1/*ω*)").between(20.0, 2000.0);
    let y = Axis::linear(0.1, 0.14, 0.01, 2, "half height (*d ω*^{2})")
        .column("half_height (d omega^2)");
    let panel =
        sheet.lettered("(c)", Frame::new(5600, 5250, 8150, 7650), x, y)?.outside(Outside::Edge);
    let grown = rise.curve(&[], "transient", "half_height")?;
    panel.marked_curve(GROWN.0, &grown, GROWN.1.2, GROWN.1)?;
    let look = (Symbol::Disc, LARGE, Stroke::solid(RED, THIN));
    let found = scores.series(&[], "transient", "half_height")?;
    panel.estimates("simulation", &found, look)?;
    panel.label("simulation", (150.0, 0.1355), (1, 0), RED)?;
    panel.label("from seeds", (300.0, 0.109), (-1, 0), INK)
}

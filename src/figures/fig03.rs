//! Draws Fig. 3: the expected number of impacts (of different gaps) against σ, simulated, and how
//! many runs it rests on.

use super::prelude::*;
use super::simulated::*;
use crate::experiments::theory::comparison;
use crate::experiments::{Results, sweep};

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let sweep = sweep::main(results)?;
    let half_height = results.number("sweep.rise.half_height").ok();
    let sheet = Sheet::new(7550);
    let n = sweep.ensemble.chain.gaps();
    let (x, y) = (sigma_axis().without_numbers(), count_axis(n, "expected number of impacts"));
    let panel = sheet.lettered("(a)", MAIN, x, y)?.outside(Outside::Cut);
    let rows = results.table("sweep.rows")?;
    let swept = |column| rows.curve(&[], "sigma", column);
    let (all, means) = (swept("mean_all")?, means(results)?);
    let intervals = sweep
        .comparable()
        .filter_map(|row| row.mean?.interval.map(|[low, high]| (row.sigma, low, high)));
    let intervals: Vec<_> = intervals.collect();
    panel.bars("mean of those with an impact", &intervals, 0, INTERVAL)?;
    printed(&panel, comparison::interpolate(&means, printed_threshold()).unwrap_or(0.0))?;
    panel.curve("mean of all", &all, Stroke::dashed(GREY, LINE, SHORT))?;
    panel.markers("mean of those with an impact", &means, CROSSES)?;
    panel.label("mean of those with an impact", (panel.x.hi, n as f64), (-1, 3), RED)?;
    panel.label("mean of all", reaches(&all, 7.0), (3, 0), GREY)?;
    if let Some(half) = half_height {
        let level = n as f64 / 2.0;
        let guide = Stroke::dashed(GREY, HAIR, DOTTED);
        panel.guide("half height", &[(panel.x.lo, level), (half, level)], guide)?;
        let text = format!("half of {n} at {}", short(half, 4));
        panel.label(&text, (panel.x.lo, level), (2, -1), INK)?;
    }

    let (x, y) = (sigma_axis(), Axis::linear(0.0, 1.0, 0.5, 5, "share"));
    let share = sheet.lettered("(b)", Frame::new(1200, 5200, 8150, 6650), x, y)?;
    let share = share.outside(Outside::Cut);
    let fraction = swept("kept")?;
    let dot = (Symbol::Disc, 38, Stroke::solid(RED, HAIR));
    share.marked_curve("share with an impact", &fraction, Stroke::solid(RED, THIN), dot)?;
    let at = reaches(&fraction, 0.5);
    share.label("share of the realisations with an impact", at, (5, 0), RED)?;

    let description = describe!(
        "(a) Mean number of different gaps that impact against σ, simulated with {} masses: of the realisations with an impact \
         (crosses, grey 95 % intervals) it {}; of all realisations (broken line) it starts near zero. (b) The share with an \
         impact rises from {} to {}.",
        sweep.ensemble.chain.masses,
        half_height
            .map_or("rises".into(), |half| format!("passes half of {n} at σ = {}", short(half, 4))),
        fraction.first().map_or("0".into(), |f| short(f.1, 2)),
        fraction.last().map_or("1".into(), |f| short(f.1, 3)),
    );
    Ok(sheet.finish("Expected number of impacts", description))
}

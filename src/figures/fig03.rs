//! Draws Fig. 3: the expected number of impacts (of different gaps) against σ, simulated, and how
//! many runs it rests on.

use super::prelude::*;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let half_height = results.number("sweep.rise.half_height").ok();
    let sheet = Sheet::new(7550);
    let n = results.number("sweep.run.gaps")? as usize;
    let (x, y) = (sigma_axis().without_numbers(), gaps_axis(n, 20.0));
    let panel = sheet.lettered("(a)", MAIN, x, y)?.outside(Cut);
    let rows = results.table("sweep.rows")?;
    let swept = |column| rows.curve(&[], "sigma", column);
    let (all, means) = (swept("mean_all")?, simulated_points(results)?);
    draw_printed_threshold(&panel, interpolate(&means, printed_threshold()).unwrap_or(0.0))?;
    panel.curve(Look::ALL.name, &all, Look::ALL.line)?;
    panel.estimates(Look::ACTIVE.name, &simulated(results)?, Look::ACTIVE.mark)?;
    panel.label(Look::ACTIVE.name, (panel.x.hi, n as f64), (-1, 3), RED)?;
    panel.label(Look::ALL.name, first_point_above(&all, 7.0), (3, 0), RED)?;
    if let Some(half) = half_height {
        let level = n as f64 / 2.0;
        let guide = Stroke::dashed(GREY, HAIR, DOTTED);
        panel.guide("half height", &[(panel.x.lo, level), (half, level)], guide)?;
        let half_label = format!("half of {n} at {}", short(half, 4));
        panel.label(&half_label, (panel.x.lo, level), (2, -1), INK)?;
    }

    let (x, y) = (sigma_axis(), Axis::linear(0.0, 1.0, 0.5, 5, "share of chains"));
    let share = sheet.lettered("(b)", Frame::new(1200, 5200, 8150, 6650), x, y)?.outside(Cut);
    let fraction = swept("kept")?;
    share.marked_curve(Look::SHARE.name, &fraction, Look::SHARE.mark.2, Look::SHARE.mark)?;
    share.label(Look::SHARE.name, first_point_above(&fraction, 0.5), (5, 0), RED)?;

    let description = describe!(
        "(a) Mean number of different gaps that impact against σ, simulated with {} masses: of the realisations with an impact \
         (crosses, standard errors) it {}; of all realisations (broken line) it starts near zero. (b) The share with an \
         impact rises from {} to {}.",
        n - 1,
        half_height
            .map_or("rises".into(), |half| format!("passes half of {n} at σ = {}", short(half, 4))),
        fraction.first().map_or("0".into(), |f| short(f.1, 2)),
        fraction.last().map_or("1".into(), |f| short(f.1, 3)),
    );
    Ok(sheet.finish("Expected number of impacts", description))
}

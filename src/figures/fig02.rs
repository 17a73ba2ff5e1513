//! Fig. 2: the most likely number of impacts against σ, simulated.

use super::prelude::*;
use super::simulated::*;
use crate::experiments::rise::Counted;

pub fn draw(sweep: &Counted) -> Result<Figure, Error> {
    let sheet = Sheet::new(HEIGHTS.0 - 380);
    let n = sweep.ensemble.chain.gaps();
    let (x, y) = (sigma_axis(last_sigma(sweep)), count_axis(n, "most likely number of impacts"));
    let panel = sheet.panel(MAIN, x, y)?;
    let bar = Stroke::solid(GREY, THIN);
    let bars: Vec<_> = sweep
        .comparable()
        .filter_map(|row| {
            let [low, high] = row.mode_interval?;
            (low < high).then_some((row.sigma, low as f64, high as f64))
        })
        .collect();
    let modes: Vec<_> =
        sweep.comparable().filter_map(|row| Some((row.sigma, row.mode? as f64))).collect();
    panel.record("mode", bars.iter().copied());
    panel.quiet().bars("interval of the mode", &bars, 40, bar, Outside::Refuse)?;
    panel.marks("mode", &modes, CROSSES, Outside::Refuse)?;
    let near = rise(&sheet, 0.075, count_axis(n, "impacts"))?;
    let shown: Vec<_> = bars.into_iter().filter(|bar| near.x.holds(bar.0)).collect();
    near.bars("interval of the mode, near the rise", &shown, 40, bar, Outside::Refuse)?;
    printed(&near)?;
    near.marks("mode, near the rise", &modes, CROSSES, Outside::Cut)?;
    let entries = [
        Entry::mark(CROSSES, "mode of the kept"),
        Entry::line(Stroke::solid(GREY, HAIR), "its bootstrap interval, 95 %"),
    ];
    sheet.legend((1200, HEIGHTS.1), (SMALL, 400), (1, 3200), &entries)?;

    let description = seen!(
        "Most likely number of different gaps that impact against σ, simulated with {} masses; bars are 95 % \
         bootstrap intervals. Below the rise the mode is small and badly determined, beyond it nearly all {n} gaps \
         impact.",
        sweep.ensemble.chain.masses
    );
    Ok(sheet.finish("fig02", "Most likely number of impacts", description))
}

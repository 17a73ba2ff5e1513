//! Fig. 2: the most likely number of impacts against σ, simulated.

use super::data::cells;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::simulated::{
    CROSS, CROSS_HALF, HEIGHTS, MAIN, comparable, count_axis, crosses, last_sigma, printed, rise,
    sigma_axis, split,
};
use super::style::{GREY, HAIR, Mark, SMALL, Stroke, THIN};
use super::{DataFile, Error, Figure};
use crate::experiments::sweep::Sweep;

/// Draws the figure.
pub fn draw(sweep: &Sweep, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(HEIGHTS.0, note)?;
    let n = sweep.parameters.chain.gaps();
    let panel = sheet.panel(
        MAIN,
        sigma_axis(last_sigma(sweep)),
        count_axis(n, "most likely number of impacts"),
    )?;
    let bar = Stroke::solid(GREY, THIN);
    let bars: Vec<_> = comparable(sweep)
        .filter_map(|row| {
            let [low, high] = row.mode_interval?;
            (low < high).then_some((row.sigma, low as f64, high as f64))
        })
        .collect();
    let modes: Vec<_> =
        comparable(sweep).filter_map(|row| Some((row.sigma, row.mode_distinct? as f64))).collect();
    panel.bars("interval of the mode", &bars, 40, bar)?;
    crosses(&panel, "mode", &modes)?;
    let near = rise(&sheet, count_axis(n, ""))?;
    printed(&near)?;
    let (low, high) = (near.x.lo, near.x.hi);
    let shown: Vec<_> = bars.into_iter().filter(|bar| bar.0 >= low && bar.0 <= high).collect();
    near.bars("interval of the mode, near the rise", &shown, 40, bar)?;
    let cross = (Mark::Cross, CROSS_HALF, CROSS);
    near.marks("mode, near the rise", &modes, cross, Outside::Cut)?;
    let entries = [
        Entry::mark(Mark::Cross, CROSS_HALF, CROSS, "mode of the kept"),
        Entry::line(Stroke::solid(GREY, HAIR), "its bootstrap interval, 95 %"),
    ];
    for (entry, x) in entries.into_iter().zip([1200, 4400]) {
        sheet.legend((x, HEIGHTS.1), (SMALL, 400), &[entry])?;
    }

    let mut data = DataFile::new(
        "fig02.csv",
        &[
            "sigma (d omega^2)",
            "kept (1)",
            "mode (1)",
            "mode_low_95 (1)",
            "mode_high_95 (1)",
            "quantile_05 (1)",
            "quantile_50 (1)",
            "quantile_95 (1)",
        ],
    );
    for row in comparable(sweep) {
        let [low, high] = split(row.mode_interval);
        let quantile = |i: usize| row.quantiles.map(|q| q[i]);
        data.row(cells![
            row.sigma,
            row.kept,
            row.mode_distinct,
            low,
            high,
            quantile(0),
            quantile(2),
            quantile(4)
        ]);
    }
    let description = format!(
        "Most likely number of different gaps that impact against σ, simulated with {} masses; bars are 95 % \
         bootstrap intervals. Below the rise the mode is small and badly determined, beyond it nearly all {n} gaps \
         impact.",
        sweep.parameters.chain.masses
    );
    Ok(sheet.finish("fig02", "Most likely number of impacts", description, vec![data]))
}

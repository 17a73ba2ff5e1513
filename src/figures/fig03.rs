//! Fig. 3: the expected number of impacts against σ, simulated, and how many runs it rests on.

use plotters::style::text_anchor::{HPos, VPos};

use super::axis::Axis;
use super::chart::{LETTERS, short};
use super::data::cells;
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::simulated::{
    CROSS, CROSS_HALF, comparable, count_axis, crosses, last_sigma, means, sigma_axis, split,
};
use super::style::{Dash, GREY, HAIR, INK, LINE, Mark, SMALL, Stroke, THIN, TINY};
use super::{DataFile, Error, Figure};
use crate::experiments::sweep::{Sweep, SweepRow};

/// Draws the figure.
pub fn draw(sweep: &Sweep, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(7450, note)?;
    let n = sweep.parameters.chain.gaps();
    let end = last_sigma(sweep);
    let panel = sheet.panel(
        Frame::new(1200, 430, 8150, 4430),
        sigma_axis(end).bare(),
        count_axis(n, "expected number of impacts"),
    )?;
    panel.letter(LETTERS[0])?;
    let all: Vec<_> =
        comparable(sweep).filter_map(|row| Some((row.sigma, row.mean_all?))).collect();
    let broken = Stroke::dashed(GREY, LINE, Dash::Short);
    panel.curve("mean of all", &all, broken, Outside::Refuse)?;
    let kept = means(sweep);
    let bars: Vec<_> = comparable(sweep)
        .filter_map(|row| row.mean_interval.map(|[low, high]| (row.sigma, low, high)))
        .collect();
    panel.bars("interval of the mean", &bars, 40, CROSS)?;
    crosses(&panel, "mean of the kept", &kept)?;
    if let Some(half) = sweep.rise.half_height {
        let level = n as f64 / 2.0;
        let guide = Stroke::dashed(INK, HAIR, Dash::Dotted);
        let corner = [(half.value, level), (half.value, 0.0)];
        panel.curve("half height", &corner, guide, Outside::Refuse)?;
        let text = format!("half height: *σ* = {}", short(half.value, 4));
        let look = (TINY, INK, HPos::Left, VPos::Center);
        panel.note(&text, (half.value, 0.12 * level), (130, 0), look)?;
    }
    sheet.legend(
        (4400, 2700),
        (SMALL, 400),
        &[
            Entry {
                line: None,
                mark: Some((Mark::Cross, CROSS_HALF, CROSS)),
                text: "mean of the kept (95 % interval)".into(),
            },
            Entry::line(broken, "mean of all"),
        ],
    )?;

    let share = sheet.panel(
        Frame::new(1200, 5100, 8150, 6550),
        sigma_axis(end),
        Axis::linear(0.0, 1.0, 0.5, 2, "kept share"),
    )?;
    share.letter(LETTERS[1])?;
    let fraction: Vec<_> =
        comparable(sweep).filter_map(|row| Some((row.sigma, kept_fraction(row)?))).collect();
    let line = Stroke::solid(GREY, THIN);
    share.curve("kept fraction", &fraction, line, Outside::Refuse)?;
    let dot = (Mark::Disc, 38, Stroke::solid(INK, HAIR));
    share.marks("kept fraction", &fraction, dot, Outside::Refuse)?;

    let description = format!(
        "(a) Mean number of different gaps that impact against σ, simulated with {} masses: of the realisations with an impact \
         (crosses, 95 % intervals) it {}; of all realisations (broken line) it starts near zero. (b) The share with an \
         impact rises from {} to {}.",
        sweep.parameters.chain.masses,
        sweep.rise.half_height.map_or("rises".into(), |half| format!(
            "passes half of {n} at σ = {}",
            short(half.value, 4)
        )),
        fraction.first().map_or("0".into(), |f| short(f.1, 2)),
        fraction.last().map_or("1".into(), |f| short(f.1, 3)),
    );
    Ok(sheet.finish("fig03", "Expected number of impacts", description, vec![table(sweep)]))
}

fn kept_fraction(row: &SweepRow) -> Option<f64> {
    let ran = row.realisations - row.rejected - row.failed;
    (ran > 0).then(|| row.kept as f64 / ran as f64)
}

fn table(sweep: &Sweep) -> DataFile {
    let mut data = DataFile::new(
        "fig03.csv",
        &[
            "sigma (d omega^2)",
            "realisations (1)",
            "kept (1)",
            "kept_fraction (1)",
            "kept_fraction_low_95 (1)",
            "kept_fraction_high_95 (1)",
            "mean_of_kept (1)",
            "standard_error (1)",
            "mean_of_kept_low_95 (1)",
            "mean_of_kept_high_95 (1)",
            "mean_of_all (1)",
            "mean_of_all_low_95 (1)",
            "mean_of_all_high_95 (1)",
        ],
    );
    for row in comparable(sweep) {
        let [f0, f1] = split(row.kept_interval);
        let [k0, k1] = split(row.mean_interval);
        let [a0, a1] = split(row.mean_all_interval);
        data.row(cells![
            row.sigma,
            row.realisations,
            row.kept,
            kept_fraction(row),
            f0,
            f1,
            row.mean_distinct,
            row.standard_error,
            k0,
            k1,
            row.mean_all,
            a0,
            a1
        ]);
    }
    data
}

//! Fig. 3: the expected number of impacts against σ, simulated, and how many runs it rests on.

use super::prelude::*;
use super::simulated::*;
use crate::experiments::rise::Counted;

pub fn draw(sweep: &Counted) -> Result<Figure, Error> {
    let sheet = Sheet::new(7450);
    let n = sweep.ensemble.chain.gaps();
    let end = last_sigma(sweep);
    let (x, y) = (sigma_axis(end).bare(), count_axis(n, "expected number of impacts"));
    let panel = sheet.lettered(LETTERS[0], Frame::new(1200, 430, 8150, 4430), x, y)?;
    let all: Vec<_> =
        sweep.comparable().filter_map(|row| Some((row.sigma, row.mean_all?.value))).collect();
    let broken = Stroke::dashed(GREY, LINE, Dash::Short);
    panel.curve("mean of all", &all, broken, Outside::Refuse)?;
    let kept = means(sweep);
    let bars: Vec<_> = sweep
        .comparable()
        .filter_map(|row| row.mean?.interval.map(|[low, high]| (row.sigma, low, high)))
        .collect();
    panel.record("mean of the kept", bars.iter().copied());
    panel.quiet().bars("interval of the mean", &bars, 40, CROSS, Outside::Refuse)?;
    panel.marks("mean of the kept", &kept, CROSSES, Outside::Refuse)?;
    if let Some(half) = sweep.first().rise.half_height {
        let level = n as f64 / 2.0;
        let guide = Stroke::dashed(INK, HAIR, Dash::Dotted);
        panel.guide("half height", &[(half.value, level), (half.value, 0.0)], guide)?;
        let text = format!("half height: *σ* = {}", short(half.value, 4));
        let look = (TINY, INK, HPos::Left, VPos::Center);
        panel.note(&text, (half.value, 0.12 * level), (130, 0), look)?;
    }
    let kept = Entry::mark(CROSSES, "mean of the kept (95 % interval)");
    let entries = [kept, Entry::line(broken, "mean of all")];
    sheet.legend((4400, 2700), (SMALL, 400), (9, 0), &entries)?;

    let (x, y) = (sigma_axis(end), Axis::linear(0.0, 1.0, 0.5, 2, "kept share"));
    let share = sheet.lettered(LETTERS[1], Frame::new(1200, 5100, 8150, 6550), x, y)?;
    let ran = sweep.comparable().filter(|row| row.ran > 0);
    let fraction: Vec<_> = ran.map(|row| (row.sigma, row.kept as f64 / row.ran as f64)).collect();
    let line = Stroke::solid(GREY, THIN);
    let dot = (Mark::Disc, 38, Stroke::solid(INK, HAIR));
    share.marked("kept fraction", &fraction, (line, dot), Outside::Refuse)?;

    let description = seen!(
        "(a) Mean number of different gaps that impact against σ, simulated with {} masses: of the realisations with an impact \
         (crosses, 95 % intervals) it {}; of all realisations (broken line) it starts near zero. (b) The share with an \
         impact rises from {} to {}.",
        sweep.ensemble.chain.masses,
        sweep.first().rise.half_height.map_or("rises".into(), |half| format!(
            "passes half of {n} at σ = {}",
            short(half.value, 4)
        )),
        fraction.first().map_or("0".into(), |f| short(f.1, 2)),
        fraction.last().map_or("1".into(), |f| short(f.1, 3)),
    );
    Ok(sheet.finish("fig03", "Expected number of impacts", description))
}

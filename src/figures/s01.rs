//! Draws Fig. S1: one long run, gap against time: how many impacts, and a tick for each at first.

use super::prelude::*;
use crate::experiments::spacetime::SpaceTime;
use std::collections::BTreeMap;

/// How much of the run the second panel shows.
const DETAIL: f64 = 400.0;

/// The intervals of time in which the first panel counts.
const INTERVALS: f64 = 200.0;

/// Numbers of impacts that share a shade.
const SHADES: [&str; 3] = ["1", "2–3", "4 or more"];

pub fn draw(run: &SpaceTime) -> Result<Figure, Error> {
    let sheet = Sheet::new(9850);
    let until = run.parameters.until;
    let gaps = || Axis::linear(-1.0, run.width() as f64, 20.0, 2, "gap");
    let time = |from: f64, to: f64, step: f64| Axis::linear(from, to, step, 2, "time *t* (1/*ω*)");

    // Thousandths are finer than the picture, and a file of all digits would be twice as long.
    let whole = time(0.0, until, until / 4.0).column("time_to_thousandths (1/omega)");
    let whole = sheet.lettered("(a)", Frame::new(1200, 430, 8150, 4130), whole, gaps())?;
    let impacts = points(run, 0.0, until);
    whole.record("impacts", impacts.iter().map(|(time, gap)| (thousandths(*time), *gap)));
    window(&whole, until)?;
    shades(&sheet, &whole, run, until / INTERVALS)?;
    starts(&whole, run, until)?;

    // From a round time before the first impact on.
    let from = (run.times.first().unwrap_or(&0.0) / 10.0).floor() * 10.0;
    let to = from + DETAIL;
    let near = Frame::new(1200, 5750, 8150, 9050);
    let near = sheet.lettered("(b)", near, time(from, to, DETAIL / 4.0), gaps())?;
    near.draw_series("first impacts", [ticks(points(run, from, to), 14, Stroke::solid(INK, 30))])?;
    starts(&near, run, to)?;
    if let Some((time, gap)) = run.times.first().zip(run.gaps.first()) {
        near.label("closes by itself", (*time, f64::from(*gap)), (2, 4), RED)?;
    }
    let description = describe!(
        "(a) Gap against time for {} impacts of one run of {} masses at σ = {}: the thicker, the more impacts. They form horizontal \
         bands that begin at {} red discs and widen in bursts; {} of {} gaps are reached by the end. (b) Its beginning, a tick for each.",
        run.times.len(),
        run.parameters.chain.masses,
        run.parameters.sigma,
        run.starts().len(),
        run.firsts().iter().flatten().count(),
        run.width(),
    );
    Ok(sheet.finish("One long run", description))
}

fn points(run: &SpaceTime, from: f64, to: f64) -> Vec<(f64, f64)> {
    let counts = run.times.iter().zip(&run.gaps).map(|(&time, &gap)| (time, f64::from(gap)));
    counts.filter(|(time, _)| (from..=to).contains(time)).collect()
}

/// Shades each gap by the number of its impacts in intervals of this length, with a key.
fn shades(sheet: &Sheet, panel: &Panel, run: &SpaceTime, length: f64) -> Drawn {
    let mut counts: BTreeMap<(u64, u16), u64> = BTreeMap::new();
    for (time, gap) in points(run, 0.0, panel.x.hi) {
        let interval = (time / length).min(INTERVALS - 1.0);
        *counts.entry((interval as u64, gap as u16)).or_default() += 1;
    }
    let Frame { left, top, right, bottom } = panel.frame;
    let row = (bottom - top) as u32 / (run.width() as u32 + 1);
    let width = (right - left) / INTERVALS as i32 + 1;
    let style = words(SMALL, INK, HPos::Left, VPos::Bottom);
    let title = format!("shade and thickness: impacts in {}/*ω*", short(length, 2));
    let base = bottom + 950;
    sheet.area.draw_text(&title, &style, (left + 60, base))?;
    for (shade, name) in SHADES.into_iter().enumerate() {
        let colour = ordered([0, 1, 3][shade], 4);
        let with_shade = counts.iter().filter(|(_, count)| count.ilog2().min(2) == shade as u32);
        let places = with_shade
            .map(|((interval, gap), _)| ((*interval as f64 + 0.5) * length, f64::from(*gap)));
        let stroke = Stroke::solid(colour, row * (shade as u32 + 1) / 3);
        panel.draw_series("impacts", [ticks(places.collect(), width, stroke)])?;
        let x = left + [3900, 4550, 5450][shade];
        sheet.area.draw(&Rectangle::new([(x, base - 170), (x + 250, base)], colour.filled()))?;
        sheet.area.draw_text(name, &style, (x + 330, base))?;
    }
    Ok(())
}

/// The window in which gaps are counted, as a background, if the run is that long.
fn window(panel: &Panel, until: f64) -> Drawn {
    let Protocol { transient, window } = Protocol::default();
    let (from, to) = (transient, transient + window);
    if to > until {
        return Ok(());
    }
    let corners = [(from, panel.y.lo), (to, panel.y.hi)];
    panel.draw_series("window", [Rectangle::new(corners, GREY.mix(0.3).filled())])?;
    panel.label("counting window", (from, panel.y.hi), (1, -1), INK)
}

/// A disc at the first impact of each gap at which impacts start.
fn starts(panel: &Panel, run: &SpaceTime, until: f64) -> Drawn {
    let firsts = run.firsts();
    let starts = run.starts().into_iter().filter_map(|gap| Some((firsts[gap]?, gap as f64)));
    let starts: Vec<_> = starts.filter(|(time, _)| *time <= until).collect();
    panel.unrecorded().markers("starts", &starts, (Symbol::Disc, 62, Stroke::solid(RED, HAIR)))?;
    panel.record("starts", starts.iter().map(|(time, gap)| (thousandths(*time), *gap)));
    Ok(())
}

fn thousandths(time: f64) -> f64 {
    (time * 1000.0).round() / 1000.0
}

//! Fig. S1: one long run, gap against time, a tick for each impact.

use super::prelude::*;
use crate::experiments::spacetime::SpaceTime;
use crate::params::Protocol;

/// How much of the run the second panel shows.
const DETAIL: f64 = 400.0;

/// A gap at which impacts start.
const START: Marker = (Symbol::Disc, 62, Stroke::solid(RED, HAIR));

pub fn draw(run: &SpaceTime) -> Result<Figure, Error> {
    let sheet = Sheet::new(9350);
    let until = run.parameters.until;
    let gaps = || Axis::linear(-1.0, run.width() as f64, 20.0, 2, "gap");
    let time = |from: f64, to: f64, step: f64| Axis::linear(from, to, step, 2, "time *t* (1/*ω*)");

    // Thousandths are finer than the picture, and a file of all digits would be twice as long.
    let whole = time(0.0, until, until / 4.0).column("time_to_thousandths (1/omega)");
    let whole = sheet.lettered(LETTERS[0], Frame::new(1200, 430, 8150, 4130), whole, gaps())?;
    let impacts = points(run, 0.0, until);
    window(&whole, until)?;
    let row = (whole.frame.bottom - whole.frame.top) / (run.width() as i32 + 1);
    whole.record("impacts", impacts.iter().map(|(time, gap)| (thousandths(*time), *gap)));
    whole.draw_series("impacts", [ticks(impacts, 12, Stroke::solid(INK, row as u32))])?;
    starts(&whole, run, until)?;

    // From a round time before the first impact on.
    let from = (run.times.first().unwrap_or(&0.0) / 10.0).floor() * 10.0;
    let to = from + DETAIL;
    let near = Frame::new(1200, 5250, 8150, 8550);
    let near = sheet.lettered(LETTERS[1], near, time(from, to, DETAIL / 4.0), gaps())?.unrecorded();
    let first = ticks(points(run, from, to), 14, Stroke::solid(INK, 30));
    near.draw_series("first impacts", [first])?;
    starts(&near, run, to)?;
    if let Some((time, gap)) = run.times.first().zip(run.gaps.first()) {
        near.label("closes by itself", (*time, f64::from(*gap)), (2, 4), RED)?;
    }
    Ok(sheet.finish("One long run", description(run)))
}

fn points(run: &SpaceTime, from: f64, to: f64) -> Vec<(f64, f64)> {
    let all = run.times.iter().zip(&run.gaps).map(|(&time, &gap)| (time, f64::from(gap)));
    all.filter(|(time, _)| (from..=to).contains(time)).collect()
}

/// The window in which gaps are counted, as a ground, if the run is that long.
fn window(panel: &Panel, until: f64) -> Drawn {
    let Protocol { transient, window } = Protocol::default();
    let (from, to) = (transient, transient + window);
    if to > until {
        return Ok(());
    }
    let (low, high) = (panel.y.lo, panel.y.hi);
    let corners = [(from, low), (to, low), (to, high), (from, high)];
    panel.draw_series("window", [Polygon::new(corners, ORANGE.mix(0.3))])?;
    panel.label("counting window", (from, high), (1, -1), ORANGE)
}

/// A disc at the first impact of each gap at which impacts start.
fn starts(panel: &Panel, run: &SpaceTime, until: f64) -> Drawn {
    let firsts = run.firsts();
    let starts = run.starts().into_iter().filter_map(|gap| Some((firsts[gap]?, gap as f64)));
    let starts: Vec<_> = starts.filter(|(time, _)| *time <= until).collect();
    panel.unrecorded().markers("starts", &starts, START, Outside::Refuse)?;
    panel.record("starts", starts.iter().map(|(time, gap)| (thousandths(*time), *gap)));
    Ok(())
}

fn description(run: &SpaceTime) -> Description {
    describe!(
        "Gap against time, a tick for each of {} impacts of one run of {} masses at σ = {}. Impacts form horizontal bands that \
         begin at {} red discs and widen in bursts; {} of {} gaps are reached by the end. (b) A part of it, finer.",
        run.times.len(),
        run.parameters.chain.masses,
        run.parameters.sigma,
        run.starts().len(),
        run.firsts().iter().flatten().count(),
        run.width(),
    )
}

fn thousandths(time: f64) -> f64 {
    (time * 1000.0).round() / 1000.0
}

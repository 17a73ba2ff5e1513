//! Fig. S4: what one gap that closes by itself sets off, how its fronts stand, and the mean count that follows.

use super::axis::{Axis, log};
use super::chart::LETTERS;
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{BLUE, Dash, INK, LINE, Mark, ORANGE, PURPLE, RED, SMALL, Stroke, THIN};
use super::{DataFile, Error, Figure};
use crate::experiments::Results;
use crate::experiments::seeds::tables::spread;
use crate::experiments::sweep::Sweep;
use crate::table::Table;

/// The σ of (a).
const SIGMAS: (f64, f64) = (0.075, 0.165);

/// Lines of the σ in (b) and (d).
const SPREADS: [Stroke; 4] = [
    Stroke::solid(PURPLE, LINE),
    Stroke::dashed(BLUE, LINE, Dash::Long),
    Stroke::dashed(ORANGE, LINE, Dash::Alternate),
    Stroke::solid(RED, THIN),
];

/// The half size of marks.
const SIZE: i32 = 58;

/// Draws the figure.
pub fn draw(results: &Results, note: Option<&str>) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let (means, rise, scores) =
        (table("seeds.means")?, table("seeds.rise")?, table("seeds.scores")?);
    let (advance, waits, fronts) =
        (table("seeds.advance")?, table("seeds.waits")?, table("seeds.fronts")?);
    let sheet = Sheet::new(13050, note)?;
    let theory = table("seeds.theory")?;
    counts(&sheet, means, theory, results.sweep()?)?;
    advances(&sheet, advance)?;
    halves(&sheet, rise, scores)?;
    standing(&sheet, waits, fronts, results.seeds()?.parameters.tick)?;
    let files = [means, theory, table("seeds.against_sweep")?, advance, rise, scores, waits];
    let title = "From one gap to many: nucleation and growth";
    Ok(sheet.finish("s04", title, description(waits), files.map(DataFile::of).into()))
}

fn counts(sheet: &Sheet, means: &Table, theory: &Table, sweep: &Sweep) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 430, 8150, 3730),
        Axis::linear(SIGMAS.0, SIGMAS.1, 0.01, 2, "standard deviation *σ* of the forcing"),
        Axis::linear(0.0, 105.0, 20.0, 2, "mean count of all"),
    )?;
    panel.letter(LETTERS[0])?;
    let transient = [("transient", sweep.parameters.protocol.transient)];
    let lines = [
        ("nucleation and growth", "grown", Stroke::solid(INK, LINE)),
        ("circuits, Eq. (25)", "eq25", Stroke::dashed(BLUE, LINE, Dash::Short)),
        ("circuits, from rest", "from_rest", Stroke::dashed(PURPLE, LINE, Dash::Long)),
    ];
    let mut entries = Vec::new();
    for (name, column, stroke) in lines {
        let points = match column {
            "grown" => means.points(&transient, "sigma", column),
            _ => theory.points(&[], "sigma", column),
        };
        panel.curve(name, &points, stroke, Outside::Refuse)?;
        entries.push(Entry::line(stroke, name));
    }
    let inside = sweep.rows.iter().filter(|row| row.sigma > SIGMAS.0 && row.sigma < SIGMAS.1);
    let bars: Vec<_> =
        inside.filter_map(|row| Some((row.sigma, row.mean_all?, row.mean_all_interval?))).collect();
    let look = (Mark::Disc, SIZE, Stroke::solid(RED, THIN));
    let ends: Vec<_> = bars.iter().map(|(x, _, [low, high])| (*x, *low, *high)).collect();
    panel.bars("simulation", &ends, 35, look.2)?;
    let points: Vec<_> = bars.iter().map(|(x, y, _)| (*x, *y)).collect();
    panel.marks("simulation", &points, look, Outside::Refuse)?;
    entries.push(Entry::mark(look.0, look.1, look.2, "simulation"));
    sheet.legend((1400, 700), (SMALL, 370), &entries)
}

fn named(sigma: f64) -> String {
    format!("*σ* = {sigma}")
}

fn advances(sheet: &Sheet, advance: &Table) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 5250, 4050, 7650),
        Axis::decades(1, 4, 1, "time since the first impact (1/*ω*)"),
        Axis::decades(-1, 2, 1, "advance of a front"),
    )?;
    panel.letter(LETTERS[1])?;
    let mut entries = Vec::new();
    for (sigma, stroke) in spread(&advance.values("sigma")).zip(SPREADS) {
        let points = advance.points(&[("sigma", *sigma)], "time", "advance");
        let points = points.into_iter().filter(|(_, own)| *own > 0.0);
        let points: Vec<_> = points.map(|(time, own)| (log(time), log(own))).collect();
        let name = named(*sigma);
        panel.curve(&name, &points, stroke, Outside::Cut)?;
        entries.push(Entry::line(stroke, &name));
    }
    let straight = Stroke::dashed(INK, THIN, Dash::Short);
    panel.curve("constant speed", &[(1.0, -1.0), (4.0, 2.0)], straight, Outside::Cut)?;
    entries.push(Entry::line(straight, "∝ *t*"));
    for (i, column) in entries.chunks(3).enumerate() {
        sheet.legend((650 + 1800 * i as i32, 8680), (SMALL, 320), column)?;
    }
    Ok(())
}

fn halves(sheet: &Sheet, rise: &Table, scores: &Table) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5350, 5250, 8150, 7650),
        Axis::decades(1, 4, 1, "transient *T* (1/*ω*)"),
        Axis::linear(0.1, 0.15, 0.01, 2, "*σ*_{1/2} of all"),
    )?;
    panel.letter(LETTERS[2])?;
    let inside = |height: f64| height.clamp(panel.y.lo, panel.y.hi);
    let line = Stroke::solid(INK, LINE);
    let grown = rise.points(&[], "transient", "half_height");
    let grown: Vec<_> = grown.iter().map(|(time, own)| (log(*time), inside(*own))).collect();
    panel.curve("nucleation and growth", &grown, line, Outside::Refuse)?;
    let look = (Mark::Disc, SIZE, Stroke::solid(RED, THIN));
    let found = scores.estimates(&[], "transient", "half_height");
    let bars: Vec<_> = found
        .iter()
        .map(|(time, half)| {
            (log(*time), inside(half.value - half.error), inside(half.value + half.error))
        })
        .collect();
    panel.bars("simulation", &bars, 35, look.2)?;
    let points: Vec<_> =
        found.iter().map(|(time, half)| (log(*time), inside(half.value))).collect();
    panel.marks("simulation", &points, look, Outside::Refuse)?;
    let entries = [
        Entry::line(line, "nucleation and growth"),
        Entry::mark(look.0, look.1, look.2, "simulation"),
    ];
    sheet.legend((4850, 8650), (SMALL, 370), &entries)
}

/// (t, share that stands longer) at each tick from the first on: it falls where waits end, and is level between.
fn longer(waits: &Table, sigma: f64, tick: f64) -> Vec<(f64, f64)> {
    let known = waits.points(&[("sigma", sigma)], "time", "longer");
    let last = known.last().map_or(0, |(time, _)| (time / tick).round() as u32);
    let at = |time: f64| known.iter().rev().find(|(own, _)| *own <= time).map_or(1.0, |own| own.1);
    (1..=last).map(|ticks| f64::from(ticks) * tick).map(|time| (time, at(time))).collect()
}

fn standing(sheet: &Sheet, waits: &Table, fronts: &Table, tick: f64) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 10150, 8150, 12250),
        Axis::decades(0, 3, 1, "time *t* for which a front stands (1/*ω*)"),
        Axis::decades(-2, 0, 1, "share longer than *t*"),
    )?;
    panel.letter(LETTERS[3])?;
    let mut entries = Vec::new();
    for (sigma, stroke) in waits.values("sigma").into_iter().zip(SPREADS) {
        let shares = longer(waits, sigma, tick).into_iter().filter(|(_, share)| *share > 0.0);
        let points: Vec<_> = shares.map(|(time, share)| (log(time), log(share))).collect();
        let name = named(sigma);
        panel.curve(&name, &points, stroke, Outside::Cut)?;
        entries.push(Entry::line(stroke, &name));
    }
    // The first row, were every wait to end at the same rate.
    if let Some((_, speed)) = fronts.points(&[], "sigma", "speed").first() {
        let decay = |step: u32| {
            let time = pxfm::f_exp10(f64::from(step) / 40.0);
            (log(time), -speed * time * std::f64::consts::LOG10_E)
        };
        let even = Stroke::dashed(SPREADS[0].colour, THIN, Dash::Short);
        let points: Vec<_> = (0..=120).map(decay).collect();
        panel.curve("constant rate", &points, even, Outside::Cut)?;
        entries.push(Entry::line(even, "constant rate"));
    }
    sheet.legend((1400, 10900), (SMALL, 270), &entries)
}

fn description(waits: &Table) -> String {
    format!(
        "(a) Mean count of all against σ: simulated points along the curve of nucleation and growth; circuits are steeper. (b) Advance \
         against time: slower than ∝ t, the more so the smaller σ. (c) Half height falls with T. (d) Share of longer waits: first \
         below a constant rate, then above it, from σ = {} down.",
        waits.values("sigma").first().copied().unwrap_or_default(),
    )
}

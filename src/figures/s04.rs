//! Fig. S4: what one gap that closes by itself sets off, how its fronts stand, and the mean count that follows.

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::data::cells;
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{BLUE, Colour, Dash, INK, LINE, Mark, ORANGE, PURPLE, RED, SMALL, Stroke, THIN};
use super::{DataFile, Error, Figure};
use crate::experiments::protocol::ProtocolMap;
use crate::experiments::seeds::{Fronts, Prediction, Seeds, Spread, Waits};
use crate::experiments::sweep::Sweep;

/// The σ of (a).
const SIGMAS: (f64, f64) = (0.075, 0.165);

/// Colours of the σ in (b) and (d).
const SPREADS: [Colour; 4] = [PURPLE, BLUE, ORANGE, RED];

/// The half size of marks.
const SIZE: i32 = 58;

/// Draws the figure.
pub fn draw(
    seeds: &Seeds,
    sweep: &Sweep,
    map: &ProtocolMap,
    note: Option<&str>,
) -> Result<Figure, Error> {
    let sheet = Sheet::new(13050, note)?;
    counts(&sheet, seeds, sweep)?;
    advances(&sheet, seeds)?;
    halves(&sheet, seeds, map)?;
    waits(&sheet, seeds)?;
    let files = tables(seeds, sweep, map);
    let title = "From one gap to many: nucleation and growth";
    Ok(sheet.finish_own(4, title, description(seeds, sweep, map), files))
}

/// The prediction for the transient of the main sweep.
fn of_sweep<'a>(seeds: &'a Seeds, sweep: &Sweep) -> Option<&'a Prediction> {
    let protocol = sweep.parameters.protocol;
    let same =
        |own: &&Prediction| own.transient == protocol.transient && own.window == protocol.window;
    seeds.predictions.iter().find(same)
}

fn counts(sheet: &Sheet, seeds: &Seeds, sweep: &Sweep) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 430, 8150, 3730),
        Axis::linear(SIGMAS.0, SIGMAS.1, 0.01, 2, "standard deviation *σ* of the forcing"),
        Axis::linear(0.0, 105.0, 20.0, 2, "mean count of all"),
    )?;
    panel.letter(LETTERS[0])?;
    let against = |ys: &mut dyn Iterator<Item = f64>| -> Vec<(f64, f64)> {
        seeds.rows.iter().map(|row| row.sigma).zip(ys).collect()
    };
    let grown =
        of_sweep(seeds, sweep).into_iter().flat_map(|own| own.means.iter().map(|own| own.value));
    let lines = [
        ("nucleation and growth", against(&mut { grown }), Stroke::solid(INK, LINE)),
        (
            "circuits, Eq. (25)",
            against(&mut seeds.rows.iter().map(|row| row.graph[0])),
            Stroke::dashed(BLUE, LINE, Dash::Short),
        ),
        (
            "circuits, from rest",
            against(&mut seeds.rows.iter().map(|row| row.graph[1])),
            Stroke::dashed(PURPLE, LINE, Dash::Long),
        ),
    ];
    let mut entries = Vec::new();
    for (name, points, stroke) in lines {
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

/// The rows at some σ: the lowest, the highest, and two between.
fn chosen(seeds: &Seeds) -> impl Iterator<Item = &Spread> {
    let last = seeds.rows.len().saturating_sub(1);
    [0, last / 3, 2 * last / 3, last].into_iter().filter_map(|i| seeds.rows.get(i))
}

/// (t, advance) from the first bin on.
fn advance(seeds: &Seeds, row: &Spread) -> impl Iterator<Item = (f64, f64)> {
    let bin = seeds.parameters.bin;
    row.advance.clone().into_iter().enumerate().skip(1).map(move |(i, own)| (i as f64 * bin, own))
}

fn advances(sheet: &Sheet, seeds: &Seeds) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 5250, 4050, 7650),
        Axis::decades(1, 4, 1, "time since the first impact"),
        Axis::decades(-1, 2, 1, "advance of a front"),
    )?;
    panel.letter(LETTERS[1])?;
    let mut entries = Vec::new();
    for (row, colour) in chosen(seeds).zip(SPREADS) {
        let points: Vec<_> = advance(seeds, row)
            .filter(|(_, own)| *own > 0.0)
            .map(|(time, own)| (log(time), log(own)))
            .collect();
        let stroke = Stroke::solid(colour, LINE);
        let name = format!("*σ* = {}", row.sigma);
        panel.curve(&name, &points, stroke, Outside::Cut)?;
        entries.push(Entry::line(stroke, &name));
    }
    let straight = Stroke::dashed(INK, THIN, Dash::Short);
    panel.curve("constant speed", &[(1.0, -1.0), (4.0, 2.0)], straight, Outside::Cut)?;
    entries.push(Entry::line(straight, "∝ *t*"));
    for (i, column) in entries.chunks(3).enumerate() {
        sheet.legend((650 + 1800 * i as i32, 8480), (SMALL, 320), column)?;
    }
    Ok(())
}

/// (T, predicted, simulated half height) for each transient.
fn both(
    seeds: &Seeds,
    map: &ProtocolMap,
) -> impl Iterator<Item = (f64, Option<f64>, Option<[f64; 2]>)> {
    seeds.predictions.iter().map(|own| {
        let cell = map
            .cells
            .iter()
            .find(|cell| cell.transient == own.transient && cell.window == own.window);
        let half = cell.and_then(|cell| cell.half_height_all).map(|half| [half.value, half.error]);
        (own.transient, own.half_height.map(|half| half.value), half)
    })
}

fn halves(sheet: &Sheet, seeds: &Seeds, map: &ProtocolMap) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5350, 5250, 8150, 7650),
        Axis::decades(1, 4, 1, "transient *T*"),
        Axis::linear(0.1, 0.15, 0.01, 2, "*σ*_{1/2} of all"),
    )?;
    panel.letter(LETTERS[2])?;
    let inside = |height: f64| height.clamp(panel.y.lo, panel.y.hi);
    let line = Stroke::solid(INK, LINE);
    let grown: Vec<_> =
        both(seeds, map).filter_map(|(time, own, _)| Some((log(time), inside(own?)))).collect();
    panel.curve("nucleation and growth", &grown, line, Outside::Refuse)?;
    let look = (Mark::Disc, SIZE, Stroke::solid(RED, THIN));
    let found: Vec<_> =
        both(seeds, map).filter_map(|(time, _, half)| Some((log(time), half?))).collect();
    let bars: Vec<_> = found
        .iter()
        .map(|(x, [half, error])| (*x, inside(half - error), inside(half + error)))
        .collect();
    panel.bars("simulation", &bars, 35, look.2)?;
    let points: Vec<_> = found.iter().map(|(x, [half, _])| (*x, inside(*half))).collect();
    panel.marks("simulation", &points, look, Outside::Refuse)?;
    let entries = [
        Entry::line(line, "nucleation and growth"),
        Entry::mark(look.0, look.1, look.2, "simulation"),
    ];
    sheet.legend((4850, 8650), (SMALL, 370), &entries)
}

/// The rows of (d), those of (b), with their waits.
fn waiting(seeds: &Seeds) -> impl Iterator<Item = (&Fronts, &Waits)> {
    let both = || seeds.fronts.iter().zip(&seeds.waits);
    chosen(seeds).filter_map(move |row| both().find(|(own, _)| own.sigma == row.sigma))
}

/// (t, share that stands longer) from the first tick on.
fn standing(seeds: &Seeds, tally: &Waits) -> impl Iterator<Item = (f64, f64)> {
    let tick = seeds.parameters.tick;
    let shares = tally.lasting().into_iter().enumerate().skip(1);
    shares.map(move |(ticks, share)| (ticks as f64 * tick, share))
}

fn waits(sheet: &Sheet, seeds: &Seeds) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 10150, 8150, 12250),
        Axis::decades(0, 3, 1, "time *t* for which a front stands"),
        Axis::decades(-2, 0, 1, "share longer than *t*"),
    )?;
    panel.letter(LETTERS[3])?;
    let mut entries = Vec::new();
    for ((own, tally), colour) in waiting(seeds).zip(SPREADS) {
        let shares = standing(seeds, tally).filter(|(_, share)| *share > 0.0);
        let points: Vec<_> = shares.map(|(time, share)| (log(time), log(share))).collect();
        let stroke = Stroke::solid(colour, LINE);
        let name = format!("*σ* = {}", own.sigma);
        panel.curve(&name, &points, stroke, Outside::Cut)?;
        entries.push(Entry::line(stroke, &name));
    }
    // The first row, were every wait to end at the same rate.
    if let Some(speed) = seeds.fronts.first().and_then(|own| own.speed) {
        let decay = |step: u32| {
            let time = pxfm::f_exp10(f64::from(step) / 40.0);
            (log(time), -speed.value * time * std::f64::consts::LOG10_E)
        };
        let even = Stroke::dashed(SPREADS[0], THIN, Dash::Short);
        let points: Vec<_> = (0..=120).map(decay).collect();
        panel.curve("constant rate", &points, even, Outside::Cut)?;
        entries.push(Entry::line(even, "constant rate"));
    }
    sheet.legend((1400, 10900), (SMALL, 270), &entries)
}

fn description(seeds: &Seeds, sweep: &Sweep, map: &ProtocolMap) -> String {
    let means: Vec<String> = of_sweep(seeds, sweep)
        .into_iter()
        .flat_map(|own| own.means.iter().zip(&seeds.rows))
        .map(|(mean, row)| {
            let ran = sweep.rows.iter().find(|own| own.sigma == row.sigma);
            let ran = ran.and_then(|own| own.mean_all);
            let ran = ran.map_or("none".into(), |own| short(own, 3));
            format!("{} for {ran} at σ = {}", short(mean.value, 3), row.sigma)
        })
        .collect();
    let advances: Vec<String> = chosen(seeds)
        .filter_map(|row| Some((row, advance(seeds, row).last()?)))
        .map(|(row, (time, own))| format!("{} by t = {time} at σ = {}", short(own, 3), row.sigma))
        .collect();
    let halves: Vec<String> = both(seeds, map)
        .map(|(time, own, half)| {
            let told = |value: Option<f64>| value.map_or("none".into(), |own| short(own, 3));
            format!("{} for {} at T = {time}", told(own), told(half.map(|half| half[0])))
        })
        .collect();
    let window = seeds.parameters.window_ticks();
    let standing: Vec<String> = waiting(seeds)
        .filter_map(|(own, tally)| Some((own, *tally.lasting().get(window)?)))
        .map(|(own, share)| format!("{} at σ = {}", short(share, 2), own.sigma))
        .collect();
    format!(
        "(a) Mean count of all chains against σ: simulated points rise along the curve that nucleation and \
         growth predict, {}; the curves of the graph theory rise steeply, at half height one on each side of it. (b) Mean advance of \
         a front against time, on logarithmic axes: curves that rise more slowly than a constant speed would, \
         the more so the smaller σ, to {}. (c) Half height against the transient, a falling curve with \
         simulated points near it: {}. (d) Share of waits of a front that are longer than a time, \
         on logarithmic axes: falling curves, the lower the larger σ, that start below the curve of a constant rate and end above it; \
         longer than {} time units are {}.",
        means.join(", "),
        advances.join(", "),
        halves.join(", "),
        window as f64 * seeds.parameters.tick,
        standing.join(", ")
    )
}

fn tables(seeds: &Seeds, sweep: &Sweep, map: &ProtocolMap) -> Vec<DataFile> {
    let mut means = DataFile::new(
        "s04.csv",
        &[
            "sigma (d omega^2)",
            "transient (1/omega)",
            "predicted_mean (1)",
            "graph_mean_25 (1)",
            "graph_mean_rest (1)",
            "simulated_mean (1)",
        ],
    );
    for own in &seeds.predictions {
        let same = of_sweep(seeds, sweep).is_some_and(|other| other.transient == own.transient);
        for (row, mean) in seeds.rows.iter().zip(&own.means) {
            let ran = sweep.rows.iter().find(|own| own.sigma == row.sigma).filter(|_| same);
            let ran = ran.and_then(|own| own.mean_all);
            means.row(cells![
                row.sigma,
                own.transient,
                mean.value,
                row.graph[0],
                row.graph[1],
                ran
            ]);
        }
    }
    let mut advances =
        DataFile::new("s04b.csv", &["sigma (d omega^2)", "time (1/omega)", "advance (d)"]);
    for row in &seeds.rows {
        advance(seeds, row).for_each(|(time, own)| advances.row(cells![row.sigma, time, own]));
    }
    let mut halves = DataFile::new(
        "s04c.csv",
        &[
            "transient (1/omega)",
            "predicted_half_height (d omega^2)",
            "simulated_half_height (d omega^2)",
            "standard_error (d omega^2)",
        ],
    );
    for (time, own, half) in both(seeds, map) {
        halves.row(cells![time, own, half.map(|half| half[0]), half.map(|half| half[1])]);
    }
    let mut waits = DataFile::new(
        "s04d.csv",
        &["sigma (d omega^2)", "time (1/omega)", "ended (1)", "cut off (1)", "share longer (1)"],
    );
    for (own, tally) in seeds.fronts.iter().zip(&seeds.waits) {
        let shares = tally.lasting();
        for (ticks, share) in shares.into_iter().enumerate() {
            let [ended, cut] = [tally.ended[ticks], tally.cut[ticks]];
            if ended + cut > 0 {
                let time = ticks as f64 * seeds.parameters.tick;
                waits.row(cells![own.sigma, time, ended, cut, share]);
            }
        }
    }
    vec![means, advances, halves, waits]
}

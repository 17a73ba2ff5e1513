//! Fig. S2: one long run, gap against time, a tick for each impact.

use super::axis::Axis;
use super::chart::LETTERS;
use super::data::cells;
use super::panel::{Frame, Panel};
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{HAIR, INK, Mark, RED, SMALL, Stroke, WHITE};
use super::{DataFile, Error, Figure};
use crate::experiments::spacetime::SpaceTime;
use crate::experiments::spacetime::scene::Scene;

/// How much of the run the second panel shows.
const DETAIL: f64 = 400.0;

/// A gap at which impacts start.
const START: (Mark, i32, Stroke) = (Mark::Disc, 62, Stroke::solid(WHITE, HAIR));

/// Draws the figure.
pub fn draw(run: &SpaceTime, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(9750, note)?;
    let until = run.parameters.until;
    let gaps = || {
        let last = (run.width() - 1) as f64;
        Axis::linear(-1.0, last + 1.0, 20.0, 2, "gap")
    };
    let time = |from: f64, to: f64, step: f64| Axis::linear(from, to, step, 2, "time *t* (1/*ω*)");

    let whole =
        sheet.panel(Frame::new(1200, 430, 8150, 4130), time(0.0, until, until / 4.0), gaps())?;
    whole.letter(LETTERS[0])?;
    let impacts = points(run, 0.0, until);
    let row = (whole.frame.bottom - whole.frame.top) / (run.width() as i32 + 1);
    whole.ticks("impacts", &impacts, 12, Stroke::solid(INK, row as u32))?;
    starts(&whole, run, until)?;

    let (from, to) = detail(run);
    let near =
        sheet.panel(Frame::new(1200, 5250, 8150, 8550), time(from, to, DETAIL / 4.0), gaps())?;
    near.letter(LETTERS[1])?;
    near.ticks("first impacts", &points(run, from, to), 14, Stroke::solid(INK, 30))?;
    starts(&near, run, to)?;

    let tick =
        Entry { line: None, mark: Some((Mark::Square, 16, INK_LINE)), text: "impact".into() };
    let disc = Entry::mark(START.0, START.1, RED_DISC, "no neighbour was hit before");
    sheet.legend((1500, 9500), (SMALL, 370), &[tick])?;
    sheet.legend((3900, 9500), (SMALL, 370), &[disc])?;
    Ok(sheet.finish("s02", "One long run", description(run), tables(run)))
}

const INK_LINE: Stroke = Stroke::solid(INK, HAIR);
const RED_DISC: Stroke = Stroke::solid(RED, HAIR);

/// Where the second panel begins and ends: a round time before the first impact.
fn detail(run: &SpaceTime) -> (f64, f64) {
    let first = run.times.first().copied().unwrap_or(0.0);
    let from = (first / 10.0).floor() * 10.0;
    (from, from + DETAIL)
}

fn points(run: &SpaceTime, from: f64, to: f64) -> Vec<(f64, f64)> {
    let all = run.times.iter().zip(&run.gaps).map(|(&time, &gap)| (time, f64::from(gap)));
    all.filter(|(time, _)| (from..=to).contains(time)).collect()
}

/// A disc at the first impact of each gap at which impacts start.
fn starts(panel: &Panel, run: &SpaceTime, until: f64) -> Result<(), Error> {
    let firsts = run.firsts();
    let own = run.starts().into_iter().filter_map(|gap| Some((firsts[gap]?, gap as f64)));
    let own: Vec<_> = own.filter(|(time, _)| *time <= until).collect();
    let (mark, half, _) = START;
    // A white rim lifts the disc off the ticks.
    panel.marks("rims", &own, (Mark::Disc, half + 22, START.2), Outside::Refuse)?;
    panel.marks("starts", &own, (mark, half, RED_DISC), Outside::Refuse)
}

fn description(run: &SpaceTime) -> String {
    format!(
        "Gap against time, a tick for each of {} impacts of one run of {} masses at σ = {}. Impacts form horizontal bands that \
         begin at {} red discs and widen in bursts; {} of {} gaps are reached by the end. (b) A part of it, finer.",
        run.times.len(),
        run.parameters.chain.masses,
        run.parameters.sigma,
        run.starts().len(),
        run.reached(),
        run.width(),
    )
}

fn tables(run: &SpaceTime) -> Vec<DataFile> {
    // Thousandths are finer than the picture, and a file of all digits would be twice as long.
    let mut impacts = DataFile::new("s02a.csv", &["time_to_thousandths (1/omega)", "gap (1)"]);
    for (&time, &gap) in run.times.iter().zip(&run.gaps) {
        impacts.row(cells![(time * 1000.0).round() / 1000.0, gap as usize]);
    }
    let mut gaps = DataFile::new(
        "s02b.csv",
        &["gap (1)", "first_time (1/omega)", "count (1)", "starts_by_itself (1)"],
    );
    let starts = run.starts();
    for (gap, first) in run.firsts().into_iter().enumerate() {
        let count = run.gaps.iter().filter(|own| **own as usize == gap).count();
        gaps.row(cells![gap, first, count, usize::from(starts.contains(&gap))]);
    }
    let places = Scene::of(run).map(|scene| positions(&scene));
    [impacts, gaps].into_iter().chain(places).collect()
}

/// Steps of the table of positions.
const STEPS: u32 = 24;

/// Positions of all bodies at times that are evenly spread over the scene.
fn positions(scene: &Scene) -> DataFile {
    let names = (scene.first..).take(scene.bodies.len()).map(|number| format!("x_{number} (d)"));
    let mut file = DataFile::new("s02c.csv", &[]);
    file.header = std::iter::once("time (1/omega)".to_string()).chain(names).collect();
    for step in 0..=STEPS {
        let time = scene.from + (scene.until - scene.from) * f64::from(step) / f64::from(STEPS);
        let places = scene.positions(time).into_iter().map(|x| x / scene.spacing);
        file.rows.push(std::iter::once(time).chain(places).map(|x| format!("{x:?}")).collect());
    }
    file
}

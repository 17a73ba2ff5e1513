//! The scene of moving masses for report.html.

use super::{PROGRAM, html::Moving};
use crate::experiments::spacetime::scene::Scene;
use crate::figures::escape;
use serde::Serialize;
use std::fmt::Write as _;

/// Length of one d in the picture.
const UNIT: f64 = 100.0;
/// Width of a block, which is a point in the model.
const BLOCK: f64 = 50.0;
/// Space beside the row.
const MARGIN: f64 = 60.0;
/// Length of the longest bar.
const BAR: f64 = 240.0;
/// Masses from one that is named to the next.
const NAMED: usize = 5;

/// What the script needs beside the scene.
#[derive(Serialize)]
struct Data<'a> {
    #[serde(flatten)]
    scene: &'a Scene,
    /// Length in the picture for a unit of length.
    scale: f64,
    /// Length of a bar for an impact.
    bar: f64,
}

/// The scene, as the page has it.
pub fn moving(scene: &Scene) -> serde_json::Result<Moving> {
    let most = scene.counts().into_iter().max().unwrap_or(0).max(1);
    let bar = BAR / most as f64;
    let data = Data { scene, scale: UNIT / scene.spacing, bar };
    let code = |item: &str| format!("../{}", PROGRAM.file(item).unwrap_or_default());
    Ok(Moving {
        name: "Scene of moving masses".into(),
        picture: picture(scene, bar),
        times: [scene.from, scene.until],
        data: serde_json::to_string(&data)?,
        origins: vec![
            ("Data", "data/s02c.csv".into()),
            ("Code", code("experiments::spacetime::scene")),
            ("Experiment", code("experiments::spacetime")),
        ],
    })
}

/// The row at its first moment, and below it the bars of its impacts.
fn picture(scene: &Scene, bar: f64) -> String {
    let shift = |k: usize| MARGIN + BLOCK * k as f64;
    let rest = |k: usize| shift(k) + UNIT * k as f64;
    let (bodies, gaps) = (scene.bodies.len(), scene.bodies.len().saturating_sub(1));
    let width = rest(gaps) + BLOCK + MARGIN;
    let mut out = format!(
        "<svg role=\"img\" aria-labelledby=\"scene-title scene-desc\" viewBox=\"0 0 {width} 740\">\
         <title id=\"scene-title\">Moving masses</title><desc id=\"scene-desc\">{}</desc>\n<g>",
        escape(&description(scene))
    );
    let [one, last] = scene.masses();
    for k in 0..bodies {
        let (number, x) = (scene.first + k, rest(k) + BLOCK / 2.0);
        if number % NAMED == 0 && (one..=last).contains(&number) {
            let _ = write!(out, "<text class=\"fill-ink\" x=\"{x}\" y=\"70\">{number}</text>");
        }
        let _ = write!(out, "<path class=\"stroke-grey\" d=\"M{x} 360v28\"/>");
    }
    out.push_str("</g>\n<g class=\"masses\">");
    let origin = scene.bodies.first().map_or(0.0, |body| body.rest);
    for (k, place) in scene.positions(scene.from).into_iter().enumerate() {
        let x = shift(k) + UNIT * (place - origin) / scene.spacing;
        let own = (one..=last).contains(&(scene.first + k));
        let colour = if own { "ink" } else { "grey" };
        let _ = write!(
            out,
            "<rect class=\"fill-{colour}\" x=\"{x:.1}\" y=\"110\" width=\"{BLOCK}\" height=\"230\"/>"
        );
    }
    out.push_str("</g>\n<g class=\"lights\">");
    for gap in 0..gaps {
        let x = rest(gap + 1);
        let _ = write!(
            out,
            "<line class=\"stroke-red\" x1=\"{x}\" x2=\"{x}\" y1=\"88\" y2=\"362\" opacity=\"0\"/>"
        );
    }
    out.push_str("</g>\n<g class=\"counts\">");
    for (gap, count) in scene.counts().into_iter().enumerate() {
        let x = rest(gap + 1) - UNIT / 2.0;
        let _ = write!(
            out,
            "<rect class=\"fill-pale\" x=\"{left}\" y=\"410\" width=\"60\" height=\"{height}\"/>\
             <rect class=\"now fill-red\" x=\"{left}\" y=\"410\" width=\"60\" height=\"0\"/>\
             <text class=\"fill-ink\" x=\"{x}\" y=\"{below}\">{count}</text>",
            left = x - 30.0,
            height = bar * count as f64,
            below = 410.0 + bar * count as f64 + 70.0,
        );
    }
    out + "</g></svg>"
}

/// What is seen before anything moves, with its numbers.
fn description(scene: &Scene) -> String {
    let places = scene.positions(scene.from);
    let widths = places.windows(2).map(|pair| (pair[1] - pair[0]) / scene.spacing);
    let (narrow, wide) =
        widths.fold((f64::MAX, 0.0_f64), |(low, high), w| (low.min(w), high.max(w)));
    let [one, last] = scene.masses();
    format!(
        "A row of {} blocks, masses {one} to {last} and a neighbour at each end, as they stand at t = {}; the gaps between \
         them are {narrow:.2} d to {wide:.2} d wide. A bar hangs below each gap, as long as the number of its impacts until \
         t = {}, at most {}.",
        scene.bodies.len(),
        scene.from,
        scene.until,
        scene.counts().into_iter().max().unwrap_or(0),
    )
}

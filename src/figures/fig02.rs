//! Draws Fig. 2: the most likely number of impacts against σ, simulated, and the distributions
//! before, at and after its jump.

use super::prelude::*;
use super::simulated::*;
use crate::experiments::{JUMP, Results};
use crate::params::Protocol;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let jumps = results.of(&JUMP)?;
    let n = jumps.gaps();
    let row = format!(
        "jump.windows[transient={},window={}]",
        Protocol::default().transient,
        Protocol::default().window
    );
    let place = results.number(&format!("{row}.place")).ok();
    let sheet = Sheet::new(8300);
    let y = Axis::linear(0.0, 1.15 * n as f64, 20.0, 2, "most likely number of impacts");
    let panel = sheet.lettered("(a)", MAIN, sigma_axis(), y)?.outside(Outside::Cut);
    let peaks = results.table("jump.rows")?.series(&[], "sigma", "peak")?;
    let is_below = |sigma: f64| place.is_none_or(|place| sigma < place);
    let below: Vec<_> = peaks.iter().filter(|(sigma, _)| is_below(*sigma)).collect();
    let bars: Vec<_> =
        below.iter().map(|(s, peak)| (*s, peak.interval[0], peak.interval[1])).collect();
    panel.bars("most likely number", &bars, 40, INTERVAL)?;
    printed(&panel, 1.03 * n as f64)?;
    let mut modes: Vec<_> = below.iter().map(|(sigma, peak)| (*sigma, peak.value)).collect();
    let beyond = peaks.iter().filter(|(sigma, _)| !is_below(*sigma));
    modes.extend(beyond.map(|(sigma, _)| (*sigma, n as f64)));
    panel.markers("most likely number", &modes, CROSSES)?;
    panel.label(&format!("all {n} gaps"), (panel.x.hi, n as f64), (-1, 3), RED)?;
    if let Some(place) = place {
        let level = bars.last().map_or(0.0, |bar| bar.2);
        let guide = Stroke::dashed(RED, THIN, SHORT);
        panel.guide("jump", &[(place, level), (place, n as f64)], guide)?;
        panel.label(
            &format!("jump at *σ* = {}", short(place, 4)),
            (place, 0.86 * n as f64),
            (5, 0),
            RED,
        )?;
    }
    if let Some(bar) = bars.get(bars.len() / 2) {
        panel.label("its 95 % interval", (bar.0, bar.1), (2, 3), GREY)?;
    }

    let table = results.table("jump.distributions")?;
    let sigmas = table.distinct("sigma")?;
    let shares = table.curve(&[], "gaps", "share")?;
    let top = shares.iter().map(|(_, share)| *share).fold(0.0, f64::max);
    let mut heights = Vec::new();
    for (i, sigma) in sigmas.iter().enumerate() {
        let shares = table.curve(&[("sigma", *sigma)], "gaps", "share")?;
        let columns: Vec<f64> = shares.iter().map(|(_, share)| *share).collect();
        let left = 1200 + 2400 * i as i32;
        let x = Axis::linear(0.0, n as f64 + 3.0, 50.0, 5, "gaps");
        let y = Axis::up_to(1.25 * top, "share of chains");
        let y = if i == 0 { y } else { y.without_numbers() };
        let frame = Frame::new(left, 5300, left + 2150, 7400);
        let panel = sheet.lettered(["(b)", "(c)", "(d)"][i], frame, x, y)?.outside(Outside::Cut);
        panel.columns("share of chains", &columns, Stroke::solid(RED, THIN))?;
        panel.label(&format!("*σ* = {}", short(*sigma, 4)), (50.0, 1.18 * top), (0, 0), INK)?;
        let all = shares.last().map_or(0.0, |last| last.1);
        heights.push(format!("{} at σ = {}", short(all, 2), short(*sigma, 4)));
    }
    let description = describe!(
        "(a) Most likely number of gaps that impact against σ: it climbs to about half of {n}, then jumps to all{}; \
         dotted: the printed σ = {}. (b) to (d) Before, at and after, the column of all gaps overtakes the hump: {}.",
        place.map_or(String::new(), |place| format!(" at σ = {}", short(place, 4))),
        printed_threshold(),
        heights.join(", "),
    );
    Ok(sheet.finish("Most likely number of impacts", description))
}

//! Fig. S1: half height and onset against the transient.

use super::prelude::*;
use crate::experiments::Results;
use crate::numerics::statistics::Estimate;

/// Windows of (a) and (c), and their looks.
const WINDOWS: [(f64, Mark, Colour); 3] =
    [(20.0, Mark::Disc, RED), (200.0, Mark::Square, BLUE), (2000.0, Mark::Diamond, GREEN)];

/// The window of (b) and (d).
const WINDOW: f64 = 200.0;

/// The map of the paper's chain, and its long end.
const REST: [&str; 2] = ["protocol.cells", "long_protocol.cells"];

/// Tables of chains, what they are, and their looks.
const STARTS: [(&str, &str, Mark, Colour); 4] = [
    (REST[0], "rest", Mark::Disc, BLUE),
    ("protocols.ring", "rest, on a ring", Mark::Ring, INK),
    ("protocols.random", "random free parts", Mark::Square, RED),
    ("protocols.zero", "on the forced motion", Mark::Diamond, PURPLE),
];

/// The rows: the column of a place, its axis, and its column in data files.
const ROWS: [(&str, &str, &str); 2] = [
    ("half_height_all", "*σ*_{1/2}", "half_height (d omega^2)"),
    ("onset", "*σ*_{0}", "onset (d omega^2)"),
];

/// The line of the bound that no mean over all chains passes.
const BOUND: Stroke = Stroke::dashed(INK, THIN, Dash::Dotted);

/// The tops of the rows.
const TOPS: [i32; 2] = [430, 4680];

/// The top of the legends.
const LEGEND: i32 = 9000;

/// (T, place) of a chain at a window; the long end of the paper's chain follows its map.
fn line(
    results: &Results,
    chain: &'static str,
    window: f64,
    place: &str,
) -> Result<Vec<(f64, Estimate)>, Error> {
    let (map, keys) = (results.table(chain)?, [("window", window)]);
    let mut all = map.estimates(&keys, "transient", place);
    if chain == REST[0] {
        let last = map.values("transient").into_iter().fold(0.0, f64::max);
        let long = results.table(REST[1])?.estimates(&keys, "transient", place);
        all.extend(long.into_iter().filter(|(time, _)| *time > last));
    }
    Ok(all)
}

/// Draws the figure.
pub fn draw(results: &Results, note: Option<&str>) -> Result<Figure, Error> {
    let found = &results.identities;
    // Half of N takes half of the chains, and a twentieth of N a twentieth of them.
    let seeds = [found.sigma_kept_half, found.sigma_kept_onset];
    let sheet = Sheet::new(10_650, note)?;
    for (row, ((place, label, column), seeds)) in ROWS.into_iter().zip(seeds).enumerate() {
        let panel = |place: usize, left: i32, label: &str| {
            let frame = Frame::new(left, TOPS[row], left + 3150, TOPS[row] + 3200);
            let x = Axis::decades(1, 5, 1, "transient *T* (1/*ω*)");
            let y = Axis::linear(0.07, 0.21, 0.02, 2, label).column(column);
            sheet.lettered(LETTERS[2 * row + place], frame, x, y)
        };
        let own = panel(0, 1000, label)?;
        own.level("bound by seeds", seeds, BOUND)?;
        for (window, _, colour) in WINDOWS.into_iter().filter(|_| row == 0) {
            let line = line(results, REST[0], window, "half_height")?;
            let line: Vec<_> = line.iter().map(|(time, own)| (*time, own.value)).collect();
            own.curve(&format!("kept, *W* = {window}"), &line, kept(colour), Outside::Cut)?;
        }
        for (window, mark, colour) in WINDOWS {
            let line = line(results, REST[0], window, place)?;
            estimates(&own, &format!("*W* = {window}"), &line, (mark, colour))?;
        }
        let others = panel(1, 4900, "")?;
        for (chain, what, mark, colour) in STARTS {
            estimates(&others, what, &line(results, chain, WINDOW, place)?, (mark, colour))?;
        }
    }
    let entry = |text: &str, mark: Mark, colour: Colour| {
        let stroke = Stroke::solid(colour, THIN);
        Entry::both(stroke, (mark, MEDIUM, stroke), text)
    };
    let windows = WINDOWS.iter().map(|(w, mark, own)| entry(&format!("*W* = {w}"), *mark, *own));
    let mut entries: Vec<_> = windows.collect();
    entries.push(Entry::line(kept(INK), "mean of the kept"));
    entries.push(Entry::line(BOUND, "bound for the mean of all"));
    sheet.legend((1000, LEGEND), (SMALL, 340), &entries)?;
    let entries = STARTS.map(|(_, what, mark, colour)| entry(what, mark, colour));
    sheet.legend((4900, LEGEND), (SMALL, 340), &entries)?;
    let title = "Half height and onset against the transient";
    Ok(sheet.finish("s01", title, description(results, seeds)?))
}

/// The line of the mean of the kept.
fn kept(colour: Colour) -> Stroke {
    Stroke::dashed(colour, THIN, Dash::Long)
}

fn estimates(
    panel: &Panel,
    name: &str,
    all: &[(f64, Estimate)],
    (mark, colour): (Mark, Colour),
) -> Result<(), Error> {
    let look = (mark, MEDIUM, Stroke::solid(colour, THIN));
    // Two points do not make a curve.
    if all.len() > 2 { panel.joined(name, all, look) } else { panel.estimates(name, all, look) }
}

fn description(results: &Results, seeds: [f64; 2]) -> Result<String, Error> {
    let ends = |place: &str| -> Result<String, Error> {
        let line = line(results, REST[0], WINDOW, place)?;
        let ends = line.first().zip(line.last().filter(|_| line.len() > 1));
        Ok(ends.map_or("none".into(), |(first, last)| {
            format!("from {} to {}", short(first.1.value, 4), short(last.1.value, 4))
        }))
    };
    let [half, onset] = seeds.map(|seeds| short(seeds, 3));
    Ok(format!(
        "Against T: (a) half height of the mean of all, falling with T and with the window towards the \
         level {half}, {} at W = {WINDOW}; dashed, of the kept, below it. (b) Other chains: a ring as the row, random starts later. (c) Onset, \
         {}, above {onset}. (d) Onsets of other chains.",
        ends(ROWS[0].0)?,
        ends(ROWS[1].0)?,
    ))
}

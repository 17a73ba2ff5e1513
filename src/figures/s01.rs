//! Fig. S1: half height and onset against the transient.

use super::prelude::*;
use crate::experiments::Results;
use impact_numerics::statistics::Estimate;

/// The windows, and their looks.
const WINDOWS: [(f64, Mark, Colour, Dash); 3] = [
    (20.0, Mark::Disc, RED, Dash::Short),
    (200.0, Mark::Square, BLUE, Dash::Long),
    (2000.0, Mark::Diamond, GREEN, Dash::Alternate),
];

/// The window of which the description speaks.
const WINDOW: f64 = 200.0;

/// The map of the paper's chain, and its long end.
const REST: [&str; 2] = ["protocol.cells", "long_protocol.cells"];

/// The panels: the column of a place, its axis with its ends and step, and its column in data files.
const PLACES: [(&str, &str, [f64; 3], &str); 2] = [
    (
        "half_height_all",
        "half height *σ*_{1/2} (*d ω*^{2})",
        [0.07, 0.19, 0.02],
        "half_height (d omega^2)",
    ),
    ("onset", "onset *σ*_{0} (*d ω*^{2})", [0.075, 0.12, 0.01], "onset (d omega^2)"),
];

/// The line of the bound that no mean over all chains passes.
const BOUND: Stroke = Stroke::dashed(INK, THIN, Dash::Dotted);

/// (T, place) at a window; the long end follows the map.
fn line(results: &Results, window: f64, place: &str) -> Result<Vec<(f64, Estimate)>, Error> {
    let (map, keys) = (results.table(REST[0])?, [("window", window)]);
    let mut all = map.estimates(&keys, "transient", place);
    let last = map.values("transient").into_iter().fold(0.0, f64::max);
    let long = results.table(REST[1])?.estimates(&keys, "transient", place);
    all.extend(long.into_iter().filter(|(time, _)| *time > last));
    Ok(all)
}

pub fn draw(results: &Results) -> Result<Figure, Error> {
    // Half of N takes half of the chains, and a twentieth of N a twentieth of them.
    let seeds = [
        results.number("theory.relation.sigma_kept_half")?,
        results.number("theory.relation.sigma_kept_onset")?,
    ];
    let sheet = Sheet::new(6_200);
    let (mut entries, mut others) = (Vec::new(), Vec::new());
    for (place, ((column, label, [low, high, step], name), seeds)) in
        PLACES.into_iter().zip(seeds).enumerate()
    {
        let left = [1200, 5250][place];
        let panel = sheet.lettered(
            LETTERS[place],
            Frame::new(left, 430, left + 2900, 3930),
            Axis::decades(1, 5, 1, "transient *T* (1/*ω*)"),
            Axis::linear(low, high, step, 2, label).column(name),
        )?;
        panel.level("bound by seeds", seeds, BOUND)?;
        for (window, _, colour, dash) in WINDOWS.into_iter().filter(|_| place == 0) {
            let line = line(results, window, "half_height")?;
            let line: Vec<_> = line.iter().map(|(time, own)| (*time, own.value)).collect();
            let (name, look) = (named(window), Stroke::dashed(colour, THIN, dash));
            panel.curve(&format!("kept, {name}"), &line, look, Outside::Cut)?;
            others.push(Entry::line(look, &format!("kept, {name}, in (a)")));
        }
        for (window, mark, colour, _) in WINDOWS {
            let (name, look) = (named(window), (mark, MEDIUM, Stroke::solid(colour, THIN)));
            panel.joined(&name, &line(results, window, column)?, look)?;
            if place == 0 {
                entries.push(Entry::both(look.2, look, &name));
            }
        }
    }
    others.push(Entry::line(BOUND, "bound for the mean of all"));
    sheet.legend((1200, 5000), (SMALL, 340), &entries)?;
    sheet.legend((4900, 5000), (SMALL, 340), &others)?;
    let title = "Half height and onset against the transient";
    Ok(sheet.finish("s01", title, description(results, seeds)?))
}

fn named(window: f64) -> String {
    format!("*W* = {window}/*ω*")
}

fn description(results: &Results, seeds: [f64; 2]) -> Result<String, Error> {
    let ends = |place: &str| -> Result<String, Error> {
        let line = line(results, WINDOW, place)?;
        let ends = line.first().zip(line.last().filter(|_| line.len() > 1));
        Ok(ends.map_or("none".into(), |(first, last)| {
            format!("from {} to {}", short(first.1.value, 4), short(last.1.value, 4))
        }))
    };
    let [half, onset] = seeds.map(|seeds| short(seeds, 3));
    Ok(format!(
        "Against T: (a) half height of the mean of all, falling with T and with the window towards the \
         level {half}, {} at W = {WINDOW}; broken, of the kept, below it. (b) Onset, {}, above {onset}.",
        ends(PLACES[0].0)?,
        ends(PLACES[1].0)?,
    ))
}

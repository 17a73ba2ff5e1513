//! Draws Fig. S5: chains from rest and from above after several transients.

use super::prelude::*;
use crate::experiments::PROTOCOL;

/// The window of the half heights.
const WINDOW: f64 = 200.0;

/// The branches: column, name, colour, and symbols for shorter and for the longest chains.
const BRANCHES: [(&str, &str, RGBColor, [Symbol; 2]); 2] = [
    ("from_rest", "from rest", INK, [Symbol::Ring, Symbol::Disc]),
    ("from_above", "from above", ORANGE, [Symbol::OpenSquare, Symbol::Square]),
];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let halves = results.table("branches.half_heights")?;
    let lengths = halves.distinct("masses")?;
    let longest = largest(&lengths);
    let sheet = Sheet::new(8800);
    half_heights(&sheet, results, halves, &lengths)?;
    shares(&sheet, results.table("branches.shares")?, longest)?;
    let ends = |column| -> Result<String, Error> {
        let places = halves.curve(&[("masses", longest)], "transient", column)?;
        let ends = places.first().zip(places.last());
        Ok(ends.map_or("none".into(), |(first, last)| {
            format!("from {} to {}", short(first.1, 3), short(last.1, 3))
        }))
    };
    let description = describe!(
        "(a) Half height against T: from rest it falls, {}; from above it rises, {}. (b) Share of gaps with an impact against σ, \
         early and late: two curves far apart that approach.",
        ends("from_rest")?,
        ends("from_above")?,
    );
    Ok(sheet.finish("Chains from rest and from above", description))
}

fn half_heights(sheet: &Sheet, results: &Results, halves: &Table, lengths: &[f64]) -> Drawn {
    let x = Axis::decades(1, 6, 1, "transient *T* (1/*ω*)").between(10.0, 1.25e5);
    let y = Axis::linear(0.06, 0.14, 0.02, 4, HALF_HEIGHT_LABEL).column("half_height (d omega^2)");
    let panel = sheet.lettered("(a)", Frame::new(1150, 430, 6000, 3930), x, y)?.outside(Cut);
    let masses = results.of(&PROTOCOL)?.first().map_or(0, |map| map.ensemble.chain.masses);
    let rest = format!("from rest, *n* = {masses}");
    let bound = results.number("theory.relation.sigma_kept_half")?;
    panel.level("bound by seeds", bound, Stroke::dashed(INK, THIN, DOTTED))?;
    panel.label(&format!("bound {rest}"), (10.0, bound), (1, 1), INK)?;
    let map = results.table("protocol.cells")?;
    let map = map.curve(&[("window", WINDOW)], "transient", "half_height_all")?;
    panel.curve(&rest.replace('*', ""), &map, Stroke::solid(GREY, LINE))?;
    let mut ends = Vec::new();
    for (place, masses) in lengths.iter().enumerate() {
        let longest = usize::from(place + 1 == lengths.len());
        for (column, name, colour, marks) in BRANCHES {
            let (mark, dash) = (marks[longest], [SHORT, SOLID][longest]);
            let points = halves.series(&[("masses", *masses)], "transient", column)?;
            let look = (mark, MEDIUM, Stroke::dashed(colour, THIN, dash));
            let name = format!("{name}, *n* = {masses}");
            panel.joined_estimates(&name, &points, look)?;
            // The names stand clear of the last symbols.
            let end = points.last().map(|(time, half)| (1.2 * time, half.value));
            ends.push((name, Vec::from_iter(end), colour));
        }
    }
    panel.label_ends(&ends)?;
    panel.label_nearby(&rest, map.get(3).copied().unwrap_or((10.0, bound)), (1, -1), GREY)
}

/// Shares after the first transient and after the last.
fn shares(sheet: &Sheet, shares: &Table, masses: f64) -> Drawn {
    let sigmas = shares.distinct("sigma")?;
    let least = sigmas.iter().copied().fold(f64::INFINITY, f64::min);
    let x = Axis::linear(least - 0.005, largest(&sigmas) + 0.005, 0.01, 2, SIGMA_LABEL);
    let y = Axis::linear(0.0, 1.0, 0.2, 2, "share of gaps with an impact");
    let panel = sheet.lettered("(b)", Frame::new(1150, 5250, 8150, 8000), x, y)?;
    let transients = shares.distinct("transient")?;
    let ends = [transients.first(), transients.last()];
    let mut labels = Vec::new();
    for (place, transient) in ends.into_iter().flatten().enumerate() {
        for (column, name, colour, marks) in BRANCHES {
            let points =
                shares.series(&[("masses", masses), ("transient", *transient)], "sigma", column)?;
            let name = format!("{name}, *T* = {}", in_powers(*transient));
            let look = (marks[1], MEDIUM, Stroke::solid(colour, THIN));
            panel.joined_estimates(&name, &points, look)?;
            // Where a label has room next to its curve.
            let Some((first, last)) = points.first().zip(points.last()) else { continue };
            let (at, side) = match (column, place) {
                // Below its points.
                ("from_above", 1) => ((last.0, first.1.value), (-1, 2)),
                ("from_rest", 0) => {
                    let named = points.iter().find(|point| point.1.value >= 0.2).unwrap_or(last);
                    ((named.0, named.1.value), (2, 1))
                }
                _ => ((last.0, last.1.value), (2, 0)),
            };
            labels.push((name, at, side, colour));
        }
    }
    // Labels keep clear of what is drawn before them.
    for (name, at, side, colour) in labels {
        panel.label_nearby(&name, at, side, colour)?;
    }
    Ok(())
}

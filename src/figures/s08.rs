//! Fig. S8: successive impacts, circuits and different gaps beside independent impacts.

use super::prelude::*;
use crate::experiments::Results;
use crate::table::Table;

/// Looks of the ensembles, by rising σ.
const LOOKS: [(Mark, Colour); 4] = [
    (Mark::Disc, RED),
    (Mark::OpenSquare, ORANGE),
    (Mark::OpenTriangle, PURPLE),
    (Mark::Ring, BLUE),
];

/// The largest length of circuits in (b).
const LONGEST: f64 = 70.0;

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let (near, frequencies) = (table("independence.near")?, table("independence.circuits")?);
    let (blocks, rising) = (table("independence.different")?, table("independence.rising")?);
    let sheet = Sheet::new(8700);
    distances(&sheet, near)?;
    circuits(&sheet, frequencies)?;
    different(&sheet, blocks, *rising.values("gaps").first().unwrap_or(&1.0))?;
    Ok(sheet.finish("s08", "Successive impacts beside independent ones", description(rising)))
}

fn looked(table: &Table) -> Vec<(f64, (Mark, Colour))> {
    // The last look is that of the highest σ, whatever is between.
    let sigmas = table.values("sigma");
    let last = sigmas.len().saturating_sub(1);
    let look = |at: usize| if at == last { LOOKS[3] } else { LOOKS[at.min(2)] };
    sigmas.into_iter().enumerate().map(|(at, sigma)| (sigma, look(at))).collect()
}

fn ends(table: &Table) -> impl Iterator<Item = (f64, (Mark, Colour))> {
    let mut all = looked(table);
    let last = all.pop();
    all.into_iter().take(1).chain(last)
}

fn named(sigma: f64) -> String {
    format!("*σ* = {sigma}")
}

fn distances(sheet: &Sheet, near: &Table) -> Result<(), Error> {
    let x = Axis::linear(-0.5, 12.5, 2.0, 2, "distance |*i* − *j*| from one impact to the next");
    let y = Axis::linear(0.0, 1.6, 0.5, 5, "observed / independent");
    let panel = sheet.lettered(LETTERS[0], Frame::new(1150, 480, 8150, 3380), x, y)?;
    let level = Stroke::solid(INK, LINE);
    panel.level("independent", 1.0, level)?;
    let mut entries = vec![Entry::line(level, "independent")];
    for (sigma, (mark, colour)) in looked(near) {
        let thin = Stroke::solid(colour, THIN);
        let known = near.estimates(&[("sigma", sigma)], "distance", "over_independent");
        panel.estimates(&named(sigma), &known, (mark, MEDIUM, thin))?;
        entries.push(Entry::mark((mark, MEDIUM, thin), &named(sigma)));
    }
    let (line, marks) = entries.split_at(1);
    sheet.legend((3800, 2250), (SMALL, 310), line)?;
    sheet.legend((5900, 2250), (SMALL, 310), marks)
}

fn circuits(sheet: &Sheet, found: &Table) -> Result<(), Error> {
    let x = Axis::linear(0.0, LONGEST, 20.0, 4, "length *k*");
    let y = Axis::decades(-6, -1, 1, "frequency");
    let panel = sheet.lettered(LETTERS[1], Frame::new(1150, 4780, 4450, 7380), x, y)?;
    let line = Stroke::solid(INK, LINE);
    let points = |sigma: f64, column: &str| -> Vec<(f64, f64)> {
        let all = found.points(&[("sigma", sigma)], "k", column).into_iter();
        all.filter(|at| at.0 <= LONGEST).collect()
    };
    let equal = found.values("sigma").first().map(|sigma| points(*sigma, "equal"));
    panel.curve("equal and independent", &equal.unwrap_or_default(), line, Outside::Cut)?;
    let mut entries = vec![Entry::line(line, "equal and independent")];
    for (sigma, (mark, colour)) in ends(found) {
        let thin = Stroke::solid(colour, THIN);
        let look = (mark, MEDIUM * 2 / 3, thin);
        panel.marks(&named(sigma), &points(sigma, "measured"), look, Outside::Cut)?;
        entries.push(Entry::mark((mark, MEDIUM, thin), &named(sigma)));
    }
    sheet.legend_in_columns((300, 8420), (SMALL, 340), (1, 3150), &entries)
}

fn different(sheet: &Sheet, found: &Table, gaps: f64) -> Result<(), Error> {
    let x = Axis::linear(0.0, 3.0, 1.0, 4, "impacts, *m*/*N*");
    let y = Axis::linear(0.0, 1.0, 0.2, 2, "different gaps/*N*");
    let panel = sheet.lettered(LETTERS[2], Frame::new(5550, 4780, 8150, 7380), x, y)?;
    let points = |sigma: f64, column: &str| -> Vec<(f64, f64)> {
        let all = found.points(&[("sigma", sigma)], "impacts", column).into_iter();
        all.map(|(m, own)| (m / gaps, own / gaps)).collect()
    };
    if let Some(sigma) = found.values("sigma").first() {
        let line = Stroke::solid(INK, LINE);
        panel.curve("equal and independent", &points(*sigma, "equal"), line, Outside::Cut)?;
    }
    for (sigma, (mark, colour)) in ends(found) {
        let look = (mark, MEDIUM, Stroke::solid(colour, THIN));
        panel.marks(&named(sigma), &points(sigma, "measured"), look, Outside::Cut)?;
    }
    Ok(())
}

fn description(rising: &Table) -> String {
    let last = |column| rising.values(column).last().map_or("none".into(), |own| short(*own, 2));
    format!(
        "(a) Successions over those of independent impacts: none at distance 0, few at 1, near one beyond. (b) Share of circuits of \
         length k: below equal gaps for short ones, far above for long ones, of mean length {} for {}. (c) Different gaps among m \
         impacts: points below the curve for the smallest σ, above it for the largest.",
        last("length"),
        last("length_equal"),
    )
}

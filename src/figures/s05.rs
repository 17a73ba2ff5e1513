//! Fig. S5: chains of several lengths.

use super::FORCING;
use super::prelude::*;
use crate::experiments::chains::is_length;
use crate::experiments::{CHAINS, Results};
use impact_chain::rise::Counted;
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::Estimate;
use literate::table::Table;

/// Marks and colours of lengths, from the smallest.
const LOOKS: [(Mark, Colour); 4] =
    [(Mark::Ring, PURPLE), (Mark::Disc, BLUE), (Mark::Square, GREEN), (Mark::Diamond, ORANGE)];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let (chains, sizes) = (results.of(&CHAINS)?, results.table("sizes.places")?);
    let window = [("window", chains[0].first().protocol.window)];
    let map = results.table("protocol.cells")?.points(&window, "transient", "half_height_all");
    let sheet = Sheet::new(5500);
    lengths(&sheet, chains)?;
    times(&sheet, results.table("chains.lengths")?, sizes, &map)?;
    Ok(sheet.finish("s05", "Chains of several lengths", description(sizes)))
}

/// The look of a length, by its order of magnitude.
fn look(masses: usize) -> (Mark, i32, Stroke) {
    let tens = pxfm::f_log10(masses as f64).round() as usize;
    let (mark, colour) = LOOKS[tens.saturating_sub(1).min(LOOKS.len() - 1)];
    (mark, MEDIUM, Stroke::solid(colour, THIN))
}

/// A length in words: the longest as a power of ten.
fn length(masses: usize) -> String {
    let tens = masses.checked_ilog10().unwrap_or(0);
    match tens >= 4 && masses == 10_usize.pow(tens) {
        true => format!("*n* = 10^{{{tens}}}"),
        false => format!("*n* = {masses}"),
    }
}

/// The transient that all lengths have.
const COMMON_TIME: f64 = 500.0;

/// How far in σ the marks of a length stand aside of those of a tenth of it: a fifth of a step, says the caption.
const ASIDE: f64 = 0.002;

/// (σ, share) of a curve at a transient.
fn shares(own: &Counted, time: f64) -> Vec<(f64, Estimate)> {
    let gaps = own.ensemble.chain.gaps() as f64 / own.ensemble.pieces as f64;
    let share = |mean: Estimate| with_error(mean.value / gaps, mean.error / gaps);
    let rows = own.curves.iter().filter(|curve| curve.protocol.transient == time);
    rows.flat_map(|curve| &curve.rows)
        .filter_map(|row| Some((row.sigma, share(row.mean_all?.estimate()?))))
        .collect()
}

fn lengths(sheet: &Sheet, chains: &[Counted]) -> Result<(), Error> {
    let x = Axis::linear(0.07, 0.19, 0.04, 4, FORCING);
    let y = Axis::linear(0.0, 1.0, 0.2, 2, "share of the gaps");
    let panel = sheet.lettered(LETTERS[0], Frame::new(1000, 430, 3900, 3730), x, y)?;
    let mut entries = Vec::new();
    for own in chains.iter().filter(|own| is_length(own)) {
        let mut all = shares(own, COMMON_TIME);
        if all.is_empty() {
            continue;
        }
        let masses = own.ensemble.chain.masses;
        let (look, name) = (look(masses), length(masses));
        // Long chains lie on one another: a line for the paper's length, the marks of the others beside it.
        if masses <= 100 {
            panel.joined(&name, &all, look)?;
        } else {
            panel.record(&name, all.clone());
            let aside = ASIDE * f64::from(masses.ilog10() - 2);
            all.iter_mut().for_each(|point| point.0 += aside);
            panel.quiet().estimates(&name, &all, look)?;
        }
        entries.push(Entry::mark(look, &name));
    }
    sheet.legend_in_columns((700, 4720), (SMALL, 340), (3, 1650), &entries)
}

/// Half heights; lengths that were measured anew are shown by these alone.
fn times(sheet: &Sheet, old: &Table, anew: &Table, map: &[(f64, f64)]) -> Result<(), Error> {
    let x = Axis::decades(1, 5, 1, "transient *T* (1/*ω*)");
    let y = Axis::linear(0.08, 0.16, 0.01, 2, "*σ*_{1/2} (*d ω*^{2})")
        .column("half_height (d omega^2)");
    let panel = sheet.lettered(LETTERS[1], Frame::new(5150, 430, 8050, 3730), x, y)?;
    let stroke = Stroke::solid(INK, THIN);
    panel.curve("map", map, stroke, Outside::Cut)?;
    let mut lengths = [old.values("masses"), anew.values("masses")].concat();
    lengths.sort_by(f64::total_cmp);
    lengths.dedup();
    for masses in lengths {
        let own = if anew.values("masses").contains(&masses) { anew } else { old };
        let all = own.estimates(&[("masses", masses)], "transient", "half_height");
        let name = format!("half height of {masses} masses");
        panel.joined(&name, &all, look(masses as usize))?;
    }
    let entry = Entry::line(stroke, "the map, *n* = 100");
    sheet.legend((4900, 4720), (SMALL, 340), &[entry])
}

fn description(sizes: &Table) -> String {
    let longest = sizes.values("masses").into_iter().fold(0.0, f64::max);
    format!(
        "(a) Share of gaps with an impact against σ after one transient: the shortest chain rises later, others, up to {longest} \
         masses, lie on one another. (b) Half height against T, falling the further the longer the chain."
    )
}

//! Fig. S2: gaps that close by themselves, and chains with one of them.

use super::FORCING;
use super::prelude::*;
use crate::experiments::Results;
use literate::table::Table;

/// The σ of (a).
const SIGMAS: (f64, f64) = (0.055, 0.165);

/// Looks of the lengths.
const LENGTHS: [(Colour, Mark); 3] =
    [(GREEN, Mark::Diamond), (RED, Mark::Disc), (PURPLE, Mark::Square)];

/// Looks of the σ in (b).
const TIMES: [(Colour, Mark); 3] =
    [(BLUE, Mark::Disc), (ORANGE, Mark::Square), (RED, Mark::Diamond)];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let (missing, shares) = (table("nucleation.times")?, table("nucleation.shares")?);
    let sheet = Sheet::new(8600);
    chains(&sheet, table("nucleation.chains")?, shares, table("sweep.rows")?)?;
    times(&sheet, missing)?;
    Ok(sheet.finish("s02", "Gaps that close by themselves", description(missing)))
}

fn chains(sheet: &Sheet, found: &Table, shares: &Table, sweep: &Table) -> Result<(), Error> {
    let x = Axis::linear(SIGMAS.0, SIGMAS.1, 0.02, 2, FORCING);
    let y = Axis::linear(0.0, 1.05, 0.2, 2, "share of the chains");
    let panel = sheet.lettered(LETTERS[0], Frame::new(1150, 430, 6150, 3730), x, y)?;
    let mut kept = sweep.points(&[], "sigma", "kept");
    kept.retain(|(sigma, _)| *sigma > SIGMAS.0 && *sigma < SIGMAS.1);
    let kept_look = (Mark::Ring, LARGE, Stroke::solid(INK, THIN));
    panel.marks("kept", &kept, kept_look, Outside::Refuse)?;
    let mut entries = Vec::new();
    let last = found.values("time").last().copied().unwrap_or_default();
    for (masses, (colour, mark)) in found.values("masses").into_iter().zip(LENGTHS) {
        let (name, keys) = (format!("*n* = {masses}"), [("masses", masses), ("time", last)]);
        let line = Stroke::solid(colour, LINE);
        panel.curve(&name, &shares.points(&keys[..1], "sigma", "clumps"), line, Outside::Refuse)?;
        let thin = Stroke::solid(colour, THIN);
        let own = found.estimates(&keys, "sigma", "found");
        panel.record(&format!("{name}, simulation"), own.iter().copied());
        panel.quiet().estimates(&name, &own, (mark, LARGE, thin))?;
        entries.push(Entry::both(line, (mark, LARGE, thin), &name));
    }
    entries.push(Entry::mark(kept_look, "kept, *n* = 100"));
    sheet.legend((6350, 1150), (SMALL, 370), (9, 0), &entries)
}

/// The lowest, the middle and the highest σ.
fn three(found: &Table) -> impl Iterator<Item = f64> {
    let sigmas = found.values("sigma");
    let last = sigmas.len().saturating_sub(1);
    [0, last / 2, last].into_iter().filter_map(move |place| sigmas.get(place).copied())
}

fn times(sheet: &Sheet, found: &Table) -> Result<(), Error> {
    let x = Axis::decades(0, 4, 1, "transient *T* (1/*ω*)").from(8.0, 3e3);
    let y = Axis::decades(-6, 0, 2, "1 − *p*_{*T*}/*p*");
    let panel = sheet.lettered(LETTERS[1], Frame::new(1150, 5250, 8150, 7650), x, y)?;
    let mut entries = Vec::new();
    for (sigma, (colour, mark)) in three(found).zip(TIMES) {
        let name = format!("*σ* = {sigma}");
        let points = found.points(&[("sigma", sigma)], "time", "missing");
        let thin = Stroke::solid(colour, THIN);
        let mark = (mark, LARGE, thin);
        panel.marked(&name, &points, (thin, mark), Outside::Cut)?;
        entries.push(Entry::both(thin, mark, &name));
    }
    // T^{−2} through (10, 10).
    let law = Stroke::dashed(INK, THIN, Dash::Short);
    panel.guide("power", &[(10.0, 10.0), (1e4, 1e-5)], law)?;
    entries.push(Entry::line(law, "∝ *T*^{ −2}"));
    sheet.legend((1400, 6400), (SMALL, 370), (9, 0), &entries)
}

fn description(missing: &Table) -> Seen {
    let sigmas = missing.values("sigma");
    seen!(
        "(a) Share of chains with an impact against σ: measured points on steep curves, farther left for longer chains. (b) What is \
         missing of p after T, for σ from {} to {}: lines like 1/T².",
        sigmas.first().copied().unwrap_or_default(),
        sigmas.last().copied().unwrap_or_default(),
    )
}

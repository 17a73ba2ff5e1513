//! Fig. S3: gaps that close by themselves, and chains with one of them.

use super::axis::{Axis, log};
use super::chart::LETTERS;
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{
    BLUE, Colour, Dash, GREEN, INK, LINE, Mark, ORANGE, PURPLE, RED, SMALL, Stroke, THIN,
};
use super::{DataFile, Error, Figure};
use crate::experiments::Results;
use crate::table::Table;

/// The σ of (a) and (b).
const SIGMAS: (f64, f64) = (0.055, 0.165);

/// Looks of the lengths.
const LENGTHS: [(Colour, Mark); 3] =
    [(GREEN, Mark::Diamond), (RED, Mark::Disc), (PURPLE, Mark::Square)];

/// Looks of the σ in (c).
const TIMES: [(Colour, Mark); 3] =
    [(BLUE, Mark::Disc), (ORANGE, Mark::Square), (RED, Mark::Diamond)];

/// The half size of marks.
const SIZE: i32 = 58;

/// Draws the figure.
pub fn draw(results: &Results, note: Option<&str>) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let (found, single) = (table("nucleation.chains")?, table("nucleation.gaps")?);
    let missing = table("nucleation.times")?;
    let (curves, shares) = (table("nucleation.curves")?, table("nucleation.shares")?);
    let sheet = Sheet::new(9350, note)?;
    chains(&sheet, found, shares, table("sweep.rows")?)?;
    gaps(&sheet, curves)?;
    times(&sheet, missing)?;
    let files = [found, shares, single, curves, missing].map(DataFile::of);
    let title = "Gaps that close by themselves";
    Ok(sheet.finish("s03", title, description(missing), files.into()))
}

fn chains(sheet: &Sheet, found: &Table, shares: &Table, sweep: &Table) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 430, 6150, 3730),
        Axis::linear(SIGMAS.0, SIGMAS.1, 0.02, 2, "standard deviation *σ* of the forcing"),
        Axis::linear(0.0, 1.05, 0.2, 2, "share of the chains"),
    )?;
    panel.letter(LETTERS[0])?;
    let mut entries = Vec::new();
    let last = found.values("time").last().copied().unwrap_or_default();
    for (masses, (colour, mark)) in found.values("masses").into_iter().zip(LENGTHS) {
        let (name, keys) = (format!("*n* = {masses}"), [("masses", masses), ("time", last)]);
        let line = Stroke::solid(colour, LINE);
        panel.curve(&name, &shares.points(&keys[..1], "sigma", "clumps"), line, Outside::Refuse)?;
        let thin = Stroke::solid(colour, THIN);
        let own = found.estimates(&keys, "sigma", "found");
        let bars = own.iter().map(|(sigma, own)| {
            (*sigma, (own.value - own.error).max(0.0), (own.value + own.error).min(1.0))
        });
        panel.bars(&name, &bars.collect::<Vec<_>>(), 35, thin)?;
        let points = found.points(&keys, "sigma", "found");
        panel.marks(&name, &points, (mark, SIZE, thin), Outside::Refuse)?;
        entries.push(Entry { line: Some(line), mark: Some((mark, SIZE, thin)), text: name });
    }
    let mut kept = sweep.points(&[], "sigma", "kept");
    kept.retain(|(sigma, _)| *sigma > SIGMAS.0 && *sigma < SIGMAS.1);
    let look = (Mark::Ring, SIZE, Stroke::solid(INK, THIN));
    panel.marks("kept", &kept, look, Outside::Refuse)?;
    entries.push(Entry::mark(look.0, look.1, look.2, "kept, *n* = 100"));
    sheet.legend((6350, 1150), (SMALL, 370), &entries)
}

fn gaps(sheet: &Sheet, curves: &Table) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 5250, 4050, 7650),
        Axis::linear(SIGMAS.0, SIGMAS.1, 0.04, 2, "*σ*"),
        Axis::decades(-8, 0, 2, "*p*"),
    )?;
    panel.letter(LETTERS[1])?;
    let lines = [
        ("from rest", "p", Stroke::solid(INK, LINE)),
        ("at a wall", "wall", Stroke::dashed(GREEN, LINE, Dash::Long)),
        ("Eq. (25)", "random", Stroke::dashed(BLUE, LINE, Dash::Short)),
        ("no free part", "zero", Stroke::dashed(PURPLE, LINE, Dash::Dotted)),
    ];
    let mut entries = Vec::new();
    for (name, column, stroke) in lines {
        let points = curves.points(&[], "sigma", column).into_iter();
        let points: Vec<_> = points.map(|(sigma, p)| (sigma, log(p))).collect();
        panel.curve(name, &points, stroke, Outside::Cut)?;
        entries.push(Entry::line(stroke, name));
    }
    for (i, column) in entries.chunks(2).enumerate() {
        sheet.legend((650 + 2250 * i as i32, 8750), (SMALL, 370), column)?;
    }
    Ok(())
}

/// The lowest, the middle and the highest σ.
fn three(found: &Table) -> impl Iterator<Item = f64> {
    let sigmas = found.values("sigma");
    let last = sigmas.len().saturating_sub(1);
    [0, last / 2, last].into_iter().filter_map(move |place| sigmas.get(place).copied())
}

fn times(sheet: &Sheet, found: &Table) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5350, 5250, 8150, 7650),
        Axis::decades(1, 4, 1, "*T* (1/*ω*)"),
        Axis::decades(-6, 0, 2, "1 − *p*_{*T*}/*p*"),
    )?;
    panel.letter(LETTERS[2])?;
    let mut entries = Vec::new();
    for (sigma, (colour, mark)) in three(found).zip(TIMES) {
        let name = format!("*σ* = {sigma}");
        let points: Vec<_> = found
            .points(&[("sigma", sigma)], "time", "missing")
            .into_iter()
            .filter(|(_, part)| *part > 0.0)
            .map(|(time, part)| (log(time), log(part)))
            .collect();
        let thin = Stroke::solid(colour, THIN);
        panel.curve(&name, &points, thin, Outside::Cut)?;
        panel.marks(&name, &points, (mark, SIZE, thin), Outside::Cut)?;
        let mark = Some((mark, SIZE, thin));
        entries.push(Entry { line: Some(thin), mark, text: name });
    }
    // T^{−2} through (10, 10).
    let law = Stroke::dashed(INK, THIN, Dash::Short);
    panel.curve("power", &[(1.0, 1.0), (4.0, -5.0)], law, Outside::Cut)?;
    entries.push(Entry::line(law, "∝ *T*^{ −2}"));
    for (i, column) in entries.chunks(2).enumerate() {
        sheet.legend((5100 + 1650 * i as i32, 8750), (SMALL, 370), column)?;
    }
    Ok(())
}

fn description(missing: &Table) -> String {
    let sigmas = missing.values("sigma");
    format!(
        "(a) Share of chains with an impact against σ: measured points on steep curves, farther left for longer chains. (b) The \
         probability p of a gap: highest from rest, then Eq. (25), at a wall, without a free part. (c) What is missing of p after \
         T, for σ from {} to {}: lines like 1/T².",
        sigmas.first().copied().unwrap_or_default(),
        sigmas.last().copied().unwrap_or_default(),
    )
}

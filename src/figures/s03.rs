//! Draws Fig. S3: gaps that close by themselves, and chains with one of them.

use super::prelude::*;

/// The σ of (a).
const SIGMAS: (f64, f64) = (0.055, 0.165);

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let (missing, shares) = (table("nucleation.times")?, table("nucleation.shares")?);
    let masses = results.number("sweep.run.gaps")? as usize - 1;
    let sheet = Sheet::new(8600);
    chains(&sheet, table("nucleation.chains")?, shares, table("sweep.rows")?, masses)?;
    times(&sheet, missing)?;
    let sigmas = missing.distinct("sigma")?;
    let description = describe!(
        "(a) Share of chains with an impact against σ: measured points on steep curves, farther left for longer chains. (b) What is \
         missing of p after T, for σ from {} to {}: lines like 1/T².",
        sigmas.first().copied().unwrap_or_default(),
        sigmas.last().copied().unwrap_or_default(),
    );
    Ok(sheet.finish("Gaps that close by themselves", description))
}

fn chains(sheet: &Sheet, found: &Table, shares: &Table, sweep: &Table, masses: usize) -> Drawn {
    let x = Axis::linear(SIGMAS.0, SIGMAS.1, 0.02, 2, SIGMA_LABEL);
    let y = Axis::linear(0.0, 1.05, 0.2, 2, "share of chains with an impact");
    let panel = sheet.lettered("(a)", Frame::new(1150, 430, 8150, 3730), x, y)?;
    let mut active = sweep.curve(&[], "sigma", "kept")?;
    active.retain(|(sigma, _)| *sigma > SIGMAS.0 && *sigma < SIGMAS.1);
    panel.markers(Look::SHARE.name, &active, Look::SHARE.mark)?;
    let last = found.distinct("time")?.last().copied().unwrap_or_default();
    let lengths = found.distinct("masses")?;
    for (i, &masses) in lengths.iter().enumerate() {
        let colour = ordered(i, lengths.len());
        let (name, keys) = (format!("*n* = {masses}"), [("masses", masses), ("time", last)]);
        let curve = shares.curve(&keys[..1], "sigma", "clumps")?;
        panel.curve(&name, &curve, Stroke::solid(colour, LINE))?;
        let marks = found.series(&keys, "sigma", "found")?;
        panel.record(&format!("{name}, simulation"), marks.iter().copied());
        let disc = (Symbol::Disc, LARGE, Stroke::solid(colour, THIN));
        panel.unrecorded().estimates(&name, &marks, disc)?;
        let rising: Vec<_> = curve.into_iter().map(|(sigma, share)| (share, sigma)).collect();
        let (height, side) = if i == 0 { (0.3, (1, 1)) } else { (0.6, (-3, 0)) };
        let place = (interpolate(&rising, height).unwrap_or(SIGMAS.0), height);
        panel.label(&name, place, side, colour)?;
    }
    let Some((sigma, share)) = active.iter().rfind(|point| point.1 < 0.9) else { return Ok(()) };
    let leader = [(sigma + 0.001, share - 0.03), (sigma + 0.004, share - 0.1)];
    panel.guide("leader", &leader, Stroke::solid(RED, HAIR))?;
    panel.label(&format!("main sweep, *n* = {masses}"), leader[1], (1, 1), RED)
}

fn times(sheet: &Sheet, found: &Table) -> Drawn {
    let x = Axis::decades(0, 4, 1, "time *T* (1/*ω*)").between(8.0, 3e3);
    let y = Axis::decades(-6, 0, 2, "1 − *p*_{*T*}/*p*_{rest}");
    let panel = sheet.lettered("(b)", Frame::new(1150, 5250, 7150, 7650), x, y)?.outside(Cut);
    let sigmas = found.distinct("sigma")?;
    let three = [sigmas.first().copied(), Some(printed_threshold()), sigmas.last().copied()];
    let mut drawn = Vec::new();
    for (place, sigma) in three.into_iter().flatten().enumerate() {
        let colour = ordered(place, 3);
        let points = found.curve(&[("sigma", sigma)], "time", "missing")?;
        let thin = Stroke::solid(colour, THIN);
        let name = format!("*σ* = {sigma}");
        panel.marked_curve(&name, &points, thin, (Symbol::Disc, LARGE, thin))?;
        // The names stand clear of the last discs.
        let ends = points.into_iter().map(|(time, missing)| (1.1 * time, missing));
        drawn.push((name, ends.collect::<Vec<_>>(), colour));
    }
    panel.label_ends(&drawn)?;
    // T^{−2} through (10, 0.1).
    panel.guide("power", &[(10.0, 0.1), (1e4, 1e-7)], Stroke::dashed(INK, THIN, SHORT))?;
    panel.label("∝ *T*^{ −2}", (60.0, 2.8e-3), (-1, 1), INK)
}

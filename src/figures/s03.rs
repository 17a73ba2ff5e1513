//! Fig. S3: gaps that close by themselves, and chains with one of them.

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::data::cells;
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{
    BLUE, Colour, Dash, GREEN, INK, LINE, Mark, ORANGE, PURPLE, RED, SMALL, Stroke, THIN,
};
use super::{DataFile, Error, Figure};
use crate::experiments::nucleation::{Chains, Gaps, Nucleation};
use crate::experiments::sweep::Sweep;

/// The σ of (a) and (b).
const SIGMAS: (f64, f64) = (0.055, 0.165);

/// Looks of the lengths.
const LENGTHS: [(Colour, Mark); 3] =
    [(GREEN, Mark::Diamond), (RED, Mark::Disc), (PURPLE, Mark::Square)];

/// Looks of the σ in (c).
const TIMES: [Colour; 3] = [BLUE, ORANGE, RED];

/// The half size of marks.
const SIZE: i32 = 58;

/// Draws the figure.
pub fn draw(found: &Nucleation, sweep: &Sweep, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(9350, note)?;
    chains(&sheet, found, sweep)?;
    gaps(&sheet, found)?;
    times(&sheet, found)?;
    let files = tables(found);
    Ok(sheet.finish_own(3, "Gaps that close by themselves", description(found), files))
}

/// The chains of each length.
fn lengths(found: &Nucleation) -> impl Iterator<Item = &[Chains]> {
    found.chains.chunk_by(|a, b| a.masses == b.masses)
}

/// Share and its binomial error, from the expected share.
fn share(own: &Chains) -> (f64, f64) {
    let n = own.realisations as f64;
    let p = own.hit.last().copied().unwrap_or(0) as f64 / n;
    (p, (p * (1.0 - p) / n).sqrt())
}

fn chains(sheet: &Sheet, found: &Nucleation, sweep: &Sweep) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 430, 6150, 3730),
        Axis::linear(SIGMAS.0, SIGMAS.1, 0.02, 2, "standard deviation *σ* of the forcing"),
        Axis::linear(0.0, 1.05, 0.2, 2, "share of the chains"),
    )?;
    panel.letter(LETTERS[0])?;
    let mut entries = Vec::new();
    for (own, (colour, mark)) in lengths(found).zip(LENGTHS) {
        let name = format!("*n* = {}", own.first().map_or(0, |chains| chains.masses));
        let expected = own.iter().filter_map(|row| Some((row.sigma, row.expected.last()?.value)));
        let line = Stroke::solid(colour, LINE);
        panel.curve(&name, &expected.collect::<Vec<_>>(), line, Outside::Refuse)?;
        let thin = Stroke::solid(colour, THIN);
        let bar = |row: &Chains| {
            let (p, error) = share(row);
            (row.sigma, (p - error).max(0.0), (p + error).min(1.0))
        };
        panel.bars(&name, &own.iter().map(bar).collect::<Vec<_>>(), 35, thin)?;
        let points: Vec<_> = own.iter().map(|row| (row.sigma, share(row).0)).collect();
        panel.marks(&name, &points, (mark, SIZE, thin), Outside::Refuse)?;
        entries.push(Entry { line: Some(line), mark: Some((mark, SIZE, thin)), text: name });
    }
    let kept: Vec<_> = sweep
        .rows
        .iter()
        .filter(|row| row.sigma > SIGMAS.0 && row.sigma < SIGMAS.1)
        .map(|row| {
            let ran = (row.realisations - row.rejected - row.failed).max(1);
            (row.sigma, row.kept as f64 / ran as f64)
        })
        .collect();
    let look = (Mark::Ring, SIZE, Stroke::solid(INK, THIN));
    panel.marks("kept", &kept, look, Outside::Refuse)?;
    entries.push(Entry::mark(look.0, look.1, look.2, "kept, *n* = 100"));
    sheet.legend((6350, 1150), (SMALL, 370), &entries)
}

/// A number of gaps.
type Of = fn(&Gaps) -> f64;

fn gaps(sheet: &Sheet, found: &Nucleation) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 5250, 4050, 7650),
        Axis::linear(SIGMAS.0, SIGMAS.1, 0.04, 2, "*σ*"),
        Axis::decades(-8, 0, 2, "*p*"),
    )?;
    panel.letter(LETTERS[1])?;
    let curves: [(&str, Of, Stroke); 4] = [
        ("from rest", |row| row.ever.p, Stroke::solid(INK, LINE)),
        ("at a wall", |row| row.ever.wall, Stroke::dashed(GREEN, LINE, Dash::Long)),
        ("Eq. (25)", |row| row.random, Stroke::dashed(BLUE, LINE, Dash::Short)),
        ("no free part", |row| row.zero, Stroke::dashed(PURPLE, LINE, Dash::Dotted)),
    ];
    let mut entries = Vec::new();
    for (name, p, stroke) in curves {
        let points: Vec<_> = found.gaps.iter().map(|row| (row.sigma, log(p(row)))).collect();
        panel.curve(name, &points, stroke, Outside::Cut)?;
        entries.push(Entry::line(stroke, name));
    }
    for (i, column) in entries.chunks(2).enumerate() {
        sheet.legend((650 + 2250 * i as i32, 8750), (SMALL, 370), column)?;
    }
    Ok(())
}

/// What is missing of p at some σ: lowest, middle, highest.
fn missing(found: &Nucleation) -> impl Iterator<Item = (&Gaps, Vec<(f64, f64)>)> {
    let last = found.gaps.len().saturating_sub(1);
    [0, last / 2, last].into_iter().filter_map(|i| {
        let row = found.gaps.get(i)?;
        let part = |own: f64| 1.0 - own / row.ever.p;
        let times = found.parameters.times.iter().zip(&row.within);
        Some((row, times.map(|(time, own)| (*time, part(own.p))).collect()))
    })
}

fn times(sheet: &Sheet, found: &Nucleation) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5350, 5250, 8150, 7650),
        Axis::decades(1, 4, 1, "*T*"),
        Axis::decades(-6, 0, 2, "1 − *p*_{*T*}/*p*"),
    )?;
    panel.letter(LETTERS[2])?;
    let mut entries = Vec::new();
    for ((row, points), colour) in missing(found).zip(TIMES) {
        let name = format!("*σ* = {}", row.sigma);
        let points: Vec<_> = points
            .into_iter()
            .filter(|(_, part)| *part > 0.0)
            .map(|(time, part)| (log(time), log(part)))
            .collect();
        let thin = Stroke::solid(colour, THIN);
        panel.curve(&name, &points, thin, Outside::Cut)?;
        panel.marks(&name, &points, (Mark::Disc, SIZE, thin), Outside::Cut)?;
        let mark = Some((Mark::Disc, SIZE, thin));
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

fn description(found: &Nucleation) -> String {
    let of = |own: &[Chains]| {
        let told: Vec<String> = own
            .iter()
            .map(|row| {
                let expected = row.expected.last().map_or(0.0, |own| own.value);
                format!("{} of {} at σ = {}", short(share(row).0, 2), short(expected, 2), row.sigma)
            })
            .collect();
        let masses = own.first().map_or(0, |row| row.masses);
        format!("n = {masses}: {}", told.join(", "))
    };
    let at_end: Vec<String> = missing(found)
        .filter_map(|(row, points)| {
            let (time, part) = *points.last()?;
            Some(format!("{} at T = {time} for σ = {}", short(part, 2), row.sigma))
        })
        .collect();
    format!(
        "(a) Share of chains with an impact against σ, a steep curve from 0 to 1 for each number of masses, \
         the longer the chain the farther to the left, with measured points on it; found and expected, {}. \
         Rings, for the kept of the main sweep, lie on the curve of the same length. (b) The probability p that a gap \
         closes by itself, on a logarithmic axis: highest for a start from rest between masses, then \
         Eq. (25), the start from rest at a wall, and a start without free part. (c) The share of p that \
         is missing at the time T, on logarithmic axes: lines that fall like T to the power −2, to {}.",
        lengths(found).map(of).collect::<Vec<_>>().join("; "),
        at_end.join(", ")
    )
}

fn tables(found: &Nucleation) -> Vec<DataFile> {
    let mut chains = DataFile::new(
        "s03.csv",
        &[
            "masses (1)",
            "sigma (d omega^2)",
            "realisations (1)",
            "able (1)",
            "time (1/omega)",
            "with_impact (1)",
            "expected_share (1)",
            "bound (1)",
            "independent (1)",
        ],
    );
    for row in &found.chains {
        let times = found.parameters.times.iter().zip(&row.hit).zip(&row.expected);
        for ((time, hit), expected) in times {
            chains.row(cells![
                row.masses,
                row.sigma,
                row.realisations as usize,
                row.able as usize,
                *time,
                *hit as usize,
                expected.value,
                expected.bound,
                expected.independent
            ]);
        }
    }
    let mut gaps = DataFile::new(
        "s03b.csv",
        &[
            "sigma (d omega^2)",
            "p_rest (1)",
            "p_rest_wall (1)",
            "pair (1)",
            "wall_pair (1)",
            "p_random (1)",
            "p_zero (1)",
        ],
    );
    for row in &found.gaps {
        let own = row.ever;
        gaps.row(cells![row.sigma, own.p, own.wall, own.pair, own.wall_pair, row.random, row.zero]);
    }
    let mut times =
        DataFile::new("s03c.csv", &["sigma (d omega^2)", "time (1/omega)", "missing (1)"]);
    for (row, points) in missing(found) {
        points.into_iter().for_each(|(time, part)| times.row(cells![row.sigma, time, part]));
    }
    vec![chains, gaps, times]
}

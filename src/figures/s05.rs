//! Fig. S5: long chains, friction, and a force with a common period.

use super::axis::{Axis, log};
use super::chart::LETTERS;
use super::data::cells;
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{
    BLUE, Colour, Dash, GREEN, INK, LINE, Mark, ORANGE, PURPLE, RED, SMALL, Stroke, THIN,
};
use super::{DataFile, Error, Figure};
use crate::experiments::chains::{Chains, Curve, Ensemble};
use crate::experiments::protocol::ProtocolMap;
use crate::numerics::statistics::Estimate;
use crate::params::{ChainCurve, ChainKind};
use std::collections::BTreeMap;

/// Marks and colours of lengths and of frictions, from the smallest.
const LOOKS: [(Mark, Colour); 6] = [
    (Mark::Ring, PURPLE),
    (Mark::Disc, BLUE),
    (Mark::Square, GREEN),
    (Mark::Diamond, ORANGE),
    (Mark::Disc, RED),
    (Mark::Ring, INK),
];

/// The half size of marks.
const SIZE: i32 = 52;

/// The frequency of (d).
const COMMON: &str = "frequency-2";

/// Draws the figure.
pub fn draw(
    chains: &Chains,
    sizes: &Chains,
    map: &ProtocolMap,
    note: Option<&str>,
) -> Result<Figure, Error> {
    let sheet = Sheet::new(10_800, note)?;
    lengths(&sheet, chains)?;
    times(&sheet, &by_length(chains, sizes), &of_map(chains, map))?;
    frictions(&sheet, chains, map)?;
    period(&sheet, chains)?;
    let title = "Long chains, friction, and a common period";
    Ok(sheet.finish("s05", title, description(sizes), tables(chains, sizes, map)))
}

/// The look of a length, by its order of magnitude.
fn look(masses: usize) -> (Mark, i32, Stroke) {
    let tens = pxfm::f_log10(masses as f64).round() as usize;
    let (mark, colour) = LOOKS[tens.saturating_sub(1).min(LOOKS.len() - 1)];
    (mark, SIZE, Stroke::solid(colour, THIN))
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

/// How far in σ the marks of a length stand aside of those of a tenth of it.
const ASIDE: f64 = 0.0018;

/// (σ, share) of a curve at a transient.
fn shares(own: &ChainCurve, curve: &Curve, time: f64) -> Vec<(f64, Estimate)> {
    let Some(at) = own.transients.iter().position(|own| *own == time) else { return Vec::new() };
    curve.rows.iter().filter_map(|row| Some((row.sigma, row.shares[at]?))).collect()
}

fn points(all: &[(f64, Estimate)]) -> Vec<(f64, f64)> {
    all.iter().map(|(x, own)| (*x, own.value)).collect()
}

fn lengths(sheet: &Sheet, chains: &Chains) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1000, 430, 3900, 3730),
        Axis::linear(0.07, 0.19, 0.03, 3, "*σ*"),
        Axis::linear(0.0, 1.0, 0.2, 2, "share of the gaps"),
    )?;
    panel.letter(LETTERS[0])?;
    let mut entries = Vec::new();
    for (own, curve) in chains.of(ChainKind::Length) {
        let mut all = shares(own, curve, COMMON_TIME);
        if all.is_empty() {
            continue;
        }
        let look = look(own.masses);
        let name = length(own.masses);
        // Long chains lie on one another: a line for the paper's length, the marks of the others beside it.
        if own.masses <= 100 {
            panel.curve(&name, &points(&all), look.2, Outside::Cut)?;
        } else {
            let aside = ASIDE * f64::from(own.masses.ilog10() - 2);
            all.iter_mut().for_each(|point| point.0 += aside);
        }
        panel.estimates(&name, &all, look, |y| y)?;
        entries.push(Entry::mark(look.0, look.1, look.2, &name));
    }
    for (i, column) in entries.chunks(3).enumerate() {
        sheet.legend((700 + 1650 * i as i32, 4720), (SMALL, 340), column)?;
    }
    Ok(())
}

/// (T, half height) of the map.
fn of_map(chains: &Chains, map: &ProtocolMap) -> Vec<(f64, Estimate)> {
    let window = chains.parameters.window;
    let cells = map.cells.iter().filter(|cell| cell.window == window);
    cells.filter_map(|cell| Some((cell.transient, cell.half_height_all?))).collect()
}

/// (T, half height) of a curve.
fn halves(own: &ChainCurve, curve: &Curve) -> Vec<(f64, Estimate)> {
    let all = own.transients.iter().zip(&curve.half_heights);
    all.filter_map(|(time, half)| Some((*time, (*half)?))).collect()
}

fn logarithmic(all: Vec<(f64, Estimate)>) -> Vec<(f64, Estimate)> {
    all.into_iter().map(|(time, half)| (log(time), half)).collect()
}

/// (T, half height) of each length, of those that were measured anew by these alone.
fn by_length(chains: &Chains, sizes: &Chains) -> BTreeMap<usize, Vec<(f64, Estimate)>> {
    let anew = |masses| sizes.all().any(|(own, _)| own.masses == masses);
    let others = chains.of(ChainKind::Length).filter(|(own, _)| !anew(own.masses));
    let mut all = BTreeMap::<usize, Vec<(f64, Estimate)>>::new();
    for (own, curve) in others.chain(sizes.all()) {
        all.entry(own.masses).or_default().extend(halves(own, curve));
    }
    all
}

fn times(
    sheet: &Sheet,
    lengths: &BTreeMap<usize, Vec<(f64, Estimate)>>,
    map: &[(f64, Estimate)],
) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5150, 430, 8050, 3730),
        Axis::decades(1, 5, 1, "transient *T* (1/*ω*)"),
        Axis::linear(0.08, 0.16, 0.01, 2, "*σ*_{1/2}"),
    )?;
    panel.letter(LETTERS[1])?;
    let stroke = Stroke::solid(INK, THIN);
    let line = logarithmic(map.to_vec());
    panel.curve("map", &points(&line), stroke, Outside::Cut)?;
    for (masses, all) in lengths {
        let (name, look) = (format!("half height of {masses} masses"), look(*masses));
        let all = logarithmic(all.clone());
        panel.curve(&name, &points(&all), look.2, Outside::Cut)?;
        panel.estimates(&name, &all, look, |y| y)?;
    }
    let entry = Entry::line(stroke, "the map, *n* = 100");
    sheet.legend((4900, 4720), (SMALL, 340), &[entry])
}

fn frictions(sheet: &Sheet, chains: &Chains, map: &ProtocolMap) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1000, 5900, 3900, 8900),
        Axis::decades(1, 4, 1, "transient *T* (1/*ω*)"),
        Axis::linear(0.09, 0.16, 0.01, 2, "*σ*_{1/2}"),
    )?;
    panel.letter(LETTERS[2])?;
    let stroke = Stroke::solid(INK, THIN);
    let line = logarithmic(of_map(chains, map));
    panel.curve("without friction", &points(&line), stroke, Outside::Cut)?;
    let mut entries = vec![Entry::line(stroke, "*c* = 0")];
    for ((own, curve), (mark, colour)) in chains.of(ChainKind::Damping).zip(&LOOKS[1..]) {
        let look = (*mark, SIZE, Stroke::solid(*colour, THIN));
        let name = format!("*c* = {}", own.damping);
        let all = logarithmic(halves(own, curve));
        panel.curve(&name, &points(&all), look.2, Outside::Cut)?;
        panel.estimates(&name, &all, look, |y| y)?;
        entries.push(Entry::mark(look.0, look.1, look.2, &name));
    }
    for (i, column) in entries.chunks(2).enumerate() {
        sheet.legend((600 + 1750 * i as i32, 9880), (SMALL, 340), column)?;
    }
    Ok(())
}

/// The share of the chains with an impact in the last window, with its binomial error.
fn alive(row: &Ensemble) -> (f64, Estimate) {
    let all = row.runs.len().max(1) as f64;
    let share = 1.0 - row.silent.iter().sum::<u64>() as f64 / all;
    let error = (share * (1.0 - share) / all).sqrt();
    (row.sigma, crate::numerics::estimates::with_error(share, error))
}

fn period(sheet: &Sheet, chains: &Chains) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5150, 5900, 8050, 8900),
        Axis::linear(0.2, 0.44, 0.1, 2, "*σ*"),
        Axis::linear(0.0, 1.0, 0.2, 2, "share of the chains"),
    )?;
    panel.letter(LETTERS[3])?;
    let Some((_, curve)) = chains.curve(COMMON) else { return Ok(()) };
    let line = |of: fn(&[f64; 3]) -> f64| -> Vec<(f64, f64)> {
        curve.kept_expected.iter().map(|own| (own[0], of(own))).collect()
    };
    let (bound, there) = (Stroke::dashed(BLUE, LINE, Dash::Short), Stroke::solid(INK, LINE));
    panel.curve("all phases", &line(|own| own[1]), bound, Outside::Cut)?;
    panel.curve("common period", &line(|own| own[2]), there, Outside::Cut)?;
    let all: Vec<_> = curve.rows.iter().map(alive).collect();
    let look = (Mark::Disc, SIZE, Stroke::solid(RED, THIN));
    panel.estimates("simulation", &all, look, |y| y)?;
    let entries = [
        Entry::line(bound, "all phases, Eq. (20)"),
        Entry::line(there, "common period"),
        Entry::mark(look.0, look.1, look.2, "simulation"),
    ];
    sheet.legend((4900, 9880), (SMALL, 340), &entries)
}

fn description(sizes: &Chains) -> String {
    let longest = sizes.all().map(|(own, _)| own.masses).max().unwrap_or_default();
    format!(
        "(a) Share of gaps with an impact against σ after one transient: the shortest chain rises later, others, up to {longest} \
         masses, lie on one another. (b) Half height against T, falling the further the longer the chain. (c) With friction: higher \
         and more level. (d) Chains with an impact for Ω = 2: on the lower of two curves."
    )
}

fn tables(chains: &Chains, sizes: &Chains, map: &ProtocolMap) -> Vec<DataFile> {
    let mut shares = DataFile::new(
        "s05a.csv",
        &[
            "chain (text)",
            "masses (1)",
            "damping (omega)",
            "forcing_frequency (omega)",
            "components (1)",
            "sigma (d omega^2)",
            "transient (1/omega)",
            "share (1)",
            "standard_error (1)",
            "chains_with_impacts (1)",
        ],
    );
    let mut places = DataFile::new(
        "s05b.csv",
        &[
            "chain (text)",
            "masses (1)",
            "damping (omega)",
            "transient (1/omega)",
            "half_height (d omega^2)",
            "standard_error (d omega^2)",
        ],
    );
    for (own, curve) in chains.all().chain(sizes.all()) {
        let name = own.name.as_str();
        for row in &curve.rows {
            for (time, share) in own.transients.iter().zip(&row.shares) {
                let share = share.as_ref();
                shares.row(cells![
                    name,
                    own.masses,
                    own.damping,
                    own.forcing_frequency,
                    own.components,
                    row.sigma,
                    *time,
                    share.map(|own| own.value),
                    share.map(|own| own.error),
                    alive(row).1.value
                ]);
            }
        }
        for (time, half) in halves(own, curve) {
            places.row(cells![name, own.masses, own.damping, time, half.value, half.error]);
        }
    }
    for (time, half) in of_map(chains, map) {
        let masses = map.parameters.chain.masses;
        places.row(cells!["map", masses, 0.0, time, half.value, half.error]);
    }
    let mut expected = DataFile::new(
        "s05d.csv",
        &["chain (text)", "sigma (d omega^2)", "share_all_phases (1)", "share_common_period (1)"],
    );
    for (own, curve) in chains.of(ChainKind::Frequency) {
        for [sigma, ever, there] in &curve.kept_expected {
            expected.row(cells![own.name.as_str(), *sigma, *ever, *there]);
        }
    }
    vec![shares, places, expected]
}

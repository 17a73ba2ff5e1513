//! Fig. S10: the rise, the heat and contact at several restitutions.

use super::axis::{Axis, log};
use super::chart::short;
use super::data::cells;
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{
    BLUE, Colour, Dash, GREEN, INK, LINE, Mark, ORANGE, PURPLE, RED, SMALL, Stroke, THIN,
};
use super::{DataFile, Error, Figure};
use crate::experiments::restitution::{Curve, Ensemble, Restitution, steady};
use crate::numerics::statistics::Estimate;
use crate::params::Chain;

/// The half size of marks.
const SIZE: i32 = 52;

/// Restitutions of (a), and their looks.
const RISES: [(f64, Mark, Colour); 5] = [
    (0.0, Mark::Disc, RED),
    (0.4, Mark::OpenSquare, ORANGE),
    (0.6, Mark::OpenTriangle, PURPLE),
    (0.8, Mark::Ring, GREEN),
    (0.95, Mark::Disc, BLUE),
];

/// The σ of (c), and their looks.
const WARM: [(f64, Mark, Colour); 2] = [(0.15, Mark::Disc, RED), (0.3, Mark::Ring, BLUE)];

/// Looks of the chains of (d), the first at r = 1 and the others below it.
const HEATED: [(Mark, Colour); 4] = [
    (Mark::Disc, RED),
    (Mark::OpenSquare, ORANGE),
    (Mark::OpenTriangle, PURPLE),
    (Mark::Ring, BLUE),
];

/// Looks of (e), by rising r.
const TOUCHED: [(Mark, Colour); 4] = [
    (Mark::Disc, RED),
    (Mark::OpenSquare, ORANGE),
    (Mark::OpenTriangle, PURPLE),
    (Mark::Ring, BLUE),
];

/// Draws the figure.
pub fn draw(found: &Restitution, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(14_000, note)?;
    rises(&sheet, found)?;
    places(&sheet, found)?;
    warmth(&sheet, found)?;
    heating(&sheet, found)?;
    contact(&sheet, found)?;
    let title = "The rise, the heat and contact at several restitutions";
    Ok(sheet.finish_own(10, title, description(found), tables(found)))
}

fn named(r: f64) -> String {
    format!("*r* = {r}")
}

fn rises(sheet: &Sheet, found: &Restitution) -> Result<(), Error> {
    let gaps = found.parameters.chain.gaps() as f64;
    let last = found.parameters.sigmas.iter().copied().fold(0.0, f64::max);
    let panel = sheet.panel(
        Frame::new(1150, 430, 8150, 3230),
        Axis::linear(0.05, last + 0.02, 0.1, 5, "standard deviation *σ* of the forcing"),
        Axis::linear(0.0, 105.0, 20.0, 4, "mean count"),
    )?;
    panel.letter("(a)")?;
    let half = Stroke::dashed(INK, THIN, Dash::Short);
    let level = [(0.05, 0.5 * gaps), (0.4, 0.5 * gaps)];
    panel.curve("half of all gaps", &level, half, Outside::Cut)?;
    let mut entries = Vec::new();
    for (r, mark, colour) in RISES {
        let Some(curve) = found.curves.iter().find(|own| own.restitution == r) else { continue };
        let points: Vec<_> =
            curve.rows.iter().filter_map(|row| Some((row.sigma, row.count?))).collect();
        let line: Vec<_> = points.iter().map(|(x, own)| (*x, own.value)).collect();
        let thin = Stroke::solid(colour, THIN);
        panel.curve(&named(r), &line, thin, Outside::Refuse)?;
        panel.estimates(&named(r), &points, (mark, SIZE, Stroke::solid(colour, THIN)), |y| y)?;
        entries.push(Entry::mark(mark, SIZE, thin, &named(r)));
    }
    sheet.legend((6350, 1750), (SMALL, 310), &entries)
}

fn places(sheet: &Sheet, found: &Restitution) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 4700, 4150, 7200),
        Axis::linear(0.0, 1.0, 0.2, 2, "restitution *r*"),
        Axis::linear(0.0, 0.35, 0.1, 4, "*σ* at half height"),
    )?;
    panel.letter("(b)")?;
    let points: Vec<_> = found
        .curves
        .iter()
        .filter_map(|curve| Some((curve.restitution, curve.half_height?)))
        .collect();
    let line: Vec<_> = points.iter().map(|(r, own)| (*r, own.value)).collect();
    panel.curve("half height", &line, Stroke::solid(RED, THIN), Outside::Refuse)?;
    panel.estimates("half height", &points, (Mark::Disc, SIZE, Stroke::solid(RED, THIN)), |y| y)
}

fn row(curve: &Curve, sigma: f64) -> Option<&Ensemble> {
    curve.rows.iter().find(|row| row.sigma == sigma)
}

fn end(list: &[Option<Estimate>]) -> Option<Estimate> {
    list.last().copied().flatten()
}

/// s²/σ² of the balance with little loss at one σ.
fn little_loss(found: &Restitution, sigma: f64, lost: f64) -> f64 {
    let chain = Chain { restitution: 1.0 - lost, ..found.parameters.chain.clone() };
    steady(&chain, sigma)
}

fn warmth(sheet: &Sheet, found: &Restitution) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5350, 4700, 8150, 7200),
        Axis::decades(-3, 0, 1, "1 − *r*"),
        Axis::decades(0, 3, 1, "*s*^{2}/*σ*^{2}"),
    )?;
    panel.letter("(c)")?;
    let losses = || (0..=60).map(|i| pxfm::f_exp10(-3.0 + 0.05 * f64::from(i)));
    let rare = |lost: f64| (log(lost), log(2.0 * (2.0 - lost) / lost));
    let solid = Stroke::solid(INK, LINE);
    panel.curve("rare impacts", &losses().map(rare).collect::<Vec<_>>(), solid, Outside::Cut)?;
    let mut marks = Vec::new();
    for (sigma, mark, colour) in WARM {
        let own = found.curves.iter().filter_map(|curve| {
            Some((log(1.0 - curve.restitution), end(&row(curve, sigma)?.ratios)?))
        });
        let watched = found.heated.iter().filter(|row| row.sigma == sigma && row.restitution < 1.0);
        let watched =
            watched.filter_map(|row| Some((log(1.0 - row.restitution), end(&row.ratios)?)));
        let points: Vec<_> = own.chain(watched).collect();
        let name = format!("*σ* = {sigma}");
        panel.estimates(&name, &points, (mark, SIZE, Stroke::solid(colour, THIN)), log)?;
        marks.push(Entry::mark(mark, SIZE, Stroke::solid(colour, THIN), &name));
        // The law is for hot chains, and drawn where little is lost.
        let curve: Vec<_> = losses()
            .filter(|lost| *lost <= 0.1)
            .map(|lost| (log(lost), log(little_loss(found, sigma, lost))))
            .collect();
        panel.curve(&format!("little loss, {name}"), &curve, little(colour), Outside::Cut)?;
    }
    let lines = [Entry::line(solid, "rare impacts"), Entry::line(little(INK), "little loss")];
    sheet.legend((4850, 8150), (SMALL, 340), &lines)?;
    sheet.legend((6800, 8150), (SMALL, 340), &marks)
}

/// The line of the law for little loss.
fn little(colour: Colour) -> Stroke {
    Stroke::dashed(colour, THIN, Dash::Long)
}

/// A line's entry above those of marks, which stand in two columns.
fn legend(sheet: &Sheet, left: i32, line: Entry, marks: &[Entry]) -> Result<(), Error> {
    sheet.legend((left, 12_850), (SMALL, 340), &[line])?;
    let (first, second) = marks.split_at(marks.len().div_ceil(2));
    sheet.legend((left, 13_190), (SMALL, 340), first)?;
    sheet.legend((left + 1650, 13_190), (SMALL, 340), second)
}

/// The chains that are watched: that without loss first, then those next to it.
fn watched(found: &Restitution) -> impl Iterator<Item = (&Ensemble, (Mark, Colour))> {
    found.heated.iter().rev().zip(HEATED)
}

/// The middle of a window on a logarithmic axis.
fn middle(found: &Restitution, window: usize) -> Option<f64> {
    let begin = *found.parameters.ends.get(window.checked_sub(1)?)?;
    Some(0.5 * (log(begin) + log(found.parameters.ends[window])))
}

fn heating(sheet: &Sheet, found: &Restitution) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 9400, 4150, 11_900),
        Axis::decades(1, 4, 1, "time *t* (1/*ω*)"),
        Axis::decades(1, 3, 1, "impacts per unit time"),
    )?;
    panel.letter("(d)")?;
    let solid = Stroke::solid(INK, LINE);
    let windows = found.hot.iter().enumerate();
    let hot: Vec<_> =
        windows.filter_map(|(i, own)| Some((middle(found, i)?, log(own.rate)))).collect();
    panel.curve("hot, without loss", &hot, solid, Outside::Cut)?;
    let mut entries = Vec::new();
    for (row, (mark, colour)) in watched(found) {
        let windows = row.rates.iter().enumerate();
        let points: Vec<_> =
            windows.filter_map(|(i, own)| Some((middle(found, i)?, (*own)?))).collect();
        panel.estimates(
            &named(row.restitution),
            &points,
            (mark, SIZE, Stroke::solid(colour, THIN)),
            log,
        )?;
        let thin = Stroke::solid(colour, THIN);
        entries.push(Entry::mark(mark, SIZE, thin, &named(row.restitution)));
    }
    legend(sheet, 900, Entry::line(solid, "expected at *r* = 1"), &entries)
}

fn contact(sheet: &Sheet, found: &Restitution) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5350, 9400, 8150, 11_900),
        Axis::linear(0.1, 0.65, 0.1, 2, "*σ*"),
        Axis::decades(-4, 0, 1, "share of gaps"),
    )?;
    panel.letter("(e)")?;
    let solid = Stroke::solid(INK, LINE);
    let curve: Vec<_> = found.able_drawn.iter().map(|&[x, share]| (x, log(share))).collect();
    panel.curve("can be pressed", &curve, solid, Outside::Cut)?;
    let mut entries = Vec::new();
    for (curve, (mark, colour)) in found.curves.iter().zip(TOUCHED) {
        let seen = |own: &Estimate| own.value > 0.0;
        let points: Vec<_> = curve
            .rows
            .iter()
            .filter_map(|row| Some((row.sigma, row.touched.filter(seen)?)))
            .collect();
        panel.estimates(
            &named(curve.restitution),
            &points,
            (mark, SIZE, Stroke::solid(colour, THIN)),
            log,
        )?;
        let thin = Stroke::solid(colour, THIN);
        entries.push(Entry::mark(mark, SIZE, thin, &named(curve.restitution)));
    }
    legend(sheet, 4950, Entry::line(solid, "|Δ*F*| > *dω*^{2}"), &entries)
}

fn description(found: &Restitution) -> String {
    let told = |own: Option<Estimate>| own.map_or("none".into(), |own| short(own.value, 3));
    let halves: Vec<String> = found
        .curves
        .iter()
        .map(|curve| format!("{} at r = {}", told(curve.half_height), curve.restitution))
        .collect();
    let rates: Vec<String> = found
        .heated
        .iter()
        .map(|row| {
            let rates: Vec<String> = row.rates.iter().map(|own| told(*own)).collect();
            format!("{} at r = {}", rates.join(", "), row.restitution)
        })
        .collect();
    let touched: Vec<String> = found
        .curves
        .iter()
        .filter_map(|curve| {
            let row = curve.rows.last()?;
            Some(format!("{} at r = {}", told(row.touched), curve.restitution))
        })
        .collect();
    let last = found.curves.last().and_then(|curve| curve.rows.last());
    format!(
        "(a) Mean number of different gaps with an impact against σ: the smaller r, the later and the slower the \
         curve rises. (b) σ at half height, falling with r: {}. (c) s²/σ² against 1 − r on logarithmic axes: points \
         below the line of rare impacts, the farther the nearer r is to one, where they follow flatter dashed lines. \
         (d) Impacts per unit of time in windows that double, on logarithmic axes: level after a while but for r = 1, \
         where they go on rising close to the line. By window: {}. (e) Share of gaps that forces can press shut against σ, \
         and of those seen in contact, far below and mostly at r = 0. The latter at σ = {}: {}.",
        halves.join(", "),
        rates.join("; "),
        last.map_or(0.0, |row| row.sigma),
        touched.join(", "),
    )
}

fn tables(found: &Restitution) -> Vec<DataFile> {
    let value = |own: Option<Estimate>| own.map(|own| own.value);
    let error = |own: Option<Estimate>| own.map(|own| own.error);
    let mut rises = DataFile::new(
        "s10a.csv",
        &["restitution (1)", "sigma (d omega^2)", "mean_count (1)", "standard_error (1)"],
    );
    let mut places = DataFile::new(
        "s10b.csv",
        &["restitution (1)", "half_height (d omega^2)", "standard_error (d omega^2)"],
    );
    let mut warmth = DataFile::new(
        "s10c.csv",
        &[
            "restitution (1)",
            "sigma (d omega^2)",
            "variance_ratio (1)",
            "standard_error (1)",
            "rare_impacts (1)",
            "little_loss (1)",
        ],
    );
    let mut heating = DataFile::new(
        "s10d.csv",
        &[
            "restitution (1)",
            "window_end (1/omega)",
            "impacts_per_unit_time (omega)",
            "standard_error (omega)",
            "variance_ratio (1)",
            "variance_ratio_error (1)",
            "hot_impacts (omega)",
            "hot_variance_ratio (1)",
        ],
    );
    let mut contact = DataFile::new(
        "s10e.csv",
        &[
            "restitution (1)",
            "sigma (d omega^2)",
            "can_be_pressed (1)",
            "seen_in_contact (1)",
            "standard_error (1)",
            "phases_per_impact (1)",
            "share_of_time (1)",
        ],
    );
    for curve in &found.curves {
        let r = curve.restitution;
        places.row(cells![r, value(curve.half_height), error(curve.half_height)]);
        for (row, able) in curve.rows.iter().zip(&found.able_expected) {
            let (sigma, ratio) = (row.sigma, end(&row.ratios));
            rises.row(cells![r, sigma, value(row.count), error(row.count)]);
            let little = little_loss(found, sigma, 1.0 - r);
            warmth.row(cells![r, sigma, value(ratio), error(ratio), curve.balanced, little]);
            let seen = row.touched;
            let (phases, held) = (value(row.phases), value(row.held));
            contact.row(cells![r, sigma, *able, value(seen), error(seen), phases, held]);
        }
    }
    for row in &found.heated {
        let windows = row.rates.iter().zip(&row.ratios).zip(&found.hot);
        for (end, ((rate, ratio), hot)) in found.parameters.ends.iter().zip(windows) {
            heating.row(cells![
                row.restitution,
                *end,
                value(*rate),
                error(*rate),
                value(*ratio),
                error(*ratio),
                hot.rate,
                hot.ratio
            ]);
        }
    }
    vec![rises, places, warmth, heating, contact]
}

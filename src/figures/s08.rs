//! Fig. S8: how hot a running chain is, and what that does to p.

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{BLUE, Dash, GREEN, INK, LINE, Mark, ORANGE, PURPLE, RED, SMALL, Stroke, THIN};
use super::{DataFile, Error, Figure};
use crate::experiments::Results;
use crate::experiments::heat::tables::{balanced_p, balanced_ratio};
use crate::experiments::theory::Theory;
use crate::params::HeatParams;
use crate::table::Table;

/// The free parts of a chain that starts from rest, over σ², in the mean: (1 + (Ω/ω)²)/2.
const FROM_REST: f64 = 1.5;

/// The σ of (a) and (c).
const SIGMAS: (f64, f64) = (0.05, 0.45);

/// The balance where impacts are frequent.
const FRICTION: (&str, Stroke) = ("with friction", Stroke::solid(PURPLE, LINE));

/// The half size of marks.
const SIZE: i32 = 58;

/// What is drawn.
struct Shown<'a> {
    parameters: &'a HeatParams,
    theory: &'a Theory,
    rising: &'a Table,
    others: &'a Table,
}

/// Draws the figure.
pub fn draw(results: &Results, note: Option<&str>) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let shown = Shown {
        parameters: &results.heat()?.parameters,
        theory: &results.theory,
        rising: table("heat.rising")?,
        others: table("heat.others")?,
    };
    let sheet = Sheet::new(9700, note)?;
    against_sigma(&sheet, &shown)?;
    against_restitution(&sheet, &shown)?;
    probabilities(&sheet, &shown)?;
    let data = [shown.rising, shown.others].map(DataFile::of);
    Ok(sheet.finish("s08", "How hot a running chain is", description(&shown), data.into()))
}

fn against_sigma(sheet: &Sheet, shown: &Shown<'_>) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 430, 8150, 3730),
        Axis::linear(SIGMAS.0, SIGMAS.1, 0.05, 5, "standard deviation *σ* of the forcing"),
        Axis::linear(0.0, 30.0, 5.0, 5, "*s*^{2}/*σ*^{2}"),
    )?;
    panel.letter(LETTERS[0])?;
    let level = |name: &str, height: f64, stroke| {
        panel.curve(name, &[(SIGMAS.0, height), (SIGMAS.1, height)], stroke, Outside::Refuse)
    };
    let expected = shown.rising.values("balanced").into_iter().fold(0.0, f64::max);
    let lines = [
        ("balance of rare impacts", expected, Stroke::solid(INK, LINE)),
        ("start from rest", FROM_REST, Stroke::dashed(GREEN, LINE, Dash::Long)),
        ("Eq. (25)", 1.0, Stroke::dashed(BLUE, LINE, Dash::Short)),
    ];
    let mut entries = Vec::new();
    for (name, height, stroke) in lines.iter().copied() {
        level(name, height, stroke)?;
        entries.push(Entry::line(stroke, name));
    }
    let friction = shown.rising.points(&[], "sigma", "balanced_at_rate");
    panel.curve(FRICTION.0, &friction, FRICTION.1, Outside::Refuse)?;
    let looks = [("masses that are hit", Mark::Ring, ORANGE), ("all masses", Mark::Disc, RED)];
    panel.estimates(
        looks[0].0,
        &shown.rising.estimates(&[], "sigma", "variance_ratio_of_hit"),
        (looks[0].1, SIZE, Stroke::solid(looks[0].2, THIN)),
        |y| y,
    )?;
    panel.estimates(
        looks[1].0,
        &shown.rising.estimates(&[], "sigma", "variance_ratio"),
        (looks[1].1, SIZE, Stroke::solid(looks[1].2, THIN)),
        |y| y,
    )?;
    for (name, mark, colour) in looks {
        entries.push(Entry::mark(mark, SIZE, Stroke::solid(colour, THIN), name));
    }
    entries.push(Entry::line(FRICTION.1, FRICTION.0));
    let (lines, marks) = entries.split_at(lines.len());
    sheet.legend((2700, 600), (SMALL, 350), lines)?;
    sheet.legend((5650, 600), (SMALL, 350), marks)
}

fn against_restitution(sheet: &Sheet, shown: &Shown<'_>) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 5250, 4050, 7650),
        Axis::linear(0.4, 1.0, 0.2, 4, "restitution *r*"),
        Axis::decades(0, 2, 1, "*s*^{2}/*σ*^{2}"),
    )?;
    panel.letter(LETTERS[1])?;
    let line = Stroke::solid(INK, LINE);
    let curve: Vec<_> =
        balanced_ratio(shown.parameters).into_iter().map(|(r, ratio)| (r, log(ratio))).collect();
    panel.curve("balance of rare impacts", &curve, line, Outside::Cut)?;
    let friction = shown.others.points(&[], "r", "balanced_at_rate");
    let friction: Vec<_> = friction.into_iter().map(|(r, ratio)| (r, log(ratio))).collect();
    panel.curve(FRICTION.0, &friction, FRICTION.1, Outside::Refuse)?;
    let points = shown.others.estimates(&[], "r", "variance_ratio_of_hit");
    panel.estimates(
        "masses that are hit",
        &points,
        (Mark::Ring, SIZE, Stroke::solid(ORANGE, THIN)),
        log,
    )?;
    let entries = [
        Entry::line(line, "balance of rare impacts"),
        Entry::line(FRICTION.1, FRICTION.0),
        Entry::mark(Mark::Ring, SIZE, Stroke::solid(ORANGE, THIN), "masses that are hit"),
    ];
    sheet.legend((900, 8750), (SMALL, 370), &entries)
}

fn probabilities(sheet: &Sheet, shown: &Shown<'_>) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5350, 5250, 8150, 7650),
        Axis::linear(SIGMAS.0, SIGMAS.1, 0.1, 2, "*σ*"),
        Axis::decades(-5, 0, 1, "*p*"),
    )?;
    panel.letter(LETTERS[2])?;
    let relation = shown.theory.relation.iter().filter(|row| row.p > 0.0);
    let (eq25, rest): (Vec<_>, Vec<_>) =
        relation.map(|row| ((row.sigma, log(row.p)), (row.sigma, log(row.p_rest)))).unzip();
    let hot: Vec<_> =
        balanced_p(shown.parameters).into_iter().map(|(sigma, p)| (sigma, log(p))).collect();
    let lines = [
        ("Eq. (25)", eq25, Stroke::dashed(BLUE, LINE, Dash::Short)),
        ("from rest", rest, Stroke::dashed(GREEN, LINE, Dash::Long)),
        ("balanced", hot, Stroke::solid(INK, LINE)),
    ];
    let mut entries = Vec::new();
    for (name, points, stroke) in lines {
        panel.curve(name, &points, stroke, Outside::Cut)?;
        entries.push(Entry::line(stroke, name));
    }
    let mut measured = shown.rising.points(&[], "sigma", "p_measured");
    measured.retain(|(_, p)| *p > 0.0);
    let measured: Vec<_> = measured.into_iter().map(|(sigma, p)| (sigma, log(p))).collect();
    let look = (Mark::Disc, SIZE, Stroke::solid(RED, THIN));
    panel.marks("measured", &measured, look, Outside::Refuse)?;
    entries.push(Entry::mark(look.0, look.1, look.2, "measured"));
    for (i, column) in entries.chunks(2).enumerate() {
        sheet.legend((4850 + 1750 * i as i32, 8750), (SMALL, 370), column)?;
    }
    Ok(())
}

fn description(shown: &Shown<'_>) -> String {
    let last = shown.rising.points(&[], "sigma", "variance_ratio_of_hit").pop();
    format!(
        "(a) Variance of the free amplitudes over that of the force against σ falls{}, below the level of rare \
         impacts. (b) The same against r, below a curve without bound towards r = 1. (c) The probability p against σ: measured \
         points go from the start from rest to the balanced variance.",
        last.map_or(String::new(), |(sigma, own)| format!(", to {} at σ = {sigma}", short(own, 3))),
    )
}

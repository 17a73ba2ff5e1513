//! Fig. S7: how hot a running chain is, and what that does to p.

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::data::cells;
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{BLUE, Dash, GREEN, INK, LINE, Mark, ORANGE, PURPLE, RED, SMALL, Stroke, THIN};
use super::{DataFile, Error, Figure};
use crate::experiments::heat::{Heat, Warmth};
use crate::experiments::theory::Theory;
use crate::numerics::statistics::Estimate;

/// The free parts of a chain that starts from rest, over σ², in the mean: (1 + (Ω/ω)²)/2.
const FROM_REST: f64 = 1.5;

/// The σ of (a) and (c).
const SIGMAS: (f64, f64) = (0.05, 0.45);

/// The balance where impacts are frequent.
const FRICTION: (&str, Stroke) = ("with friction", Stroke::solid(PURPLE, LINE));

/// The half size of marks.
const SIZE: i32 = 58;

/// Draws the figure.
pub fn draw(heat: &Heat, theory: &Theory, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(9700, note)?;
    against_sigma(&sheet, heat)?;
    against_restitution(&sheet, heat)?;
    probabilities(&sheet, heat, theory)?;
    let files = tables(heat);
    Ok(sheet.finish_own(7, "How hot a running chain is", description(heat), files))
}

fn against_sigma(sheet: &Sheet, heat: &Heat) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 430, 8150, 3730),
        Axis::linear(SIGMAS.0, SIGMAS.1, 0.05, 5, "standard deviation *σ* of the forcing"),
        Axis::linear(0.0, 30.0, 5.0, 5, "*s*^{2}/*σ*^{2}"),
    )?;
    panel.letter(LETTERS[0])?;
    let level = |name: &str, height: f64, stroke| {
        panel.curve(name, &[(SIGMAS.0, height), (SIGMAS.1, height)], stroke, Outside::Refuse)
    };
    let expected = heat.rising().map(|row| row.expected).fold(0.0, f64::max);
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
    let friction: Vec<_> = heat.rising().map(|row| (row.row.sigma, row.expected_at_rate)).collect();
    panel.curve(FRICTION.0, &friction, FRICTION.1, Outside::Refuse)?;
    let of = |pick: fn(&Warmth) -> Option<Estimate>| -> Vec<(f64, Estimate)> {
        heat.rising().filter_map(|row| Some((row.row.sigma, pick(row)?))).collect()
    };
    let looks = [("masses that are hit", Mark::Ring, ORANGE), ("all masses", Mark::Disc, RED)];
    panel.estimates(
        looks[0].0,
        &of(|row| row.ratio_of_hit),
        (looks[0].1, SIZE, Stroke::solid(looks[0].2, THIN)),
        |y| y,
    )?;
    panel.estimates(
        looks[1].0,
        &of(|row| row.ratio),
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

fn against_restitution(sheet: &Sheet, heat: &Heat) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 5250, 4050, 7650),
        Axis::linear(0.4, 1.0, 0.2, 4, "restitution *r*"),
        Axis::decades(0, 2, 1, "*s*^{2}/*σ*^{2}"),
    )?;
    panel.letter(LETTERS[1])?;
    let line = Stroke::solid(INK, LINE);
    let curve: Vec<_> = heat.expected.iter().map(|&[r, ratio]| (r, log(ratio))).collect();
    panel.curve("balance of rare impacts", &curve, line, Outside::Cut)?;
    let friction: Vec<_> =
        heat.others().map(|row| (row.row.restitution, log(row.expected_at_rate))).collect();
    panel.curve(FRICTION.0, &friction, FRICTION.1, Outside::Refuse)?;
    let points: Vec<_> =
        heat.others().filter_map(|row| Some((row.row.restitution, row.ratio_of_hit?))).collect();
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

fn probabilities(sheet: &Sheet, heat: &Heat, theory: &Theory) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5350, 5250, 8150, 7650),
        Axis::linear(SIGMAS.0, SIGMAS.1, 0.1, 2, "*σ*"),
        Axis::decades(-5, 0, 1, "*p*"),
    )?;
    panel.letter(LETTERS[2])?;
    let relation = theory.relation.iter().filter(|row| row.p > 0.0);
    let (eq25, rest): (Vec<_>, Vec<_>) =
        relation.map(|row| ((row.sigma, log(row.p)), (row.sigma, log(row.p_rest)))).unzip();
    let hot: Vec<_> = heat.balanced.iter().map(|&[sigma, p]| (sigma, log(p))).collect();
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
    let measured = heat.rising().filter(|row| row.p_measured > 0.0);
    let measured: Vec<_> = measured.map(|row| (row.row.sigma, log(row.p_measured))).collect();
    let look = (Mark::Disc, SIZE, Stroke::solid(RED, THIN));
    panel.marks("measured", &measured, look, Outside::Refuse)?;
    entries.push(Entry::mark(look.0, look.1, look.2, "measured"));
    for (i, column) in entries.chunks(2).enumerate() {
        sheet.legend((4850 + 1750 * i as i32, 8750), (SMALL, 370), column)?;
    }
    Ok(())
}

fn description(heat: &Heat) -> String {
    let told = |own: Option<Estimate>| own.map_or("none".into(), |own| short(own.value, 3));
    let rising: Vec<String> = heat
        .rising()
        .map(|row| format!("{} at σ = {}", told(row.ratio_of_hit), row.row.sigma))
        .collect();
    let others: Vec<String> = heat
        .others()
        .map(|row| {
            let expected = short(row.expected, 3);
            format!("{} of {expected} at r = {}", told(row.ratio_of_hit), row.row.restitution)
        })
        .collect();
    let p: Vec<String> = heat
        .rising()
        .map(|row| format!("{} at σ = {}", short(row.p_measured, 2), row.row.sigma))
        .collect();
    format!(
        "(a) Variance of the free amplitudes over that of the force against σ, of masses that are hit and of \
         all masses, with standard errors; level lines at what the balance of rare impacts gives, \
         at {FROM_REST} for a start from rest, and at 1 for Eq. (25), and a falling line for the balance with \
         the friction of frequent impacts. Masses that are hit: {}. \
         (b) The same against the restitution r at one σ, on a logarithmic axis, below a curve that rises \
         without bound towards r = 1, with friction much less: {}. (c) The probability p against σ on a logarithmic axis: rising \
         curves, at the rise lowest Eq. (25), then the start from rest, highest the balanced variance; the \
         measured points go from the second to the third: {}.",
        rising.join(", "),
        others.join(", "),
        p.join(", ")
    )
}

fn tables(heat: &Heat) -> Vec<DataFile> {
    let mut rows = DataFile::new(
        "s07.csv",
        &[
            "sigma (d omega^2)",
            "r (1)",
            "variance_ratio (1)",
            "standard_error (1)",
            "variance_ratio_of_hit (1)",
            "standard_error_of_hit (1)",
            "expected (1)",
            "rate (omega)",
            "expected_at_rate (1)",
            "balance (1)",
            "balance_error (1)",
            "mean_count (1)",
            "p (1)",
            "p_rest (1)",
            "p_balanced (1)",
            "p_measured (1)",
        ],
    );
    let value = |own: Option<Estimate>| own.map(|own| own.value);
    let error = |own: Option<Estimate>| own.map(|own| own.error);
    for row in &heat.rows {
        rows.row(cells![
            row.row.sigma,
            row.row.restitution,
            value(row.ratio),
            error(row.ratio),
            value(row.ratio_of_hit),
            error(row.ratio_of_hit),
            row.expected,
            row.rate,
            row.expected_at_rate,
            value(row.balance),
            error(row.balance),
            value(row.count),
            row.p,
            row.p_rest,
            row.p_balanced,
            row.p_measured
        ]);
    }
    let mut balanced = DataFile::new("s07c.csv", &["sigma (d omega^2)", "p_balanced (1)"]);
    heat.balanced.iter().for_each(|&[sigma, p]| balanced.row(cells![sigma, p]));
    let mut expected = DataFile::new("s07b.csv", &["r (1)", "expected (1)"]);
    heat.expected.iter().for_each(|&[r, ratio]| expected.row(cells![r, ratio]));
    vec![rows, expected, balanced]
}

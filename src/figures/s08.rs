//! Fig. S8: how hot a running chain is.

use super::prelude::*;
use super::{FORCING, SIGMA};
use crate::experiments::Results;
use crate::experiments::heat::tables::balanced_ratio;
use crate::params::HeatParams;
use crate::table::Table;

/// The free parts of a chain that starts from rest, over σ², in the mean: (1 + (Ω/ω)²)/2.
const FROM_REST: f64 = 1.5;

/// The σ of (a).
const SIGMAS: (f64, f64) = (0.05, 0.45);

/// The balance where impacts are frequent.
const FRICTION: (&str, Stroke) = ("with friction", Stroke::solid(PURPLE, LINE));

/// The closed theory, which is for masses that are hit.
const CLOSED: (&str, Stroke) = ("closed theory", Stroke::dashed(ORANGE, LINE, Dash::Alternate));

/// What is drawn.
struct Shown<'a> {
    parameters: &'a HeatParams,
    rising: &'a Table,
    others: &'a Table,
}

/// Draws the figure.
pub fn draw(results: &Results, note: Option<&str>) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let shown = Shown {
        parameters: &results.heat()?.parameters,
        rising: table("heat.rising")?,
        others: table("heat.others")?,
    };
    let sheet = Sheet::new(10250, note)?;
    against_sigma(&sheet, &shown)?;
    against_restitution(&sheet, &shown)?;
    Ok(sheet.finish("s08", "How hot a running chain is", description(&shown)))
}

fn against_sigma(sheet: &Sheet, shown: &Shown<'_>) -> Result<(), Error> {
    let x = Axis::linear(SIGMAS.0, SIGMAS.1, 0.05, 5, FORCING).column(SIGMA);
    let y = Axis::linear(0.0, 30.0, 5.0, 5, "*s*^{2}/*σ*^{2}");
    let panel = sheet.lettered(LETTERS[0], Frame::new(1150, 430, 8150, 3730), x, y)?;
    let expected = shown.rising.values("balanced").into_iter().fold(0.0, f64::max);
    let lines = [
        ("balance of rare impacts", expected, Stroke::solid(INK, LINE)),
        ("start from rest", FROM_REST, Stroke::dashed(GREEN, LINE, Dash::Long)),
        ("Eq. (25)", 1.0, Stroke::dashed(BLUE, LINE, Dash::Short)),
    ];
    let mut entries = Vec::new();
    for (name, height, stroke) in lines {
        panel.level(name, height, stroke)?;
        entries.push(Entry::line(stroke, name));
    }
    let friction = shown.rising.points(&[], "sigma", "balanced_at_rate");
    panel.curve(FRICTION.0, &friction, FRICTION.1, Outside::Refuse)?;
    let closed = shown.rising.points(&[], "sigma", "closed");
    panel.curve(CLOSED.0, &closed, CLOSED.1, Outside::Cut)?;
    let looks = [
        ("masses that are hit", "variance_ratio_of_hit", Mark::Ring, ORANGE),
        ("all masses", "variance_ratio", Mark::Disc, RED),
    ];
    for (name, column, mark, colour) in looks {
        let look = (mark, LARGE, Stroke::solid(colour, THIN));
        panel.estimates(name, &shown.rising.estimates(&[], "sigma", column), look)?;
        entries.push(Entry::mark(look, name));
    }
    entries.push(Entry::line(FRICTION.1, FRICTION.0));
    entries.push(Entry::line(CLOSED.1, CLOSED.0));
    sheet.legend_in_columns((1150, 4950), (SMALL, 350), (4, 3700), &entries)
}

fn against_restitution(sheet: &Sheet, shown: &Shown<'_>) -> Result<(), Error> {
    let x = Axis::linear(0.4, 1.0, 0.2, 4, "restitution *r*");
    let y = Axis::decades(0, 2, 1, "*s*^{2}/*σ*^{2}");
    let panel = sheet.lettered(LETTERS[1], Frame::new(1150, 6900, 8150, 9300), x, y)?;
    let line = Stroke::solid(INK, LINE);
    let curve: Vec<_> = balanced_ratio(shown.parameters).into_iter().collect();
    panel.curve("balance of rare impacts", &curve, line, Outside::Cut)?;
    let friction = shown.others.points(&[], "r", "balanced_at_rate");
    panel.curve(FRICTION.0, &friction, FRICTION.1, Outside::Refuse)?;
    // The keys of (a) are those of this line too.
    let closed = shown.others.points(&[], "r", "closed");
    panel.curve(CLOSED.0, &closed, CLOSED.1, Outside::Cut)?;
    let points = shown.others.estimates(&[], "r", "variance_ratio_of_hit");
    let look = (Mark::Ring, LARGE, Stroke::solid(ORANGE, THIN));
    panel.estimates("masses that are hit", &points, look)?;
    let entries = [
        Entry::line(line, "balance of rare impacts"),
        Entry::line(FRICTION.1, FRICTION.0),
        Entry::mark(look, "masses that are hit"),
    ];
    sheet.legend((4800, 8400), (SMALL, 370), &entries)
}

fn description(shown: &Shown<'_>) -> String {
    let last = shown.rising.points(&[], "sigma", "variance_ratio_of_hit").pop();
    format!(
        "(a) Variance of the free amplitudes over that of the force against σ falls{}, below the level of rare \
         impacts; masses that are hit follow the closed theory. (b) The same against r, below a curve without bound towards r = 1.",
        last.map_or(String::new(), |(sigma, own)| format!(", to {} at σ = {sigma}", short(own, 3))),
    )
}

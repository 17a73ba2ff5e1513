//! Fig. S8: how hot a running chain is.

use super::FORCING;
use super::prelude::*;
use crate::experiments::heat::tables::balanced_ratio;
use crate::experiments::{HEAT, Results};
use crate::params::HeatParams;
use crate::table::Table;

/// The free parts of a chain that starts from rest, over σ², in the mean: (1 + (Ω/ω)²)/2.
const FROM_REST: f64 = 1.5;

/// The σ of (a).
const SIGMAS: (f64, f64) = (0.05, 0.45);

/// The formula for rare impacts, with the rate that was measured.
const AT_RATE: (&str, Stroke) = ("rare impacts, at the measured rate", Stroke::solid(PURPLE, LINE));

/// The closed theory, which is for masses that are hit.
const CLOSED: (&str, Stroke) = ("closed theory", Stroke::dashed(ORANGE, LINE, Dash::Alternate));

/// The look of the masses that are hit.
const HIT: Marker = (Mark::Ring, 62, Stroke::solid(ORANGE, THIN));

/// What is drawn.
struct Shown<'a> {
    parameters: &'a HeatParams,
    rising: &'a Table,
    others: &'a Table,
}

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let shown = Shown {
        parameters: &results.of(&HEAT)?.parameters,
        rising: table("heat.rising")?,
        others: table("heat.others")?,
    };
    let sheet = Sheet::new(10250);
    against_sigma(&sheet, &shown)?;
    against_restitution(&sheet, &shown)?;
    Ok(sheet.finish("s08", "How hot a running chain is", description(&shown)))
}

fn against_sigma(sheet: &Sheet, shown: &Shown<'_>) -> Result<(), Error> {
    let x = Axis::linear(SIGMAS.0, SIGMAS.1, 0.1, 2, FORCING);
    let y = Axis::linear(0.0, 30.0, 10.0, 2, "*s*^{2}/*σ*^{2}");
    let panel = sheet.lettered(LETTERS[0], Frame::new(1150, 430, 8150, 3730), x, y)?;
    let expected = shown.rising.values("balanced").into_iter().fold(0.0, f64::max);
    let lines = [
        ("rare impacts", expected, Stroke::solid(INK, LINE)),
        ("start from rest", FROM_REST, Stroke::dashed(GREEN, LINE, Dash::Long)),
        ("Eq. (25)", 1.0, Stroke::dashed(BLUE, LINE, Dash::Short)),
    ];
    for (name, height, stroke) in lines {
        panel.level(name, height, stroke)?;
    }
    let at_rate = shown.rising.points(&[], "sigma", "balanced_at_rate");
    panel.curve(AT_RATE.0, &at_rate, AT_RATE.1, Outside::Refuse)?;
    let closed = shown.rising.points(&[], "sigma", "closed");
    panel.curve(CLOSED.0, &closed, CLOSED.1, Outside::Cut)?;
    let mut entries: Vec<_> =
        lines.iter().map(|(name, _, stroke)| Entry::line(*stroke, name)).collect();
    entries.splice(1..1, [AT_RATE, CLOSED].map(|(name, stroke)| Entry::line(stroke, name)));
    // The smaller discs leave the rings to be seen.
    let looks = [
        ("masses that are hit", "variance_ratio_of_hit", HIT),
        ("all masses", "variance_ratio", (Mark::Disc, 34, Stroke::solid(RED, THIN))),
    ];
    for (name, column, look) in looks {
        panel.estimates(name, &shown.rising.estimates(&[], "sigma", column), look)?;
        entries.push(Entry::mark(look, name));
    }
    // The key is that of (b) too.
    sheet.legend_in_columns((600, 4950), (SMALL, 350), (4, 4700), &entries)
}

fn against_restitution(sheet: &Sheet, shown: &Shown<'_>) -> Result<(), Error> {
    let x = Axis::linear(0.4, 1.0, 0.2, 4, "restitution *r*");
    let y = Axis::decades(0, 2, 1, "*s*^{2}/*σ*^{2}");
    let panel = sheet.lettered(LETTERS[1], Frame::new(1150, 6900, 8150, 9300), x, y)?;
    let line = Stroke::solid(INK, LINE);
    let curve: Vec<_> = balanced_ratio(shown.parameters).into_iter().collect();
    panel.curve("rare impacts", &curve, line, Outside::Cut)?;
    let at_rate = shown.others.points(&[], "r", "balanced_at_rate");
    panel.curve(AT_RATE.0, &at_rate, AT_RATE.1, Outside::Refuse)?;
    let closed = shown.others.points(&[], "r", "closed");
    panel.curve(CLOSED.0, &closed, CLOSED.1, Outside::Cut)?;
    let points = shown.others.estimates(&[], "r", "variance_ratio_of_hit");
    panel.estimates("masses that are hit", &points, HIT)
}

fn description(shown: &Shown<'_>) -> String {
    let last = shown.rising.points(&[], "sigma", "variance_ratio_of_hit").pop();
    format!(
        "(a) Variance of the free amplitudes over that of the force against σ falls{}, below the level of rare \
         impacts; masses that are hit follow the closed theory. (b) The same against r, below a curve without bound towards r = 1.",
        last.map_or(String::new(), |(sigma, own)| format!(", to {} at σ = {sigma}", short(own, 3))),
    )
}

//! Fig. S3: what one gap that closes by itself sets off, and the mean count that follows.

use super::FORCING;
use super::prelude::*;
use super::simulated::count_axis;
use crate::experiments::Results;
use crate::experiments::rise::Counted;
use crate::experiments::sweep;
use literate::table::Table;

/// The σ of (a).
const SIGMAS: (f64, f64) = (0.075, 0.165);

/// Lines of the σ in (b).
const SPREADS: [Stroke; 4] = [
    Stroke::solid(PURPLE, LINE),
    Stroke::dashed(BLUE, LINE, Dash::Long),
    Stroke::dashed(ORANGE, LINE, Dash::Alternate),
    Stroke::solid(RED, THIN),
];

/// Nucleation and growth, which is computed at some places only.
const GROWN: (&str, Marker) =
    ("nucleation and growth", (Mark::OpenSquare, 44, Stroke::solid(INK, HAIR)));

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let table = |name| results.table(name);
    let sheet = Sheet::new(9600);
    counts(&sheet, table("seeds.means")?, table("seeds.theory")?, sweep::main(results)?)?;
    let advance = table("seeds.advance")?;
    advances(&sheet, advance)?;
    halves(&sheet, table("seeds.rise")?, table("seeds.scores")?)?;
    Ok(sheet.finish("s03", "From one gap to many: nucleation and growth", description(advance)))
}

fn counts(sheet: &Sheet, means: &Table, theory: &Table, sweep: &Counted) -> Result<(), Error> {
    let x = Axis::linear(SIGMAS.0, SIGMAS.1, 0.01, 2, FORCING);
    let y = count_axis(sweep.ensemble.chain.gaps(), "mean count of all");
    let panel = sheet.lettered(LETTERS[0], Frame::new(1150, 430, 8150, 3730), x, y)?;
    let transient = [("transient", sweep.first().protocol.transient)];
    let lines = [
        ("circuits, Eq. (25)", "eq25", Stroke::dashed(BLUE, LINE, Dash::Short)),
        ("circuits, from rest", "from_rest", Stroke::dashed(PURPLE, LINE, Dash::Long)),
    ];
    let mut entries = Vec::new();
    for (name, column, stroke) in lines {
        panel.curve(name, &theory.points(&[], "sigma", column), stroke, Outside::Refuse)?;
        entries.push(Entry::line(stroke, name));
    }
    panel.joined(GROWN.0, &means.estimates(&transient, "sigma", "grown"), GROWN.1)?;
    entries.insert(0, Entry::both(GROWN.1.2, GROWN.1, GROWN.0));
    let inside =
        sweep.first().rows.iter().filter(|row| row.sigma > SIGMAS.0 && row.sigma < SIGMAS.1);
    let bars: Vec<_> = inside
        .filter_map(|row| Some((row.sigma, row.mean_all?.value, row.mean_all?.interval?)))
        .collect();
    let look = (Mark::Disc, 42, Stroke::solid(RED, THIN));
    let ends: Vec<_> = bars.iter().map(|(x, _, [low, high])| (*x, *low, *high)).collect();
    panel.bars("simulation", &ends, 35, look.2, Outside::Refuse)?;
    let points: Vec<_> = bars.iter().map(|(x, y, _)| (*x, *y)).collect();
    panel.marks("simulation", &points, look, Outside::Refuse)?;
    entries.push(Entry::mark(look, "simulation"));
    sheet.legend((1400, 700), (SMALL, 370), (9, 0), &entries)
}

fn named(sigma: f64) -> String {
    format!("*σ* = {sigma}")
}

/// Four of so many, or all, from the first to the last.
fn spread<T>(all: &[T]) -> impl Iterator<Item = &T> {
    let last = all.len().saturating_sub(1);
    let mut places = vec![0, last / 3, 2 * last / 3, last];
    places.dedup();
    places.into_iter().filter_map(|place| all.get(place))
}

fn advances(sheet: &Sheet, advance: &Table) -> Result<(), Error> {
    let x = Axis::decades(1, 4, 1, "time since the first impact (1/*ω*)").from(20.0, 2000.0);
    let y = Axis::decades(-1, 2, 1, "advance (gaps)");
    let panel = sheet.lettered(LETTERS[1], Frame::new(1150, 5250, 4050, 7650), x, y)?;
    let mut entries = Vec::new();
    for (sigma, stroke) in spread(&advance.values("sigma")).zip(SPREADS) {
        let points = advance.points(&[("sigma", *sigma)], "time", "advance");
        let name = named(*sigma);
        panel.curve(&name, &points, stroke, Outside::Cut)?;
        entries.push(Entry::line(stroke, &name));
    }
    let straight = Stroke::dashed(INK, THIN, Dash::Short);
    panel.guide("constant speed", &[(10.0, 0.1), (1e4, 100.0)], straight)?;
    entries.push(Entry::line(straight, "∝ *t*"));
    sheet.legend((650, 8680), (SMALL, 320), (3, 1800), &entries)
}

fn halves(sheet: &Sheet, rise: &Table, scores: &Table) -> Result<(), Error> {
    let x = Axis::decades(1, 4, 1, "transient *T* (1/*ω*)").from(20.0, 2000.0);
    let y = Axis::linear(0.1, 0.15, 0.01, 2, "*σ*_{1/2} of all (*d ω*^{2})")
        .column("half_height (d omega^2)");
    let panel = sheet.lettered(LETTERS[2], Frame::new(5350, 5250, 8150, 7650), x, y)?;
    let grown = rise.points(&[], "transient", "half_height");
    panel.marked(GROWN.0, &grown, (GROWN.1.2, GROWN.1), Outside::Edge)?;
    let look = (Mark::Disc, LARGE, Stroke::solid(RED, THIN));
    let found = scores.estimates(&[], "transient", "half_height");
    panel.estimates("simulation", &found, look)?;
    let entries = [Entry::both(GROWN.1.2, GROWN.1, GROWN.0), Entry::mark(look, "simulation")];
    sheet.legend((4850, 8650), (SMALL, 370), (9, 0), &entries)
}

fn description(advance: &Table) -> Seen {
    let sigmas = advance.values("sigma");
    let [low, high] = [sigmas.first(), sigmas.last()].map(|own| own.copied().unwrap_or_default());
    seen!(
        "(a) Mean count of all against σ: simulated points along nucleation and growth; circuits steeper. (b) Advance \
         against time at σ from {low} to {high}: slower than ∝ t, the more so the smaller σ. (c) Half height falls with T.",
    )
}

//! Fig. S10: periodic orbits from circuits.

use super::SIGMA;
use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::orbits::{Example, Orbits, Row};

/// The colours of masses, and of lengths.
const COLOURS: [Colour; 4] = [BLUE, RED, GREEN, ORANGE];

/// The marks of lengths: with an orbit, and with a stable one.
const MARKS: [[Mark; 2]; 4] = [
    [Mark::Disc, Mark::Ring],
    [Mark::Square, Mark::OpenSquare],
    [Mark::Diamond, Mark::OpenDiamond],
    [Mark::Triangle, Mark::OpenTriangle],
];

/// The end of the axes of (c): multipliers beyond it are told by their number.
const REACH: f64 = 2.0;

/// The σ of (c), or the last if it was not run.
const DRAWN: f64 = 0.3;

/// Draws the figure.
pub fn draw(results: &Results, note: Option<&str>) -> Result<Figure, Error> {
    let orbits = results.orbits()?;
    let sheet = Sheet::new(9500, note)?;
    if let Some(example) = &orbits.example {
        motion(&sheet, example)?;
    }
    shares(&sheet, orbits)?;
    plane(&sheet, orbits)?;
    Ok(sheet.finish("s10", "Periodic orbits from circuits", description(orbits)))
}

fn motion(sheet: &Sheet, example: &Example) -> Result<(), Error> {
    let masses = example.positions.len();
    let wall = (masses + 1) as f64;
    // A mass may be anywhere between the walls.
    let time = Axis::linear(0.0, example.period, 0.5, 1, "time *t* (1/*ω*), one period");
    let x = time.column("time (1/omega)");
    let y = Axis::linear(0.0, wall, 1.0, 2, "position *x*_{*j*} / *d*");
    let panel = sheet.lettered(LETTERS[0], Frame::new(1150, 430, 7900, 3630), x, y)?;
    panel.level("right wall", wall, Stroke::solid(INK, HAIR))?;
    for ((place, colour), j) in example.positions.iter().zip(COLOURS).zip(1..) {
        let points: Vec<_> = example.times.iter().copied().zip(place.iter().copied()).collect();
        let own = panel.series(&format!("mass {j}"));
        own.curve("mass", &points, Stroke::solid(colour, LINE), Outside::Cut)?;
    }
    for (j, place) in example.positions.iter().enumerate() {
        if let Some(end) = place.last() {
            let look = (SMALL, INK, HPos::Left, VPos::Center);
            panel.note(&format!("*x*_{{{}}}", j + 1), (example.period, *end), (60, 0), look)?;
        }
    }
    let impacts: Vec<_> = impacts(example).collect();
    panel.marks("impacts", &impacts, (Mark::Disc, MEDIUM, Stroke::solid(INK, THIN)), Outside::Cut)
}

/// Where the impacts of an example are: at a mass of the gap, or at the wall.
fn impacts(example: &Example) -> impl Iterator<Item = (f64, f64)> + '_ {
    example.impacts.iter().zip(&example.circuit).map(|(&time, &gap)| {
        let left = gap.checked_sub(1).and_then(|j| example.positions.get(j));
        let at = example.times.iter().position(|t| *t == time);
        (time, left.zip(at).map_or(0.0, |(places, at)| places[at]))
    })
}

fn shares(sheet: &Sheet, orbits: &Orbits) -> Result<(), Error> {
    let all = || orbits.rows.iter().flat_map(|row| &row.lengths);
    let largest = all().map(|own| own.admissible.value + own.admissible.error).fold(0.1, f64::max);
    let last = orbits.rows.iter().map(|row| row.sigma).fold(0.0, f64::max);
    let x = Axis::linear(0.0, if last > 0.35 { 0.7 } else { 0.35 }, 0.1, 2, "*σ*").column(SIGMA);
    let y = upwards_from_zero(largest, "share of circuits");
    let panel = sheet.lettered(LETTERS[1], Frame::new(1150, 4950, 4150, 7750), x, y)?;
    let mut entries = Vec::new();
    let lengths = orbits.rows.first().map_or(0, |row| row.lengths.len());
    for ((k, colour), [full, open]) in (1..=lengths).zip(COLOURS).zip(MARKS) {
        let own = |row: &Row| row.lengths.iter().find(|own| own.k == k).cloned();
        let of: Vec<_> =
            orbits.rows.iter().filter_map(|row| Some((row.sigma, own(row)?))).collect();
        let name = format!("length {k}");
        let thin = Stroke::solid(colour, THIN);
        let bars: Vec<_> = of
            .iter()
            .map(|(x, own)| (x, own.admissible.value, own.admissible.error))
            .map(|(x, y, e)| (*x, y - e, y + e))
            .collect();
        panel.bars(&name, &bars, 35, thin, Outside::Edge)?;
        let points: Vec<_> = of.iter().map(|(x, own)| (*x, own.admissible.value)).collect();
        let line = Stroke::solid(colour, LINE);
        panel.marked(&name, &points, (line, (full, MEDIUM, line)), Outside::Refuse)?;
        let points: Vec<_> = of.iter().map(|(x, own)| (*x, own.stable.value)).collect();
        let stable = panel.series(&format!("{name}, stable"));
        let broken = Stroke::dashed(colour, THIN, Dash::Short);
        stable.marked(&name, &points, (broken, (open, MEDIUM, thin)), Outside::Refuse)?;
        entries.push(Entry::mark((full, MEDIUM, thin), &format!("*k* = {k}")));
    }
    let (left, right) = entries.split_at(entries.len().div_ceil(2));
    sheet.legend((900, 8750), (SMALL, 370), left)?;
    sheet.legend((2200, 8750), (SMALL, 370), right)?;
    let open = Entry::mark((Mark::Ring, MEDIUM, Stroke::solid(INK, THIN)), "open: stable");
    sheet.legend((3500, 8750), (SMALL, 370), &[open])
}

/// The row whose multipliers are drawn.
fn chosen(orbits: &Orbits) -> Option<&Row> {
    orbits.rows.iter().find(|row| row.sigma == DRAWN).or(orbits.rows.last())
}

fn plane(sheet: &Sheet, orbits: &Orbits) -> Result<(), Error> {
    let x = Axis::linear(-REACH, REACH, 1.0, 2, "Re *λ*");
    let y = Axis::linear(-REACH, REACH, 1.0, 2, "Im *λ*");
    let panel = sheet.lettered(LETTERS[2], Frame::new(5350, 4950, 8150, 7750), x, y)?;
    let circle: Vec<_> = (0..=180)
        .map(|i| pxfm::f_sincos(f64::from(i) * std::f64::consts::PI / 90.0))
        .map(|(sin, cos)| (cos, sin))
        .collect();
    panel.guide("unit circle", &circle, Stroke::solid(GREY, THIN))?;
    let Some(row) = chosen(orbits) else { return Ok(()) };
    let looks =
        [("unstable orbits", Mark::Ring, ORANGE, false), ("stable orbits", Mark::Disc, BLUE, true)];
    for (place, (name, mark, colour, stable)) in looks.into_iter().enumerate() {
        let own = row.found.iter().filter(|f| (f.radius < 1.0) == stable);
        let points: Vec<_> =
            own.flat_map(|f| f.multipliers.iter().map(|[re, im]| (*re, *im))).collect();
        let stroke = Stroke::solid(colour, THIN);
        panel.marks(name, &points, (mark, 32, stroke), Outside::Cut)?;
        let entry = Entry::mark((mark, MEDIUM, stroke), name);
        sheet.legend((5750, 8750 + 370 * place as i32), (SMALL, 370), &[entry])?;
    }
    Ok(())
}

fn description(orbits: &Orbits) -> String {
    let example = orbits.example.as_ref().map_or("none was found".into(), |own| {
        format!("σ = {}, largest multiplier {}", own.sigma, short(own.radius, 2))
    });
    format!(
        "(a) Positions of the masses over one period of a stable orbit ({example}), with a disc at each impact. (b) Share of simple \
         circuits with an orbit against σ, falling with their length; far below, dashed, with a stable one. (c) Multipliers: stable \
         ones inside the unit circle, unstable ones along the real axis.",
    )
}

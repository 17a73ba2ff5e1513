//! Fig. S8: what an impact costs against the number of masses, counted and measured.

use super::prelude::*;
use super::rivals::{Timed, by_method, entries, look, most_accurate, timed};
use crate::experiments::Measured;
use crate::experiments::accuracy::scale::Scale as Costs;
use crate::experiments::accuracy::tables::name;
use crate::experiments::measured::{Measurement, What};
use crate::params::MethodName;

/// The measured times of the engine with one chain on one thread.
fn own(measured: &Measured) -> Vec<&Measurement> {
    measured.of(What::Engine).filter(|row| row.chains == 1 && row.note.is_empty()).collect()
}

pub fn draw(scale: &Costs, measured: &Measured) -> Result<Figure, Error> {
    let sheet = Sheet::new(12_800);
    let own = own(measured);
    // Somewhat wider than the sizes, which would stand on the other axis.
    let masses = || Axis::decades(0, 5, 1, "number of masses *n*").from(7.0, 1.4e4);
    let work = scale.iter().map(|row| row.2);
    let (x, y) = (masses().bare(), Axis::around(work, 1, "evaluations per impact"));
    let counted = sheet.lettered(LETTERS[0], Frame::new(1200, 430, 8150, 2730), x, y)?;
    let all = by_method(scale, |row| Some((row.0.method, (row.1 as f64, row.2))));
    for (method, points) in &all {
        let look = look(*method);
        counted.marked(name(*method), points, (look.2, look), Outside::Refuse)?;
    }

    let programs = timed(measured);
    let times = own.iter().filter_map(|row| row.microseconds_per_impact);
    let (x, y) =
        (masses(), Axis::around(times, 1, "µs per impact").finely().column("time per impact (us)"));
    let clock = sheet.lettered(LETTERS[1], Frame::new(1200, 3450, 8150, 5150), x, y)?;
    let red = look(MethodName::Certified);
    let line: Vec<_> =
        own.iter().filter_map(|row| Some((row.n as f64, row.microseconds_per_impact?))).collect();
    clock.marked("this engine", &line, (red.2, red), Outside::Refuse)?;
    let words = (TINY, INK, HPos::Right, VPos::Bottom);
    let told = format!("measured on {}", measured.date);
    clock.note(&told, (clock.x.hi, clock.y.hi), (0, -80), words)?;

    let legend = entries(|method| all.iter().any(|(own, _)| *own == method));
    sheet.legend((500, 6350), (SMALL, 370), (2, 2650), &legend)?;
    ranked(&sheet, &most_accurate(&programs))?;
    Ok(sheet.finish("s08", "Cost of an impact against n", description(scale, measured)))
}

/// A row for each program at its most accurate setting, the fastest at the top.
fn ranked(sheet: &Sheet, programs: &[&Timed]) -> Result<(), Error> {
    const ROW: i32 = 330;
    let mut sizes: Vec<u64> = programs.iter().map(|row| row.masses).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let largest = sizes.last().copied().unwrap_or(0);
    let mut rows: Vec<&Timed> =
        programs.iter().copied().filter(|row| row.masses == largest).collect();
    rows.sort_by(|a, b| a.microseconds.total_cmp(&b.microseconds));
    let count = rows.len() as i32;
    let top = 7500;
    let times = programs.iter().map(|row| row.microseconds);
    let places = Axis::new(Scale::Linear, [-0.5, f64::from(count) - 0.5], "", Vec::new());
    let x =
        Axis::around(times, 1, "measured µs per impact").column("measured time per impact (us)");
    let y = places.column("place from below (1)");
    let panel = sheet.panel(Frame::new(2900, top, 8150, top + ROW * count), x, y)?;
    let panel = panel.file("c");
    sheet.text(LETTERS[2], (260, top - 80), (TEXT, INK, HPos::Left, VPos::Bottom))?;
    // The smaller disc leaves the ring to be seen.
    let line = Stroke::solid(INK, THIN);
    let marks = [(Mark::Ring, LARGE, line), (Mark::Disc, 36, line)];
    for (place, own) in rows.iter().enumerate() {
        let y = f64::from(count - 1) - place as f64;
        let title: &str = match own.method {
            Some(method) => name(method),
            None => &own.name,
        };
        let colour = if own.method == Some(MethodName::Certified) { RED } else { INK };
        let words = (SMALL, colour, HPos::Right, VPos::Center);
        panel.note(title, (panel.x.lo, y), (-120, 0), words)?;
        let guide = Stroke::dashed(PALE, HAIR, Dash::Dotted);
        panel.level("row", y, guide)?;
        for (masses, mark) in sizes.iter().zip(marks) {
            let alike = |row: &&&Timed| row.name == own.name && row.masses == *masses;
            let at: Vec<_> =
                programs.iter().filter(alike).map(|row| (row.microseconds, y)).collect();
            panel.record(&format!("{title}, n = {masses}"), at.iter().copied());
            panel.quiet().marks(title, &at, mark, Outside::Refuse)?;
        }
    }
    let entry = |(masses, mark): (&u64, _)| Entry::mark(mark, &format!("*n* = {masses}"));
    let entries: Vec<_> = sizes.iter().zip(marks).map(entry).collect();
    sheet.legend((2900, top + ROW * count + 1100), (SMALL, 370), (1, 2300), &entries)
}

fn description(scale: &Costs, measured: &Measured) -> Seen {
    let most = scale.iter().rfind(|row| row.0.method == MethodName::Certified);
    let counted =
        most.map_or("none".into(), |(_, n, work)| format!("{} at n = {n}", short(*work, 2)));
    let last = own(measured).last().and_then(|row| Some((row.n, row.microseconds_per_impact?)));
    let timed = last.map_or("none".into(), |(n, time)| format!("{} at n = {n}", short(time, 2)));
    seen!(
        "Cost against the number of masses n, all axes logarithmic. (a) Evaluations per impact: this engine lowest and nearly level, \
         {counted}; Runge–Kutta grows with n. (b) Microseconds per impact of this engine, {timed}. (c) Programs by their time, this engine first."
    )
}

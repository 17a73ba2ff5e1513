//! Fig. S15: what an impact costs against the number of masses, counted and measured.

use plotters::style::text_anchor::{HPos, VPos};

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::data::cells;
use super::panel::Frame;
use super::rivals::{
    HALF, Timed, by_method, decades_around, entries, look, most_accurate, name, timed,
};
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{Dash, HAIR, INK, Mark, PALE, RED, SMALL, Stroke, TEXT, THIN, TINY};
use super::{DataFile, Error, Figure};
use crate::experiments::Measured;
use crate::experiments::accuracy::scale::{Scale, ScaleRow};
use crate::experiments::measured::{Row, What};
use crate::params::MethodName;

/// The engine's own measured rows with their evaluations: one chain, one thread.
fn own(measured: &Measured) -> Vec<&Row> {
    measured.of(What::Engine).filter(|row| row.chains == 1 && row.note.is_empty()).collect()
}

/// Draws the figure.
pub fn draw(scale: &Scale, measured: &Measured, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(14_000, note)?;
    let own = own(measured);
    let sizes = scale.rows.iter().map(|row| row.masses as f64);
    let sizes = || sizes.clone().chain(own.iter().map(|row| row.n as f64));
    let masses = || decades_around(sizes(), 1, "number of masses *n*");
    let work = scale.rows.iter().map(|row| row.evaluations_per_impact);
    let counted = sheet.panel(
        Frame::new(1200, 430, 8150, 3230),
        masses().bare(),
        decades_around(work, 1, "evaluations per impact"),
    )?;
    counted.letter(LETTERS[0])?;
    let point = |row: &ScaleRow| Some((log(row.masses as f64), log(row.evaluations_per_impact)));
    let all = by_method(&scale.rows, |row| row.setting, point);
    for (method, points) in &all {
        let look = look(*method);
        counted.curve(name(*method), points, look.line(), Outside::Refuse)?;
        counted.marks(name(*method), points, look.marker(), Outside::Refuse)?;
    }
    // Sizes beyond what the report runs, counted when they were timed.
    let largest = scale.rows.iter().map(|row| row.masses as u64).max().unwrap_or(0);
    let beyond: Vec<_> = own
        .iter()
        .filter(|row| row.n > largest)
        .filter_map(|row| Some((log(row.n as f64), log(row.evaluations_per_impact?))))
        .collect();
    let red = look(MethodName::Certified);
    let open = (Mark::Ring, HALF, Stroke::solid(red.colour, THIN));
    counted.marks("counted when timed", &beyond, open, Outside::Cut)?;

    let programs: Vec<Timed> = timed(measured)
        .into_iter()
        .filter(|row| row.horizon.is_some() && row.name != MethodName::Certified.id())
        .collect();
    let programs = most_accurate(&programs);
    let clock = sheet.panel(
        Frame::new(1200, 3950, 8150, 5650),
        masses(),
        decades_around(
            own.iter().filter_map(|row| row.microseconds_per_impact),
            1,
            "µs per impact",
        ),
    )?;
    clock.letter(LETTERS[1])?;
    let line: Vec<_> = own
        .iter()
        .filter_map(|row| Some((log(row.n as f64), log(row.microseconds_per_impact?))))
        .collect();
    clock.curve("this engine", &line, red.line(), Outside::Refuse)?;
    clock.marks("this engine", &line, red.marker(), Outside::Refuse)?;
    let words = (TINY, INK, HPos::Right, VPos::Bottom);
    let told = format!("measured on {}", measured.date);
    clock.note(&told, (clock.x.hi, clock.y.hi), (0, -80), words)?;

    let mut legend = entries(|method| all.iter().any(|(own, _)| *own == method));
    legend.push(Entry::mark(Mark::Ring, HALF, Stroke::solid(red.colour, THIN), "when timed"));
    for (i, column) in legend.chunks(2).enumerate() {
        sheet.legend((500 + 2650 * i as i32, 6850), (SMALL, 370), column)?;
    }
    ranked(&sheet, &programs)?;
    let files = vec![table(scale), clock_table(measured)];
    Ok(sheet.finish("s15", "Cost of an impact against n", description(scale, measured), files))
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
    let top = 8300;
    let panel = sheet.panel(
        Frame::new(2900, top, 8150, top + ROW * count),
        decades_around(programs.iter().map(|row| row.microseconds), 1, "measured µs per impact"),
        Axis { lo: -0.5, hi: f64::from(count) - 0.5, label: String::new(), ticks: Vec::new() },
    )?;
    sheet.text(LETTERS[2], (260, top - 80), (TEXT, INK, HPos::Left, VPos::Bottom))?;
    let marks = [Mark::Ring, Mark::Disc];
    for (place, own) in rows.iter().enumerate() {
        let y = f64::from(count - 1) - place as f64;
        let title: &str = match own.method {
            Some(method) => name(method),
            None => &own.name,
        };
        let words = (SMALL, INK, HPos::Right, VPos::Center);
        panel.note(title, (panel.x.lo, y), (-120, 0), words)?;
        let guide = Stroke::dashed(PALE, HAIR, Dash::Dotted);
        panel.curve("row", &[(panel.x.lo, y), (panel.x.hi, y)], guide, Outside::Refuse)?;
        let colour = if own.method == Some(MethodName::Certified) { RED } else { INK };
        for (masses, mark) in sizes.iter().zip(marks) {
            let alike = |row: &&&Timed| row.name == own.name && row.masses == *masses;
            let at: Vec<_> =
                programs.iter().filter(alike).map(|row| (log(row.microseconds), y)).collect();
            panel.marks(title, &at, (mark, HALF, Stroke::solid(colour, THIN)), Outside::Refuse)?;
        }
    }
    for (i, (masses, mark)) in sizes.iter().zip(marks).enumerate() {
        let text = format!("*n* = {masses}");
        let entry = Entry::mark(mark, HALF, Stroke::solid(INK, THIN), &text);
        let at = (2900 + 2300 * i as i32, top + ROW * count + 1150);
        sheet.legend(at, (SMALL, 370), &[entry])?;
    }
    Ok(())
}

fn description(scale: &Scale, measured: &Measured) -> String {
    let certified = |row: &&ScaleRow| row.setting.method == MethodName::Certified;
    let most = scale.rows.iter().rfind(certified);
    let counted = most.map_or("none".into(), |row| {
        format!("{} at n = {}", short(row.evaluations_per_impact, 2), row.masses)
    });
    let last = own(measured).last().and_then(|row| Some((row.n, row.microseconds_per_impact?)));
    let timed = last.map_or("none".into(), |(n, time)| format!("{} at n = {n}", short(time, 2)));
    format!(
        "Cost against the number of masses n, all axes logarithmic. (a) Evaluations per impact: this engine lowest and nearly level, \
         {counted}; Runge–Kutta grows with n. (b) Microseconds per impact of this engine, {timed}. (c) Programs by their time, this engine first."
    )
}

fn table(scale: &Scale) -> DataFile {
    let mut file = DataFile::new(
        "s15.csv",
        &[
            "method",
            "step_or_tolerance (1/omega)",
            "n (1)",
            "time (1/omega)",
            "impacts (1)",
            "steps_per_impact (1)",
            "evaluations_per_impact (1)",
        ],
    );
    for row in &scale.rows {
        let value = (row.setting.method != MethodName::Certified).then_some(row.setting.value);
        file.row(cells![
            name(row.setting.method),
            value,
            row.masses,
            row.until,
            row.impacts,
            row.steps_per_impact,
            row.evaluations_per_impact
        ]);
    }
    file
}

fn clock_table(measured: &Measured) -> DataFile {
    let mut file = DataFile::new(
        "s15-measured.csv",
        &[
            "program",
            "version (text)",
            "settings (text)",
            "n (1)",
            "microseconds_per_impact (us)",
            "evaluations_per_impact (1)",
        ],
    );
    let timed = measured.rows.iter().filter(|row| row.chains == 1);
    for row in timed.filter(|row| row.microseconds_per_impact.is_some()) {
        file.row(cells![
            row.name.as_str(),
            row.version.as_str(),
            row.settings.as_str(),
            row.n,
            row.microseconds_per_impact,
            row.evaluations_per_impact
        ]);
    }
    file
}

//! Fig. S15: what an impact costs against the number of masses, counted and measured.

use plotters::style::text_anchor::{HPos, VPos};

use super::axis::log;
use super::chart::{LETTERS, short};
use super::data::cells;
use super::panel::Frame;
use super::rivals::{
    HALF, Timed, by_method, decades_around, entries, entries_of_others, look, look_of,
    most_accurate, name, others, timed,
};
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{INK, Mark, SMALL, Stroke, THIN, TINY};
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
    let sheet = Sheet::new(9550, note)?;
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
        .filter(|row| row.method != Some(MethodName::Certified) && row.horizon.is_some())
        .collect();
    let programs = most_accurate(&programs);
    let times = own.iter().filter_map(|row| row.microseconds_per_impact);
    let times = times.chain(programs.iter().map(|row| row.microseconds));
    let clock = sheet.panel(
        Frame::new(1200, 3950, 8150, 6550),
        masses(),
        decades_around(times, 1, "measured µs per impact"),
    )?;
    clock.letter(LETTERS[1])?;
    let line: Vec<_> = own
        .iter()
        .filter_map(|row| Some((log(row.n as f64), log(row.microseconds_per_impact?))))
        .collect();
    clock.curve("this engine", &line, red.line(), Outside::Refuse)?;
    clock.marks("this engine", &line, red.marker(), Outside::Refuse)?;
    let whole = timed(measured);
    let others = others(&whole);
    for row in &programs {
        let at = [(log(row.masses as f64), log(row.microseconds))];
        clock.marks(&row.name, &at, look_of(row, &others).marker(), Outside::Refuse)?;
    }
    let words = (TINY, INK, HPos::Right, VPos::Bottom);
    let told = format!("measured on {}", measured.date);
    clock.note(&told, (clock.x.hi, clock.y.hi), (0, -80), words)?;

    let timed_too = |method| programs.iter().any(|row| row.method == Some(method));
    let counted_too = |method| all.iter().any(|(m, _)| *m == method);
    let mut legend = entries(|method| counted_too(method) || timed_too(method));
    legend.extend(entries_of_others(&others));
    legend.push(Entry::mark(Mark::Ring, HALF, Stroke::solid(red.colour, THIN), "when timed"));
    for (i, column) in legend.chunks(5).enumerate() {
        sheet.legend((500 + 2650 * i as i32, 7800), (SMALL, 370), column)?;
    }
    let files = vec![table(scale), clock_table(measured)];
    Ok(sheet.finish("s15", "Cost of an impact against n", description(scale, measured), files))
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
         {counted}; Runge–Kutta grows with n. (b) Microseconds per impact: this engine lowest, {timed}, the other programs \
         above it."
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

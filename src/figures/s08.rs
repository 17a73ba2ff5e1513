//! Draws Fig. S8: in how many cases of each scene each method and each program fails, and how.

use super::prelude::*;
use crate::experiments::accuracy::case::Outcome::{self, *};
use crate::experiments::accuracy::trials::{Trial, right};
use crate::experiments::{PROGRAMS, TRIALS};

/// How cases end that are not right, from the bottom of a tile upwards.
const FAILURES: [(&str, RGBColor, &[Outcome]); 3] = [
    ("missed", RED, &[Missed]),
    ("late, ghost, or wrong speed", ORANGE, &[Late, Ghost, WrongSpeed, WrongRest]),
    ("announced", GREY, &[GaveUp, Refused, Warned]),
];

/// Where the tiles begin, how far one row of them is from the next, and how high they are.
const LEFT: i32 = 2950;
const TOP: i32 = 1850;
const ROW: i32 = 600;
const HEIGHT: i32 = 420;

/// Between two tiles.
const SPACE: i32 = 18;

/// A method or a program: its name, and for each of its settings the trial in each scene.
type Group<'a> = (&'a str, Vec<Vec<&'a Trial>>);

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let trials = results.of(&TRIALS)?;
    let scenes = &trials.parameters.scenes;
    let own = trials.parameters.settings.iter().enumerate().map(|(place, setting)| {
        let column = trials.trials.iter().map(|row| &row[place]);
        (setting.method.title(), column.collect::<Vec<_>>())
    });
    let others = results.of(&PROGRAMS)?.iter().flat_map(|program| &program.settings);
    let others = others.map(|run| (&*run.name, scenes.iter().map(|s| run.trial(s)).collect()));
    let mut groups: Vec<Group> = Vec::new();
    for (name, trials) in own.chain(others) {
        match groups.last_mut().filter(|group| group.0 == name) {
            Some(group) => group.1.push(trials),
            None => groups.push((name, vec![trials])),
        }
    }
    let methods = trials.parameters.settings.chunk_by(|a, b| a.method == b.method).count();
    let count = scenes.len() as i32;
    let sheet = Sheet::new((TOP + ROW * count + 850) as u32);
    let frame = Frame::new(LEFT, TOP, 8350, TOP + ROW * count);
    let x = Axis::linear(0.0, 1.0, 1.0, 1, "").column("scene (1)");
    let y = Axis::linear(0.5, f64::from(count) + 0.5, 1.0, 1, "").column("share right (1)");
    let panel = sheet.bare_panel(frame, x, y)?;
    let name = words(SMALL, INK, HPos::Right, VPos::Center);
    for (row, scene) in (0..).zip(scenes) {
        let (first, second) = in_two(&scene.title);
        for (line, down) in [(first, -140), (second, 140)] {
            sheet.area.draw_text(line, &name, (LEFT - 130, TOP + ROW * row + ROW / 2 + down))?;
        }
    }
    let settings: usize = groups.iter().map(|group| group.1.len()).sum();
    let width = (frame.right - LEFT - 240 - 60 * groups.len() as i32) / settings as i32;
    let mut left = LEFT;
    let head = words(SMALL, INK, HPos::Left, VPos::Center).transform(FontTransform::Rotate270);
    for (i, (name, settings)) in groups.iter().enumerate() {
        let middle = left + width * settings.len() as i32 / 2;
        sheet.area.draw_text(name, &head, (middle, TOP - 100))?;
        let bracket = [left, 2 * middle - left - SPACE].map(|x| (x, TOP - 30));
        sheet.area.draw(&line(bracket.into(), Stroke::solid(INK, HAIR)))?;
        for (place, trials) in settings.iter().enumerate() {
            let share = |trial: &Trial| right(trial) as f64 / trial.len() as f64;
            let shares = (1..).map(f64::from).zip(trials.iter().map(|trial| share(trial)));
            panel.record(&format!("{name}, {}", place + 1), shares);
            for (row, trial) in (0..).zip(trials) {
                let top = TOP + ROW * row + (ROW - HEIGHT) / 2;
                tile(&sheet, Frame::new(left, top, left + width - SPACE, top + HEIGHT), trial)?;
            }
            left += width;
        }
        // What is not of this program stands apart.
        left += if i + 1 == methods { 300 } else { 60 };
    }
    let key = words(SMALL, INK, HPos::Left, VPos::Center);
    let (y, size) = (frame.bottom + 400, 200);
    let all_right = ("right", GREEN, &[Right][..]);
    for ((name, _, outcomes), x) in [all_right].iter().chain(&FAILURES).zip([240, 1420, 2850, 6430])
    {
        tile(&sheet, Frame::new(x, y, x + size, y + size), &vec![outcomes[0]])?;
        sheet.area.draw_text(name, &key, (x + size + 70, y + size / 2))?;
    }
    let description = describe!(
        "A row for each of {count} scenes, with a tile for each setting of {} methods and programs, filled as far as its cases fail. The \
         engine, at the left, is right in all cases of {} scenes.",
        groups.len(),
        trials.trials.iter().filter(|row| right(&row[0]) == row[0].len()).count(),
    );
    Ok(sheet.finish("Where methods and programs fail", description))
}

/// Breaks a title at the space nearest to its middle, but not next to "=".
fn in_two(title: &str) -> (&str, &str) {
    let is_free = |at: &usize| !title[..*at].ends_with('=') && !title[*at..].starts_with(" =");
    let spaces = title.match_indices(' ').map(|space| space.0).filter(is_free);
    title.split_at(spaces.min_by_key(|at| at.abs_diff(title.len() / 2)).unwrap_or(0))
}

/// Draws a tile, filled from below by each kind of failure as far as its share of the cases.
fn tile(sheet: &Sheet, Frame { left, top, right, bottom }: Frame, trial: &Trial) -> Drawn {
    sheet.area.draw(&Rectangle::new([(left, top), (right, bottom)], GREEN.mix(0.3).filled()))?;
    let (mut failures, mut base) = (0, bottom);
    for (_, colour, outcomes) in FAILURES {
        failures += trial.iter().filter(|outcome| outcomes.contains(outcome)).count();
        let upper = bottom - (bottom - top) * failures as i32 / trial.len() as i32;
        if upper < base {
            sheet.area.draw(&Rectangle::new([(left, upper), (right, base)], colour.filled()))?;
        }
        base = upper;
    }
    Ok(())
}

//! Fig. S12: error and misses of the next impact against counted work, for every method.

use plotters::style::text_anchor::{HPos, VPos};

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::data::cells;
use super::panel::Frame;
use super::rivals::{by_method, decades_around, entries, look, name};
use super::series::Outside;
use super::sheet::Sheet;
use super::style::{Dash, GREY, HAIR, INK, SMALL, Stroke, TINY};
use super::{DataFile, Error, Figure};
use crate::experiments::accuracy::race::{DISPLACED, Entry, Race};
use crate::params::MethodName;

fn table(race: &Race) -> DataFile {
    let mut file = DataFile::new(
        "s12.csv",
        &[
            "method",
            "step_or_tolerance (1/omega)",
            "evaluations_per_impact (1)",
            "steps_per_impact (1)",
            "segments (1)",
            "unseen (1)",
            "wrong_gap (1)",
            "displaced (1)",
            "failed (1)",
            "error_median (1/omega)",
            "error_90 (1/omega)",
            "error_largest (1/omega)",
        ],
    );
    for entry in &race.entries {
        let s = &entry.segments;
        let error = |i: usize| s.errors.map(|errors| errors[i]);
        let value = (entry.setting.method != MethodName::Certified).then_some(entry.setting.value);
        file.row(cells![
            name(entry.setting.method),
            value,
            entry.evaluations_per_impact,
            entry.steps_per_impact,
            s.tried,
            s.unseen,
            s.wrong_gap,
            s.displaced,
            s.failed,
            error(0),
            error(1),
            error(2)
        ]);
    }
    file
}
